// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "TracedVolume.h"

#include "AnalyticSolver.h"
#include "ApronBricks.h"
#include "CellSegment.h"
#include "CellTraversal.h"
#include "FastSolver.h"
#include "LinearSolver.h"
#include "MacrocellHierarchy.h"
#include "MarmittSolver.h"
#include "RobustSolver.h"
#include "TrilinearCell.h"
#include "TwoLevelBricks.h"
#include "Unbricked.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

/// Whether a surface of the isovalue passes between corners of these values.
template <typename Value>
bool Straddles(const Value corners[8], double isovalue)
{
  const auto range = std::minmax_element(corners, corners + 8);
  return static_cast<double>(*range.first) < isovalue &&
    isovalue <= static_cast<double>(*range.second);
}

/// The isovalue is taken off first: the sign of the difference is exact.
template <typename Value>
CellCorners Difference(const Value corners[8], double isovalue)
{
  CellCorners difference;
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    difference[corner] = static_cast<double>(corners[corner]) - isovalue;
  }
  return difference;
}

template <typename Visit>
void ForEachRoot(const CellCorners& difference, const CellSegment& segment, const Wanted& wanted,
  const Visit& visit)
{
  switch (wanted.Solver)
  {
    case RootSolver::Analytic:
      return Analytic::ForEachRoot(difference, segment, visit);
    case RootSolver::Marmitt:
      return Marmitt::ForEachRoot(difference, segment, wanted.Interpolations, visit);
    case RootSolver::Linear:
      return Linear::ForEachRoot(difference, segment, visit);
    default:
      return Robust::ForEachRoot(difference, segment, visit);
  }
}

Hit MakeHit(const Ray& ray, const Index3& cell, const CellSegment& segment, int surface, double u,
  bool rising)
{
  return { ray.Base + Lerp(segment.Begin, segment.End, u), cell, surface,
    { Lerp(segment.Entry[0], segment.Exit[0], u), Lerp(segment.Entry[1], segment.Exit[1], u),
      Lerp(segment.Entry[2], segment.Exit[2], u) },
    rising };
}

/// Puts the hits in one cell, of several surfaces, in order along the ray. Surfaces met at one t
/// are met in the order of their values.
void SortHits(std::vector<Hit>::iterator first, std::vector<Hit>::iterator last,
  const std::vector<Isosurface>& surfaces)
{
  const auto order = [&surfaces](const Hit& hit)
  {
    const double isovalue = surfaces[static_cast<std::size_t>(hit.Surface)].Isovalue;
    return std::make_pair(hit.T, hit.Rising ? isovalue : -isovalue);
  };
  std::stable_sort(
    first, last, [&order](const Hit& a, const Hit& b) { return order(a) < order(b); });
}

/// What a ray has met on its way, and how much of it is left.
class RayProgress
{
public:
  explicit RayProgress(const Wanted& wanted)
    : Want(&wanted)
  {
  }

  /// Passes the hits of a cell, those from the given one on, front to back. If nothing of the ray
  /// is left behind one of them, drops the rest and returns true.
  bool Pass(std::vector<Hit>& hits, std::size_t first)
  {
    if (hits.size() > first + 1)
    {
      SortHits(hits.begin() + static_cast<std::ptrdiff_t>(first), hits.end(), this->Want->Surfaces);
    }
    for (std::size_t i = first; i < hits.size(); ++i)
    {
      this->Transmittance *=
        1.0 - this->Want->Surfaces[static_cast<std::size_t>(hits[i].Surface)].Opacity;
      if (this->Transmittance < NegligibleTransmittance)
      {
        hits.resize(i + 1);
        return true;
      }
    }
    return false;
  }

private:
  const Wanted* Want;
  double Transmittance = 1.0;
};

/// A cell that a ray may hit, queued for the fast solver.
struct Candidate
{
  std::size_t Ray;
  Index3 Cell;
  int Surface;
  CellSegment Segment;
  std::array<float, 8> Difference;
};

/// A ray that is followed side by side with others.
struct Follower
{
  std::size_t Ray;
  MacrocellWalk Macrocells;
  RayProgress Progress;
  /// The walk over the cells of the macrocell that the ray is in, if any.
  LatticeWalk Cells;
  bool IsInRegion = false;
  /// How many of its hits it has passed.
  std::size_t Passed = 0;
};

/// The corners in single precision: in the range where squares are safe, and each with its sign.
std::array<float, 8> ToSinglePrecision(const CellCorners& difference)
{
  double size = 0.0;
  for (const double value : difference)
  {
    size = std::max(size, std::abs(value));
  }
  const bool isSafe = size >= Fast::Smallest && size <= Fast::Largest;
  const int exponent = isSafe ? 0 : std::clamp(-std::ilogb(size), -1000, 1000);
  std::array<float, 8> result;
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    const double value = isSafe ? difference[corner] : std::ldexp(difference[corner], exponent);
    result[corner] = static_cast<float>(value);
    if (result[corner] == 0.0F && value < 0.0)
    {
      result[corner] = -std::numeric_limits<float>::denorm_min();
    }
  }
  return result;
}

/// Calls visit(candidate, u, rising) for the roots of all candidates, in order.
template <typename Visit>
void SolveCandidates(
  const std::vector<Candidate>& candidates, const Wanted& wanted, const Visit& visit)
{
  const bool opaque = std::all_of(wanted.Surfaces.begin(), wanted.Surfaces.end(),
    [](const Isosurface& surface) { return surface.Opacity >= 1.0; });
  Fast::Batch batch = {};
  Fast::Roots roots;
  for (std::size_t first = 0; first < candidates.size(); first += Fast::Lanes)
  {
    const std::size_t lanes = std::min<std::size_t>(Fast::Lanes, candidates.size() - first);
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      const Candidate& candidate = candidates[first + lane];
      for (std::size_t corner = 0; corner < 8; ++corner)
      {
        batch.Difference[corner][lane] = candidate.Difference[corner];
      }
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        batch.Entry[axis][lane] = static_cast<float>(candidate.Segment.Entry[axis]);
        batch.Exit[axis][lane] = static_cast<float>(candidate.Segment.Exit[axis]);
      }
    }
    Fast::Solve(batch, opaque, roots);
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      for (std::size_t piece = 0; piece < 3; ++piece)
      {
        if (roots.Found[piece][lane] != 0)
        {
          visit(candidates[first + lane], static_cast<double>(roots.U[piece][lane]),
            roots.Rising[piece][lane] != 0);
        }
      }
    }
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

  void Select(const Wanted& wanted, int threads) override
  {
    const bool sameIsovalues = std::equal(wanted.Surfaces.begin(), wanted.Surfaces.end(),
      this->Want.Surfaces.begin(), this->Want.Surfaces.end(),
      [](const Isosurface& a, const Isosurface& b) { return a.Isovalue == b.Isovalue; });
    this->Want = wanted;
    if (!sameIsovalues)
    {
      std::vector<double> isovalues;
      for (const Isosurface& surface : wanted.Surfaces)
      {
        isovalues.push_back(surface.Isovalue);
      }
      this->Active = this->Hierarchy.FindActive(isovalues, threads);
    }
  }

  void Trace(const std::vector<std::optional<Ray>>& rays, RayHits& hits) override
  {
    if (this->Want.Solver == RootSolver::Fast)
    {
      this->TraceTogether(rays, hits);
      return;
    }
    hits.Hits.clear();
    hits.First.assign(1, 0);
    for (const std::optional<Ray>& ray : rays)
    {
      if (ray)
      {
        this->TraceAlone(*ray, hits.Hits);
      }
      hits.First.push_back(hits.Hits.size());
    }
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
  /// Calls visit(surface, corners, segment) for the surfaces that may pass through a cell of a ray.
  template <typename Visit>
  void ExamineCell(
    typename Layout::Reader& reader, const Ray& ray, const Index3& cell, const Visit& visit)
  {
    typename Layout::Value corners[8];
    reader.Load(cell, corners);
    CellSegment segment;
    if (!HasSurface(corners, this->Want.Surfaces) || !IsFinite(corners) ||
      !SegmentInCell(ray, cell, segment))
    {
      return;
    }
    for (std::size_t i = 0; i < this->Want.Surfaces.size(); ++i)
    {
      const Isosurface& surface = this->Want.Surfaces[i];
      if (Straddles(corners, surface.Isovalue))
      {
        visit(static_cast<int>(i), Difference(corners, surface.Isovalue), segment);
      }
    }
  }

  /// Follows one ray to its end, solving cell by cell.
  void TraceAlone(const Ray& ray, std::vector<Hit>& hits)
  {
    typename Layout::Reader reader(this->Bricks);
    RayProgress progress(this->Want);
    TraverseCells(ray, this->Active,
      [&](const Index3& cell)
      {
        const std::size_t first = hits.size();
        this->ExamineCell(reader, ray, cell,
          [&](int surface, const CellCorners& difference, const CellSegment& segment)
          {
            const bool opaque =
              this->Want.Surfaces[static_cast<std::size_t>(surface)].Opacity >= 1.0;
            ForEachRoot(difference, segment, this->Want,
              [&](double u, bool rising)
              {
                hits.push_back(MakeHit(ray, cell, segment, surface, u, rising));
                return opaque;
              });
          });
        return hits.size() > first && progress.Pass(hits, first);
      });
  }

  /// Follows rays side by side, each from one cell that it may hit to the next. The cells of all
  /// rays are solved together.
  void TraceTogether(const std::vector<std::optional<Ray>>& rays, RayHits& result)
  {
    std::vector<Follower> followers;
    std::vector<std::size_t> going;
    followers.reserve(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      if (rays[i])
      {
        going.push_back(followers.size());
        followers.push_back(
          { i, MacrocellWalk(*rays[i], this->Active), RayProgress(this->Want), {} });
      }
    }
    std::vector<std::vector<Hit>> hits(rays.size());
    std::vector<Candidate> candidates;
    while (!going.empty())
    {
      candidates.clear();
      const auto isAtEnd = [&](std::size_t i)
      {
        Follower& follower = followers[i];
        return !this->FindCandidates(*rays[follower.Ray], follower, candidates);
      };
      going.erase(std::remove_if(going.begin(), going.end(), isAtEnd), going.end());
      SolveCandidates(candidates, this->Want,
        [&](const Candidate& candidate, double u, bool rising)
        {
          hits[candidate.Ray].push_back(MakeHit(
            *rays[candidate.Ray], candidate.Cell, candidate.Segment, candidate.Surface, u, rising));
        });
      const auto isSpent = [&hits, &followers](std::size_t i)
      {
        Follower& follower = followers[i];
        std::vector<Hit>& own = hits[follower.Ray];
        const std::size_t first = std::exchange(follower.Passed, own.size());
        return own.size() > first && follower.Progress.Pass(own, first);
      };
      going.erase(std::remove_if(going.begin(), going.end(), isSpent), going.end());
    }
    result.Hits.clear();
    result.First.assign(1, 0);
    for (const std::vector<Hit>& own : hits)
    {
      result.Hits.insert(result.Hits.end(), own.begin(), own.end());
      result.First.push_back(result.Hits.size());
    }
  }

  /// Walks a ray on to the next cell that it may hit, and queues it. Returns false if there is
  /// none.
  bool FindCandidates(const Ray& ray, Follower& follower, std::vector<Candidate>& candidates)
  {
    const std::size_t before = candidates.size();
    typename Layout::Reader reader(this->Bricks);
    while (candidates.size() == before)
    {
      CellRegion region;
      if (!follower.IsInRegion)
      {
        if (!follower.Macrocells.Next(region))
        {
          return false;
        }
        follower.Cells = LatticeWalk(ray, 1, region.First, region.Last, region.Start);
      }
      LatticeWalk walk = follower.Cells;
      do
      {
        const Index3 cell = walk.GetBlock();
        this->ExamineCell(reader, ray, cell,
          [&](int surface, const CellCorners& difference, const CellSegment& segment) {
            candidates.push_back(
              { follower.Ray, cell, surface, segment, ToSinglePrecision(difference) });
          });
        follower.IsInRegion = walk.Advance(walk.GetExit());
      } while (follower.IsInRegion && candidates.size() == before);
      follower.Cells = walk;
    }
    return true;
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
  Wanted Want;
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
