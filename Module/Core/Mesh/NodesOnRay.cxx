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
  this->Nodes.clear();
  this->Nodes.push_back({ ray.Begin, selection.Tree->GetNumberOfLevels() - 1, 0 });
}

//------------------------------------------------------------------------------
bool NodesOnRay::FindLeaf(const MeshSelection& selection, float end, std::size_t& leaf)
{
  while (!this->Nodes.empty())
  {
    const Node node = this->Nodes.back();
    this->Nodes.pop_back();
    if (node.Near > end)
    {
      continue;
    }
    if (node.Level == CellTree::LowestLevel)
    {
      leaf = node.Number;
      return true;
    }
    this->Expand(selection, node, end);
  }
  return false;
}

//------------------------------------------------------------------------------
/// Adds the children on the ray, sorted.
void NodesOnRay::Expand(const MeshSelection& selection, const Node& node, float end)
{
  float near[CellTreeNode::Width];
  const std::size_t first = this->Nodes.size();
  for (unsigned int found = selection.PacketKernels->FindChildrenOnRay(
         selection.Tree->GetNode(node.Level, node.Number), this->Ray, end, selection.Spans.data(),
         static_cast<int>(selection.Spans.size()), near);
       found != 0; found &= found - 1)
  {
    const int child = LowestBit(found);
    const Node added = { near[child], node.Level - 1,
      node.Number * CellTree::Width + static_cast<std::size_t>(child) };
    selection.Prefetch(added.Level, added.Number);
    std::size_t place = this->Nodes.size();
    this->Nodes.push_back(added);
    for (; place > first && this->Nodes[place - 1].Near < added.Near; --place)
    {
      this->Nodes[place] = this->Nodes[place - 1];
    }
    this->Nodes[place] = added;
  }
}

}
