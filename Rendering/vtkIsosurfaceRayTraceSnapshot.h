// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The blocks of composite data, and when each was modified: what is known of them is right as long
// as these are the same.

#ifndef vtkIsosurfaceRayTraceSnapshot_h
#define vtkIsosurfaceRayTraceSnapshot_h

#include "vtkIsosurfaceRayTraceGridLists.h" // for ivars
#include "vtkIsosurfaceRayTracingCompat.h"  // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                        // for vtkMTimeType

#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCompositeDataDisplayAttributes;
class vtkCompositeDataSet;
class vtkDataObject;

class vtkIsosurfaceRayTraceSnapshot
{
public:
  /// Of no data.
  vtkIsosurfaceRayTraceSnapshot() = default;

  /// The attributes that blocks are displayed with may be null.
  vtkIsosurfaceRayTraceSnapshot(
    vtkCompositeDataSet* data, vtkCompositeDataDisplayAttributes* attributes);

  /// Whether the data have the same blocks, none of which was modified, and the attributes neither.
  /// Thousands of blocks may be asked for that several times in a frame.
  bool IsOf(
    vtkCompositeDataSet* data, vtkCompositeDataDisplayAttributes* attributes, int threads) const;

  ///@{
  /// The same of the blocks alone, and of the attributes.
  bool IsOfBlocks(vtkCompositeDataSet* data, int threads) const;
  bool IsOfAttributes(vtkCompositeDataDisplayAttributes* attributes) const;
  ///@}

private:
  struct Node
  {
    vtkDataObject* Data;
    unsigned int FlatIndex;
    vtkMTimeType Time;
  };
  /// A block, and the objects that are asked for their times where it is asked for its own. They
  /// may be gone.
  struct Block : Node
  {
    vtkIsosurfaceRayTraceGridLists Lists;
    const void* Parts[9];
  };

  static Block MakeBlock(vtkDataObject* data, unsigned int flatIndex);
  bool HasBlocksOf(vtkCompositeDataSet* data) const;
  bool AreBlocksUnmodified(int threads) const;

  vtkMTimeType DisplayTime = 0;
  /// The data, and the trees in them, if they are a tree: whatever adds or removes a block modifies
  /// the tree that has it. What has another one comes before it, so that no one that is gone is
  /// asked for its time.
  std::vector<Node> Trees;
  std::vector<Block> Blocks;
};

VTK_ABI_NAMESPACE_END

#endif
