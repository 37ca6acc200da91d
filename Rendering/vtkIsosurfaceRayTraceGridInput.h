// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The input of a mapper that traces images and rectilinear grids, and composite data of them.

#ifndef vtkIsosurfaceRayTraceGridInput_h
#define vtkIsosurfaceRayTraceGridInput_h

#include "vtkIsosurfaceRayTraceBlocks.h"   // for ivars
#include "vtkIsosurfaceRayTraceInput.h"    // for base class
#include "vtkIsosurfaceRayTraceSource.h"   // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include <optional> // for std::optional
#include <string>   // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkImageData;
class vtkVolumeMapper;
class vtkVolumeProperty;

class vtkIsosurfaceRayTraceGridInput final : public vtkIsosurfaceRayTraceInput
{
public:
  /// What is taken from the inputs of a mapper, besides the settings of all volume mappers.
  struct Choice
  {
    /// A component of the scalars, or their magnitude (vtkIsosurfaceRayTraceSource::Selection);
    /// without one, the weights of the property decide.
    std::optional<int> Component;
    std::string ColorArrayName;
  };

  /// Finds the data in the inputs of a mapper, which must be up to date, and their scalars. Returns
  /// why they cannot be traced; empty if they can.
  std::string Select(vtkVolumeMapper* mapper, const Choice& choice, vtkVolumeProperty* property);

  /// From the object space of what was selected to the coordinates of the data, before Update.
  vtkIsosurfaceRayTracing::Matrix4 FindPhysicalFromObject() const
  {
    return vtkIsosurfaceRayTraceGeometry(this->Grid, this->Scalars.AreOfCells)
      .GetPhysicalFromObject();
  }

  /// Builds what tracing the selection needs. Returns whether macrocells had to be built.
  bool Update(const vtkIsosurfaceRayTracing::ImageSettings& settings, int threads);

  /// What of the data is visible: by blanking, ghosts, and the cropping of a mapper.
  vtkIsosurfaceRayTracing::Visibility FindVisible(vtkVolumeMapper* mapper) const;

  /// See vtkIsosurfaceRayTraceMapper::FindBlock. Null if the input is not composite, or no block
  /// has the cell.
  vtkDataSet* FindBlock(vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex) const;

  vtkIsosurfaceRayTracing::TracedField* GetField() const override
  {
    return this->Source.GetField();
  }
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
  vtkIdType GetNumberOfCells() const override;
  vtkIdType GetNumberOfPoints() const override;
  bool IsIntact() const override;
  std::vector<vtkObject*> GetObjects() const override;

private:
  std::string SelectGrid(vtkVolumeMapper* mapper, const std::string& colorArrayName);
  std::string SelectComponent(std::optional<int> component, vtkVolumeProperty* property);
  std::string SelectColors(vtkImageData* image, const std::string& name);

  /// Whether the grid is formed by the blocks of composite data.
  bool IsComposite = false;
  vtkIsosurfaceRayTraceBlocks Blocks;
  vtkDataSet* Grid = nullptr;
  vtkIsosurfaceRayTraceSource::Selection Scalars;
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
