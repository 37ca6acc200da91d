// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The clouds of a property.

#ifndef vtkIsosurfaceRayTraceClouds_h
#define vtkIsosurfaceRayTraceClouds_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Picture/CloudMedium.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkDataArray;
class vtkVolumeProperty;

namespace vtkIsosurfaceRayTraceClouds
{

/// The components of scalars that a cloud takes: one, which is that of its isosurfaces, or all.
struct Components
{
  /// None without data.
  int Count = 1;
  /// Whether they are a colour and an opacity themselves, from 0 to 255.
  bool AreBytes = false;

  bool operator==(const Components& other) const
  {
    return this->Count == other.Count && this->AreBytes == other.AreBytes;
  }
};

/// All components of an array that a property is for; with null, one.
Components FindComponents(vtkDataArray* array, vtkVolumeProperty* property);

/// Why a property cannot draw components; empty if it can.
std::string FindProblem(const Components& components, vtkVolumeProperty* property);

/// How many components of the cloud, the last ones, have gradients that light it: none, if the
/// property does not shade any of them; all, if they are independent; else one.
int FindLitComponents(const Components& components, vtkVolumeProperty* property, int component);

/// The material of each of them.
std::vector<vtkIsosurfaceRayTracing::CloudMaterial> MakeMaterials(
  const Components& components, vtkVolumeProperty* property, int component);

/// Makes the cloud that a property makes of components, or of the given component of the property
/// if there is one. Transfer functions are linear between nodes: those of the property, and as many
/// between them as it takes where its functions are not linear (midpoints, sharpness, colour
/// spaces, logarithms), to less than 1e-4. The opacity is the attenuation for the unit distance, as
/// vtkUnstructuredGridVolumeMapper's family has it.
std::unique_ptr<vtkIsosurfaceRayTracing::CloudMedium> MakeMedium(
  const Components& components, vtkVolumeProperty* property, int component);

}

VTK_ABI_NAMESPACE_END

#endif
