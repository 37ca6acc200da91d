// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/NearestNodes.h"

#include "Math/Compiler.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The nodes that hold blocks of cells.
constexpr int LevelOfLeaves = 0;

IsovalueSpan FindSpan(double isovalue)
{
  const auto rounded = static_cast<float>(isovalue);
  const float from =
    static_cast<double>(rounded) < isovalue ? std::nextafterf(rounded, FloatInfinity) : rounded;
  return { std::nextafterf(from, -FloatInfinity), from };
}

}

//------------------------------------------------------------------------------
void NearestNodes::Begin(const MeshSelection& selection, const BeamProjection& projection)
{
  this->Projection = projection;
  this->Spans.clear();
  for (const MeshSurface& surface : selection.Surfaces)
  {
    this->Spans.push_back(FindSpan(surface.Isovalue));
  }
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
    if (node.Level == LevelOfLeaves)
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
      this->Projection, this->Spans.data(), static_cast<int>(this->Spans.size()), bounds);
  for (; found != 0; found &= found - 1)
  {
    const int child = LowestBit(found);
    const std::size_t number = node.Number * CellTree::Width + static_cast<std::size_t>(child);
    this->Prefetch(selection, node.Level - 1, number);
    this->Heap.push_back({ bounds.Near[child], node.Level - 1, number });
    std::push_heap(this->Heap.begin(), this->Heap.end());
  }
}

//------------------------------------------------------------------------------
/// Begins to fetch what is read of a node when it is expanded.
void NearestNodes::Prefetch(const MeshSelection& selection, int level, std::size_t number)
{
  if (level > LevelOfLeaves)
  {
    selection.Tree->Prefetch(level, number);
  }
  for (const MeshSurface& surface : selection.Surfaces)
  {
    if (level == LevelOfLeaves)
    {
      surface.Pieces->PrefetchBoxes(number);
    }
    else if (level == LevelOfLeaves + 1)
    {
      surface.Pieces->Prefetch(number * CellTree::Width, CellTree::Width);
    }
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
//------------------------------------------------------------------------------
/// As ProjectChildren does it, with a W that is 1.
bool NearestNodes::IsOnRay(const PackedPieces& set, float end) const
{
  const BeamProjection& beam = this->Projection;
  const float z[2] = { set.Lower[beam.Along] - beam.Plane + beam.PlaneRest,
    set.Upper[beam.Along] - beam.Plane + beam.PlaneRest };
  const float near = beam.IsUp ? z[0] : -z[1];
  const float far = beam.IsUp ? z[1] : -z[0];
  bool isMet = near - beam.DepthError <= end && beam.Begin <= far + beam.DepthError;
  for (int k = 0; k < 2; ++k)
  {
    const float left = set.Lower[beam.Across[k]] - beam.Center[k] + beam.CenterRest[k];
    const float right = set.Upper[beam.Across[k]] - beam.Center[k] + beam.CenterRest[k];
    const float shift[2] = { beam.Slope[k] * z[0], beam.Slope[k] * z[1] };
    const float room = 1.0F + beam.Error;
    isMet = isMet && beam.Scale * left - std::max(shift[0], shift[1]) <= room &&
      -room <= beam.Scale * right - std::min(shift[0], shift[1]);
  }
  return isMet;
}

}
