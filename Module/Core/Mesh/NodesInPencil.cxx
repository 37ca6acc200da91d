// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/NodesInPencil.h"

#include "Math/Compiler.h"

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void NodesInPencil::Begin(const MeshSelection& selection, const PencilThroughBoxes& pencil)
{
  this->Pencil = pencil;
  this->Nodes[0] = { pencil.Begin, selection.Tree->GetNumberOfLevels() - 1, 0 };
  this->Count = 1;
}

//------------------------------------------------------------------------------
bool NodesInPencil::FindLeaf(const MeshSelection& selection, float end, std::size_t& leaf)
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
/// Adds the children of a node that are in the pencil. Those that are first along the last axis,
/// which counts most in the order of cells, come first, if cells are in this order: to sort
/// children by depth takes more time than it saves.
void NodesInPencil::Expand(const MeshSelection& selection, int level, std::size_t number, float end)
{
  float near[CellTreeNode::Width];
  unsigned int found =
    selection.PacketKernels->FindChildrenInPencil(selection.Tree->GetNode(level, number),
      this->Pencil, end, selection.Spans.data(), static_cast<int>(selection.Spans.size()), near);
  while (found != 0)
  {
    const int child = this->Pencil.IsUp ? HighestBit(found) : LowestBit(found);
    found &= ~(1U << child);
    // Member by member: a copy of the whole would wait for these.
    Node& node = this->Nodes[this->Count++];
    node.Near = near[child];
    node.Level = level - 1;
    node.Number = number * CellTree::Width + static_cast<std::size_t>(child);
    selection.Prefetch(node.Level, node.Number);
  }
}

}
