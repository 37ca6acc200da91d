// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Renders ids instead of colours for a hardware selector.

#ifndef vtkIsosurfaceRayTraceSelection_h
#define vtkIsosurfaceRayTraceSelection_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                       // for vtkIdType

#include "Rays/Hit.h"

VTK_ABI_NAMESPACE_BEGIN

class vtkHardwareSelector;
class vtkIsosurfaceRayTraceInputs;
class vtkIsosurfaceRayTracePicture;

class vtkIsosurfaceRayTraceSelection
{
public:
  /// Begins the prop; the destructor ends it. In between, its ids are drawn.
  vtkIsosurfaceRayTraceSelection(
    vtkHardwareSelector* selector, const vtkIsosurfaceRayTraceInputs& inputs);
  ~vtkIsosurfaceRayTraceSelection();
  vtkIsosurfaceRayTraceSelection(const vtkIsosurfaceRayTraceSelection&) = delete;
  void operator=(const vtkIsosurfaceRayTraceSelection&) = delete;

  /// Replaces a picture of the input, which must have kept its hits, by one of the ids that the
  /// selector requests.
  void WriteIds(vtkIsosurfaceRayTracePicture& picture) const;

private:
  /// How a point or a cell is named.
  struct Element
  {
    unsigned int FlatIndex = 1;
    vtkIdType Id;
  };

  vtkIdType GetId(const vtkIsosurfaceRayTracing::Hit& hit) const;
  Element FindPoint(const vtkIsosurfaceRayTracing::Hit& hit) const;
  Element FindCell(const vtkIsosurfaceRayTracing::Hit& hit) const;

  vtkHardwareSelector* Selector;
  const vtkIsosurfaceRayTraceInputs& Inputs;
};

VTK_ABI_NAMESPACE_END

#endif
