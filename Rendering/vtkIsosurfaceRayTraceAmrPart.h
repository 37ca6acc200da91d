// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// A block of an AMR data set, as a field that is traced.

#ifndef vtkIsosurfaceRayTraceAmrPart_h
#define vtkIsosurfaceRayTraceAmrPart_h

#include "vtkIsosurfaceRayTraceGeometry.h" // for ivars
#include "vtkIsosurfaceRayTraceLeaves.h"   // for ivars
#include "vtkIsosurfaceRayTracePart.h"     // for base class
#include "vtkIsosurfaceRayTraceScalars.h"  // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

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
  /// that crops may be null.
  static std::vector<std::unique_ptr<vtkIsosurfaceRayTracePart>> MakeParts(
    const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves,
    const vtkIsosurfaceRayTraceScalars& scalars,
    const vtkIsosurfaceRayTracing::ImageSettings& settings, vtkVolumeMapper* cropping,
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
  std::optional<double> FindOpacity() const override { return this->Leaf.Display.Opacity; }
  const vtkIsosurfaceRayTraceLeaf& FindLeaf(
    const vtkIsosurfaceRayTracing::Hit& /*hit*/) const override
  {
    return this->Leaf;
  }
  void SampleColors(
    const vtkIsosurfaceRayTracing::Hit& hit, int components, double* values) const override;
  bool IsIntact() const override;
  void AddObjects(std::vector<vtkObject*>& objects) const override;

private:
  /// What the parts of a data set share.
  struct Hierarchy;

  vtkIsosurfaceRayTraceAmrPart(
    const vtkIsosurfaceRayTraceLeaf& leaf, std::size_t number, std::shared_ptr<Hierarchy> whole);
  vtkIsosurfaceRayTracing::Index3 FindStructuredCell(
    const vtkIsosurfaceRayTracing::Hit& hit, vtkIsosurfaceRayTracing::Vector3& parametric) const;

  vtkIsosurfaceRayTraceLeaf Leaf;
  /// Of the patch in the hierarchy.
  std::size_t Number;
  std::shared_ptr<Hierarchy> Whole;
  vtkIsosurfaceRayTracing::Index3 Cells;
  /// Of the nodes.
  vtkIsosurfaceRayTraceGeometry Geometry;
  /// None before it is asked for first.
  std::optional<vtkIsosurfaceRayTracing::AmrRange> Range;
  vtkIsosurfaceRayTracing::AmrNodes Nodes;
  std::unique_ptr<vtkIsosurfaceRayTracing::ImageField> Field;
  /// What the scalars were when they were selected.
  const void* Memory;
  vtkIdType NumberOfTuples;
};

VTK_ABI_NAMESPACE_END

#endif
