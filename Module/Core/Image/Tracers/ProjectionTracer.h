// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ProjectionTracer_h
#define ProjectionTracer_h

#include "Image/Cells/TrilinearGradients.h"
#include "Image/Tracers/ImageTracer.h"
#include "Image/Tracers/PacketProjector.h"

namespace vtkIsosurfaceRayTracing
{

/// A projection, of the trilinear interpolant: each ray has at most one hit, where its value is the
/// largest or the smallest.
template <typename T, typename Layout, Extremum Kind>
class ProjectionTracer final : public ImageTracer
{
public:
  /// All must outlive the tracer.
  ProjectionTracer(const ImageSelection& selection, const Samples<T>& samples,
    const MacrocellHierarchy<T>& hierarchy, CellMasks<T>& masks, Layout& bricks)
    : ImageTracer(selection)
    , Gradients(samples)
    , Hierarchy(hierarchy)
    , Masks(masks)
    , Bricks(bricks)
  {
  }

  /// All: there are no surfaces. Rays use the ranges of macrocells.
  ActiveMacrocells FindActive(int threads) override
  {
    ActiveMacrocells active(this->Hierarchy.GetLattice());
    for (std::size_t level = 0; level < this->Hierarchy.GetLattice().Levels.size(); ++level)
    {
      active.Fill(level, threads, [](std::size_t /*macrocell*/) { return true; });
    }
    return active;
  }

  void Trace(RayPacket& rays, RayHits& hits) override
  {
    Projector<T, Layout, Kind> projector(
      this->Hierarchy, this->Bricks, this->Selection.Lattice, this->Selection.Request.Visible);
    if (this->Selection.CanTracePacket(rays) && !this->Selection.Cropped)
    {
      PacketProjector<T, Layout, Kind>(this->Selection, rays, this->Masks, this->Bricks, projector)
        .Project(hits);
      return;
    }
    this->Selection.ForEachRay(rays, hits,
      [&projector, &hits](const Ray& ray)
      {
        const Projection projection = projector.Project(ray);
        if (projection.Exists())
        {
          hits.Hits.push_back(projection.Found);
        }
      });
  }

protected:
  Vector3 GetFieldGradient(const Hit& hit, NormalMode mode) const override
  {
    return this->Gradients.GetGradient(hit, mode, this->Selection.Lattice);
  }

private:
  TrilinearGradients<T> Gradients;
  const MacrocellHierarchy<T>& Hierarchy;
  CellMasks<T>& Masks;
  Layout& Bricks;
};

}

#endif
