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
    const Kernels& kernels = this->Selection.GetAnyKernels();
    const int surfaces = static_cast<int>(this->Selection.Isovalues.size());
    for (int i = 0; i < surfaces; ++i)
    {
      roots.NextSurface();
      if (const TricubicCell* coefficients = this->Load(kernels, cell, i))
      {
        const bool firstOnly = !all && this->Selection.EndsRays(static_cast<std::size_t>(i));
        AddTricubicRoots(kernels, *coefficients, segment, i, firstOnly, roots);
      }
    }
  }

private:
  /// A cell whose coefficients were made for a surface, which may pass it or not.
  struct LoadedCell
  {
    Index3 Cell;
    int Surface = -1;
    bool MayHit;
  };

  /// Makes the coefficients of a cell, or finds them: neighbouring rays pass the same cells.
  /// Returns null if the surface does not pass it.
  const TricubicCell* Load(const Kernels& kernels, const Index3& cell, int surface)
  {
    const auto place =
      static_cast<std::size_t>((cell[0] & 7) | (cell[1] & 7) << 3 | ((cell[2] + surface) & 3) << 6);
    LoadedCell& loaded = this->Loaded[place];
    TricubicCell& coefficients = this->Coefficients[place];
    if (loaded.Surface != surface || loaded.Cell != cell)
    {
      const ScaledIsovalue& isovalue = this->Selection.Isovalues[static_cast<std::size_t>(surface)];
      const bool mayHit = this->Field.Load(kernels, cell, isovalue, coefficients);
      loaded = { cell, surface, mayHit };
    }
    return loaded.MayHit ? &coefficients : nullptr;
  }

  const ImageSelection& Selection;
  const TricubicField<T>& Field;
  CellMasks<T>& Masks;
  /// The block of the last mask, and the mask; Own is where it is made if it cannot be kept.
  Index3 Block = {};
  const BlockMask* Mask = nullptr;
  BlockMask Own;
  std::array<LoadedCell, 256> Loaded;
  std::array<TricubicCell, 256> Coefficients;
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
      [this](const Index3& block, BlockMask& mask) {
        this->Field.MakeMask(
          this->Selection.GetAnyKernels(), block, this->Selection.Isovalues, mask);
      });
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
    const Kernels& kernels = this->Selection.GetAnyKernels();
    const std::optional<double> value =
      this->Field.GetDifference(kernels, end.Cell, cap.Parametric, { 0.0, 1.0 });
    if (!value)
    {
      return;
    }
    cap.Value = *value;
    cap.Surface = this->FindInnermost([this, &kernels, &end, &cap](const ScaledIsovalue& isovalue)
      { return *this->Field.GetDifference(kernels, end.Cell, cap.Parametric, isovalue); });
  }

  Vector3 GetFieldGradient(const Hit& hit, NormalMode /*mode*/) const override
  {
    const Kernels& kernels = this->Selection.GetAnyKernels();
    const Index3 cell = this->Selection.Lattice.GetCell(hit);
    TricubicCell coefficients;
    this->Field.Load(kernels, cell, this->GetIsovalue(hit), coefficients);
    return this->FindGradient(kernels, coefficients, cell, hit);
  }

  /// Hits that follow each other are often in one cell, and of one surface.
  void GetGradients(const Hit* hits, const Index3* cells, int count, NormalMode mode,
    double (*gradients)[RayPacket::Capacity]) const override
  {
    const Kernels& kernels = this->Selection.GetAnyKernels();
    TricubicCell coefficients;
    int loaded = -1;
    for (int i = 0; i < count; ++i)
    {
      if (hits[i].Plane != Hit::NoPlane)
      {
        this->StoreGradient(hits[i], mode, i, gradients);
        continue;
      }
      if (loaded < 0 || cells[i] != cells[loaded] || hits[i].Surface != hits[loaded].Surface)
      {
        this->Field.Load(kernels, cells[i], this->GetIsovalue(hits[i]), coefficients);
        loaded = i;
      }
      const Vector3 gradient = this->FindGradient(kernels, coefficients, cells[i], hits[i]);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        gradients[axis][i] = gradient[axis];
      }
    }
  }

private:
  /// Gradients are made of differences to it: those of the values themselves lose the digits that
  /// the values have in common, and those of the smallest vanish.
  const ScaledIsovalue& GetIsovalue(const Hit& hit) const
  {
    return this->Selection.Isovalues[static_cast<std::size_t>(hit.Surface)];
  }

  Vector3 FindGradient(const Kernels& kernels, const TricubicCell& coefficients, const Index3& cell,
    const Hit& hit) const
  {
    Vector3 gradient;
    kernels.FindCellGradient(coefficients.data(), hit.Parametric.data(), gradient.data());
    return DivideByWidths(gradient, this->Selection.Lattice.GetPlanes(), cell);
  }

  TricubicField<T> Field;
  const MacrocellHierarchy<T>& Hierarchy;
  CellMasks<T>& Masks;
};

}

#endif
