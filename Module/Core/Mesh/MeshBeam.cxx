// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/MeshBeam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr float FloatInfinity = std::numeric_limits<float>::infinity();

/// Differences that are smaller, as a part of the largest one in a cell, do not keep their ratio in
/// single precision.
constexpr double SmallestRatio = 1e-30;
/// Larger coordinates overflow in single precision.
constexpr double LargestCoordinate = 1e15;

IsovalueSpan FindSpan(double isovalue)
{
  const auto rounded = static_cast<float>(isovalue);
  const float from =
    static_cast<double>(rounded) < isovalue ? std::nextafterf(rounded, FloatInfinity) : rounded;
  return { std::nextafterf(from, -FloatInfinity), from };
}

/// The corners of a tetrahedron in the order of BeamCells, by which of them are inside.
struct TetrahedronOrder
{
  int Corners[4];
  bool IsTwoByTwo;
};

TetrahedronOrder FindOrder(unsigned int inside)
{
  static constexpr TetrahedronOrder orders[8] = {
    { { 0, 1, 2, 3 }, false }, // none or all
    { { 0, 1, 2, 3 }, false },
    { { 1, 0, 2, 3 }, false },
    { { 0, 1, 2, 3 }, true },
    { { 2, 0, 1, 3 }, false },
    { { 0, 2, 1, 3 }, true },
    { { 1, 2, 0, 3 }, true },
    { { 3, 0, 1, 2 }, false },
  };
  return orders[inside < 8 ? inside : 15 - inside];
}

/// Sets the differences of a cell, given them in the order of the corners. Returns whether they can
/// be told in single precision.
bool SetDifferences(const double* differences, int count, int place, BeamCells& cells)
{
  double largest = 0.0;
  for (int i = 0; i < count; ++i)
  {
    largest = std::max(largest, std::abs(differences[i]));
  }
  const double inverse = 1.0 / largest;
  bool isTold = largest < std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i)
  {
    const double ratio = differences[i] * inverse;
    isTold = isTold && (differences[i] == 0.0 || std::abs(ratio) > SmallestRatio);
    // Zero is inside: it has no sign.
    cells.Difference[i][place] = static_cast<float>(ratio + 0.0);
  }
  return isTold;
}

/// Sets a corner of a cell. Returns whether it has a label.
bool SetCorner(const BeamPoint& point, int corner, int place, BeamCells& cells)
{
  cells.X[corner][place] = static_cast<float>(point.X);
  cells.Y[corner][place] = static_cast<float>(point.Y);
  cells.W[corner][place] = static_cast<float>(point.W);
  cells.Depth[corner][place] = static_cast<float>(point.Depth);
  return point.W > BeamFrame::SmallestW &&
    std::abs(point.X) + std::abs(point.Y) + point.W < LargestCoordinate;
}

}

//------------------------------------------------------------------------------
void MeshBeam::Begin(const MeshSelection& selection, const RayPacket& lines)
{
  this->Heap.clear();
  this->Blocks.clear();
  this->Bounds.clear();
  this->NumberOfSets = 0;
  this->NumberOfPieces = 0;
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
  bool hasOthers = false;
  for (const bool areTetrahedra : { true, false })
  {
    for (std::size_t surface = 0; surface < selection.Surfaces.size(); ++surface)
    {
      for (unsigned int active = selection.Surfaces[surface].Active->Get(block); active != 0;
           active &= active - 1)
      {
        const std::uint32_t number = selection.Tree->GetCell(block, __builtin_ctz(active));
        MeshCell cell;
        selection.Cells->LoadIds(number, cell);
        if ((cell.Shape == CellShape::Tetrahedron) != areTetrahedra)
        {
          hasOthers = true;
          continue;
        }
        selection.Cells->LoadCorners(cell);
        this->AddCell(selection, cell, number, static_cast<int>(surface));
        if (this->Bounded.Count == BeamCells::Capacity)
        {
          this->EndSet(selection, areTetrahedra);
        }
      }
    }
    this->EndSet(selection, areTetrahedra);
    if (!hasOthers)
    {
      return;
    }
  }
}

//------------------------------------------------------------------------------
void MeshBeam::AddCell(
  const MeshSelection& selection, const MeshCell& cell, std::uint32_t number, int surface)
{
  const auto piece = static_cast<std::size_t>(this->NumberOfPieces++);
  if (piece == this->Cells.size())
  {
    this->Cells.resize(2 * piece + BeamCells::Capacity);
    this->Records.resize(this->Cells.size());
  }
  PassedCell& passed = this->Cells[piece];
  passed = { number, surface, cell.Shape == CellShape::Tetrahedron, {} };
  // The corners as they are recorded.
  int corners[BeamCells::Corners];
  if (passed.IsTetrahedron)
  {
    passed.Order = CornerOrder(cell);
    std::copy_n(passed.Order.Corners, 4, corners);
  }
  else
  {
    std::copy_n(GetTraits(cell.Shape).Trilinear, BeamCells::Corners, corners);
  }
  const int count = passed.IsTetrahedron ? 4 : BeamCells::Corners;
  const MeshSurface& traced = selection.Surfaces[static_cast<std::size_t>(surface)];
  CellRecord& record = this->Records[piece];
  for (int i = 0; i < count; ++i)
  {
    std::copy_n(cell.Points[corners[i]].begin(), 3, record.Corner[i]);
    record.Corner[i][3] = Difference(cell.Values[corners[i]], traced.Isovalue, traced.Scale);
  }
  this->AddToBounds(record, count);
}

//------------------------------------------------------------------------------
void MeshBeam::AddToBounds(const CellRecord& record, int corners)
{
  BeamCells& cells = this->Bounded;
  const int place = cells.Count++;
  int order[BeamCells::Corners];
  std::iota(order, order + corners, 0);
  if (corners == 4)
  {
    unsigned int inside = 0;
    for (int i = 0; i < 4; ++i)
    {
      inside |= static_cast<unsigned int>(IsInside(record.Corner[i][3])) << i;
    }
    const TetrahedronOrder found = FindOrder(inside);
    std::copy_n(found.Corners, 4, order);
    cells.IsTwoByTwo[place] = found.IsTwoByTwo ? 1.0F : 0.0F;
  }
  double differences[BeamCells::Corners];
  bool isBounded = true;
  for (int i = 0; i < corners; ++i)
  {
    const double* corner = record.Corner[order[i]];
    differences[i] = corner[3];
    const BeamPoint point = this->Frame.Project({ corner[0], corner[1], corner[2] });
    isBounded = SetCorner(point, i, place, cells) && isBounded;
  }
  isBounded = SetDifferences(differences, corners, place, cells) && isBounded;
  cells.Unbounded |= static_cast<std::uint32_t>(!isBounded) << place;
}

//------------------------------------------------------------------------------
void MeshBeam::EndSet(const MeshSelection& selection, bool areTetrahedra)
{
  BeamCells& cells = this->Bounded;
  if (cells.Count == 0)
  {
    return;
  }
  const auto number = static_cast<std::size_t>(this->NumberOfSets++);
  if (number == this->Sets.size())
  {
    this->Sets.emplace_back();
  }
  PieceSet& set = this->Sets[number];
  set.Pieces.Count = cells.Count;
  set.First = this->NumberOfPieces - cells.Count;
  const Kernels& kernels = *selection.PacketKernels;
  (areTetrahedra ? kernels.BoundTetrahedra : kernels.BoundTrilinear)(
    cells, this->Frame.GetMargin(), set.Pieces);
  cells.Count = 0;
  cells.Unbounded = 0;
}

}
