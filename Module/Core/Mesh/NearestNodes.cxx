// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/NearestNodes.h"

#include "Math/Compiler.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void NearestNodes::Begin(const MeshSelection& selection, const BeamProjection& projection)
{
  this->Projection = projection;
  this->Heap.clear();
  this->Heap.push_back({ -FloatInfinity, selection.Tree->GetNumberOfLevels() - 1, 0 });
}

//------------------------------------------------------------------------------
bool NearestNodes::FindLeaf(const MeshSelection& selection, float end, std::size_t& leaf)
{
  while (!this->Heap.empty() && this->Heap.front().Near <= end)
  {
    std::pop_heap(this->Heap.begin(), this->Heap.end());
    const Node node = this->Heap.back();
    this->Heap.pop_back();
    if (node.Level == CellTree::LowestLevel)
    {
      leaf = node.Number;
      return true;
    }
    this->Expand(selection, node);
  }
  return false;
}

//------------------------------------------------------------------------------
void NearestNodes::Expand(const MeshSelection& selection, const Node& node)
{
  LabelBounds bounds;
  unsigned int found =
    selection.PacketKernels->ProjectChildren(selection.Tree->GetNode(node.Level, node.Number),
      this->Projection, selection.Spans.data(), static_cast<int>(selection.Spans.size()), bounds);
  for (; found != 0; found &= found - 1)
  {
    const int child = LowestBit(found);
    const std::size_t number = node.Number * CellTree::Width + static_cast<std::size_t>(child);
    selection.Prefetch(node.Level - 1, number);
    this->Heap.push_back({ bounds.Near[child], node.Level - 1, number });
    std::push_heap(this->Heap.begin(), this->Heap.end());
  }
}

//------------------------------------------------------------------------------
unsigned int NearestNodes::FindSets(
  const MeshSelection& selection, const PackedPieces* sets, int count, LabelBounds& bounds) const
{
  constexpr IsovalueSpan anyValue = { 0.0F, 0.0F };
  CellTreeNode boxes = {};
  std::fill_n(boxes.Low, CellTreeNode::Width, FloatInfinity);
  std::fill_n(boxes.Low, count, -FloatInfinity);
  std::fill_n(boxes.High, count, FloatInfinity);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < count; ++i)
    {
      boxes.Lower[axis][i] = sets[i].Lower[axis];
      boxes.Upper[axis][i] = sets[i].Upper[axis];
    }
  }
  return selection.PacketKernels->ProjectChildren(boxes, this->Projection, &anyValue, 1, bounds);
}

}
