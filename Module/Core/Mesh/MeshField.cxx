// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/MeshField.h"

#include "Field/HitCollector.h"
#include "Field/PixelBlocks.h"
#include "Field/Stopwatch.h"
#include "Mesh/BeamTracer.h"
#include "Mesh/CellHits.h"
#include "Mesh/HitOrder.h"
#include "Mesh/HitsOfRays.h"
#include "Mesh/MeshBeam.h"
#include "Mesh/MeshCaps.h"
#include "Mesh/MeshCloud.h"
#include "Mesh/MeshRay.h"
#include "Mesh/ScatteredRayTracer.h"
#include "Mesh/ShapeFunctions.h"
#include "Rays/AppendBoxedRay.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

IsovalueSpan FindSpan(double isovalue)
{
  const auto rounded = static_cast<float>(isovalue);
  const float from =
    static_cast<double>(rounded) < isovalue ? std::nextafterf(rounded, HUGE_VALF) : rounded;
  return { std::nextafterf(from, -HUGE_VALF), from };
}

/// Appends the caps of rays to their hits.
void AppendCaps(const std::vector<Cap>& caps, RayHits& hits)
{
  if (caps.empty())
  {
    return;
  }
  std::vector<Hit> all;
  all.reserve(hits.Hits.size() + caps.size());
  auto cap = caps.begin();
  std::size_t first = 0;
  for (int ray = 0; static_cast<std::size_t>(ray) + 1 < hits.First.size(); ++ray)
  {
    std::size_t& next = hits.First[static_cast<std::size_t>(ray) + 1];
    const auto begin = hits.Hits.begin();
    all.insert(all.end(), begin + static_cast<std::ptrdiff_t>(first),
      begin + static_cast<std::ptrdiff_t>(next));
    if (cap != caps.end() && cap->Ray == ray)
    {
      all.push_back(cap++->TheHit);
    }
    first = std::exchange(next, all.size());
  }
  hits.Hits = std::move(all);
}

}

/// What a thread traces packets with.
class MeshField::ThreadBeam final : public Beam
{
public:
  MeshBeam Pieces;
  BeamTracer Tracer;
  ScatteredRayTracer ScatteredRays;
  HitsOfRays Hits;
};

/// What one of them is taken from and given back to: to make one takes longer than to trace a few
/// packets.
class MeshField::SpareBeams
{
public:
  std::unique_ptr<ThreadBeam> Take()
  {
    const std::lock_guard<std::mutex> lock(this->Lock);
    if (this->Beams.empty())
    {
      return std::make_unique<ThreadBeam>();
    }
    std::unique_ptr<ThreadBeam> taken = std::move(this->Beams.back());
    this->Beams.pop_back();
    return taken;
  }

  void GiveBack(std::unique_ptr<ThreadBeam> beam)
  {
    const std::lock_guard<std::mutex> lock(this->Lock);
    this->Beams.push_back(std::move(beam));
  }

private:
  std::mutex Lock;
  std::vector<std::unique_ptr<ThreadBeam>> Beams;
};

//------------------------------------------------------------------------------
struct MeshField::GradientsOfComponent
{
  GradientsOfComponent(const MeshField& field, int component)
    : Cells(field.Cells.OfComponent(component))
    , Smooth(this->Cells, field.Tree, field.GetUnitOfGradients())
  {
  }

  MeshCells Cells;
  PointGradients Smooth;
};

//------------------------------------------------------------------------------
MeshField::MeshField(const MeshCells& cells, int threads)
  : Cells(cells)
  , Tree(this->Cells, threads)
  , Spare(std::make_unique<SpareBeams>())
{
}

//------------------------------------------------------------------------------
MeshField::MeshField(const MeshView& view, int threads)
  : MeshField(MeshCells(view, threads), threads)
{
}

//------------------------------------------------------------------------------
MeshField::~MeshField() = default;

//------------------------------------------------------------------------------
void MeshField::Select(
  const TraceRequest& request, const Execution& execution, const MemoryBudget& /*budget*/)
{
  this->GradientSeconds = 0.0;
  std::vector<const PointGradients*> ofCloud;
  if (request.Normals == NormalMode::CentralDifferences)
  {
    this->FindSmoothGradients(request, execution.Threads);
    ofCloud = this->FindGradientsOfCloud(request.LitComponents, execution.Threads);
  }
  std::vector<MeshSurface> surfaces;
  std::vector<IsovalueSpan> spans;
  for (const Isosurface& surface : request.Surfaces)
  {
    surfaces.push_back(this->SelectSurface(surface.Isovalue));
    spans.push_back(FindSpan(surface.Isovalue));
  }
  std::vector<HalfSpace> halves =
    MovePlanesIntoCells(request.Visible.HalfSpaces, this->Tree, this->Cells.GetPointType());
  if (request.HasCloud && !this->Boxes)
  {
    this->Boxes = std::make_unique<CellBoxes>(this->Cells, this->Tree, execution.Threads);
  }
  this->Selection = { &this->Cells, &this->Tree, this->Boxes.get(), std::move(ofCloud), request,
    std::move(halves), std::move(surfaces), std::move(spans), this->GetCellSize(),
    execution.PacketKernels,
    execution.RaysForTrees * static_cast<double>(this->Cells.GetNumberOfCells()) };
}

//------------------------------------------------------------------------------
void MeshField::FindSmoothGradients(const TraceRequest& request, int threads)
{
  const Stopwatch watch;
  // If there is not enough memory, they are not there.
  std::unique_ptr<PointGradients> smooth = std::move(this->Smooth);
  if (!smooth)
  {
    smooth = std::make_unique<PointGradients>(this->Cells, this->Tree, this->GetUnitOfGradients());
  }
  std::vector<double> isovalues;
  for (const Isosurface& surface : request.Surfaces)
  {
    isovalues.push_back(surface.Isovalue);
  }
  const bool isLit = request.LitComponents > 0 && this->Cells.GetNumberOfComponents() == 1;
  const bool areKnown = isLit ? smooth->FindAll(threads) : smooth->Find(isovalues, threads);
  this->Smooth = std::move(smooth);
  this->GradientSeconds = areKnown ? 0.0 : watch.GetSeconds();
}

//------------------------------------------------------------------------------
/// Those at the points of the last components, which light a cloud.
std::vector<const PointGradients*> MeshField::FindGradientsOfCloud(int components, int threads)
{
  std::vector<const PointGradients*> found;
  const int all = this->Cells.GetNumberOfComponents();
  if (components > 0 && all == 1)
  {
    return { this->Smooth.get() };
  }
  this->SmoothOfComponents.resize(static_cast<std::size_t>(all));
  const Stopwatch watch;
  for (int component = all - components; component < all; ++component)
  {
    auto& kept = this->SmoothOfComponents[static_cast<std::size_t>(component)];
    auto smooth = std::move(kept);
    if (!smooth)
    {
      smooth = std::make_unique<GradientsOfComponent>(*this, component);
    }
    if (!smooth->Smooth.FindAll(threads))
    {
      this->GradientSeconds += watch.GetSeconds();
    }
    kept = std::move(smooth);
    found.push_back(&kept->Smooth);
  }
  return found;
}

//------------------------------------------------------------------------------
/// That of the last request, if it had the isovalue.
MeshSurface MeshField::SelectSurface(double isovalue) const
{
  const auto known = std::find_if(this->Selection.Surfaces.begin(), this->Selection.Surfaces.end(),
    [isovalue](const MeshSurface& surface) { return surface.Isovalue == isovalue; });
  if (known != this->Selection.Surfaces.end())
  {
    return *known;
  }
  const double scale = GetValueScale(this->Tree.GetLow(), this->Tree.GetHigh(), isovalue);
  const auto pieces = std::make_shared<SurfacePieces>(this->Cells, this->Tree, isovalue, scale);
  return { isovalue, scale, pieces, std::make_shared<PieceTreesOnDemand>(pieces->GetMaker()) };
}

//------------------------------------------------------------------------------
bool MeshField::MayHit() const
{
  return std::any_of(this->Selection.Surfaces.begin(), this->Selection.Surfaces.end(),
           [this](const MeshSurface& surface) {
             return this->Tree.GetLow() < surface.Isovalue &&
               surface.Isovalue <= this->Tree.GetHigh();
           }) ||
    this->Selection.Request.Visible.HasCaps() || this->Selection.Request.HasCloud;
}

//------------------------------------------------------------------------------
void MeshField::AddRay(const Vector3& origin, const Vector3& direction, double begin, double end,
  RayPacket& packet) const
{
  AppendBoxedRay(this->Tree.GetBounds(), origin, direction, begin, end, packet);
}

//------------------------------------------------------------------------------
void MeshField::ClipRays(RayPacket& packet) const
{
  if (!this->Selection.PacketKernels)
  {
    TracedField::ClipRays(packet);
    return;
  }
  const Bounds& box = this->Tree.GetBounds();
  this->Selection.PacketKernels->MoveRaysToBox(box.Lower.data(), box.Upper.data(), packet);
}

//------------------------------------------------------------------------------
void MeshField::MakeRays(const Camera& view, const PixelRectangle& pixels,
  const PixelDepths& depths, RayPacket& packet) const
{
  if (!this->Selection.PacketKernels)
  {
    TracedField::MakeRays(view, pixels, depths, packet);
    return;
  }
  const Bounds& box = this->Tree.GetBounds();
  this->Selection.PacketKernels->MakeBoxedRays(
    MakePixelBlock(view, pixels, depths), box.Lower.data(), box.Upper.data(), packet);
}

//------------------------------------------------------------------------------
std::unique_ptr<TracedField::Beam> MeshField::MakeBeam() const
{
  return this->Selection.PacketKernels ? std::make_unique<ThreadBeam>() : nullptr;
}

//------------------------------------------------------------------------------
void MeshField::Begin(const RayPacket& lines, Beam* beam) const
{
  static_cast<ThreadBeam*>(beam)->Pieces.Begin(this->Selection, lines);
}

//------------------------------------------------------------------------------
bool MeshField::MayHitBetween(RayPacket& lines, Beam* beam) const
{
  auto* thread = static_cast<ThreadBeam*>(beam);
  // Caps may be anywhere, not where surfaces are alone.
  return this->Selection.Request.Visible.HasCaps() || !thread || !thread->Pieces.IsBeam() ||
    thread->Pieces.MayHitBetween(this->Selection, lines);
}

//------------------------------------------------------------------------------
/// The caps that rays begin with. Rays behind opaque ones no longer exist.
std::vector<Cap> MeshField::FindFirstCaps(RayPacket& packet, CellHits& inCell) const
{
  std::vector<Cap> caps = FindCaps(this->Selection, packet, packet.Exists, RayEnd::Begin, inCell);
  for (const Cap& cap : caps)
  {
    if (this->Selection.Request.GetOpacity(cap.TheHit) >= 1.0)
    {
      Remove(cap.Ray, packet.Exists);
    }
  }
  return caps;
}

//------------------------------------------------------------------------------
/// One to be given back. Rays to a light, and others without a picture, may be a beam.
std::unique_ptr<MeshField::ThreadBeam> MeshField::TakeBeamOf(const RayPacket& packet) const
{
  constexpr int fewest = 8;
  std::unique_ptr<ThreadBeam> taken = this->Spare->Take();
  if (CountOf(packet.Exists) < fewest)
  {
    taken->Pieces.End();
  }
  else
  {
    taken->Pieces.Begin(this->Selection, packet, packet.Exists);
  }
  return taken;
}

//------------------------------------------------------------------------------
/// Finds the hits of the rays of a packet together; given departures, any that stop them. Returns
/// those that were traced.
RaySet MeshField::TraceTogether(
  const RayPacket& packet, const Departure* departures, ThreadBeam& thread) const
{
  thread.Hits.Clear();
  RaySet traced = {};
  if (thread.Pieces.IsBeam())
  {
    traced = thread.Tracer.Trace(this->Selection, packet, departures, thread.Pieces, thread.Hits);
  }
  const RaySet others = Without(packet.Exists, traced);
  ForEachRay(others, [&thread](int ray) { thread.Hits.RemoveAll(ray); });
  if (!IsEmpty(others))
  {
    traced = Unite(traced, this->TraceAlone(packet, others, departures, thread));
  }
  return traced;
}

//------------------------------------------------------------------------------
/// The same of some rays that make no beam.
RaySet MeshField::TraceAlone(const RayPacket& packet, const RaySet& rays,
  const Departure* departures, ThreadBeam& thread) const
{
  const int count = CountOf(rays);
  const auto hasTrees = [this, count](const MeshSurface& surface)
  {
    return surface.Trees->Find(
             count, this->Selection.RaysForTrees, *this->Selection.PacketKernels) != nullptr;
  };
  // All count them.
  const std::vector<MeshSurface>& surfaces = this->Selection.Surfaces;
  const auto ready = std::count_if(surfaces.begin(), surfaces.end(), hasTrees);
  const bool haveTrees = ready == static_cast<std::ptrdiff_t>(surfaces.size());
  return thread.ScatteredRays.Trace(
    this->Selection, packet, rays, departures, haveTrees, thread.Hits);
}

//------------------------------------------------------------------------------
void MeshField::Trace(RayPacket& packet, RayHits& hits, Beam* beam)
{
  hits.Clear();
  CutRays(this->Selection.HalfSpaces, packet);
  CellHits inCell;
  const bool hasCaps = this->Selection.Request.Visible.HasCaps();
  const std::vector<Cap> caps = hasCaps ? this->FindFirstCaps(packet, inCell) : std::vector<Cap>{};
  auto cap = caps.begin();
  std::unique_ptr<ThreadBeam> own =
    beam || !this->Selection.PacketKernels ? nullptr : this->TakeBeamOf(packet);
  auto* thread = own ? own.get() : static_cast<ThreadBeam*>(beam);
  const RaySet traced = thread ? this->TraceTogether(packet, nullptr, *thread) : RaySet{};
  std::vector<Hit> found;
  hits.First.resize(static_cast<std::size_t>(packet.Count) + 1);
  // Those that something is left of at their end.
  RaySet left = packet.Exists;
  for (int i = 0; i < packet.Count; ++i)
  {
    const bool isTraced = Has(traced, i);
    const Hit* first = cap != caps.end() && cap->Ray == i ? &cap++->TheHit : nullptr;
    if (isTraced && !hasCaps && !thread->Hits.HasSeveral(i))
    {
      if (const Hit* only = thread->Hits.GetAny(i))
      {
        hits.Hits.push_back(*only);
      }
    }
    else
    {
      found.clear();
      if (isTraced)
      {
        thread->Hits.Get(i, found);
      }
      else if (Has(packet.Exists, i))
      {
        MeshRay(this->Selection, packet, i).FindHits(inCell, found);
      }
      if (this->AddHits(first, found, hits.Hits))
      {
        Remove(i, left);
      }
    }
    hits.First[static_cast<std::size_t>(i) + 1] = hits.Hits.size();
  }
  if (hasCaps)
  {
    AppendCaps(FindCaps(this->Selection, packet, left, RayEnd::End, inCell), hits);
  }
  if (own)
  {
    this->Spare->GiveBack(std::move(own));
  }
}

//------------------------------------------------------------------------------
double MeshField::GetCellSize() const
{
  const Bounds& box = this->Tree.GetBounds();
  return Length(box.Upper - box.Lower) /
    std::cbrt(static_cast<double>(this->Cells.GetNumberOfCells()));
}

//------------------------------------------------------------------------------
/// Finds those of the rays of a packet that surfaces stop. Leaves the rays that only the order of
/// all crossings decides about, or that were not traced.
StoppedRays MeshField::FindStopped(RayPacket& packet, const Departure* departures) const
{
  CutRays(this->Selection.HalfSpaces, packet);
  StoppedRays found;
  std::unique_ptr<ThreadBeam> own = this->TakeBeamOf(packet);
  const RaySet traced = this->TraceTogether(packet, departures, *own);
  ForEachRay(traced,
    [&](int ray)
    {
      if (const Hit* hit = own->Hits.GetAny(ray))
      {
        found.AddCrossing(
          ray, hit->T * Length(packet.GetDirection(ray)) / this->Selection.CellSize);
      }
    });
  this->Spare->GiveBack(std::move(own));
  const RaySet decided = Without(traced, Without(found.Unsure, found.Stopped));
  packet.Exists = Without(packet.Exists, decided);
  return found;
}

//------------------------------------------------------------------------------
/// Where all surfaces are opaque, any crossing decides, not only the first.
void MeshField::FindTransmittance(
  RayPacket& packet, const Departure* departures, double* transmittance)
{
  StoppedRays found;
  if (this->Selection.PacketKernels && this->Selection.Request.EndsRaysAtAnyHit())
  {
    found = this->FindStopped(packet, departures);
  }
  TracedField::FindTransmittance(packet, departures, transmittance);
  ForEachRay(found.Stopped, [transmittance](int ray) { transmittance[ray] = 0.0; });
}

//------------------------------------------------------------------------------
/// Adds the cap that a ray begins with, which may be null, and its hits, which were found in any
/// order. Returns whether nothing is left of the ray behind them.
bool MeshField::AddHits(const Hit* first, std::vector<Hit>& found, std::vector<Hit>& hits) const
{
  if (found.size() > 1)
  {
    PutInOrder(this->Selection.Request, first ? first->Surface : Hit::NoSurface, found);
  }
  HitCollector collector(*this, hits);
  return (first && collector.AddVisible(*first)) ||
    std::any_of(found.begin(), found.end(),
      [&collector](const Hit& hit) { return collector.AddVisible(hit); });
}

//------------------------------------------------------------------------------
void MeshField::AddClouds(const Camera& view, const std::vector<ValueIntervals>& shown,
  const Kernels* kernels, std::vector<ViewedCloud>& clouds) const
{
  clouds.push_back(
    { std::make_unique<MeshCloud>(this->Selection, shown, kernels ? *kernels : BaselineKernels),
      view });
}

//------------------------------------------------------------------------------
Vector3 MeshField::GetPoint(const Hit& hit) const
{
  MeshCell cell;
  this->Cells.LoadIds(hit.Cell, cell);
  this->Cells.LoadPoints(cell);
  return vtkIsosurfaceRayTracing::GetPoint(cell, hit.Parametric);
}

//------------------------------------------------------------------------------
Vector3 MeshField::GetPointInCells(const Hit& hit) const
{
  MeshCell cell;
  this->Cells.LoadIds(hit.Cell, cell);
  this->Cells.LoadPoints(cell);
  double longest = 0.0;
  for (int i = 1; i < cell.Count; ++i)
  {
    longest = std::max(longest, Length(cell.Points[i] - cell.Points[0]));
  }
  return vtkIsosurfaceRayTracing::GetPoint(cell, hit.Parametric) *
    (longest > 0.0 ? 1.0 / longest : 1.0);
}

//------------------------------------------------------------------------------
/// The power of two that makes a rise of all values along the whole mesh about 1.
double MeshField::GetUnitOfGradients() const
{
  const Bounds& box = this->Tree.GetBounds();
  const double length = Length(box.Upper * 0.5 - box.Lower * 0.5);
  const double rise = 0.5 * this->Tree.GetHigh() - 0.5 * this->Tree.GetLow();
  return length > 0.0 && rise > 0.0
    ? std::ldexp(1.0, std::clamp(std::ilogb(length) - std::ilogb(rise), -1000, 1000))
    : 1.0;
}

//------------------------------------------------------------------------------
/// Those at the corners of cells, if hits of the request are shaded by them and they are there;
/// else null.
const PointGradients* MeshField::GetSmoothGradients(NormalMode mode) const
{
  return mode == NormalMode::CentralDifferences && mode == this->Selection.Request.Normals
    ? this->Smooth.get()
    : nullptr;
}

//------------------------------------------------------------------------------
Vector3 MeshField::GetGradient(const Hit& hit, NormalMode mode) const
{
  if (hit.Plane != Hit::NoPlane)
  {
    return this->Selection.HalfSpaces[static_cast<std::size_t>(hit.Plane)].Normal;
  }
  MeshCell cell;
  this->Cells.LoadIds(hit.Cell, cell);
  if (const PointGradients* smoothGradients = this->GetSmoothGradients(mode))
  {
    CornerWeights weights;
    GetWeights(cell.Shape, hit.Parametric, weights);
    const Vector3 smooth = smoothGradients->Get(cell, weights);
    if (smooth != Vector3{})
    {
      return smooth;
    }
  }
  this->Cells.LoadPoints(cell);
  this->Cells.LoadValues(cell);
  return vtkIsosurfaceRayTracing::GetGradient(cell, hit.Parametric);
}

//------------------------------------------------------------------------------
void MeshField::GetPointsAndGradients(const Hit* hits, int count, NormalMode mode,
  double (*points)[RayPacket::Capacity], double (*gradients)[RayPacket::Capacity]) const
{
  const PointGradients* smoothGradients = this->GetSmoothGradients(mode);
  for (int first = 0; first < count; first += WeightedCorners::Capacity)
  {
    WeightedCorners corners;
    corners.Count = std::min(count - first, WeightedCorners::Capacity);
    for (int i = 0; i < corners.Count; ++i)
    {
      const Hit& hit = hits[first + i];
      const CellShape shape = this->Cells.LoadIds(hit.Cell, corners.Ids[i]);
      corners.Corners[i] = GetTraits(shape).Corners;
      GetWeights(shape, hit.Parametric, corners.Weights[i]);
      if (smoothGradients)
      {
        smoothGradients->Prefetch(corners.Ids[i], corners.Corners[i]);
      }
    }
    this->Cells.InterpolatePoints(corners, first, points);
    if (smoothGradients)
    {
      // There are none at caps.
      for (int i = 0; i < corners.Count; ++i)
      {
        corners.Corners[i] = hits[first + i].Plane == Hit::NoPlane ? corners.Corners[i] : 0;
      }
      smoothGradients->Interpolate(corners, first, gradients);
    }
  }
  for (int i = 0; i < count; ++i)
  {
    const bool isSmooth = smoothGradients &&
      (gradients[0][i] != 0.0 || gradients[1][i] != 0.0 || gradients[2][i] != 0.0);
    if (isSmooth)
    {
      continue;
    }
    const Vector3 gradient = this->GetGradient(hits[i], mode);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      gradients[axis][i] = gradient[axis];
    }
  }
}

//------------------------------------------------------------------------------
FieldStatistics MeshField::GetStatistics() const
{
  FieldStatistics statistics;
  statistics.HierarchyMemory = this->Tree.GetMemory() +
    (this->Boxes ? this->Boxes->GetMemory() : 0) + (this->Smooth ? this->Smooth->GetMemory() : 0);
  for (const std::unique_ptr<GradientsOfComponent>& component : this->SmoothOfComponents)
  {
    statistics.HierarchyMemory += component ? component->Smooth.GetMemory() : 0;
  }
  for (const MeshSurface& surface : this->Selection.Surfaces)
  {
    const PieceTrees* trees = surface.Trees->Get();
    statistics.CacheMemory += surface.Pieces->GetMemory() + (trees ? trees->GetMemory() : 0);
  }
  return statistics;
}

}
