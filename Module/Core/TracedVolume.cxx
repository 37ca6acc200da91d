// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "TracedVolume.h"

#include "ApronBricks.h"
#include "CellSegment.h"
#include "CellTraversal.h"
#include "CubicRoots.h"
#include "MacrocellHierarchy.h"
#include "TrilinearCell.h"
#include "TwoLevelBricks.h"
#include "Unbricked.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Whether a ray may meet a surface in a cell: some corners are inside, others not. NaN compares
/// false; IsFinite settles what slips through.
template <typename Value>
bool HasSurface(const Value corners[8], const std::vector<Isosurface>& surfaces)
{
  Value low = corners[0];
  Value high = corners[0];
  for (int i = 1; i < 8; ++i)
  {
    low = std::min(low, corners[i]);
    high = std::max(high, corners[i]);
  }
  return std::any_of(surfaces.begin(), surfaces.end(),
    [low, high](const Isosurface& surface)
    {
      return static_cast<double>(low) < surface.Isovalue &&
        surface.Isovalue <= static_cast<double>(high);
    });
}

/// A cell with a corner that is NaN or infinite is empty.
template <typename Value>
bool IsFinite(const Value corners[8])
{
  if constexpr (std::is_floating_point_v<Value>)
  {
    return std::all_of(corners, corners + 8, [](Value v) { return std::isfinite(v); });
  }
  return true;
}

/// The power of two by which values are multiplied before the isovalue is taken off: 1, unless the
/// values are so large or small that products of differences overflow or vanish.
double GetScale(double low, double high, double isovalue)
{
  const double size = std::max(std::max(std::abs(low), std::abs(high)), std::abs(isovalue));
  const bool isExtreme = size < 0x1p-400 || size > 0x1p400;
  return isExtreme && std::isfinite(size) && size > 0.0
    ? std::ldexp(1.0, std::clamp(-std::ilogb(size), -1000, 1000))
    : 1.0;
}

/// The difference between a value and the isovalue. Its sign is exact.
double Difference(double value, double isovalue, double scale)
{
  const double difference = value * scale - isovalue * scale;
  if (std::abs(difference) >= SmallestDifference)
  {
    return difference;
  }
  return value < isovalue ? -SmallestDifference : (value > isovalue ? SmallestDifference : 0.0);
}

/// A root along the segment of a ray in a cell.
struct Root
{
  /// As a fraction of the segment.
  double Fraction;
  int Surface;
  bool Rising;
};

/// The roots in a cell of several surfaces, in order along the ray.
class CellRoots
{
public:
  /// Starts with the roots of the next surface. Surfaces come in the order of their isovalues.
  void NextSurface() { this->FirstAllowed = 0; }

  /// Adds a root behind those of the same surface. Where surfaces are met at one place, a ray that
  /// goes in meets the smaller isovalue first, and a ray that goes out the larger one.
  void Add(const Root& root)
  {
    const auto first = this->Roots.begin() + this->FirstAllowed;
    const auto place = root.Rising
      ? std::upper_bound(first, this->Roots.end(), root.Fraction,
          [](double fraction, const Root& other) { return fraction < other.Fraction; })
      : std::lower_bound(first, this->Roots.end(), root.Fraction,
          [](const Root& other, double fraction) { return other.Fraction < fraction; });
    this->FirstAllowed = place - this->Roots.begin() + 1;
    this->Roots.insert(place, root);
  }

  void Clear() { this->Roots.clear(); }
  const std::vector<Root>& Get() const { return this->Roots; }

private:
  std::vector<Root> Roots;
  std::ptrdiff_t FirstAllowed = 0;
};

Hit MakeHit(const Ray& ray, const Index3& cell, const CellSegment& segment, const Root& root)
{
  const double u = root.Fraction;
  Vector3 point;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    point[axis] = Lerp(segment.Entry[axis], segment.Exit[axis], u);
  }
  // Written so that it never falls as u grows.
  const double t = segment.Begin + (segment.End - segment.Begin) * u;
  return { ray.Base + std::min(t, segment.End), cell, root.Surface, point, root.Rising };
}

template <typename T, typename Layout>
class TypedVolume final : public TracedVolume
{
public:
  template <typename... LayoutArguments>
  TypedVolume(const Samples<T>& samples, const std::vector<int>& branching, int threads,
    LayoutArguments... arguments)
    : TheSamples(samples)
    , Hierarchy(samples, branching, threads)
    , Active(this->Hierarchy.GetLattice())
    , Bricks(samples, arguments...)
  {
  }

  void SelectSurfaces(const std::vector<Isosurface>& surfaces, int threads) override
  {
    const bool sameIsovalues =
      std::equal(surfaces.begin(), surfaces.end(), this->Surfaces.begin(), this->Surfaces.end(),
        [](const Isosurface& a, const Isosurface& b) { return a.Isovalue == b.Isovalue; });
    this->Surfaces = surfaces;
    if (sameIsovalues)
    {
      return;
    }
    const ValueRange<T>& range = this->Hierarchy.GetRange();
    std::vector<double> isovalues;
    this->Scales.clear();
    for (const Isosurface& surface : surfaces)
    {
      isovalues.push_back(surface.Isovalue);
      this->Scales.push_back(
        GetScale(static_cast<double>(range.Min), static_cast<double>(range.Max), surface.Isovalue));
    }
    this->Active = this->Hierarchy.FindActive(isovalues, threads);
  }

  void Trace(const Ray& ray, std::vector<Hit>& hits) override
  {
    typename Layout::Reader reader(this->Bricks);
    CellRoots roots;
    double transmittance = 1.0;
    TraverseCells(ray, this->Active,
      [&](const Index3& cell)
      {
        typename Layout::Value corners[8];
        reader.Load(cell, corners);
        CellSegment segment;
        if (!HasSurface(corners, this->Surfaces) || !IsFinite(corners) ||
          !SegmentInCell(ray, cell, segment))
        {
          return false;
        }
        this->FindRoots(corners, segment, roots);
        for (const Root& root : roots.Get())
        {
          hits.push_back(MakeHit(ray, cell, segment, root));
          transmittance *= 1.0 - this->Surfaces[static_cast<std::size_t>(root.Surface)].Opacity;
          if (transmittance < NegligibleTransmittance)
          {
            return true;
          }
        }
        return false;
      });
  }

  Vector3 GetGradient(const Hit& hit, NormalMode mode) const override
  {
    if (mode == NormalMode::CentralDifferences)
    {
      const Vector3 gradient = this->GetSmoothGradient(hit);
      if (std::isfinite(gradient[0]) && std::isfinite(gradient[1]) && std::isfinite(gradient[2]))
      {
        return gradient;
      }
      // Beside NaN or infinite samples there is no difference to take.
    }
    Stored<T> values[8];
    LoadCorners(this->TheSamples, hit.Cell, values);
    CellCorners corners;
    std::copy(values, values + 8, corners.begin());
    return InterpolantGradient(corners, hit.Parametric);
  }

  const Index3& GetDimensions() const override { return this->TheSamples.GetDimensions(); }
  std::size_t GetMacrocellMemory() const override { return this->Hierarchy.GetMemory(); }
  std::size_t GetBrickMemory() const override { return this->Bricks.GetMemory(); }
  std::size_t GetNumberOfBricks() const override { return this->Bricks.GetCounters().Bricks; }
  std::size_t GetMaximumNumberOfBricks() const override
  {
    return this->Bricks.GetMaximumNumberOfBricks();
  }
  std::int64_t GetBrickNanoseconds() const override
  {
    return this->Bricks.GetCounters().Nanoseconds;
  }

private:
  /// The roots of all surfaces in a cell, in order. Behind one of an opaque surface there may be
  /// more.
  void FindRoots(
    const typename Layout::Value corners[8], const CellSegment& segment, CellRoots& roots) const
  {
    roots.Clear();
    for (std::size_t i = 0; i < this->Surfaces.size(); ++i)
    {
      const Isosurface& surface = this->Surfaces[i];
      CellCorners differences;
      for (std::size_t corner = 0; corner < 8; ++corner)
      {
        differences[corner] =
          Difference(static_cast<double>(corners[corner]), surface.Isovalue, this->Scales[i]);
      }
      roots.NextSurface();
      Robust::ForEachRoot(CubicAlongSegment(differences, segment.Entry, segment.Exit),
        [&](double u, bool rising)
        {
          roots.Add({ u, static_cast<int>(i), rising });
          return surface.Opacity >= 1.0;
        });
    }
  }

  /// The central difference at a sample; at the border of the volume, the one-sided difference.
  double GetDifference(Index3 sample, std::size_t axis) const
  {
    const int place = sample[axis];
    const int next = std::min(place + 1, this->TheSamples.GetDimensions()[axis] - 1);
    const int previous = std::max(place - 1, 0);
    sample[axis] = next;
    const auto high = static_cast<double>(*this->TheSamples.At(sample));
    sample[axis] = previous;
    const auto low = static_cast<double>(*this->TheSamples.At(sample));
    return (high - low) / (next - previous);
  }

  Vector3 GetSmoothGradient(const Hit& hit) const
  {
    Vector3 gradient;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      CellCorners differences;
      for (int corner = 0; corner < 8; ++corner)
      {
        differences[static_cast<std::size_t>(corner)] =
          this->GetDifference({ hit.Cell[0] + (corner & 1), hit.Cell[1] + (corner >> 1 & 1),
                                hit.Cell[2] + (corner >> 2) },
            axis);
      }
      gradient[axis] = Interpolate(differences, hit.Parametric);
    }
    return gradient;
  }

  Samples<T> TheSamples;
  MacrocellHierarchy<T> Hierarchy;
  ActiveMacrocells Active;
  Layout Bricks;
  std::vector<Isosurface> Surfaces;
  /// For each surface, see GetScale.
  std::vector<double> Scales;
};

}

//------------------------------------------------------------------------------
std::unique_ptr<TracedVolume> TracedVolume::New(
  const VolumeView& view, const VolumeSettings& settings, int threads)
{
  return DispatchScalarType(view,
    [&settings, threads](const auto& samples) -> std::unique_ptr<TracedVolume>
    {
      using T = typename std::decay_t<decltype(samples)>::Value;
      const std::vector<int>& branching = settings.MacrocellBranching;
      switch (settings.Layout)
      {
        case BrickLayout::Unbricked:
          return std::make_unique<TypedVolume<T, Unbricked<T>>>(samples, branching, threads);
        case BrickLayout::TwoLevel:
          return std::make_unique<TypedVolume<T, TwoLevelBricks<T>>>(
            samples, branching, threads, settings.BrickSize, settings.BrickGroupSize);
        case BrickLayout::Apron:
          break;
      }
      return std::make_unique<TypedVolume<T, ApronBricks<T>>>(
        samples, branching, threads, settings.BrickSize);
    });
}

}
