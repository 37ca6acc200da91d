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
#include <utility>

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

/// Appends the hits of a ray in a cell, in order along the ray. Behind an opaque hit there may be
/// more.
template <typename Value>
void IntersectCell(const Ray& ray, const Index3& cell, const Value corners[8],
  const std::vector<Isosurface>& surfaces, std::vector<Hit>& hits)
{
  CellSegment segment;
  if (!IsFinite(corners) || !SegmentInCell(ray, cell, segment))
  {
    return;
  }
  const std::size_t before = hits.size();
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    const Isosurface& surface = surfaces[i];
    // The isovalue is taken off first: the sign of the difference is exact.
    CellCorners difference;
    for (std::size_t corner = 0; corner < 8; ++corner)
    {
      difference[corner] = static_cast<double>(corners[corner]) - surface.Isovalue;
    }
    Robust::ForEachRoot(CubicAlongSegment(difference, segment.Entry, segment.Exit),
      [&](double u, bool rising)
      {
        hits.push_back({ ray.Base + Lerp(segment.Begin, segment.End, u), cell, static_cast<int>(i),
          { Lerp(segment.Entry[0], segment.Exit[0], u), Lerp(segment.Entry[1], segment.Exit[1], u),
            Lerp(segment.Entry[2], segment.Exit[2], u) },
          rising });
        return surface.Opacity >= 1.0;
      });
  }
  if (hits.size() > before + 1)
  {
    // Surfaces met at one t are met in the order of their values.
    std::stable_sort(hits.begin() + static_cast<std::ptrdiff_t>(before), hits.end(),
      [&surfaces](const Hit& a, const Hit& b)
      {
        const auto order = [&surfaces](const Hit& hit)
        {
          const double isovalue = surfaces[static_cast<std::size_t>(hit.Surface)].Isovalue;
          return std::make_pair(hit.T, hit.Rising ? isovalue : -isovalue);
        };
        return order(a) < order(b);
      });
  }
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
    if (!sameIsovalues)
    {
      std::vector<double> isovalues;
      for (const Isosurface& surface : surfaces)
      {
        isovalues.push_back(surface.Isovalue);
      }
      this->Active = this->Hierarchy.FindActive(isovalues, threads);
    }
  }

  void Trace(const Ray& ray, std::vector<Hit>& hits) override
  {
    typename Layout::Reader reader(this->Bricks);
    double transmittance = 1.0;
    TraverseCells(ray, this->Active,
      [&](const Index3& cell)
      {
        typename Layout::Value corners[8];
        reader.Load(cell, corners);
        if (!HasSurface(corners, this->Surfaces))
        {
          return false;
        }
        std::size_t last = hits.size();
        IntersectCell(ray, cell, corners, this->Surfaces, hits);
        for (; last < hits.size(); ++last)
        {
          transmittance *=
            1.0 - this->Surfaces[static_cast<std::size_t>(hits[last].Surface)].Opacity;
          if (transmittance < NegligibleTransmittance)
          {
            hits.resize(last + 1);
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
