// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The cells that a place is in. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

unsigned int FindChildrenAround(const CellTreeNode& node, const PlaceInBoxes& place)
{
  unsigned int found = 0;
  for (int i = 0; i < CellTreeNode::Width; i += FloatWidth)
  {
    FloatMask isBeside = LoadFloats(&node.High[i]) < place.LeastHigh;
    for (int axis = 0; axis < 3; ++axis)
    {
      isBeside = isBeside | (place.Below[axis] < LoadFloats(&node.Lower[axis][i])) |
        (LoadFloats(&node.Upper[axis][i]) < place.Above[axis]);
    }
    found |= (~ToBits(isBeside) & ((1U << FloatWidth) - 1U)) << i;
  }
  return found;
}

}
}
