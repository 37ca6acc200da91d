// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef NearestTracer_h
#define NearestTracer_h

#include "Image/Cells/BoxFaces.h"
#include "Image/Macrocells/CellMasks.h"
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
    if (this->Selection.Isovalues.size() == 1 && this->Selection.IsOpaque(0) &&
      this->Selection.CanTracePacket(rays))
    {
      this->TraceFirstHits(rays, hits);
      return;
    }
    if (this->Selection.CanTracePacket(rays))
    {
      BoxHits<T, Layout> cells(this->Selection, rays, this->Masks, this->Bricks);
      RayFollower(*this->Selection.PacketKernels, this->Selection.GetTracedBlocks())
        .Follow(rays, cells);
      cells.AppendTo(hits);
      return;
    }
    this->TraceCellByCell(rays, hits);
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

  /// Traces each ray by itself, cell by cell. This is the reference.
  void TraceCellByCell(const RayPacket& rays, RayHits& hits)
  {
    typename Layout::Reader reader(this->Bricks);
    std::vector<FaceHit> faces;
    this->Selection.ForEachRay(rays, hits,
      [this, &reader, &faces, &hits](const Ray& ray)
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
            faces.clear();
            FindFaceHits(
              ray, cell, values, this->Selection.Lattice, this->Selection.Request.Surfaces, faces);
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
  CellMasks<T>& Masks;
  Layout& Bricks;
};

}

#endif
