// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What a process has of the data that a vtkIsosurfaceRayTraceRepresentation shows.

#ifndef vtkIsosurfaceRayTracePiece_h
#define vtkIsosurfaceRayTracePiece_h

#include "vtkBoundingBox.h"                // for GetOwnBounds
#include "vtkDataObject.h"                 // for vtkSmartPointer<vtkDataObject>
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"               // for vtkSmartPointer

#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCompositeDataDisplayAttributes;
class vtkDataArray;

namespace vtkIsosurfaceRayTracePiece
{
/// A shallow copy as vtkIsosurfaceRayTraceMapper takes it: a single mesh becomes composite data of
/// one block.
vtkSmartPointer<vtkDataObject> MakeInput(vtkDataObject* data);

/// The bounds of the cells of visible blocks that are no ghosts: those of several processes do not
/// overlap if their cells do not. The data may be null.
vtkBoundingBox GetOwnBounds(vtkDataObject* data, vtkCompositeDataDisplayAttributes* attributes);

/// What is known of the pieces of all processes: the bounds of each, in the order of the processes,
/// the most components that an array has in one, and whether one has new AMR data.
struct Together
{
  std::vector<vtkBoundingBox> Bounds;
  int NumberOfComponents = 0;
  bool HasNewAmr = false;
};

/// Gathers it. To be called by all processes, with what each knows of its own piece.
Together Gather(const double bounds[6], int numberOfComponents, bool isNewAmr);

bool IsAmr(vtkDataObject* data);

/// AMR data with the blocks of other processes that are next to its own, hidden; other data as they
/// are. To be called by all processes. The data may be null.
vtkSmartPointer<vtkDataObject> AddGhostBlocks(vtkDataObject* data);

/// The array of points or cells of the first block with cells that has it; null if none has it.
vtkDataArray* FindArray(vtkDataObject* data, int association, const std::string& name);
}

VTK_ABI_NAMESPACE_END

#endif
