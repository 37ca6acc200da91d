// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The bounds of what is visible of the data at all connections of a mapper. Those of blocks are
// kept: there may be thousands, and they are asked for in every frame.

#ifndef vtkIsosurfaceRayTraceInputBounds_h
#define vtkIsosurfaceRayTraceInputBounds_h

#include "vtkIsosurfaceRayTraceSnapshot.h" // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include <array>      // for std::array
#include <functional> // for std::function
#include <vector>     // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkAlgorithm;
class vtkCompositeDataDisplayAttributes;
class vtkCompositeDataSet;
class vtkVolume;

class vtkIsosurfaceRayTraceInputBounds
{
public:
  /// Finds the bounds of the data of the first port, which are up to date, each moved by the matrix
  /// of its connection's volume, if it has one. If there are none, bounds are left as they are. The
  /// attributes of blocks may be null.
  void Find(vtkAlgorithm* mapper,
    const std::function<vtkVolume*(int connection)>& getConnectionVolume,
    vtkCompositeDataDisplayAttributes* attributes, int threads, double bounds[6]);

private:
  /// The blocks that a connection had when their bounds were asked for last.
  struct BlocksOfConnection
  {
    vtkIsosurfaceRayTraceSnapshot Found;
    std::array<double, 6> Bounds = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  };

  static void FindOfBlocks(vtkCompositeDataSet* data, vtkCompositeDataDisplayAttributes* attributes,
    int threads, BlocksOfConnection& last);

  std::vector<BlocksOfConnection> Blocks;
};

VTK_ABI_NAMESPACE_END

#endif
