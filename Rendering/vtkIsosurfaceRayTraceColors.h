// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Colours of hits by another array, which may be that of another image.

#ifndef vtkIsosurfaceRayTraceColors_h
#define vtkIsosurfaceRayTraceColors_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Scene.h"

#include <string> // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkDataArray;
class vtkImageData;
class vtkVolumeProperty;

class vtkIsosurfaceRayTraceColors : public vtkIsosurfaceRayTracing::HitColors
{
public:
  /// The array of a name, or the point scalars of the image if it is empty; null if there is none.
  static vtkDataArray* FindArray(vtkImageData* image, const std::string& name);

  /// The matrix leads from the indices of hits to the coordinates of the image. A component of the
  /// property turns values into colours, unless the array has colours of 8 bits.
  vtkIsosurfaceRayTraceColors(vtkImageData* image, vtkDataArray* array,
    const vtkIsosurfaceRayTracing::Matrix4& physicalFromIndex, vtkVolumeProperty* property,
    int component);

  vtkIsosurfaceRayTracing::Vector3 Get(const vtkIsosurfaceRayTracing::Hit& hit) const override;

private:
  double Sample(const double index[3], int component) const;

  vtkImageData* Image;
  vtkDataArray* Array;
  vtkIsosurfaceRayTracing::Matrix4 PhysicalFromIndex;
  vtkVolumeProperty* Property;
  int Component;
  bool IsDirect;
};

VTK_ABI_NAMESPACE_END

#endif
