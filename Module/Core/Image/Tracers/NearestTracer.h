// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef NearestTracer_h
#define NearestTracer_h

#include "Image/Macrocells/MacrocellHierarchy.h"
#include "Image/Samples/Unbricked.h"
#include "Image/Tracers/BoxFirstHits.h"
#include "Image/Tracers/BoxHits.h"
#include "Image/Tracers/SurfaceTracer.h"
#include "Image/Traversal/CellTraversal.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Interpolant::Nearest: rays traverse the cells, and cross faces between boxes there.
template <typename T, typename Layout>
class NearestTracer final : public SurfaceTracer
{
public:
  /// All must outlive the tracer.
  NearestTracer(const ImageSelection& selection, const Samples<T>& samples,
    const MacrocellHierarchy<T>& hierarchy, CellMasks<T>& masks, Layout& bricks)
    : SurfaceTracer(selection)
    , TheSamples(samples)
    , Hierarchy(hierarchy)
    , Masks(masks)
    , Bricks(bricks)
  {
  }

  /// The masks have the cells with samples that are not finite, too: there may be faces between
  /// others.
  ActiveMacrocells FindActive(int threads) override
  {
    const std::vector<double> isovalues = this->GetIsovalues();
    this->Masks.Select(isovalues, this->Selection.Request.Visible.HiddenCells,
      [this](const Index3& block, BlockMask& mask) { this->Masks.FindStraddling(block, mask); });
    return this->Hierarchy.FindActive(isovalues, threads);
  }

protected:
  void TraceSurfaces(RayPacket& rays, RayHits& hits) override
  {
    const bool endsRays = this->Selection.Request.HasOnlyOpaqueSurfaces();
    const bool isOne = this->Selection.Isovalues.size() == 1;
    // To the first of several surfaces it is less to go cell by cell than through whole slices.
    if (!this->Selection.CanTracePacket(rays) || (endsRays && !isOne))
    {
      this->TraceCellByCell(rays, hits);
    }
    else if (endsRays)
    {
      this->TraceFirstHits(rays, hits);
    }
    else
    {
      BoxHits<T, Layout> cells(this->Selection, rays, this->Masks, this->Bricks);
      RayFollower(*this->Selection.PacketKernels, this->Selection.GetTracedBlocks())
        .Follow(rays, cells);
      cells.AppendTo(hits);
    }
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
  /// Traces each ray by itself, cell by cell. This is the reference.
  void TraceCellByCell(const RayPacket& rays, RayHits& hits)
  {
    BoxCells<T, Layout> cells(this->Selection, this->Masks, this->Bricks);
    std::vector<FaceHit> faces;
    this->Selection.ForEachRay(rays, hits,
      [this, &cells, &faces, &hits](const Ray& ray)
      {
        HitCollector collector = this->Selection.NewCollector(hits.Hits);
        TraverseCells(ray, this->Selection.Active,
          [&](const Index3& cell)
          {
            faces.clear();
            cells.FindFacesIfAny(ray, cell, faces);
            return std::any_of(faces.begin(), faces.end(),
              [&collector](const FaceHit& face) { return collector.Add(face.TheHit); });
          });
      });
  }

  void TraceFirstHits(const RayPacket& rays, RayHits& hits)
  {
    FirstHitTracer tracer(*this->Selection.PacketKernels, this->Selection.GetTracedBlocks());
    BoxFirstHits<T, Layout> cells(this->Selection, rays, this->Masks, this->Bricks);
    const PacketHits& found = tracer.FindFirstHits(rays, cells, this->Selection.Isovalues[0]);
    for (int i = 0; i < rays.Count; ++i)
    {
      if (Has(found.Found, i))
      {
        const auto number = static_cast<std::size_t>(i);
        const int axis = found.Begin[number].Axis;
        hits.Hits.push_back(found.Hits[number]);
        Hit& hit = hits.Hits.back();
        hit.Jump = GetJump(axis, hit.Entering, rays.Direction[axis][i] > 0.0);
      }
      hits.EndRay();
    }
  }

  const Samples<T>& TheSamples;
  const MacrocellHierarchy<T>& Hierarchy;
  CellMasks<T>& Masks;
  Layout& Bricks;
};

}

#endif
