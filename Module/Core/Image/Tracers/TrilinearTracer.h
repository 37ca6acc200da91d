// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearTracer_h
#define TrilinearTracer_h

#include "Image/Cells/TrilinearGradients.h"
#include "Image/Macrocells/MacrocellHierarchy.h"
#include "Image/Tracers/AllHitsTracer.h"
#include "Image/Tracers/RootTracing.h"
#include "Image/Tracers/StopTracer.h"
#include "Image/Tracers/SurfaceTracer.h"
#include "Image/Tracers/TrilinearFirstHits.h"

namespace vtkIsosurfaceRayTracing
{

/// Interpolant::Trilinear.
template <typename T, typename Layout>
class TrilinearTracer final : public SurfaceTracer
{
public:
  /// All must outlive the tracer.
  TrilinearTracer(const ImageSelection& selection, const Samples<T>& samples,
    const MacrocellHierarchy<T>& hierarchy, CellMasks<T>& masks, Layout& bricks)
    : SurfaceTracer(selection)
    , TheSamples(samples)
    , Gradients(samples)
    , Hierarchy(hierarchy)
    , Masks(masks)
    , Bricks(bricks)
  {
  }

  ActiveMacrocells FindActive(int threads) override
  {
    const std::vector<double> isovalues = this->GetIsovalues();
    this->Masks.Select(isovalues, this->Selection.Request.Visible.HiddenCells);
    return this->Hierarchy.FindActive(isovalues, threads);
  }

  void GetGradients(const Hit* hits, const Index3* cells, int count, NormalMode mode,
    double (*gradients)[RayPacket::Capacity]) const override
  {
    const Kernels* kernels = this->Selection.PacketKernels;
    if (!kernels || mode != NormalMode::CentralDifferences)
    {
      SurfaceTracer::GetGradients(hits, cells, count, mode, gradients);
      return;
    }
    const RaySet others = this->Gradients.InterpolateDifferences(
      hits, cells, count, *kernels, this->Selection.Lattice.GetPlanes(), gradients);
    if (IsEmpty(others))
    {
      return;
    }
    for (int i = 0; i < count; ++i)
    {
      if (Has(others, i))
      {
        this->StoreGradient(hits[i], mode, i, gradients);
      }
    }
  }

  std::optional<StoppedRays> FindStopped(
    const RayPacket& rays, const Departure* departures) override
  {
    TrilinearCells<T, Layout> cells(this->Selection, this->Masks, this->Bricks);
    if (this->HasKernels(rays))
    {
      CornerRows<Layout> corners(cells.GetReader());
      return StopTracer(this->Selection, rays, departures, cells, corners).FindStopped();
    }
    return FindStoppedRays(this->Selection, rays, departures, cells);
  }

protected:
  void TraceSurfaces(RayPacket& rays, RayHits& hits) override
  {
    const bool hasKernels = this->HasKernels(rays);
    if (hasKernels && this->HasOneOpaqueSurface())
    {
      this->TraceFirstHits(rays, hits);
      return;
    }
    TrilinearCells<T, Layout> cells(this->Selection, this->Masks, this->Bricks);
    if (hasKernels)
    {
      CornerRows<Layout> corners(cells.GetReader());
      AllHitsTracer(this->Selection, rays, cells, corners).FindHits(hits);
      return;
    }
    TraceRoots(this->Selection, rays, cells, hits);
  }

  void EvaluateCap(const Ray& /*ray*/, const EndCell& end, Hit& cap) const override
  {
    Stored<T> corners[8];
    LoadCorners(this->TheSamples, end.Cell, corners);
    if (!IsFinite(corners))
    {
      return;
    }
    CellCorners values;
    std::copy(corners, corners + 8, values.begin());
    cap.Value = Interpolate(values, cap.Parametric);
    cap.Surface = this->FindInnermost([&values, &cap](const ScaledIsovalue& isovalue)
      { return Interpolate(TakeOff(values, isovalue), cap.Parametric); });
  }

  Vector3 GetFieldGradient(const Hit& hit, NormalMode mode) const override
  {
    return this->Gradients.GetGradient(hit, mode, this->Selection.Lattice);
  }

private:
  /// Whether kernels find the roots of rays that are requested.
  bool HasKernels(const RayPacket& rays) const
  {
    return this->Selection.Request.Solver == RootSolver::Robust &&
      this->Selection.CanTracePacket(rays);
  }

  /// Of one opaque surface only the first hits are needed.
  bool HasOneOpaqueSurface() const
  {
    return this->Selection.Isovalues.size() == 1 && this->Selection.IsOpaque(0);
  }

  void TraceFirstHits(RayPacket& rays, RayHits& hits)
  {
    FirstHitTracer tracer(*this->Selection.PacketKernels, this->Selection.GetTracedBlocks());
    TrilinearFirstHits<T, Layout> cells(this->Selection, rays, this->Masks, this->Bricks);
    const PacketHits& found = tracer.FindFirstHits(rays, cells, this->Selection.Isovalues[0]);
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

  const Samples<T>& TheSamples;
  TrilinearGradients<T> Gradients;
  const MacrocellHierarchy<T>& Hierarchy;
  CellMasks<T>& Masks;
  Layout& Bricks;
};

}

#endif
