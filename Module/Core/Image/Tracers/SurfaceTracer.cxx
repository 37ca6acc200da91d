// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Tracers/SurfaceTracer.h"

#include "Image/Cells/CellSegment.h"

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void SurfaceTracer::Trace(RayPacket& rays, RayHits& hits)
{
  if (this->Selection.Request.Visible.HasCaps())
  {
    this->TraceBetweenCaps(rays, hits);
  }
  else
  {
    this->TraceSurfaces(rays, hits);
  }
}

//------------------------------------------------------------------------------
void SurfaceTracer::TraceBetweenCaps(const RayPacket& rays, RayHits& hits)
{
  RayPacket inner = rays;
  RayCaps caps[RayPacket::Capacity];
  for (int i = 0; i < rays.Count; ++i)
  {
    if (Has(rays.Exists, i))
    {
      caps[i] = this->CutToCaps(inner, i);
    }
  }
  RayHits between;
  between.Clear();
  this->TraceSurfaces(inner, between);
  for (int i = 0; i < rays.Count; ++i)
  {
    const auto ray = static_cast<std::size_t>(i);
    HitCollector collector = this->Selection.NewCollector(hits.Hits);
    bool isOver = caps[i].First && collector.Add(*caps[i].First);
    for (std::size_t k = between.First[ray]; k < between.First[ray + 1] && !isOver; ++k)
    {
      isOver = collector.Add(between.Hits[k]);
    }
    if (caps[i].Last && !isOver)
    {
      collector.Add(*caps[i].Last);
    }
    hits.EndRay();
  }
}

//------------------------------------------------------------------------------
/// Finds the caps of a ray, and cuts it to the part between them. If nothing is left, or if the
/// first cap is opaque, the ray no longer exists.
SurfaceTracer::RayCaps SurfaceTracer::CutToCaps(RayPacket& rays, int i) const
{
  Ray ray = this->Selection.TakeRay(rays, i);
  const int firstPlane = this->GoToPlane(ray, RayEnd::Begin);
  const int lastPlane = this->GoToPlane(ray, RayEnd::End);
  rays.Begin[i] = ray.Begin;
  rays.End[i] = ray.End;
  RayCaps caps;
  caps.First = this->FindCap(ray, RayEnd::Begin, firstPlane);
  if (!(ray.Begin < ray.End) ||
    (caps.First && this->Selection.Request.GetOpacity(*caps.First) >= 1.0))
  {
    Remove(i, rays.Exists);
    return caps;
  }
  caps.Last = this->FindCap(ray, RayEnd::End, lastPlane);
  return caps;
}

//------------------------------------------------------------------------------
/// The half-space with caps in whose plane a ray begins or ends; there may be none. Where other
/// planes coincide with it, the ray is extended to what the half-space leaves.
int SurfaceTracer::GoToPlane(Ray& ray, RayEnd end) const
{
  const Index3& cells = this->Selection.Lattice.GetCells();
  const int plane = FindCappedPlane(ray, end, this->Selection.Request.Visible.HalfSpaces, cells);
  if (plane != Hit::NoPlane)
  {
    StepOverPlanes(ray, end, cells, this->HasBoxes());
  }
  return plane;
}

//------------------------------------------------------------------------------
/// The cap in a plane at one end of a ray that is cut, if one is visible there.
std::optional<Hit> SurfaceTracer::FindCap(const Ray& ray, RayEnd end, int plane) const
{
  if (plane == Hit::NoPlane)
  {
    return std::nullopt;
  }
  CellSegment segment;
  const EndCell endCell = FindEndCell(ray, end, this->Selection.Lattice.GetCells());
  if (!SegmentInCell(ray, endCell.Cell, segment))
  {
    return std::nullopt;
  }
  const bool isEntering = end == RayEnd::Begin;
  Hit cap = MakeHit(ray, this->Selection.Lattice, endCell.Cell, segment, isEntering ? 0.0 : 1.0,
    Hit::NoSurface, isEntering);
  cap.Plane = plane;
  const TraceRequest& request = this->Selection.Request;
  if (request.Visible.IsConvex() ||
    request.Visible.Shows(cap, this->Selection.Lattice.GetPoint(cap)))
  {
    this->EvaluateCap(ray, endCell, cap);
  }
  return cap.Surface != Hit::NoSurface ? std::make_optional(cap) : std::nullopt;
}

}
