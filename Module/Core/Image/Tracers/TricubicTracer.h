// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TricubicTracer_h
#define TricubicTracer_h

#include "Image/Cells/TricubicField.h"
#include "Image/Cells/TricubicRoots.h"
#include "Image/Cells/TrilinearGradients.h"
#include "Image/Macrocells/CellMasks.h"
#include "Image/Macrocells/MacrocellHierarchy.h"
#include "Image/Tracers/RootTracing.h"
#include "Image/Tracers/SurfaceTracer.h"

namespace vtkIsosurfaceRayTracing
{

/// The cells of an image, by the tricubic interpolant.
template <typename T>
class TricubicCells final : public RootCells
{
public:
  TricubicCells(const ImageSelection& selection, const TricubicField<T>& field, CellMasks<T>& masks)
    : Selection(selection)
    , Field(field)
    , Masks(masks)
  {
  }

  const BlockMask& GetMask(const Index3& block, BlockMask& own) override
  {
    return this->Masks.Get(block, own);
  }

  /// Samples are read where the user keeps them.
  void Prefetch(const Index3& block) override { this->Masks.Prefetch(block); }

  /// Whether the cell is in the mask of its block.
  bool MayHit(const Index3& cell) override
  {
    constexpr int edge = BlockMask::Edge;
    const Index3 block = { cell[0] / edge, cell[1] / edge, cell[2] / edge };
    if (!this->Mask || block != this->Block)
    {
      this->Mask = &this->Masks.Get(block, this->Own);
      this->Block = block;
    }
    return this->Mask->Has({ cell[0] % edge, cell[1] % edge, cell[2] % edge });
  }

  void FindRoots(const Index3& cell, const CellSegment& segment, bool all, RootSet& roots) override
  {
    roots.Clear();
    for (std::size_t i = 0; i < this->Selection.Isovalues.size(); ++i)
    {
      roots.NextSurface();
      TricubicCell coefficients;
      if (this->Field.Load(cell, this->Selection.Isovalues[i], coefficients))
      {
        AddTricubicRoots(
          coefficients, segment, static_cast<int>(i), !all && this->Selection.EndsRays(i), roots);
      }
    }
  }

private:
  const ImageSelection& Selection;
  const TricubicField<T>& Field;
  CellMasks<T>& Masks;
  /// The block of the last mask, and the mask; Own is where it is made if it cannot be kept.
  Index3 Block = {};
  const BlockMask* Mask = nullptr;
  BlockMask Own;
};

/// Interpolant::Tricubic.
template <typename T>
class TricubicTracer final : public SurfaceTracer
{
public:
  /// All must outlive the tracer.
  TricubicTracer(const ImageSelection& selection, const Samples<T>& samples,
    const MacrocellHierarchy<T>& hierarchy, CellMasks<T>& masks)
    : SurfaceTracer(selection)
    , Field(samples)
    , Hierarchy(hierarchy)
    , Masks(masks)
  {
  }

  bool SetPlanes(const UnevenPlanes* planes) override { return this->Field.SetPlanes(planes); }

  /// A macrocell is active also by the samples around it, and by the overshoot of coefficients; the
  /// mask of a block has the cells with coefficients on both sides.
  ActiveMacrocells FindActive(int threads) override
  {
    const std::vector<double> isovalues = this->GetIsovalues();
    this->Masks.Select(isovalues, this->Selection.Request.Visible.HiddenCells,
      [this](const Index3& block, BlockMask& mask)
      { this->Field.MakeMask(block, this->Selection.Isovalues, mask); });
    return this->Hierarchy.FindActive(isovalues, this->Field.GetEdges().GetOvershoot(), threads);
  }

  std::optional<StoppedRays> FindStopped(
    const RayPacket& rays, const Departure* departures) override
  {
    TricubicCells<T> cells(this->Selection, this->Field, this->Masks);
    return FindStoppedRays(this->Selection, rays, departures, cells);
  }

protected:
  void TraceSurfaces(RayPacket& rays, RayHits& hits) override
  {
    TricubicCells<T> cells(this->Selection, this->Field, this->Masks);
    TraceRoots(this->Selection, rays, cells, hits);
  }

  void EvaluateCap(const Ray& /*ray*/, const EndCell& end, Hit& cap) const override
  {
    const std::optional<double> value =
      this->Field.GetDifference(end.Cell, cap.Parametric, { 0.0, 1.0 });
    if (!value)
    {
      return;
    }
    cap.Value = *value;
    cap.Surface = this->FindInnermost([this, &end, &cap](const ScaledIsovalue& isovalue)
      { return *this->Field.GetDifference(end.Cell, cap.Parametric, isovalue); });
  }

  Vector3 GetFieldGradient(const Hit& hit, NormalMode /*mode*/) const override
  {
    const CellLattice& lattice = this->Selection.Lattice;
    const Index3 cell = lattice.GetCell(hit);
    return DivideByWidths(this->Field.GetGradient(cell, hit.Parametric), lattice.GetPlanes(), cell);
  }

private:
  TricubicField<T> Field;
  const MacrocellHierarchy<T>& Hierarchy;
  CellMasks<T>& Masks;
};

}

#endif
