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
  /// The array of a name, or the point scalars of the grid if the name is empty; null if there is
  /// none.
  static vtkDataArray* FindArray(vtkDataSet* grid, const std::string& name);

  /// That an input has no array of that name.
  static std::string DescribeMissing(const std::string& name, const std::string& input);

  /// Whether an array holds colours of 8 bits, and not values that have colours.
  static bool IsDirect(vtkDataArray* array);

  vtkIsosurfaceRayTracing::Vector3 Get(const vtkIsosurfaceRayTracing::Hit& hit) const final;

protected:
  /// The values of the array have these colours, unless they are colours themselves.
  vtkIsosurfaceRayTraceColors(
    bool isDirect, const vtkIsosurfaceRayTraceValueColors& colorsOfValues);

  /// Finds the first components of the array at a hit.
  virtual void Sample(
    const vtkIsosurfaceRayTracing::Hit& hit, int components, double* values) const = 0;

private:
  bool AreDirect;
  const vtkIsosurfaceRayTraceValueColors& ColorsOfValues;
};

VTK_ABI_NAMESPACE_END

#endif
