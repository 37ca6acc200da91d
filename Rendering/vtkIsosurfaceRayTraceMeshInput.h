// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The input of a mapper that traces meshes of cells: unstructured and structured grids, and
// composite data of them.

#ifndef vtkIsosurfaceRayTraceMeshInput_h
#define vtkIsosurfaceRayTraceMeshInput_h

#include "vtkIsosurfaceRayTraceInput.h"    // for base class
#include "vtkIsosurfaceRayTraceLeaves.h"   // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTraceMesh;
class vtkIsosurfaceRayTraceMeshMapper;

class vtkIsosurfaceRayTraceMeshInput final : public vtkIsosurfaceRayTraceInput
{
public:
  /// The mapper owns its inputs.
  explicit vtkIsosurfaceRayTraceMeshInput(vtkIsosurfaceRayTraceMeshMapper* mapper);
  ~vtkIsosurfaceRayTraceMeshInput() override;

  std::string Select(vtkVolumeProperty* property) override;
  vtkIsosurfaceRayTracing::Matrix4 FindPhysicalFromObject() const override;
  bool Update(int threads) override;

  int GetNumberOfFields() const override;
  vtkIsosurfaceRayTracing::TracedField* GetField(int number) const override;
  double GetCellSize(int field) const override;
  vtkIsosurfaceRayTracing::Visibility FindVisible(int field) const override;
  const vtkIsosurfaceRayTracing::Matrix4& GetPhysicalFromObject() const override;
  int GetPropertyComponent() const override { return this->PropertyComponent; }
  std::unique_ptr<vtkIsosurfaceRayTracing::HitColors> MakeColors(
    const vtkIsosurfaceRayTraceValueColors& colorsOfValues) const override;
  vtkIdType FindCell(const vtkIsosurfaceRayTracing::Hit& hit,
    vtkIsosurfaceRayTracing::Vector3& parametric) const override;
  vtkIdType FindPoint(const vtkIsosurfaceRayTracing::Hit& hit) const override;
  vtkDataSet* FindBlock(
    vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex) const override;
  vtkIdType GetNumberOfCells() const override { return this->Leaves.GetNumberOfCells(); }
  vtkIdType GetNumberOfPoints() const override { return this->Leaves.GetNumberOfPoints(); }
  bool IsIntact() const override;
  std::vector<vtkObject*> GetObjects() const override;

private:
  std::string SelectLeaves();
  std::string SelectMesh(const vtkIsosurfaceRayTraceLeaf& leaf, int component,
    std::vector<std::unique_ptr<vtkIsosurfaceRayTraceMesh>>& before);
  const vtkIsosurfaceRayTraceMesh& GetMesh(const vtkIsosurfaceRayTracing::Hit& hit) const;
  const vtkIsosurfaceRayTraceLeaf& GetLeaf(const vtkIsosurfaceRayTracing::Hit& hit) const;

  vtkIsosurfaceRayTraceMeshMapper* Mapper;
  bool IsComposite = false;
  vtkIsosurfaceRayTraceLeaves Leaves;
  /// One for each leaf.
  std::vector<std::unique_ptr<vtkIsosurfaceRayTraceMesh>> Meshes;
  int PropertyComponent = 0;
};

VTK_ABI_NAMESPACE_END

#endif
