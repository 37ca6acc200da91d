// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Images on one lattice, or a rectilinear grid, as a field that is traced.

#ifndef vtkIsosurfaceRayTraceGridPart_h
#define vtkIsosurfaceRayTraceGridPart_h

#include "vtkIsosurfaceRayTraceBlocks.h"   // for ivars
#include "vtkIsosurfaceRayTracePart.h"     // for base class
#include "vtkIsosurfaceRayTraceSource.h"   // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include <optional> // for std::optional
#include <string>   // for std::string
#include <vector>   // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkVolumeMapper;

class vtkIsosurfaceRayTraceGridPart final : public vtkIsosurfaceRayTracePart
{
public:
  /// Whether a data set is of a class that is traced.
  static bool IsGrid(vtkDataSet* data);

  /// Whether a grid has cells of three dimensions.
  static bool HasVolume(vtkDataSet* grid);

  /// Whether the part was last selected of the data of these leaves.
  bool IsOf(const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves) const;

  /// Selects leaves, which must have no problem and lie on one lattice, with scalars like these.
  /// The mapper that crops may be null. Returns why they have too few samples together; empty if
  /// they have enough.
  std::string Select(const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves,
    const vtkIsosurfaceRayTraceScalars& scalars,
    const vtkIsosurfaceRayTracing::ImageSettings& settings, const std::string& cacheDirectory,
    vtkVolumeMapper* cropping);

  vtkIsosurfaceRayTracing::TracedField& GetField() override;
  vtkIsosurfaceRayTracing::Visibility FindVisible() const override;
  vtkIsosurfaceRayTracing::Matrix4 FindPhysicalFromObject() const override;
  vtkDataSet* GetFirstData() const override { return this->Blocks.Get().front().Data; }
  bool IsBuiltOnDemand() const override;
  bool Update(int threads) override;
  bool SelectLevel(vtkIsosurfaceRayTraceLevel level, int threads) override
  {
    return this->Source.SelectLevel(level, threads);
  }
  bool IsCoarse() const override { return this->Source.IsCoarse(); }
  void ReadSlab(int threads) override { this->Source.ReadSlab(threads); }
  double GetFractionRead() const override { return this->Source.GetFractionRead(); }
  std::string GetWarning() const override { return this->Source.GetCacheProblem(); }
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
  vtkIsosurfaceRayTraceBlocks Blocks;
  vtkIsosurfaceRayTraceScalars Scalars;
  vtkIdType NumberOfTuples = 0;
  /// Null if surfaces are coloured by isovalue.
  vtkDataArray* Colors = nullptr;
  vtkIdType NumberOfColors = 0;
  vtkIsosurfaceRayTracing::ImageSettings Settings;
  std::string CacheDirectory;
  vtkVolumeMapper* Cropping = nullptr;
  vtkIsosurfaceRayTraceSource Source;
  /// Whether the field is that of the last selection.
  bool IsBuilt = false;
};

VTK_ABI_NAMESPACE_END

#endif
