// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// How blocks of composite data are displayed, as vtkCompositeDataDisplayAttributes says it.

#ifndef vtkIsosurfaceRayTraceBlockDisplay_h
#define vtkIsosurfaceRayTraceBlockDisplay_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Math/Vector.h"

#include <map>      // for std::map
#include <optional> // for std::optional

VTK_ABI_NAMESPACE_BEGIN

class vtkCompositeDataDisplayAttributes;
class vtkDataObject;

struct vtkIsosurfaceRayTraceBlockDisplay
{
  bool IsVisible = true;
  /// None: the colours are those of the volume.
  std::optional<vtkIsosurfaceRayTracing::Vector3> Color;
  /// In (0, 1]. None: the opacities are those of the volume.
  std::optional<double> Opacity;
};

/// Those of composite data. What is said of a node holds for all below it, unless they have their
/// own.
class vtkIsosurfaceRayTraceBlockDisplays
{
public:
  /// The attributes may be null.
  vtkIsosurfaceRayTraceBlockDisplays(
    vtkDataObject* root, vtkCompositeDataDisplayAttributes* attributes);

  vtkIsosurfaceRayTraceBlockDisplay Get(vtkDataObject* block) const;

private:
  void Visit(vtkDataObject* node, vtkIsosurfaceRayTraceBlockDisplay display);
  void VisitChildren(vtkDataObject* node, const vtkIsosurfaceRayTraceBlockDisplay& display);

  vtkCompositeDataDisplayAttributes* Attributes;
  /// Of AMR data, whose blocks have no nodes between them and the root.
  vtkIsosurfaceRayTraceBlockDisplay OfRoot;
  std::map<vtkDataObject*, vtkIsosurfaceRayTraceBlockDisplay> Displays;
};

VTK_ABI_NAMESPACE_END

#endif
