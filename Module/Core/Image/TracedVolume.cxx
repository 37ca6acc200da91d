// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/TracedVolume.h"

#include "Image/Cells/BoxFaces.h"
#include "Image/Cells/CellSegment.h"
#include "Image/Cells/Solvers/AnalyticSolver.h"
#include "Image/Cells/Solvers/FastSolver.h"
#include "Image/Cells/Solvers/LinearSolver.h"
#include "Image/Cells/Solvers/MarmittSolver.h"
#include "Image/Cells/Solvers/RobustSolver.h"
#include "Image/Cells/TricubicField.h"
#include "Image/Macrocells/BlockTree.h"
#include "Image/Macrocells/CellMasks.h"
#include "Image/Macrocells/MacrocellHierarchy.h"
#include "Image/Samples/ApronBricks.h"
#include "Image/Samples/TwoLevelBricks.h"
#include "Image/Samples/Unbricked.h"
#include "Image/Traversal/Caps.h"
#include "Image/Traversal/CellTraversal.h"
#include "Image/Traversal/PacketTracer.h"
#include "Image/Traversal/Projection.h"
#include "Kernels/Kernels.h"
#include "Math/TrilinearCell.h"
#include "Rays/RayPacket.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

/// A root along the segment of a ray in a cell.
struct Root
{
  /// As a fraction of the segment.
  double Fraction;
  int Surface;
  bool Entering;
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
    const auto place = root.Entering
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
  return MakeHit(ray, cell, segment, root.Fraction, root.Surface, root.Entering);
}

template <typename Visit>
void ForEachRoot(const CellCorners& difference, const CellSegment& segment,
  const TraceRequest& wanted, const Visit& visit)
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

/// How much is left of a ray on its way.
class RayProgress
{
public:
  /// The dimensions are those of the volume, in samples.
  RayProgress(const TraceRequest& wanted, const Index3& dimensions)
    : Request(&wanted)
    , Dimensions(dimensions)
  {
  }

  /// Appends the hits that the roots in a cell are. Returns true if nothing of the ray is left
  /// behind the last of them.
  bool Pass(const Ray& ray, const Index3& cell, const CellSegment& segment, const CellRoots& roots,
    std::vector<Hit>& hits)
  {
    for (const Root& root : roots.Get())
    {
      if (this->Pass(MakeHit(ray, cell, segment, root), hits))
      {
        return true;
      }
    }
    return false;
  }

  /// Appends a hit, if it is seen. Returns true if nothing of the ray is left behind it.
  bool Pass(const Hit& hit, std::vector<Hit>& hits)
  {
    if (!this->Request->Visible.IsConvex() &&
      !this->Request->Visible.Shows(hit, this->Dimensions, this->Request->Planes))
    {
      return false;
    }
    hits.push_back(hit);
    this->Transmittance *=
      1.0 - this->Request->Surfaces[static_cast<std::size_t>(hit.Surface)].Opacity;
    return this->Transmittance < NegligibleTransmittance;
  }

private:
  const TraceRequest* Request;
  Index3 Dimensions;
  double Transmittance = 1.0;
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
  const int exponent = isSafe ? 0 : -std::clamp(std::ilogb(size), -1000, 1000);
  std::array<float, 8> result;
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    const double value = isSafe ? difference[corner] : std::ldexp(difference[corner], exponent);
    result[corner] = static_cast<float>(value);
    // What is below stays below in three interpolations in turn: see SmallestDifference.
    if (value < 0.0 && result[corner] > -0x1p-100F)
    {
      result[corner] = -0x1p-100F;
    }
  }
  return result;
}

/// A ray that is followed side by side with others, from one cell that it may hit to the next.
struct Follower
{
  /// Its number among all rays.
  std::size_t Number;
  const Ray* TheRay;
  MacrocellTraversal<ActiveMacrocells> Macrocells;
  RayProgress Progress;
  /// The walk over the cells of the macrocell that the ray is in, if any.
  LatticeTraversal Cells;
  bool IsInMacrocell = false;
  /// The cell it has come to.
  Index3 Cell = {};
  CellSegment Segment = {};
};

/// A surface in the cell of a follower, to be solved.
struct Candidate
{
  std::size_t Follower;
  int Surface;
  std::array<float, 8> Difference;
};

/// Fills a lane of a batch.
void Load(
  const Candidate& candidate, const CellSegment& segment, std::size_t lane, Fast::Batch& batch)
{
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    batch.Difference[corner][lane] = candidate.Difference[corner];
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    batch.Entry[axis][lane] = static_cast<float>(segment.Entry[axis]);
    batch.Exit[axis][lane] = static_cast<float>(segment.Exit[axis]);
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
    , Masks(samples)
    , Bricks(samples, arguments...)
    , Cubic(samples)
  {
  }

  void Select(const TraceRequest& wanted, int threads) override
  {
    this->BeginFrame(wanted.MaximumMemory);
    const bool sameIsovalues = std::equal(wanted.Surfaces.begin(), wanted.Surfaces.end(),
      this->Request.Surfaces.begin(), this->Request.Surfaces.end(),
      [](const Isosurface& a, const Isosurface& b) { return a.Isovalue == b.Isovalue; });
    const bool wasCubic = this->IsCubic();
    this->Request = wanted;
    const bool isOtherCubic = this->IsCubic() && this->Cubic.SetPlanes(wanted.Planes);
    if (sameIsovalues && wasCubic == this->IsCubic() && !isOtherCubic)
    {
      return;
    }
    const ValueRange<T>& range = this->Hierarchy.GetRange();
    std::vector<double> isovalues;
    this->Scales.clear();
    for (const Isosurface& surface : wanted.Surfaces)
    {
      isovalues.push_back(surface.Isovalue);
      this->Scales.push_back(
        GetScale(static_cast<double>(range.Min), static_cast<double>(range.Max), surface.Isovalue));
    }
    this->Active = this->IsCubic()
      ? this->Hierarchy.FindActive(isovalues, this->Cubic.GetEdges().GetOvershoot(), threads)
      : this->Hierarchy.FindActive(isovalues, threads);
    this->HasTree = !this->Active.GetLattice().Levels.empty() &&
      this->Active.GetLattice().Levels[0].Edge == BlockMask::Edge;
    if (this->HasTree)
    {
      this->Tree = BlockTree(this->Active, threads);
    }
    this->SelectMasks(isovalues);
  }

  bool MayHitBetween(RayPacket& lines) const override
  {
    // Extreme values and caps may be anywhere, not in active macrocells alone.
    const bool isInTree = this->HasTree && this->Request.BeamKernels && !this->Request.Projection &&
      !this->Request.Visible.HasCaps();
    return !isInTree || this->Request.Planes ||
      PacketTracer::MayMeet(*this->Request.BeamKernels, this->Tree, this->GetDimensions(), lines);
  }

  void Trace(RayPacket& rays, RayHits& hits) override
  {
    hits.Clear();
    for (const HalfSpace& half : this->Request.Visible.HalfSpaces)
    {
      CutRays(half, rays);
    }
    if (this->Request.Projection)
    {
      this->Project(rays, hits);
    }
    else if (this->Request.Visible.HasCaps())
    {
      this->TraceBetweenCaps(rays, hits);
    }
    else
    {
      this->TraceSurfaces(rays, hits);
    }
  }

  Vector3 GetGradient(const Hit& hit, NormalMode mode) const override
  {
    if (hit.Plane != Hit::NoPlane)
    {
      return this->Request.Visible.HalfSpaces[static_cast<std::size_t>(hit.Plane)].Normal;
    }
    if (hit.Jump != 0)
    {
      return GetJumpDirection(hit);
    }
    if (this->IsCubic())
    {
      const Vector3 gradient = this->Cubic.GetGradient(hit.Cell, hit.Parametric);
      return this->Request.Planes ? this->DivideByWidths(gradient, hit.Cell) : gradient;
    }
    const bool isFlat = this->Request.Planes && this->Request.Planes->IsFlat(hit.Cell);
    if (mode == NormalMode::CentralDifferences && !isFlat)
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
    const Vector3 gradient = InterpolantGradient(corners, hit.Parametric);
    return this->Request.Planes ? this->DivideByWidths(gradient, hit.Cell) : gradient;
  }

  void GetGradients(const Hit* hits, int count, NormalMode mode, const Kernels& kernels,
    double (*gradients)[RayPacket::Capacity]) const override
  {
    // Kernels know even spacing only. Where no cell is inner, none is asked for.
    const bool areSmooth = mode == NormalMode::CentralDifferences && !this->Request.Planes &&
      this->Request.Field == Interpolant::Trilinear && this->IsInner({ 1, 1, 1 });
    if (areSmooth)
    {
      InnerCells cells;
      cells.Count = count;
      for (int i = 0; i < count; ++i)
      {
        const Hit& hit = hits[i];
        cells.First[i] =
          this->TheSamples.At(this->IsInner(hit.Cell) ? hit.Cell : Index3{ 1, 1, 1 });
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          cells.Parametric[axis][i] = hit.Parametric[axis];
        }
      }
      const auto type = static_cast<std::size_t>(ScalarTypeOf<T>());
      kernels.InterpolateDifferences[type](cells, this->TheSamples.GetStrides(), gradients);
    }
    for (int i = 0; i < count; ++i)
    {
      if (!areSmooth || hits[i].Plane != Hit::NoPlane || !this->IsInner(hits[i].Cell) ||
        !std::isfinite(gradients[0][i]) || !std::isfinite(gradients[1][i]) ||
        !std::isfinite(gradients[2][i]))
      {
        const Vector3 gradient = this->GetGradient(hits[i], mode);
        gradients[0][i] = gradient[0];
        gradients[1][i] = gradient[1];
        gradients[2][i] = gradient[2];
      }
    }
  }

  const Index3& GetDimensions() const override { return this->TheSamples.GetDimensions(); }
  std::size_t GetMacrocellMemory() const override { return this->Hierarchy.GetMemory(); }
  std::size_t GetBrickMemory() const override
  {
    return this->Bricks.GetMemory() + this->Masks.GetMemory();
  }
  std::size_t GetNumberOfBricks() const override { return this->Bricks.GetNumberOfBricks(); }
  std::size_t GetMaximumNumberOfBricks() const override
  {
    return this->Bricks.GetMaximumNumberOfBricks();
  }
  std::int64_t GetBrickNanoseconds() const override
  {
    return this->Bricks.GetCounters().Nanoseconds;
  }

private:
  bool IsCubic() const { return this->Request.Field == Interpolant::Tricubic; }

  /// Forgets the masks of cells; those of the tricubic interpolant are made by their own rule.
  void SelectMasks(const std::vector<double>& isovalues)
  {
    if (!this->IsCubic())
    {
      this->Masks.Select(isovalues);
      return;
    }
    std::vector<ScaledIsovalue> scaled;
    for (std::size_t surface = 0; surface < isovalues.size(); ++surface)
    {
      scaled.push_back(this->GetIsovalue(surface));
    }
    this->Masks.Select(isovalues,
      [this, scaled](const Index3& block, BlockMask& mask)
      { this->Cubic.MakeMask(block, scaled, mask); });
  }

  /// Shares the memory a frame may take between bricks and masks, by what they take of one block.
  void BeginFrame(std::size_t maximumMemory)
  {
    constexpr std::size_t brick = BlockMask::Edge * BlockMask::Edge * BlockMask::Edge * sizeof(T);
    const std::size_t forMasks = maximumMemory / (brick + sizeof(BlockMask)) * sizeof(BlockMask);
    this->Masks.BeginFrame(forMasks);
    this->Bricks.BeginFrame(maximumMemory - forMasks);
  }

  /// Adds the hits of rays that are cut with the surfaces.
  void TraceSurfaces(RayPacket& rays, RayHits& hits)
  {
    if (this->Request.Field == Interpolant::Nearest)
    {
      this->ForEachRay(
        rays, hits, [this, &hits](const Ray& ray) { this->TraceFaces(ray, hits.Hits); });
    }
    else if (this->Request.Solver == RootSolver::Fast && !this->IsCubic())
    {
      this->TraceTogether(rays, hits);
    }
    else if (this->CanUseBeams(rays))
    {
      this->TraceBeams(rays, hits);
    }
    else if (this->IsCubic())
    {
      this->ForEachRay(
        rays, hits, [this, &hits](const Ray& ray) { this->TraceCubic(ray, hits.Hits); });
    }
    else
    {
      this->ForEachRay(
        rays, hits, [this, &hits](const Ray& ray) { this->TraceAlone(ray, hits.Hits); });
    }
  }

  /// The same, with the caps at the ends of the rays. Where the first is opaque, there is no more.
  void TraceBetweenCaps(const RayPacket& rays, RayHits& hits)
  {
    RayPacket inner = rays;
    std::optional<Hit> first[RayPacket::Capacity];
    std::optional<Hit> last[RayPacket::Capacity];
    for (int i = 0; i < rays.Count; ++i)
    {
      if (!Has(rays.Exists, i))
      {
        continue;
      }
      Ray ray = this->TakeRay(rays, i);
      const int firstPlane = this->GoToPlane(ray, RayEnd::Begin);
      const int lastPlane = this->GoToPlane(ray, RayEnd::End);
      inner.Begin[i] = ray.Begin;
      inner.End[i] = ray.End;
      first[i] = this->FindCap(ray, RayEnd::Begin, firstPlane);
      if (!(ray.Begin < ray.End) || (first[i] && this->GetOpacity(*first[i]) >= 1.0))
      {
        Remove(i, inner.Exists);
        continue;
      }
      last[i] = this->FindCap(ray, RayEnd::End, lastPlane);
    }
    RayHits between;
    between.Clear();
    this->TraceSurfaces(inner, between);
    for (int i = 0; i < rays.Count; ++i)
    {
      const auto number = static_cast<std::size_t>(i);
      RayProgress progress = this->NewProgress();
      bool isOver = first[i] && progress.Pass(*first[i], hits.Hits);
      for (std::size_t k = between.First[number]; k < between.First[number + 1] && !isOver; ++k)
      {
        isOver = progress.Pass(between.Hits[k], hits.Hits);
      }
      if (last[i] && !isOver)
      {
        progress.Pass(*last[i], hits.Hits);
      }
      hits.First.push_back(hits.Hits.size());
    }
  }

  /// The half-space with caps in whose plane a ray begins or ends, and where planes coincide, goes
  /// to what it leaves. There may be none.
  int GoToPlane(Ray& ray, RayEnd end) const
  {
    const Index3& cells = this->Hierarchy.GetLattice().Cells;
    const int plane = FindCappedPlane(ray, end, this->Request.Visible.HalfSpaces, cells);
    if (plane != Hit::NoPlane)
    {
      StepOverPlanes(ray, end, cells, this->Request.Field == Interpolant::Nearest);
    }
    return plane;
  }

  /// The cap in a plane at one end of a ray that is cut, if one is seen there.
  std::optional<Hit> FindCap(const Ray& ray, RayEnd end, int plane) const
  {
    if (plane == Hit::NoPlane)
    {
      return std::nullopt;
    }
    CellSegment segment;
    const EndCell place = FindEndCell(ray, end, this->Hierarchy.GetLattice().Cells);
    if (!SegmentInCell(ray, place.Cell, segment))
    {
      return std::nullopt;
    }
    const bool goesIn = end == RayEnd::Begin;
    Hit hit = MakeHit(ray, place.Cell, segment, goesIn ? 0.0 : 1.0, Hit::NoSurface, goesIn);
    hit.Plane = plane;
    const bool isSeen = this->Request.Visible.IsConvex() ||
      this->Request.Visible.Shows(hit, this->GetDimensions(), this->Request.Planes);
    const bool isInside =
      isSeen && (this->IsCubic() ? this->TakeCubicValue(hit) : this->TakeValue(ray, place, hit));
    return isInside ? std::make_optional(hit) : std::nullopt;
  }

  /// Gives a cap its value and its surface. Returns whether it has any.
  bool TakeValue(const Ray& ray, const EndCell& place, Hit& hit) const
  {
    typename Layout::Value corners[8];
    LoadCorners(this->TheSamples, hit.Cell, corners);
    Vector3 point = hit.Parametric;
    if (this->Request.Field == Interpolant::Nearest)
    {
      const auto value = corners[FindBox(ray, hit.Cell, place.At)];
      std::fill_n(corners, 8, value);
      point = { 0.0, 0.0, 0.0 }; // where interpolation does not round
    }
    if (!IsFinite(corners))
    {
      return false;
    }
    CellCorners values;
    std::copy(corners, corners + 8, values.begin());
    hit.Value = Interpolate(values, point);
    hit.Surface = this->FindInnermost([this, &corners, &point](std::size_t surface)
      { return Interpolate(this->TakeOff(surface, corners), point); });
    return hit.Surface != Hit::NoSurface;
  }

  /// The same with the tricubic interpolant.
  bool TakeCubicValue(Hit& hit) const
  {
    const std::optional<double> value =
      this->Cubic.GetDifference(hit.Cell, hit.Parametric, { 0.0, 1.0 });
    if (!value)
    {
      return false;
    }
    hit.Value = *value;
    hit.Surface = this->FindInnermost([this, &hit](std::size_t surface)
      { return *this->Cubic.GetDifference(hit.Cell, hit.Parametric, this->GetIsovalue(surface)); });
    return hit.Surface != Hit::NoSurface;
  }

  /// The surface of the largest isovalue whose inside a point is in, if there is one:
  /// getDifference(surface) gives the value there, less the isovalue.
  template <typename GetDifference>
  int FindInnermost(const GetDifference& getDifference) const
  {
    static_assert(Hit::NoSurface == -1);
    auto surface = static_cast<int>(this->Request.Surfaces.size()) - 1;
    while (surface >= 0 && !IsInside(getDifference(static_cast<std::size_t>(surface))))
    {
      --surface;
    }
    return surface;
  }

  double GetOpacity(const Hit& hit) const
  {
    return this->Request.Surfaces[static_cast<std::size_t>(hit.Surface)].Opacity;
  }

  void Project(const RayPacket& rays, RayHits& hits)
  {
    if (*this->Request.Projection == Extremum::Largest)
    {
      Projector<T, Layout, Extremum::Largest>(this->Hierarchy, this->Bricks, this->Request)
        .Project(rays, hits);
    }
    else
    {
      Projector<T, Layout, Extremum::Smallest>(this->Hierarchy, this->Bricks, this->Request)
        .Project(rays, hits);
    }
  }

  /// Looks at a cell of a ray. Returns whether the ray may hit a surface there; then the corners
  /// and the segment are those of the cell.
  bool Examine(typename Layout::Reader& reader, const Ray& ray, const Index3& cell,
    typename Layout::Value corners[8], CellSegment& segment) const
  {
    reader.Load(cell, corners);
    return HasSurface(corners, this->Request.Surfaces) && IsFinite(corners) &&
      SegmentInCell(ray, cell, segment);
  }

  /// The corners with an isovalue taken off.
  CellCorners TakeOff(std::size_t surface, const typename Layout::Value corners[8]) const
  {
    CellCorners differences;
    for (std::size_t corner = 0; corner < 8; ++corner)
    {
      differences[corner] = Difference(static_cast<double>(corners[corner]),
        this->Request.Surfaces[surface].Isovalue, this->Scales[surface]);
    }
    return differences;
  }

  /// The roots of all surfaces in a cell, in order. Behind one of an opaque surface there may be
  /// more.
  void FindRoots(
    const typename Layout::Value corners[8], const CellSegment& segment, CellRoots& roots) const
  {
    this->FindRoots(roots,
      [this, corners, &segment](std::size_t surface, const auto& visit)
      { ForEachRoot(this->TakeOff(surface, corners), segment, this->Request, visit); });
  }

  /// The same for the tricubic interpolant.
  void FindCubicRoots(const Index3& cell, const CellSegment& segment, CellRoots& roots) const
  {
    this->FindRoots(roots,
      [this, &cell, &segment](std::size_t surface, const auto& visit)
      { this->Cubic.ForEachRoot(cell, this->GetIsovalue(surface), segment, visit); });
  }

  /// The same, where forEachRoot(surface, visit) calls visit(fraction, entering) until it returns
  /// true.
  template <typename ForEachRootOfSurface>
  void FindRoots(CellRoots& roots, const ForEachRootOfSurface& forEachRoot) const
  {
    roots.Clear();
    for (std::size_t i = 0; i < this->Request.Surfaces.size(); ++i)
    {
      const bool isLast =
        this->Request.Surfaces[i].Opacity >= 1.0 && this->Request.Visible.IsConvex();
      roots.NextSurface();
      forEachRoot(i,
        [&roots, i, isLast](double u, bool entering)
        {
          roots.Add({ u, static_cast<int>(i), entering });
          return isLast;
        });
    }
  }

  ScaledIsovalue GetIsovalue(std::size_t surface) const
  {
    return { this->Request.Surfaces[surface].Isovalue, this->Scales[surface] };
  }

  RayProgress NewProgress() const
  {
    return RayProgress(this->Request, this->TheSamples.GetDimensions());
  }

  /// A ray of a group that exists.
  Ray TakeRay(const RayPacket& rays, int i) const
  {
    Ray ray = GetRay(rays, i);
    ray.Planes = this->Request.Planes;
    return ray;
  }

  /// Beams take even spacing, macrocells of 8^3 cells, and rays of ordinary length.
  bool CanUseBeams(const RayPacket& rays) const
  {
    bool isFinite = true;
    for (int i = 0; i < rays.Count; ++i)
    {
      isFinite = isFinite &&
        (!Has(rays.Exists, i) || (std::isfinite(rays.Begin[i]) && std::isfinite(rays.End[i])));
    }
    return isFinite && this->HasTree && this->Request.BeamKernels && !this->Request.Planes;
  }

  void TraceBeams(RayPacket& rays, RayHits& hits)
  {
    PacketTracer tracer(*this->Request.BeamKernels, this->Tree);
    PacketCells cells(*this, rays);
    const bool firstHits = this->Request.Solver == RootSolver::Robust && !this->IsCubic() &&
      this->Request.Surfaces.size() == 1 && this->Request.Surfaces[0].Opacity >= 1.0 &&
      this->Request.Visible.IsConvex();
    if (!firstHits)
    {
      cells.StartFollowing();
      tracer.FollowRays(rays, cells);
      cells.GetHits(hits);
      return;
    }
    const PacketHits& found = tracer.FindFirstHits(rays, cells, this->GetIsovalue(0));
    hits.Hits.resize(static_cast<std::size_t>(CountOf(found.Found)));
    hits.First.resize(static_cast<std::size_t>(rays.Count) + 1);
    Hit* hit = hits.Hits.data();
    for (int i = 0; i < rays.Count; ++i)
    {
      if (Has(found.Found, i))
      {
        *hit++ = found.Hits[static_cast<std::size_t>(i)];
      }
      hits.First[static_cast<std::size_t>(i) + 1] =
        static_cast<std::size_t>(hit - hits.Hits.data());
    }
  }

  /// The cells of the volume, for the beams of one thread.
  class PacketCells final : public PacketTracer::Cells
  {
  public:
    PacketCells(TypedVolume& volume, const RayPacket& rays)
      : Volume(volume)
      , Rays(rays)
      , Reader(volume.Bricks)
    {
    }

    /// Makes ready to follow rays, which those who want first hits need not pay for.
    void StartFollowing()
    {
      const auto count = static_cast<std::size_t>(this->Rays.Count);
      this->Progress.assign(count, this->Volume.NewProgress());
      this->Hits.assign(count, {});
    }

    void Prefetch(const Index3& block) override
    {
      this->Volume.Masks.Prefetch(block);
      this->Reader.Prefetch(
        { block[0] * BlockMask::Edge, block[1] * BlockMask::Edge, block[2] * BlockMask::Edge });
    }

    const BlockMask& GetMask(const Index3& block, BlockMask& own) override
    {
      return this->Volume.Masks.Get(block, own);
    }

    bool Follow(int ray, const std::vector<Index3>& cells) override
    {
      const Ray& own = GetRay(this->Rays, ray);
      this->Passed.clear();
      for (const Index3& cell : cells)
      {
        CellSegment segment;
        if (SegmentInCell(own, cell, segment))
        {
          this->Passed.push_back({ cell, segment });
        }
      }
      std::sort(this->Passed.begin(), this->Passed.end(),
        [](const PassedCell& a, const PassedCell& b)
        {
          return Crossing{ a.Segment.Begin, a.Segment.BeginAxis } <
            Crossing{ b.Segment.Begin, b.Segment.BeginAxis };
        });
      const auto number = static_cast<std::size_t>(ray);
      for (const PassedCell& passed : this->Passed)
      {
        this->FindRoots(passed);
        if (this->Progress[number].Pass(
              own, passed.Cell, passed.Segment, this->Roots, this->Hits[number]))
        {
          return true;
        }
      }
      return false;
    }

    /// The hits of the rays that were followed.
    void GetHits(RayHits& hits) const
    {
      for (const std::vector<Hit>& own : this->Hits)
      {
        hits.Hits.insert(hits.Hits.end(), own.begin(), own.end());
        hits.First.push_back(hits.Hits.size());
      }
    }

    const void* FindCorner(const Index3& block) override
    {
      return this->Reader.FindBlock(
        { block[0] * BlockMask::Edge, block[1] * BlockMask::Edge, block[2] * BlockMask::Edge },
        BlockMask::Edge);
    }

    std::array<std::ptrdiff_t, 3> GetCornerSteps() const override
    {
      const std::ptrdiff_t* strides = this->Reader.GetStrides();
      constexpr std::ptrdiff_t size = sizeof(typename Layout::Kept);
      return { strides[0] * size, strides[1] * size, strides[2] * size };
    }

    void CopyCorners(PassedCells& cells, int axis, const Passages& passages) override
    {
      // Those behind the last, up to a vector, are as the first.
      const int count = cells.Count + PassedCells::Spare;
      this->Copies.resize(8 * static_cast<std::size_t>(count));
      for (int i = 0; i < count; ++i)
      {
        const unsigned int code = cells.Codes[i];
        const int* first = passages.First[passages.Ways[code & 0xFFFFU].Block];
        Index3 cell = { first[0], first[1], first[2] };
        cell[static_cast<std::size_t>(axis)] += static_cast<int>(code >> 16 & 7U);
        cell[static_cast<std::size_t>(BlockMask::U[axis])] += static_cast<int>(code >> 24 & 7U);
        cell[static_cast<std::size_t>(BlockMask::V[axis])] += static_cast<int>(code >> 27);
        auto* corners = &this->Copies[8 * static_cast<std::size_t>(i)];
        this->Reader.Load(cell, corners);
        cells.First[i] = corners;
      }
    }

    void ClassifyCells(const PassedCells& cells, int axis, bool areCopied, Passages& passages,
      Candidates& candidates, RaySet& hits) override
    {
      this->Volume.Request.BeamKernels->ClassifyCells[GetType(areCopied)](cells, axis,
        this->GetStrides(areCopied), this->Volume.GetIsovalue(0), passages, candidates, hits);
    }

    void LoadCorners(bool areCopied, Candidates& candidates) override
    {
      this->Volume.Request.BeamKernels->LoadCorners[GetType(areCopied)](
        this->GetStrides(areCopied), candidates);
    }

    bool FindFirstHit(int ray, const Index3& cell, Hit& hit, Crossing& begin) override
    {
      return this->Volume.FindFirstHit(this->Reader, GetRay(this->Rays, ray), cell, hit, begin);
    }

  private:
    static std::size_t GetType(bool areCopied)
    {
      return static_cast<std::size_t>(
        areCopied ? ScalarTypeOf<typename Layout::Value>() : ScalarTypeOf<typename Layout::Kept>());
    }

    const std::ptrdiff_t* GetStrides(bool areCopied) const
    {
      static constexpr std::ptrdiff_t ofCopies[3] = { 1, 2, 4 };
      return areCopied ? ofCopies : this->Reader.GetStrides();
    }

    struct PassedCell
    {
      Index3 Cell;
      CellSegment Segment;
    };

    void FindRoots(const PassedCell& passed)
    {
      if (this->Volume.IsCubic())
      {
        this->Volume.FindCubicRoots(passed.Cell, passed.Segment, this->Roots);
        return;
      }
      typename Layout::Value corners[8];
      this->Reader.Load(passed.Cell, corners);
      this->Volume.FindRoots(corners, passed.Segment, this->Roots);
    }

    TypedVolume& Volume;
    const RayPacket& Rays;
    typename Layout::Reader Reader;
    /// Of each ray that is followed.
    std::vector<RayProgress> Progress;
    std::vector<std::vector<Hit>> Hits;
    std::vector<PassedCell> Passed;
    CellRoots Roots;
    /// The eight corners of each cell that is looked at where there are no rows.
    std::vector<typename Layout::Value> Copies;
  };

  /// The first hit of a ray in a cell, and where the ray enters the cell.
  bool FindFirstHit(
    typename Layout::Reader& reader, const Ray& ray, const Index3& cell, Hit& hit, Crossing& begin)
  {
    typename Layout::Value corners[8];
    CellSegment segment;
    CellRoots roots;
    if (!this->Examine(reader, ray, cell, corners, segment))
    {
      return false;
    }
    this->FindRoots(corners, segment, roots);
    if (roots.Get().empty())
    {
      return false;
    }
    hit = MakeHit(ray, cell, segment, roots.Get().front());
    begin = { segment.Begin, segment.BeginAxis };
    return true;
  }

  /// Calls trace(ray) for the rays of a group that exist, of which each appends its hits.
  template <typename Trace>
  void ForEachRay(const RayPacket& rays, RayHits& hits, const Trace& trace) const
  {
    for (int i = 0; i < rays.Count; ++i)
    {
      if (Has(rays.Exists, i))
      {
        trace(this->TakeRay(rays, i));
      }
      hits.First.push_back(hits.Hits.size());
    }
  }

  /// Follows one ray to its end, from face to face between the boxes of samples.
  void TraceFaces(const Ray& ray, std::vector<Hit>& hits)
  {
    typename Layout::Reader reader(this->Bricks);
    RayProgress progress = this->NewProgress();
    TraverseCells(ray, this->Active,
      [&](const Index3& cell)
      {
        typename Layout::Value corners[8];
        reader.Load(cell, corners);
        return VisitFaceHits(ray, cell, corners, this->Request.Surfaces,
          [&progress, &hits](const Hit& hit) { return progress.Pass(hit, hits); });
      });
  }

  /// Follows one ray to its end, from one cell that a surface of the tricubic interpolant may pass
  /// to the next.
  void TraceCubic(const Ray& ray, std::vector<Hit>& hits)
  {
    BlockMask own;
    const BlockMask* mask = nullptr;
    Index3 block = {};
    CellRoots roots;
    RayProgress progress = this->NewProgress();
    TraverseCells(ray, this->Active,
      [&](const Index3& cell)
      {
        constexpr int edge = BlockMask::Edge;
        const Index3 next = { cell[0] / edge, cell[1] / edge, cell[2] / edge };
        if (!mask || next != block)
        {
          mask = &this->Masks.Get(next, own);
          block = next;
        }
        CellSegment segment;
        if (!mask->Has({ cell[0] % edge, cell[1] % edge, cell[2] % edge }) ||
          !SegmentInCell(ray, cell, segment))
        {
          return false;
        }
        this->FindCubicRoots(cell, segment, roots);
        return progress.Pass(ray, cell, segment, roots, hits);
      });
  }

  /// Follows one ray to its end, solving cell by cell.
  void TraceAlone(const Ray& ray, std::vector<Hit>& hits)
  {
    typename Layout::Reader reader(this->Bricks);
    CellRoots roots;
    RayProgress progress = this->NewProgress();
    TraverseCells(ray, this->Active,
      [&](const Index3& cell)
      {
        typename Layout::Value corners[8];
        CellSegment segment;
        if (!this->Examine(reader, ray, cell, corners, segment))
        {
          return false;
        }
        this->FindRoots(corners, segment, roots);
        return progress.Pass(ray, cell, segment, roots, hits);
      });
  }

  /// Follows rays side by side, each from one cell that it may hit to the next. The cells of all
  /// rays are solved together.
  void TraceTogether(const RayPacket& group, RayHits& result)
  {
    std::vector<Ray> rays;
    std::vector<Follower> followers;
    std::vector<std::size_t> going;
    rays.reserve(RayPacket::Capacity);
    followers.reserve(RayPacket::Capacity);
    for (int i = 0; i < group.Count; ++i)
    {
      if (Has(group.Exists, i))
      {
        rays.push_back(this->TakeRay(group, i));
        going.push_back(followers.size());
        followers.push_back({ static_cast<std::size_t>(i), &rays.back(),
          MacrocellTraversal<ActiveMacrocells>(rays.back(), this->Active), this->NewProgress(),
          {} });
      }
    }
    std::vector<std::vector<Hit>> hits(static_cast<std::size_t>(group.Count));
    std::vector<Candidate> candidates;
    while (!going.empty())
    {
      candidates.clear();
      for (const std::size_t i : going)
      {
        this->GoToNextCell(i, followers[i], candidates);
      }
      // Those that came to no cell are at their end.
      going.clear();
      this->SolveCandidates(candidates, followers,
        [&](std::size_t i, const CellRoots& roots)
        {
          Follower& follower = followers[i];
          if (!follower.Progress.Pass(
                *follower.TheRay, follower.Cell, follower.Segment, roots, hits[follower.Number]))
          {
            going.push_back(i);
          }
        });
    }
    for (const std::vector<Hit>& own : hits)
    {
      result.Hits.insert(result.Hits.end(), own.begin(), own.end());
      result.First.push_back(result.Hits.size());
    }
  }

  /// Traversals a ray on to the next cell that it may hit, if there is one, and queues it once for
  /// every surface.
  void GoToNextCell(std::size_t number, Follower& follower, std::vector<Candidate>& candidates)
  {
    const Ray& ray = *follower.TheRay;
    typename Layout::Reader reader(this->Bricks);
    typename Layout::Value corners[8];
    bool found = false;
    while (!found)
    {
      if (!follower.IsInMacrocell)
      {
        CellRegion region;
        if (!follower.Macrocells.Next(region))
        {
          return;
        }
        follower.Cells = LatticeTraversal(ray, 1, region.First, region.Last, region.Start);
      }
      LatticeTraversal walk = follower.Cells;
      do
      {
        follower.Cell = walk.GetBlock();
        found = this->Examine(reader, ray, follower.Cell, corners, follower.Segment);
        follower.IsInMacrocell = walk.Advance(walk.GetExit());
      } while (follower.IsInMacrocell && !found);
      follower.Cells = walk;
    }
    for (std::size_t i = 0; i < this->Request.Surfaces.size(); ++i)
    {
      candidates.push_back(
        { number, static_cast<int>(i), ToSinglePrecision(this->TakeOff(i, corners)) });
    }
  }

  /// Solves all candidates, a batch at a time, and calls visit(follower, roots) for every follower
  /// they belong to.
  template <typename Visit>
  void SolveCandidates(const std::vector<Candidate>& candidates,
    const std::vector<Follower>& followers, const Visit& visit) const
  {
    const bool firstOnly = this->Request.Visible.IsConvex() &&
      std::all_of(this->Request.Surfaces.begin(), this->Request.Surfaces.end(),
        [](const Isosurface& surface) { return surface.Opacity >= 1.0; });
    Fast::Batch batch = {};
    Fast::Roots solved;
    CellRoots roots;
    for (std::size_t first = 0; first < candidates.size(); first += Fast::Lanes)
    {
      const std::size_t lanes = std::min<std::size_t>(Fast::Lanes, candidates.size() - first);
      for (std::size_t lane = 0; lane < lanes; ++lane)
      {
        const Candidate& candidate = candidates[first + lane];
        Load(candidate, followers[candidate.Follower].Segment, lane, batch);
      }
      Fast::Solve(batch, firstOnly, solved);
      for (std::size_t lane = 0; lane < lanes; ++lane)
      {
        const Candidate& candidate = candidates[first + lane];
        if (candidate.Surface == 0)
        {
          roots.Clear();
        }
        roots.NextSurface();
        for (std::size_t piece = 0; piece < 3; ++piece)
        {
          if (solved.Found[piece][lane] != 0)
          {
            roots.Add({ static_cast<double>(solved.U[piece][lane]), candidate.Surface,
              solved.Entering[piece][lane] != 0 });
          }
        }
        if (static_cast<std::size_t>(candidate.Surface) + 1 == this->Request.Surfaces.size())
        {
          visit(candidate.Follower, roots);
        }
      }
    }
  }

  /// From differences along the edges of a cell to the gradient. In a flat cell only its flat axes
  /// count: there the gradient is infinite, and this is its direction.
  Vector3 DivideByWidths(Vector3 gradient, const Index3& cell) const
  {
    const bool isFlat = this->Request.Planes->IsFlat(cell);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double width = this->Request.Planes->GetWidth(axis, cell[axis]);
      gradient[axis] = isFlat ? (width > 0.0 ? 0.0 : gradient[axis]) : gradient[axis] / width;
    }
    return gradient;
  }

  /// The slope at a sample: the central difference, or what is that with uneven spacing; at the
  /// border of the volume, the one-sided difference.
  double GetDifference(Index3 sample, std::size_t axis) const
  {
    const int place = sample[axis];
    const int next = std::min(place + 1, this->TheSamples.GetDimensions()[axis] - 1);
    const int previous = std::max(place - 1, 0);
    sample[axis] = next;
    const auto high = static_cast<double>(*this->TheSamples.At(sample));
    sample[axis] = previous;
    const auto low = static_cast<double>(*this->TheSamples.At(sample));
    if (this->Request.Planes)
    {
      sample[axis] = place;
      const auto middle = static_cast<double>(*this->TheSamples.At(sample));
      const UnevenPlanes::SlopeWeights& weights =
        this->Request.Planes->GetSlopeWeights(axis, place);
      return weights.Below * (middle - low) + weights.Above * (high - middle);
    }
    return (high - low) / (next - previous);
  }

  /// Central differences at the corners of a cell, interpolated.
  Vector3 GetSmoothGradient(const Hit& hit) const
  {
    const Index3& cell = hit.Cell;
    Vector3 gradient;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      CellCorners differences;
      for (int corner = 0; corner < 8; ++corner)
      {
        differences[static_cast<std::size_t>(corner)] = this->GetDifference(
          { cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2) }, axis);
      }
      gradient[axis] = Interpolate(differences, hit.Parametric);
    }
    return gradient;
  }

  /// Whether all corners of a cell have neighbours on both sides.
  bool IsInner(const Index3& cell) const
  {
    const Index3& dimensions = this->TheSamples.GetDimensions();
    return cell[0] > 0 && cell[1] > 0 && cell[2] > 0 && cell[0] < dimensions[0] - 2 &&
      cell[1] < dimensions[1] - 2 && cell[2] < dimensions[2] - 2;
  }

  Samples<T> TheSamples;
  MacrocellHierarchy<T> Hierarchy;
  ActiveMacrocells Active;
  BlockTree Tree;
  bool HasTree = false;
  CellMasks<T> Masks;
  Layout Bricks;
  TricubicField<T> Cubic;
  TraceRequest Request;
  /// For each surface, see GetScale.
  std::vector<double> Scales;
};

}

//------------------------------------------------------------------------------
void TracedVolume::Trace(const std::vector<std::optional<Ray>>& rays, RayHits& hits)
{
  hits.Clear();
  RayHits some;
  RayPacket group;
  for (std::size_t first = 0; first < rays.size(); first += RayPacket::Capacity)
  {
    group.Count = 0;
    group.Exists = {};
    for (std::size_t i = first; i < std::min(first + RayPacket::Capacity, rays.size()); ++i)
    {
      AddRay(rays[i], group);
    }
    this->Trace(group, some);
    hits.Append(some);
  }
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
