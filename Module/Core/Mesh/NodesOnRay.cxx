// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/NodesOnRay.h"

#include "Math/Compiler.h"

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void NodesOnRay::Begin(const MeshSelection& selection, const RayThroughBoxes& ray)
{
  this->Ray = ray;
  this->Nodes[0] = { ray.Begin, selection.Tree->GetNumberOfLevels() - 1, 0 };
  this->Count = 1;
}

//------------------------------------------------------------------------------
bool NodesOnRay::FindLeaf(const MeshSelection& selection, float end, std::size_t& leaf)
{
  while (this->Count > 0)
  {
    const Node& node = this->Nodes[--this->Count];
    if (node.Near > end)
    {
      continue;
    }
    if (node.Level == CellTree::LowestLevel)
    {
      leaf = node.Number;
      return true;
    }
    this->Expand(selection, node.Level, node.Number, end);
  }
  return false;
}

//------------------------------------------------------------------------------
/// Adds the children of a node that are on the ray, the nearest one last.
void NodesOnRay::Expand(const MeshSelection& selection, int level, std::size_t number, float end)
{
  float near[CellTreeNode::Width];
  int order[CellTreeNode::Width];
  int count = 0;
  for (unsigned int found =
         selection.PacketKernels->FindChildrenOnRay(selection.Tree->GetNode(level, number),
           this->Ray, end, selection.Spans.data(), static_cast<int>(selection.Spans.size()), near);
       found != 0; found &= found - 1)
  {
    const int child = LowestBit(found);
    selection.Prefetch(level - 1, number * CellTree::Width + static_cast<std::size_t>(child));
    int place = count++;
    for (; place > 0 && near[order[place - 1]] < near[child]; --place)
    {
      order[place] = order[place - 1];
    }
    order[place] = child;
  }
  for (int i = 0; i < count; ++i)
  {
    // Member by member: a copy of the whole would wait for these.
    Node& node = this->Nodes[this->Count++];
    node.Near = near[order[i]];
    node.Level = level - 1;
    node.Number = number * CellTree::Width + static_cast<std::size_t>(order[i]);
  }
}

}
