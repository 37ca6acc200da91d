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

float RoundDown(double value)
{
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) > value ? std::nextafterf(rounded, -FloatInfinity) : rounded;
}

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
  for (Queue* queue : { &this->Tetrahedra, &this->Others })
  {
    queue->Bounded.Count = 0;
    queue->Bounded.Unbounded = 0;
  }
  this->Sets = 0;
  const int levels = selection.Tree->GetNumberOfLevels();
  this->HasFrame =
    levels > 0 && selection.PacketKernels && this->Frame.Find(lines, selection.Tree->GetBounds());
  if (!this->HasFrame)
  {
    return;
  }
  this->Sides = this->Frame.GetSides();
  this->Spans.clear();
  for (const MeshSurface& surface : selection.Surfaces)
  {
    this->Spans.push_back(FindSpan(surface.Isovalue));
  }
  this->Heap.push_back({ -FloatInfinity, levels - 1, 0 });
}

//------------------------------------------------------------------------------
bool MeshBeam::FindMore(const MeshSelection& selection, float end)
{
  const int before = this->Sets;
  while (this->Sets == before && !this->Heap.empty() && this->Heap.front().Depth <= end)
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
      this->AddBlock(selection, node.Number);
    }
  }
  if (this->Sets == before)
  {
    this->Bound(selection, this->Tetrahedra, true);
    this->Bound(selection, this->Others, false);
  }
  return this->Sets > before;
}

//------------------------------------------------------------------------------
void MeshBeam::Expand(const MeshSelection& selection, const Node& node)
{
  const CellTreeNode& children = selection.Tree->GetNode(node.Level, node.Number);
  const std::size_t axis = this->Frame.GetAxis();
  const float* nearest = this->Frame.IsUp() ? children.Lower[axis] : children.Upper[axis];
  for (unsigned int found = selection.PacketKernels->FindChildrenInBeam(
         children, this->Sides, this->Spans.data(), static_cast<int>(this->Spans.size()));
       found != 0; found &= found - 1)
  {
    const int child = __builtin_ctz(found);
    this->Heap.push_back({ RoundDown(this->Frame.GetDepth(static_cast<double>(nearest[child]))),
      node.Level - 1, node.Number * CellTree::Width + static_cast<std::size_t>(child) });
    std::push_heap(this->Heap.begin(), this->Heap.end());
  }
}

//------------------------------------------------------------------------------
void MeshBeam::AddBlock(const MeshSelection& selection, std::size_t block)
{
  const std::uint32_t* cells = &selection.Tree->GetOrder()[block * CellTree::Width];
  for (std::size_t surface = 0; surface < selection.Surfaces.size(); ++surface)
  {
    for (unsigned int active = selection.Surfaces[surface].Active->Get(block); active != 0;
         active &= active - 1)
    {
      this->AddCell(selection, cells[__builtin_ctz(active)], static_cast<int>(surface));
    }
  }
}

//------------------------------------------------------------------------------
void MeshBeam::AddCell(const MeshSelection& selection, std::uint32_t number, int surface)
{
  MeshCell cell;
  selection.Cells->Load(number, cell);
  const bool isTetrahedron = cell.Shape == CellShape::Tetrahedron;
  Queue& queue = isTetrahedron ? this->Tetrahedra : this->Others;
  const int place = queue.Bounded.Count++;
  PassedCell& passed = queue.Cells[place];
  passed = { number, surface, isTetrahedron, {} };
  const MeshSurface& traced = selection.Surfaces[static_cast<std::size_t>(surface)];
  // The corners as they are recorded.
  int corners[BeamCells::Corners];
  if (isTetrahedron)
  {
    passed.Order = CornerOrder(cell);
    std::copy_n(passed.Order.Corners, 4, corners);
  }
  else
  {
    std::copy_n(GetTraits(cell.Shape).Trilinear, BeamCells::Corners, corners);
  }
  const int count = isTetrahedron ? 4 : BeamCells::Corners;
  CellRecord& record = queue.Records[place];
  for (int i = 0; i < count; ++i)
  {
    std::copy_n(cell.Points[corners[i]].begin(), 3, record.Corner[i]);
    record.Corner[i][3] = Difference(cell.Values[corners[i]], traced.Isovalue, traced.Scale);
  }
  this->AddToBounds(record, count, place, queue.Bounded);
  if (queue.Bounded.Count == BeamCells::Capacity)
  {
    this->Bound(selection, queue, isTetrahedron);
  }
}

//------------------------------------------------------------------------------
void MeshBeam::AddToBounds(const CellRecord& record, int count, int place, BeamCells& cells) const
{
  int order[BeamCells::Corners];
  std::iota(order, order + count, 0);
  if (count == 4)
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
  for (int i = 0; i < count; ++i)
  {
    const double* corner = record.Corner[order[i]];
    differences[i] = corner[3];
    const BeamPoint point = this->Frame.Project({ corner[0], corner[1], corner[2] });
    isBounded = SetCorner(point, i, place, cells) && isBounded;
  }
  isBounded = SetDifferences(differences, count, place, cells) && isBounded;
  cells.Unbounded |= static_cast<std::uint32_t>(!isBounded) << place;
}

//------------------------------------------------------------------------------
void MeshBeam::Bound(const MeshSelection& selection, Queue& queue, bool areTetrahedra)
{
  BeamCells& cells = queue.Bounded;
  if (cells.Count == 0)
  {
    return;
  }
  const auto set = static_cast<std::size_t>(this->Sets++);
  constexpr auto capacity = static_cast<std::size_t>(BeamPieces::Capacity);
  if (set == this->Pieces.size())
  {
    this->Pieces.emplace_back();
    this->Cells.resize(this->Cells.size() + capacity);
    this->Records.resize(this->Records.size() + capacity);
  }
  BeamPieces& pieces = this->Pieces[set];
  pieces.Count = cells.Count;
  const Kernels& kernels = *selection.PacketKernels;
  (areTetrahedra ? kernels.BoundTetrahedra : kernels.BoundTrilinear)(
    cells, this->Frame.GetMargin(), pieces);
  std::copy_n(queue.Cells, cells.Count, &this->Cells[set * capacity]);
  std::copy_n(queue.Records, cells.Count, &this->Records[set * capacity]);
  cells.Count = 0;
  cells.Unbounded = 0;
}

}
