// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/ImageField.h"

#include "Image/ImageStructures.h"
#include "Image/Tracers/ImageTracer.h"
#include "Image/Traversal/PacketTracer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The power of two by which values are multiplied before the isovalue is taken off: 1, unless the
/// values are so large or small that products of differences overflow or vanish.
double GetScale(const SampleRange& range, double isovalue)
{
  const double size = std::max({ std::abs(range.Min), std::abs(range.Max), std::abs(isovalue) });
  const bool isExtreme = size < 0x1p-400 || size > 0x1p400;
  return isExtreme && std::isfinite(size) && size > 0.0
    ? std::ldexp(1.0, std::clamp(-std::ilogb(size), -1000, 1000))
    : 1.0;
}

bool HaveSameIsovalues(const TraceRequest& a, const TraceRequest& b)
{
  return std::equal(a.Surfaces.begin(), a.Surfaces.end(), b.Surfaces.begin(), b.Surfaces.end(),
    [](const Isosurface& one, const Isosurface& other) { return one.Isovalue == other.Isovalue; });
}

}

//------------------------------------------------------------------------------
std::unique_ptr<ImageField> ImageField::New(
  const VolumeView& view, const ImageSettings& settings, int threads)
{
  auto structures = DispatchScalarType(view,
    [&settings, threads](const auto& samples)
    { return NewImageStructures(samples, settings, threads); });
  return std::unique_ptr<ImageField>(new ImageField(std::move(structures)));
}

//------------------------------------------------------------------------------
ImageField::ImageField(std::unique_ptr<ImageStructures> structures)
  : Structures(std::move(structures))
  , Selection(this->Structures->GetLattice())
  , Dimensions(this->Selection.GetDimensions())
  , Tracer(this->Structures->NewTracer(this->Selection))
{
}

//------------------------------------------------------------------------------
ImageField::~ImageField() = default;

//------------------------------------------------------------------------------
void ImageField::Select(const TraceRequest& request, int threads)
{
  this->Structures->BeginFrame(request.MaximumMemory);
  const TraceRequest& before = this->Selection.Request;
  const bool isOtherTracer =
    request.Field != before.Field || request.Projection != before.Projection;
  const bool areSameIsovalues = HaveSameIsovalues(request, before);
  this->Selection.Request = request;
  if (isOtherTracer)
  {
    this->Tracer = this->Structures->NewTracer(this->Selection);
  }
  const bool isOtherSpacing = this->Tracer->SetPlanes(request.Planes);
  if (areSameIsovalues && !isOtherTracer && !isOtherSpacing)
  {
    return;
  }
  this->Selection.Isovalues.clear();
  for (const Isosurface& surface : request.Surfaces)
  {
    this->Selection.Isovalues.push_back(
      { surface.Isovalue, GetScale(this->Structures->GetRange(), surface.Isovalue) });
  }
  this->Selection.SetActive(this->Tracer->FindActive(threads), threads);
}

//------------------------------------------------------------------------------
bool ImageField::MayHitBetween(RayPacket& lines) const
{
  // Extreme values and caps may be anywhere, not in active macrocells alone.
  const TraceRequest& request = this->Selection.Request;
  const bool isInTree = this->Selection.Tree && request.BeamKernels && !request.Planes &&
    !request.Projection && !request.Visible.HasCaps();
  return !isInTree ||
    PacketTracer::MayMeet(*request.BeamKernels, *this->Selection.Tree, this->Dimensions, lines);
}

//------------------------------------------------------------------------------
void ImageField::Trace(RayPacket& rays, RayHits& hits)
{
  hits.Clear();
  for (const HalfSpace& half : this->Selection.Request.Visible.HalfSpaces)
  {
    CutRays(half, rays);
  }
  this->Tracer->Trace(rays, hits);
}

//------------------------------------------------------------------------------
void ImageField::Trace(const std::vector<std::optional<Ray>>& rays, RayHits& hits)
{
  hits.Clear();
  RayHits some;
  RayPacket packet;
  for (std::size_t first = 0; first < rays.size(); first += RayPacket::Capacity)
  {
    packet.Count = 0;
    packet.Exists = {};
    for (std::size_t i = first; i < std::min(first + RayPacket::Capacity, rays.size()); ++i)
    {
      AddRay(rays[i], packet);
    }
    this->Trace(packet, some);
    hits.Append(some);
  }
}

//------------------------------------------------------------------------------
Vector3 ImageField::GetGradient(const Hit& hit, NormalMode mode) const
{
  return this->Tracer->GetGradient(hit, mode);
}

//------------------------------------------------------------------------------
void ImageField::GetGradients(const Hit* hits, int count, NormalMode mode, const Kernels& kernels,
  double (*gradients)[RayPacket::Capacity]) const
{
  this->Tracer->GetGradients(hits, count, mode, kernels, gradients);
}

//------------------------------------------------------------------------------
std::size_t ImageField::GetMacrocellMemory() const
{
  return this->Structures->GetMacrocellMemory();
}

//------------------------------------------------------------------------------
std::size_t ImageField::GetBrickMemory() const
{
  return this->Structures->GetBrickMemory();
}

//------------------------------------------------------------------------------
std::size_t ImageField::GetNumberOfBricks() const
{
  return this->Structures->GetNumberOfBricks();
}

//------------------------------------------------------------------------------
std::size_t ImageField::GetMaximumNumberOfBricks() const
{
  return this->Structures->GetMaximumNumberOfBricks();
}

//------------------------------------------------------------------------------
std::int64_t ImageField::GetBrickNanoseconds() const
{
  return this->Structures->GetBrickNanoseconds();
}

}
