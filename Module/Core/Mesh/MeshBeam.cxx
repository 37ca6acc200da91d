// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/MeshBeam.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr float FloatInfinity = std::numeric_limits<float>::infinity();

IsovalueSpan FindSpan(double isovalue)
{
  const auto rounded = static_cast<float>(isovalue);
  const float from =
    static_cast<double>(rounded) < isovalue ? std::nextafterf(rounded, FloatInfinity) : rounded;
  return { std::nextafterf(from, -FloatInfinity), from };
}

}

//------------------------------------------------------------------------------
void MeshBeam::Begin(const MeshSelection& selection, const RayPacket& lines)
{
  this->Heap.clear();
  this->Blocks.clear();
  this->Bounds.clear();
  this->NumberOfSets = 0;
  const int levels = selection.Tree->GetNumberOfLevels();
  this->HasFrame =
    levels > 0 && selection.PacketKernels && this->Frame.Find(lines, selection.Tree->GetBounds());
  if (!this->HasFrame)
  {
    return;
  }
  this->Projection = this->Frame.GetProjection();
  this->Spans.clear();
  for (const MeshSurface& surface : selection.Surfaces)
  {
    this->Spans.push_back(FindSpan(surface.Isovalue));
  }
  this->Heap.push_back({ 0, levels - 1, -FloatInfinity, {}, {} });
}

//------------------------------------------------------------------------------
bool MeshBeam::FindMore(const MeshSelection& selection, float end)
{
  const std::size_t before = this->Blocks.size();
  while (this->Blocks.size() - before < LabelBounds::Capacity && !this->Heap.empty() &&
    this->Heap.front().Near <= end)
  {
    std::pop_heap(this->Heap.begin(), this->Heap.end());
    const Node node = this->Heap.back();
    this->Heap.pop_back();
    if (node.Level >= 0)
    {
      this->Expand(selection, node);
    }
    else
    {
      this->AddBlock(selection, node);
    }
  }
  return this->Blocks.size() > before;
}

//------------------------------------------------------------------------------
void MeshBeam::Expand(const MeshSelection& selection, const Node& node)
{
  LabelBounds bounds;
  for (unsigned int found =
         selection.PacketKernels->ProjectChildren(selection.Tree->GetNode(node.Level, node.Number),
           this->Projection, this->Spans.data(), static_cast<int>(this->Spans.size()), bounds);
       found != 0; found &= found - 1)
  {
    const int child = __builtin_ctz(found);
    this->Heap.push_back({ node.Number * CellTree::Width + static_cast<std::size_t>(child),
      node.Level - 1, bounds.Near[child], { bounds.Lower[0][child], bounds.Lower[1][child] },
      { bounds.Upper[0][child], bounds.Upper[1][child] } });
    if (node.Level > 0)
    {
      selection.Tree->Prefetch(node.Level - 1, this->Heap.back().Number);
    }
    std::push_heap(this->Heap.begin(), this->Heap.end());
  }
}

//------------------------------------------------------------------------------
void MeshBeam::AddBlock(const MeshSelection& selection, const Node& node)
{
  const std::size_t place = this->Blocks.size() % LabelBounds::Capacity;
  if (place == 0)
  {
    this->Bounds.emplace_back();
  }
  LabelBounds& bounds = this->Bounds.back();
  for (std::size_t k = 0; k < 2; ++k)
  {
    bounds.Lower[k][place] = node.Lower[k];
    bounds.Upper[k][place] = node.Upper[k];
  }
  bounds.Near[place] = node.Near;
  this->Blocks.push_back({ node.Number, -1, -1 });
  if (!selection.Tree->AreCellsSorted())
  {
    selection.Cells->Prefetch(
      selection.Tree->GetCell(node.Number, 0), selection.Tree->GetNumberOfCells(node.Number));
  }
}

//------------------------------------------------------------------------------
MeshBeam::PieceSets MeshBeam::GetPieces(const MeshSelection& selection, int block)
{
  Block& found = this->Blocks[static_cast<std::size_t>(block)];
  if (found.FirstSet < 0)
  {
    found.FirstSet = this->NumberOfSets;
    this->AddPieces(selection, found.Number);
    found.LastSet = this->NumberOfSets;
  }
  return { this->Sets.data() + found.FirstSet, this->Sets.data() + found.LastSet };
}

//------------------------------------------------------------------------------
void MeshBeam::AddPieces(const MeshSelection& selection, std::size_t block)
{
  for (std::size_t surface = 0; surface < selection.Surfaces.size(); ++surface)
  {
    // A set has one kind.
    std::uint32_t numbers[2][CellTree::Width];
    int counts[2] = {};
    for (unsigned int active = selection.Surfaces[surface].Active->Get(block); active != 0;
         active &= active - 1)
    {
      const std::uint32_t number = selection.Tree->GetCell(block, __builtin_ctz(active));
      const std::size_t kind = selection.Cells->IsTetrahedron(number) ? 0 : 1;
      numbers[kind][counts[kind]++] = number;
    }
    for (const std::size_t kind : { 0U, 1U })
    {
      if (counts[kind] > 0)
      {
        this->AddSet(selection, numbers[kind], counts[kind], surface, kind == 0);
      }
    }
  }
}

//------------------------------------------------------------------------------
void MeshBeam::AddSet(const MeshSelection& selection, const std::uint32_t* numbers, int count,
  std::size_t surface, bool areTetrahedra)
{
  const auto number = static_cast<std::size_t>(this->NumberOfSets++);
  if (number == this->Sets.size())
  {
    this->Sets.emplace_back();
  }
  PieceSet& set = this->Sets[number];
  set.First = static_cast<int>(number) * BeamPieces::Capacity;
  set.Surface = static_cast<int>(surface);
  set.AreTetrahedra = areTetrahedra;
  set.Pieces.Count = count;
  std::copy_n(numbers, count, set.Cells);
  selection.Cells->LoadRecords(numbers, count, areTetrahedra, set.Orders, set.Records);
  const MeshSurface& traced = selection.Surfaces[surface];
  const int corners = areTetrahedra ? 4 : PassedCellRecords::Corners;
  for (int corner = 0; corner < corners; ++corner)
  {
    double* values = set.Records.Corner[corner][3];
    for (int i = 0; i < count; ++i)
    {
      values[i] = Difference(values[i], traced.Isovalue, traced.Scale);
    }
  }
  const Kernels& kernels = *selection.PacketKernels;
  (areTetrahedra ? kernels.BoundTetrahedra : kernels.BoundTrilinear)(
    set.Records, this->Frame.GetNumbers(), set.Pieces);
}

}
