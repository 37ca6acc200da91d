// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The input of a mapper that traces meshes of cells: unstructured and structured grids.

#ifndef vtkIsosurfaceRayTraceMeshInput_h
#define vtkIsosurfaceRayTraceMeshInput_h

#include "vtkIsosurfaceRayTraceInput.h"    // for base class
#include "vtkIsosurfaceRayTraceScalars.h"  // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"               // for ivars

#include "Mesh/MeshField.h"

#include <array>   // for std::array
#include <cstdint> // for std::int64_t

VTK_ABI_NAMESPACE_BEGIN

class vtkDataArray;
class vtkIsosurfaceRayTraceMeshMapper;
class vtkPointSet;
class vtkUnstructuredGrid;

class vtkIsosurfaceRayTraceMeshInput final : public vtkIsosurfaceRayTraceInput
{
public:
  /// The mapper owns its inputs.
  explicit vtkIsosurfaceRayTraceMeshInput(vtkIsosurfaceRayTraceMeshMapper* mapper);
  ~vtkIsosurfaceRayTraceMeshInput() override;

  /// Of the points of a cell.
  static vtkIdType FindNearestPoint(vtkDataSet* grid, vtkIdType cell, const double position[3]);

  std::string Select(vtkVolumeProperty* property) override;
  vtkIsosurfaceRayTracing::Matrix4 FindPhysicalFromObject() const override;
  bool Update(int threads) override;
  vtkIsosurfaceRayTracing::Visibility FindVisible() const override;

  vtkIsosurfaceRayTracing::TracedField* GetField() const override { return this->Field.get(); }
  const vtkIsosurfaceRayTracing::Matrix4& GetPhysicalFromObject() const override;
  int GetPropertyComponent() const override { return this->PropertyComponent; }
  std::unique_ptr<vtkIsosurfaceRayTracing::HitColors> MakeColors(
    const vtkIsosurfaceRayTraceValueColors& colorsOfValues) const override;
  vtkIdType FindCell(const vtkIsosurfaceRayTracing::Hit& hit,
    vtkIsosurfaceRayTracing::Vector3& parametric) const override;
  vtkIdType FindPoint(const vtkIsosurfaceRayTracing::Hit& hit) const override;
  vtkDataSet* FindBlock(
    vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex) const override;
  vtkIdType GetNumberOfCells() const override;
  vtkIdType GetNumberOfPoints() const override;
  bool IsIntact() const override;
  std::vector<vtkObject*> GetObjects() const override;

private:
  struct Key;

  Key MakeKey() const;
  std::string SelectCells();
  void SelectListedCells(vtkUnstructuredGrid* grid);
  void SubdivideCells(vtkUnstructuredGrid* grid);
  void SelectPoints();
  void SelectValues();
  void FindHiddenCells();

  vtkIsosurfaceRayTraceMeshMapper* Mapper;
  vtkPointSet* Grid = nullptr;
  vtkIsosurfaceRayTraceScalars Scalars;
  int PropertyComponent = 0;

  /// What the view was made from.
  std::unique_ptr<Key> Built;
  vtkIsosurfaceRayTracing::MeshView View;
  std::unique_ptr<vtkIsosurfaceRayTracing::MeshField> Field;
  /// Copies of what cannot be read where it is: points, scalars.
  vtkSmartPointer<vtkDataArray> PlainPoints;
  vtkSmartPointer<vtkDataArray> PointScalars;
  vtkSmartPointer<vtkDataArray> PlainScalars;
  /// Of an unstructured grid, the shapes of the cells; and the cells themselves, if some had to be
  /// subdivided, with the ids of those that they are parts of.
  std::vector<unsigned char> Shapes;
  std::vector<std::int64_t> Offsets;
  std::vector<std::int64_t> Connectivity;
  std::vector<vtkIdType> CellIds;
  std::vector<unsigned char> HiddenCells;
};

VTK_ABI_NAMESPACE_END

#endif
