// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Colours of hits by an array of the parts that are traced, or by another image.

#ifndef vtkIsosurfaceRayTraceArrayColors_h
#define vtkIsosurfaceRayTraceArrayColors_h

#include "vtkDataArray.h"                  // for its number of components
#include "vtkIsosurfaceRayTraceColors.h"   // for base class
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Field/TracedField.h"

#include <memory>  // for std::unique_ptr
#include <utility> // for std::move

VTK_ABI_NAMESPACE_BEGIN

class vtkImageData;
class vtkIsosurfaceRayTraceInput;

/// By the arrays of the parts of an input, which must outlive this.
class vtkIsosurfaceRayTraceArrayColors final : public vtkIsosurfaceRayTraceColors
{
public:
  /// Arrays of cells have one value in a cell. Direct: the arrays hold colours.
  vtkIsosurfaceRayTraceArrayColors(const vtkIsosurfaceRayTraceInput& input, bool areOfCells,
    bool areDirect, int components, const vtkIsosurfaceRayTraceValueColors& colorsOfValues)
    : vtkIsosurfaceRayTraceColors(areDirect, components, colorsOfValues)
    , Input(input)
    , AreOfCells(areOfCells)
  {
  }

private:
  void Sample(
    const vtkIsosurfaceRayTracing::Hit& hit, int components, double* values) const override;

  const vtkIsosurfaceRayTraceInput& Input;
  bool AreOfCells;
};

/// By an image that lies where the hits are.
class vtkIsosurfaceRayTraceImageColors final : public vtkIsosurfaceRayTraceColors
{
public:
  /// The matrix leads from the object space of the field to the coordinates of the image. All must
  /// outlive this.
  vtkIsosurfaceRayTraceImageColors(vtkImageData* image, vtkDataArray* array,
    const vtkIsosurfaceRayTracing::TracedField& field,
    const vtkIsosurfaceRayTracing::Matrix4& physicalFromObject,
    const vtkIsosurfaceRayTraceValueColors& colorsOfValues)
    : vtkIsosurfaceRayTraceColors(IsDirect(array), array->GetNumberOfComponents(), colorsOfValues)
    , Image(image)
    , Array(array)
    , Field(field)
    , PhysicalFromObject(physicalFromObject)
  {
  }

private:
  void Sample(
    const vtkIsosurfaceRayTracing::Hit& hit, int components, double* values) const override;

  vtkImageData* Image;
  vtkDataArray* Array;
  const vtkIsosurfaceRayTracing::TracedField& Field;
  vtkIsosurfaceRayTracing::Matrix4 PhysicalFromObject;
};

/// By the colours that blocks have; else as without them.
class vtkIsosurfaceRayTraceBlockColors final : public vtkIsosurfaceRayTracing::HitColors
{
public:
  /// The colours of an array may be null. All else must outlive this.
  vtkIsosurfaceRayTraceBlockColors(const vtkIsosurfaceRayTraceInput& input,
    std::unique_ptr<vtkIsosurfaceRayTracing::HitColors> ofArray,
    const vtkIsosurfaceRayTraceValueColors& ofValues)
    : Input(input)
    , OfArray(std::move(ofArray))
    , OfValues(ofValues)
  {
  }

  vtkIsosurfaceRayTracing::Vector3 Get(const vtkIsosurfaceRayTracing::Hit& hit) const override;

private:
  const vtkIsosurfaceRayTraceInput& Input;
  std::unique_ptr<vtkIsosurfaceRayTracing::HitColors> OfArray;
  const vtkIsosurfaceRayTraceValueColors& OfValues;
};

VTK_ABI_NAMESPACE_END

#endif
