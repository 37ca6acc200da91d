// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The data that a mapper traces: the interface that requests, frames, hits and selections use.

#ifndef vtkIsosurfaceRayTraceInput_h
#define vtkIsosurfaceRayTraceInput_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                       // for vtkIdType

#include "Picture/Scene.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkDataSet;
class vtkIsosurfaceRayTraceValueColors;
class vtkObject;
class vtkVolumeProperty;

class vtkIsosurfaceRayTraceInput
{
public:
  virtual ~vtkIsosurfaceRayTraceInput() = default;

  /// Finds the data in the inputs of the mapper, which must be up to date, and their scalars.
  /// Returns why they cannot be traced; empty if they can.
  virtual std::string Select(vtkVolumeProperty* property) = 0;

  /// From the object space of what was selected to the coordinates of the data, before Update.
  virtual vtkIsosurfaceRayTracing::Matrix4 FindPhysicalFromObject() const = 0;

  /// Builds what tracing the selection needs. Returns whether its hierarchy had to be built.
  virtual bool Update(int threads) = 0;

  /// The fields, which share one object space; there are none before the input is first traced. A
  /// hit has the number of its field.
  virtual int GetNumberOfFields() const = 0;
  virtual vtkIsosurfaceRayTracing::TracedField* GetField(int number) const = 0;

  /// The size of the cells of a field in object space, about.
  virtual double GetCellSize(int field) const = 0;

  /// What of a field is visible: by blanking, ghosts, and the cropping of the mapper.
  virtual vtkIsosurfaceRayTracing::Visibility FindVisible(int field) const = 0;

  /// From the object space of the fields to the coordinates of the data.
  virtual const vtkIsosurfaceRayTracing::Matrix4& GetPhysicalFromObject() const = 0;

  /// The component of the volume property that gives the colours of the surfaces.
  virtual int GetPropertyComponent() const = 0;

  /// The colours of an array, by those of its values; null if surfaces are coloured by their
  /// isovalues. The input and the colours of values must outlive them.
  virtual std::unique_ptr<vtkIsosurfaceRayTracing::HitColors> MakeColors(
    const vtkIsosurfaceRayTraceValueColors& colorsOfValues) const = 0;

  /// The cell that a hit is in, and the point nearest to it, by their ids in the data.
  virtual vtkIdType FindCell(const vtkIsosurfaceRayTracing::Hit& hit,
    vtkIsosurfaceRayTracing::Vector3& parametric) const = 0;
  virtual vtkIdType FindPoint(const vtkIsosurfaceRayTracing::Hit& hit) const = 0;
  /// The block of composite data that has a cell, and the number of the cell there; null if the
  /// input is not composite, or no block has the cell.
  virtual vtkDataSet* FindBlock(
    vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex) const = 0;
  virtual vtkIdType GetNumberOfCells() const = 0;
  virtual vtkIdType GetNumberOfPoints() const = 0;

  /// Whether the arrays that are traced are still where they were, and as long. (An observer may
  /// have released their memory.)
  virtual bool IsIntact() const = 0;

  /// The objects that a picture of the input depends on. Some may be null.
  virtual std::vector<vtkObject*> GetObjects() const = 0;
};

VTK_ABI_NAMESPACE_END

#endif
