// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The input of a mapper that traces images and rectilinear grids, and composite data of them.

#ifndef vtkIsosurfaceRayTraceGridInput_h
#define vtkIsosurfaceRayTraceGridInput_h

#include "vtkIsosurfaceRayTraceBlocks.h"   // for ivars
#include "vtkIsosurfaceRayTraceInput.h"    // for base class
#include "vtkIsosurfaceRayTraceSource.h"   // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include <string> // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkImageData;
class vtkIsosurfaceRayTraceMapper;
class vtkVolumeProperty;

class vtkIsosurfaceRayTraceGridInput final : public vtkIsosurfaceRayTraceInput
{
public:
  /// The mapper owns its inputs.
  explicit vtkIsosurfaceRayTraceGridInput(vtkIsosurfaceRayTraceMapper* mapper)
    : Mapper(mapper)
  {
  }

  std::string Select(vtkVolumeProperty* property) override;
  vtkIsosurfaceRayTracing::Matrix4 FindPhysicalFromObject() const override
  {
    return vtkIsosurfaceRayTraceGeometry(this->Grid, this->Scalars.AreOfCells)
      .GetPhysicalFromObject();
  }
  bool Update(int threads) override;
  int GetNumberOfFields() const override { return this->Source.GetField() ? 1 : 0; }
  vtkIsosurfaceRayTracing::TracedField* GetField(int /*number*/) const override
  {
    return this->Source.GetField();
  }
  double GetCellSize(int /*field*/) const override { return 1.0; }
  vtkIsosurfaceRayTracing::Visibility FindVisible(int field) const override;
  const vtkIsosurfaceRayTracing::Matrix4& GetPhysicalFromObject() const override
  {
    return this->Source.GetGeometry().GetPhysicalFromObject();
  }
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
  std::string SelectGrid();
  std::string SelectColors();

  vtkIsosurfaceRayTraceMapper* Mapper;
  /// Whether the grid is formed by the blocks of composite data.
  bool IsComposite = false;
  vtkIsosurfaceRayTraceBlocks Blocks;
  vtkDataSet* Grid = nullptr;
  vtkIsosurfaceRayTraceScalars Scalars;
  int PropertyComponent = 0;
  /// The colours of the surfaces. The array is null if they are coloured by isovalue, the image if
  /// the array belongs to the grid.
  vtkImageData* ColorImage = nullptr;
  vtkDataArray* ColorArray = nullptr;
  /// The number of its tuples.
  vtkIdType NumberOfColors = 0;

  vtkIsosurfaceRayTraceSource Source;
};

VTK_ABI_NAMESPACE_END

#endif
