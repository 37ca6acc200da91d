// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// An unstructured or structured grid with scalars, as a field that is traced.

#ifndef vtkIsosurfaceRayTraceMeshPart_h
#define vtkIsosurfaceRayTraceMeshPart_h

#include "vtkIsosurfaceRayTraceLeaves.h"      // for ivars
#include "vtkIsosurfaceRayTracePart.h"        // for base class
#include "vtkIsosurfaceRayTraceReadArrays.h"  // for ivars
#include "vtkIsosurfaceRayTraceScalars.h"     // for ivars
#include "vtkIsosurfaceRayTraceTracedCells.h" // for ivars
#include "vtkIsosurfaceRayTracingCompat.h"    // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"                  // for ivars
#include "vtkType.h"                          // for vtkIdType

#include "Mesh/MeshField.h"

#include <cstdint>  // for std::int64_t
#include <memory>   // for std::unique_ptr
#include <optional> // for std::optional
#include <string>   // for std::string
#include <vector>   // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkDataArray;
class vtkDataSet;
class vtkGenericCell;
class vtkIdList;
class vtkObject;
class vtkPointSet;

class vtkIsosurfaceRayTraceMeshPart final : public vtkIsosurfaceRayTracePart
{
public:
  /// Whether a data set is of a class that is traced.
  static bool IsMesh(vtkDataSet* data);

  /// Of a grid as it is now, or of its cells split into tetrahedra. The scalars must have no
  /// problem.
  vtkIsosurfaceRayTraceMeshPart(
    vtkPointSet* grid, const vtkIsosurfaceRayTraceScalars& scalars, bool isTetrahedralized);
  ~vtkIsosurfaceRayTraceMeshPart() override;
  vtkIsosurfaceRayTraceMeshPart(const vtkIsosurfaceRayTraceMeshPart&) = delete;
  void operator=(const vtkIsosurfaceRayTraceMeshPart&) = delete;

  /// Whether the mesh is still that of a grid with these.
  bool IsOf(
    vtkPointSet* grid, const vtkIsosurfaceRayTraceScalars& scalars, bool isTetrahedralized) const;

  /// Sets the leaf that the grid is of: its numbers, and the array to colour by.
  void SetLeaf(const vtkIsosurfaceRayTraceLeaf& leaf) { this->Leaf = leaf; }

  /// Finds the cells to trace. Returns why there are none; else empty.
  std::string SelectCells(int threads);

  vtkPointSet* GetGrid() const;

  vtkIsosurfaceRayTracing::TracedField& GetField() override { return *this->Field; }
  vtkIsosurfaceRayTracing::Visibility FindVisible() const override;
  vtkIsosurfaceRayTracing::Matrix4 FindPhysicalFromObject() const override;
  vtkDataSet* GetFirstData() const override;
  bool IsBuiltOnDemand() const override { return false; }
  bool Update(int threads) override;
  std::string GetWarning() const override { return this->TracedCells.GetWarning(); }
  vtkIsosurfaceRayTracing::Bounds FindBox() const override { return this->Field->GetBounds(); }
  /// As if all cells were cubes of one size.
  double FindCellSize() const override;
  vtkIdType FindCell(const vtkIsosurfaceRayTracing::Hit& hit,
    vtkIsosurfaceRayTracing::Vector3& parametric) const override;
  vtkIdType FindPoint(const vtkIsosurfaceRayTracing::Hit& hit) const override;
  void MoveToWholeCell(const vtkIsosurfaceRayTracing::Hit& hit, vtkGenericCell* any,
    vtkIsosurfaceRayTracing::Vector3& parametric) const override;
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
  struct Key;

  void SelectPoints();
  void SelectValues(int threads);
  void FindHiddenCells();
  void HidePartsOfInfiniteCells();
  void FindPointsOfCell(std::int64_t number, vtkIdList* points) const;
  double FindColor(std::int64_t point, int component) const;

  /// What the mesh is made from.
  std::unique_ptr<Key> MadeFrom;
  vtkIsosurfaceRayTraceScalars Scalars;
  vtkIsosurfaceRayTraceLeaf Leaf;
  vtkIsosurfaceRayTraceTracedCells TracedCells;
  vtkIsosurfaceRayTracing::MeshView View;
  /// Null before Update.
  std::unique_ptr<vtkIsosurfaceRayTracing::MeshCells> Cells;
  std::unique_ptr<vtkIsosurfaceRayTracing::MeshField> Field;
  /// What is read where it is, and copies of what cannot: points, scalars.
  vtkIsosurfaceRayTraceReadArrays ReadArrays;
  vtkSmartPointer<vtkDataArray> PlainPoints;
  vtkSmartPointer<vtkDataArray> PointScalars;
  vtkSmartPointer<vtkDataArray> PlainScalars;
  std::vector<unsigned char> HiddenCells;
};

VTK_ABI_NAMESPACE_END

#endif
