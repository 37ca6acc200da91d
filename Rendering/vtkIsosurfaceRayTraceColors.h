// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Colours of hits by an array.

#ifndef vtkIsosurfaceRayTraceColors_h
#define vtkIsosurfaceRayTraceColors_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Picture/Scene.h"

#include <string> // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkDataArray;
class vtkDataSet;
class vtkIsosurfaceRayTraceValueColors;

class vtkIsosurfaceRayTraceColors : public vtkIsosurfaceRayTracing::HitColors
{
public:
  /// The point data of a name with a tuple for every point, or the point scalars if the name is
  /// empty; null if there are none.
  static vtkDataArray* FindArray(vtkDataSet* grid, const std::string& name);

  /// The cell data of a name with a tuple for every cell; null if there are none.
  static vtkDataArray* FindCellArray(vtkDataSet* grid, const std::string& name);

  /// That the input, or the image to colour by, has no array of that name.
  static std::string DescribeMissing(const std::string& name);
  static std::string DescribeMissingInImage(const std::string& name);

  /// Whether an array holds colours of 8 bits, and not values that have colours.
  static bool IsDirect(vtkDataArray* array);

  vtkIsosurfaceRayTracing::Vector3 Get(const vtkIsosurfaceRayTracing::Hit& hit) const final;

protected:
  /// The values of an array like this one have these colours, unless they are colours themselves.
  vtkIsosurfaceRayTraceColors(
    bool isDirect, int components, const vtkIsosurfaceRayTraceValueColors& colorsOfValues);

  /// Finds the first components of the array at a hit.
  virtual void Sample(
    const vtkIsosurfaceRayTracing::Hit& hit, int components, double* values) const = 0;

private:
  bool AreDirect;
  /// How many are looked at; and whether their magnitude is shown, or the last of them.
  int Components;
  bool AreMagnitudes;
  const vtkIsosurfaceRayTraceValueColors& ColorsOfValues;
};

VTK_ABI_NAMESPACE_END

#endif
