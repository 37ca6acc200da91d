// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef NearestTracer_h
#define NearestTracer_h

#include "Image/Cells/BoxFaces.h"
#include "Image/Macrocells/MacrocellHierarchy.h"
#include "Image/Samples/Unbricked.h"
#include "Image/Tracers/SurfaceTracer.h"
#include "Image/Traversal/CellTraversal.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{

/// Interpolant::Nearest: rays traverse the cells, and cross faces between boxes there.
template <typename T, typename Layout>
class NearestTracer final : public SurfaceTracer
{
public:
  /// All must outlive the tracer.
  NearestTracer(const ImageSelection& selection, const Samples<T>& samples,
    const MacrocellHierarchy<T>& hierarchy, Layout& bricks)
    : SurfaceTracer(selection)
    , TheSamples(samples)
    , Hierarchy(hierarchy)
    , Bricks(bricks)
  {
  }

  ActiveMacrocells FindActive(int threads) override
  {
    return this->Hierarchy.FindActive(this->GetIsovalues(), threads);
  }

protected:
  void TraceSurfaces(RayPacket& rays, RayHits& hits) override
  {
    typename Layout::Reader reader(this->Bricks);
    this->Selection.ForEachRay(rays, hits,
      [this, &reader, &hits](const Ray& ray)
      {
        HitCollector collector = this->Selection.NewCollector(hits.Hits);
        TraverseCells(ray, this->Selection.Active,
          [&](const Index3& cell)
          {
            Value corners[8];
            reader.Load(cell, corners);
            if (!this->HasFaces(corners))
            {
              return false;
            }
            CellCorners values;
            std::copy(corners, corners + 8, values.begin());
            return AddFaceHits(ray, cell, values, this->Selection.Lattice,
              this->Selection.Request.Surfaces, collector);
          });
      });
  }

  bool HasBoxes() const override { return true; }

  void EvaluateCap(const Ray& ray, const EndCell& end, Hit& cap) const override
  {
    Stored<T> corners[8];
    LoadCorners(this->TheSamples, end.Cell, corners);
    const auto value = static_cast<double>(corners[FindBox(ray, end.Cell, end.At)]);
    if (!std::isfinite(value))
    {
      return;
    }
    cap.Value = value;
    cap.Surface = this->FindInnermost([value](const ScaledIsovalue& isovalue)
      { return Difference(value, isovalue.Isovalue, isovalue.Scale); });
  }

  Vector3 GetFieldGradient(const Hit& hit, NormalMode /*mode*/) const override
  {
    return GetJumpDirection(hit);
  }

private:
  using Value = typename Layout::Value;

  /// Whether a face between the boxes of a cell's corners is a surface.
  bool HasFaces(const Value corners[8]) const
  {
    ValueRange<Value> range;
    for (int corner = 0; corner < 8; ++corner)
    {
      range.Include(corners[corner], corners[corner]);
    }
    const std::vector<Isosurface>& surfaces = this->Selection.Request.Surfaces;
    return std::any_of(surfaces.begin(), surfaces.end(),
      [&range](const Isosurface& surface) { return range.Straddles(surface.Isovalue); });
  }

  const Samples<T>& TheSamples;
  const MacrocellHierarchy<T>& Hierarchy;
  Layout& Bricks;
};

}

#endif
