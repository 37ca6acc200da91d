// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Blocks of an AMR data set that fill a box of a level, as a field that is traced.

#ifndef vtkIsosurfaceRayTraceAmrPart_h
#define vtkIsosurfaceRayTraceAmrPart_h

#include "vtkIsosurfaceRayTraceAmrBlocks.h" // for ivars
#include "vtkIsosurfaceRayTraceGeometry.h"  // for ivars
#include "vtkIsosurfaceRayTraceLeaves.h"    // for ivars
#include "vtkIsosurfaceRayTracePart.h"      // for base class
#include "vtkIsosurfaceRayTraceScalars.h"   // for ivars
#include "vtkIsosurfaceRayTracingCompat.h"  // for VTK_ABI_NAMESPACE_BEGIN

#include "Amr/AmrHierarchy.h"
#include "Image/ImageField.h"

#include <cstddef>  // for std::size_t
#include <memory>   // for std::unique_ptr
#include <optional> // for std::optional
#include <vector>   // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkVolumeMapper;

class vtkIsosurfaceRayTraceAmrPart final : public vtkIsosurfaceRayTracePart
{
public:
  /// Makes the parts of blocks, which must have no problem but those of their places. The mapper
  /// that crops may be null. Former parts are those of blocks that have not been modified since;
  /// they are taken where only the display of blocks is another.
  static std::vector<std::unique_ptr<vtkIsosurfaceRayTracePart>> MakeParts(
    const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves,
    const vtkIsosurfaceRayTraceScalars& scalars,
    const vtkIsosurfaceRayTracing::ImageSettings& settings, vtkVolumeMapper* cropping, int threads,
    std::vector<std::unique_ptr<vtkIsosurfaceRayTraceAmrPart>>&& former,
    vtkIsosurfaceRayTraceLeftOut& leftOut);

  bool MayHit(const vtkIsosurfaceRayTracing::TraceRequest& request) override;
  vtkIsosurfaceRayTracing::TracedField& GetField() override;
  vtkIsosurfaceRayTracing::Visibility FindVisible() const override;
  std::size_t GetMemory() const override;
  vtkIsosurfaceRayTracing::Matrix4 FindPhysicalFromObject() const override
  {
    return this->Geometry.GetPhysicalFromObject();
  }
  bool IsBuiltOnDemand() const override { return true; }
  bool IsSeamless() const override { return true; }
  bool Update(int threads) override;
  vtkIsosurfaceRayTracing::Bounds FindBox() const override;
  double FindCellSize() const override { return 1.0; }
  vtkIdType FindCell(const vtkIsosurfaceRayTracing::Hit& hit,
    vtkIsosurfaceRayTracing::Vector3& parametric) const override;
  vtkIdType FindPoint(const vtkIsosurfaceRayTracing::Hit& hit) const override;
  std::optional<double> FindOpacity() const override;
  const vtkIsosurfaceRayTraceLeaf& FindLeaf(const vtkIsosurfaceRayTracing::Hit& hit) const override;
  void SampleColors(
    const vtkIsosurfaceRayTracing::Hit& hit, int components, double* values) const override;
  bool IsIntact() const override;
  void AddObjects(std::vector<vtkObject*>& objects) const override;

private:
  /// A cell of a block that a hit is in.
  struct BlockCell
  {
    const vtkIsosurfaceRayTraceLeaf& Leaf;
    /// The numbers of cells of the block.
    vtkIsosurfaceRayTracing::Index3 Cells;
    vtkIsosurfaceRayTracing::Index3 Cell;
    vtkIsosurfaceRayTracing::Vector3 Parametric;
  };

  vtkIsosurfaceRayTraceAmrPart(vtkIsosurfaceRayTracing::AmrRegion&& region,
    std::shared_ptr<vtkIsosurfaceRayTraceAmrBlocks> whole);
  BlockCell FindBlockCell(const vtkIsosurfaceRayTracing::Hit& hit) const;

  vtkIsosurfaceRayTracing::AmrRegion Region;
  /// The parts of a data set share it.
  std::shared_ptr<vtkIsosurfaceRayTraceAmrBlocks> Whole;
  /// Of the nodes.
  vtkIsosurfaceRayTraceGeometry Geometry;
  /// None before it is asked for first.
  std::optional<vtkIsosurfaceRayTracing::AmrRange> Range;
  vtkIsosurfaceRayTracing::AmrNodes Nodes;
  std::unique_ptr<vtkIsosurfaceRayTracing::ImageField> Field;
};

VTK_ABI_NAMESPACE_END

#endif
