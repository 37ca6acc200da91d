// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/ImageField.h"

#include "Field/PixelBlocks.h"
#include "Image/ImageStructures.h"
#include "Image/Tracers/ImageTracer.h"
#include "Image/Traversal/PacketTracer.h"
#include "Math/PrefetchLines.h"
#include "Math/TrilinearCell.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

bool HaveSameIsovalues(const TraceRequest& a, const TraceRequest& b)
{
  return std::equal(a.Surfaces.begin(), a.Surfaces.end(), b.Surfaces.begin(), b.Surfaces.end(),
    [](const Isosurface& one, const Isosurface& other) { return one.Isovalue == other.Isovalue; });
}

/// Says of rays that kernels have made which cells they stay in along the axes whose planes they
/// are parallel to, if these are uneven; see Ray.
void SetCellsOfParallelRays(const UnevenPlanes* planes, RayPacket& rays)
{
  for (int i = 0; planes && i < rays.Count; ++i)
  {
    if (!Has(rays.Exists, i))
    {
      continue;
    }
    Vector3 origin = rays.GetOrigin(i);
    Vector3 direction = rays.GetDirection(i);
    SnapToPlanes(*planes, origin, direction);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (direction[axis] == 0.0)
      {
        rays.Origin[axis][i] = origin[axis];
        rays.Direction[axis][i] = 0.0;
        rays.Inverse[axis][i] = planes->FindCell(axis, origin[axis]);
      }
    }
  }
}

}

//------------------------------------------------------------------------------
std::unique_ptr<ImageField> ImageField::New(
  const VolumeView& view, const ImageSettings& settings, int threads)
{
  auto field = NewUnread(view, settings);
  while (field->GetFractionRead() < 1.0)
  {
    field->ReadSlab(threads);
  }
  return field;
}

//------------------------------------------------------------------------------
std::unique_ptr<ImageField> ImageField::NewUnread(
  const VolumeView& view, const ImageSettings& settings)
{
  auto structures = DispatchScalarType(
    view, [&settings](const auto& samples) { return NewImageStructures(samples, settings); });
  return std::unique_ptr<ImageField>(new ImageField(std::move(structures)));
}

//------------------------------------------------------------------------------
ImageField::ImageField(std::unique_ptr<ImageStructures> structures)
  : Structures(std::move(structures))
  , Selection(*this, this->Structures->GetLattice())
  , Tracer(this->Structures->NewTracer(this->Selection))
{
}

//------------------------------------------------------------------------------
ImageField::~ImageField() = default;

//------------------------------------------------------------------------------
void ImageField::ReadSlab(int threads, RangeStore* store)
{
  this->HasReadMore = true;
  this->Structures->ReadSlab(threads, store);
}

//------------------------------------------------------------------------------
double ImageField::GetFractionRead() const
{
  return this->Structures->GetFractionRead();
}

//------------------------------------------------------------------------------
void ImageField::SetPlanes(const UnevenPlanes* planes)
{
  this->Selection.Lattice.SetPlanes(planes);
}

//------------------------------------------------------------------------------
void ImageField::Select(
  const TraceRequest& request, const Execution& execution, const MemoryBudget& budget)
{
  this->Structures->BeginFrame(budget.CacheBytes);
  this->Selection.PacketKernels = execution.PacketKernels;
  // Whatever throws on the way, the next call starts over.
  const bool wasComplete = std::exchange(this->IsSelectionComplete, false);
  const TraceRequest& before = this->Selection.Request;
  const bool isOtherTracer = !wasComplete || request.Interpolation != before.Interpolation ||
    request.Projection != before.Projection;
  const bool areSameIsovalues =
    HaveSameIsovalues(request, before) && request.Visible.HiddenCells == before.Visible.HiddenCells;
  this->Selection.Request = request;
  if (isOtherTracer)
  {
    this->Tracer = this->Structures->NewTracer(this->Selection);
  }
  this->Selection.SetCropping();
  const bool isOtherSpacing = this->Tracer->SetPlanes(this->Selection.Lattice.GetPlanes());
  const bool isOtherRange = std::exchange(this->HasReadMore, false);
  if (areSameIsovalues && !isOtherTracer && !isOtherSpacing && !isOtherRange)
  {
    this->IsSelectionComplete = true;
    return;
  }
  const SampleRange range = this->Structures->GetRange();
  this->Selection.Isovalues.clear();
  for (const Isosurface& surface : request.Surfaces)
  {
    this->Selection.Isovalues.push_back(
      { surface.Isovalue, GetValueScale(range.Min, range.Max, surface.Isovalue) });
  }
  this->Selection.SetActive(this->Tracer->FindActive(execution.Threads), execution.Threads);
  // A pass reads all samples anyway; which of them a projection needs is not known.
  if (this->GetFractionRead() == 1.0 && !request.Projection)
  {
    this->Structures->ReadAhead(this->Selection.Active);
  }
  this->IsSelectionComplete = true;
}

//------------------------------------------------------------------------------
bool ImageField::MayHit() const
{
  const TraceRequest& request = this->Selection.Request;
  return request.Projection || request.Visible.HasCaps() ||
    (!request.Surfaces.empty() && this->Selection.Active.IsAnyActive());
}

//------------------------------------------------------------------------------
Bounds ImageField::GetBounds() const
{
  const Index3& cells = this->Selection.Lattice.GetCells();
  return { { 0.0, 0.0, 0.0 },
    { static_cast<double>(cells[0]), static_cast<double>(cells[1]),
      static_cast<double>(cells[2]) } };
}

//------------------------------------------------------------------------------
void ImageField::AddRay(const Vector3& origin, const Vector3& direction, double begin, double end,
  RayPacket& packet) const
{
  const CellLattice& lattice = this->Selection.Lattice;
  AppendRay(
    ClipToVolume(origin, direction, begin, end, lattice.GetDimensions(), lattice.GetPlanes()),
    packet);
}

//------------------------------------------------------------------------------
/// Those that make rays; none for rays that are made one by one, as where cells at the border are
/// flat: kernels do not know of these.
const Kernels* ImageField::GetKernelsOfRays() const
{
  const UnevenPlanes* planes = this->Selection.Lattice.GetPlanes();
  return planes && planes->HasFlatBorder() ? nullptr : this->Selection.PacketKernels;
}

//------------------------------------------------------------------------------
void ImageField::ClipRays(RayPacket& packet) const
{
  const CellLattice& lattice = this->Selection.Lattice;
  const Kernels* kernels = this->GetKernelsOfRays();
  if (!kernels)
  {
    TracedField::ClipRays(packet);
    return;
  }
  kernels->ClipRays(lattice.GetDimensions().data(), packet);
  SetCellsOfParallelRays(lattice.GetPlanes(), packet);
}

//------------------------------------------------------------------------------
void ImageField::MoveRays(
  const RayPacket& rays, const RaysInBox& parts, const Matrix4& ownFromRays, RayPacket& moved) const
{
  const CellLattice& lattice = this->Selection.Lattice;
  const Kernels* kernels = this->GetKernelsOfRays();
  if (!kernels)
  {
    TracedField::MoveRays(rays, parts, ownFromRays, moved);
    return;
  }
  kernels->MoveRays(rays, parts, ownFromRays.data(), lattice.GetDimensions().data(), moved);
  SetCellsOfParallelRays(lattice.GetPlanes(), moved);
}

//------------------------------------------------------------------------------
void ImageField::MakeRays(const Camera& view, const PixelRectangle& pixels,
  const PixelDepths& depths, RayPacket& packet) const
{
  const CellLattice& lattice = this->Selection.Lattice;
  const Kernels* kernels = this->GetKernelsOfRays();
  if (!kernels)
  {
    TracedField::MakeRays(view, pixels, depths, packet);
    return;
  }
  PixelBlock block = MakePixelBlock(view, pixels, depths);
  block.Dimensions = lattice.GetDimensions().data();
  kernels->MakeRays(block, packet);
  SetCellsOfParallelRays(lattice.GetPlanes(), packet);
}

//------------------------------------------------------------------------------
bool ImageField::MayHitBetween(RayPacket& lines, Beam* /*beam*/) const
{
  // Extreme values and caps may be anywhere, not in active macrocells alone.
  const TraceRequest& request = this->Selection.Request;
  const CellLattice& lattice = this->Selection.Lattice;
  const Kernels* kernels = this->Selection.PacketKernels;
  const bool isInTree =
    this->Selection.Tree && kernels && !request.Projection && !request.Visible.HasCaps();
  return !isInTree || PacketTracer::MayMeet(*kernels, *this->Selection.Tree, lattice, lines);
}

//------------------------------------------------------------------------------
void ImageField::Prefetch() const
{
  constexpr std::size_t sizeOfTracer = 128; // About.
  PrefetchLines(this->Tracer.get(), sizeOfTracer);
  this->Selection.Prefetch();
  this->Structures->Prefetch();
}

//------------------------------------------------------------------------------
void ImageField::Trace(RayPacket& packet, RayHits& hits, Beam* /*beam*/)
{
  hits.Clear();
  CutRays(this->Selection.Request.Visible.HalfSpaces, packet);
  this->Tracer->Trace(packet, hits);
}

//------------------------------------------------------------------------------
/// Where all surfaces are opaque, any crossing decides, not only the first.
void ImageField::FindTransmittance(
  RayPacket& packet, const Departure* departures, double* transmittance)
{
  std::optional<StoppedRays> found;
  if (this->Selection.Request.EndsRaysAtAnyHit())
  {
    CutRays(this->Selection.Request.Visible.HalfSpaces, packet);
    found = this->Tracer->FindStopped(packet, departures);
  }
  if (found)
  {
    // Only rays that are still undecided are left.
    packet.Exists = Without(found->Unsure, found->Stopped);
  }
  TracedField::FindTransmittance(packet, departures, transmittance);
  for (int i = 0; found && i < packet.Count; ++i)
  {
    transmittance[i] = Has(found->Stopped, i) ? 0.0 : transmittance[i];
  }
}

//------------------------------------------------------------------------------
Vector3 ImageField::GetPoint(const Hit& hit) const
{
  return this->Selection.Lattice.GetPoint(hit);
}

//------------------------------------------------------------------------------
Vector3 ImageField::GetPointInCells(const Hit& hit) const
{
  return this->Selection.Lattice.GetPointInCells(hit);
}

//------------------------------------------------------------------------------
Vector3 ImageField::GetGradient(const Hit& hit, NormalMode mode) const
{
  return this->Tracer->GetGradient(hit, mode);
}

//------------------------------------------------------------------------------
void ImageField::GetPointsAndGradients(const Hit* hits, int count, NormalMode mode,
  double (*points)[RayPacket::Capacity], double (*gradients)[RayPacket::Capacity]) const
{
  Index3 cells[RayPacket::Capacity];
  for (int i = 0; i < count; ++i)
  {
    cells[i] = this->Selection.Lattice.GetCell(hits[i]);
    const Vector3 point = this->Selection.Lattice.GetPoint(cells[i], hits[i].Parametric);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      points[axis][i] = point[axis];
    }
  }
  this->Tracer->GetGradients(hits, cells, count, mode, gradients);
}

//------------------------------------------------------------------------------
FieldStatistics ImageField::GetStatistics() const
{
  return this->Structures->GetStatistics();
}

}
