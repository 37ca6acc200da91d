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
      this->AddBlock(node);
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
    std::push_heap(this->Heap.begin(), this->Heap.end());
  }
}

//------------------------------------------------------------------------------
void MeshBeam::AddBlock(const Node& node)
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
/// Tetrahedra first, then the others: a set has one kind.
void MeshBeam::AddPieces(const MeshSelection& selection, std::size_t block)
{
  int left = 0;
  for (const MeshSurface& surface : selection.Surfaces)
  {
    left += __builtin_popcount(surface.Active->Get(block));
  }
  for (const bool areTetrahedra : { true, false })
  {
    PieceSet* set = nullptr;
    for (std::size_t surface = 0; surface < selection.Surfaces.size() && left > 0; ++surface)
    {
      for (unsigned int active = selection.Surfaces[surface].Active->Get(block); active != 0;
           active &= active - 1)
      {
        const std::uint32_t number = selection.Tree->GetCell(block, __builtin_ctz(active));
        MeshCell cell;
        selection.Cells->LoadIds(number, cell);
        if ((cell.Shape == CellShape::Tetrahedron) != areTetrahedra)
        {
          continue;
        }
        --left;
        set = set ? set : &this->BeginSet(areTetrahedra);
        this->AddCell(selection, cell, number, static_cast<int>(surface), *set);
        if (set->Pieces.Count == BeamPieces::Capacity)
        {
          this->EndSet(selection, *set);
          set = nullptr;
        }
      }
    }
    if (set)
    {
      this->EndSet(selection, *set);
    }
  }
}

//------------------------------------------------------------------------------
MeshBeam::PieceSet& MeshBeam::BeginSet(bool areTetrahedra)
{
  const auto number = static_cast<std::size_t>(this->NumberOfSets++);
  if (number == this->Sets.size())
  {
    this->Sets.emplace_back();
  }
  PieceSet& set = this->Sets[number];
  set.First = static_cast<int>(number) * BeamPieces::Capacity;
  set.AreTetrahedra = areTetrahedra;
  set.Pieces.Count = 0;
  return set;
}

//------------------------------------------------------------------------------
void MeshBeam::AddCell(const MeshSelection& selection, MeshCell& cell, std::uint32_t number,
  int surface, PieceSet& set) const
{
  selection.Cells->LoadCorners(cell);
  const int place = set.Pieces.Count++;
  PassedCell& passed = set.Cells[place];
  passed.Number = number;
  passed.Surface = surface;
  // The corners as they are recorded.
  int corners[PassedCellRecords::Corners];
  if (set.AreTetrahedra)
  {
    passed.Order = CornerOrder(cell);
    std::copy_n(passed.Order.Corners, 4, corners);
  }
  else
  {
    std::copy_n(GetTraits(cell.Shape).Trilinear, PassedCellRecords::Corners, corners);
  }
  const int count = set.AreTetrahedra ? 4 : PassedCellRecords::Corners;
  const MeshSurface& traced = selection.Surfaces[static_cast<std::size_t>(surface)];
  for (int i = 0; i < count; ++i)
  {
    auto& record = set.Records.Corner[i];
    const Vector3& point = cell.Points[corners[i]];
    record[0][place] = point[0];
    record[1][place] = point[1];
    record[2][place] = point[2];
    record[3][place] = Difference(cell.Values[corners[i]], traced.Isovalue, traced.Scale);
  }
}

//------------------------------------------------------------------------------
void MeshBeam::EndSet(const MeshSelection& selection, PieceSet& set) const
{
  const Kernels& kernels = *selection.PacketKernels;
  (set.AreTetrahedra ? kernels.BoundTetrahedra : kernels.BoundTrilinear)(
    set.Records, this->Frame.GetNumbers(), set.Pieces);
}

}
