// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ProjectionTracer_h
#define ProjectionTracer_h

#include "Image/Cells/TrilinearGradients.h"
#include "Image/Tracers/ImageTracer.h"
#include "Image/Traversal/Projector.h"

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
    const MacrocellHierarchy<T>& hierarchy, Layout& bricks)
    : ImageTracer(selection)
    , Gradients(samples)
    , Hierarchy(hierarchy)
    , Bricks(bricks)
  {
  }

  /// None: there are no surfaces. Rays use the ranges of macrocells.
  ActiveMacrocells FindActive(int /*threads*/) override
  {
    return ActiveMacrocells(this->Hierarchy.GetLattice());
  }

  void Trace(RayPacket& rays, RayHits& hits) override
  {
    Projector<T, Layout, Kind>(
      this->Hierarchy, this->Bricks, this->Selection.Lattice, this->Selection.Request.Visible)
      .Project(rays, hits);
  }

protected:
  Vector3 GetFieldGradient(const Hit& hit, NormalMode mode) const override
  {
    return this->Gradients.GetGradient(hit, mode, this->Selection.Lattice);
  }

private:
  TrilinearGradients<T> Gradients;
  const MacrocellHierarchy<T>& Hierarchy;
  Layout& Bricks;
};

}

#endif
