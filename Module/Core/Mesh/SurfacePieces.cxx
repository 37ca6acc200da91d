// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/SurfacePieces.h"

#include "Math/RoundOutward.h"
#include "Math/TrilinearCell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Of leaves without any.
constexpr PackedPieces NoPieces = {};

/// Points whose convex hull a piece is in: between each corner inside and each outside at most.
struct PiecePoints
{
  int Count;
  Vector3 Points[MaximumCorners * MaximumCorners / 4];
};

/// Finds the points of pieces of a surface.
class CellCut
{
public:
  CellCut(const MeshCell& cell, double isovalue, double scale)
    : Cell(&cell)
  {
    for (int i = 0; i < cell.Count; ++i)
    {
      this->Differences[i] = Difference(cell.Values[i], isovalue, scale);
      const int side = this->Differences[i] >= 0.0 ? 1 : 0;
      this->Corners[side][this->Counts[side]++] = i;
    }
  }

  /// The corners of the piece in a tetrahedron, a triangle or a quadrangle, in order around it.
  void FindPolygon(PiecePoints& points) const
  {
    this->FindHull(points);
    if (points.Count == 4)
    {
      std::swap(points.Points[2], points.Points[3]);
    }
    else
    {
      points.Points[points.Count++] = points.Points[2];
    }
  }

  /// Where all segments between corners inside and outside meet the surface: a trilinear cell is,
  /// with its values, in the convex hull of its corners.
  void FindHull(PiecePoints& points) const
  {
    points.Count = 0;
    for (int i = 0; i < this->Counts[0]; ++i)
    {
      for (int j = 0; j < this->Counts[1]; ++j)
      {
        points.Points[points.Count++] = this->Meet(i, j);
      }
    }
  }

private:
  Vector3 Meet(int outside, int inside) const
  {
    const int a = this->Corners[0][outside];
    const int b = this->Corners[1][inside];
    const double fraction = this->Differences[a] / (this->Differences[a] - this->Differences[b]);
    return this->Cell->Points[a] * (1.0 - fraction) + this->Cell->Points[b] * fraction;
  }

  const MeshCell* Cell;
  double Differences[MaximumCorners];
  /// Those outside of the surface, and inside.
  int Corners[2][MaximumCorners];
  int Counts[2] = { 0, 0 };
};

/// Pieces that are put into one set.
class SetOfPieces
{
public:
  explicit SetOfPieces(bool areInTetrahedra) { this->Packed.AreInTetrahedra = areInTetrahedra; }

  void Add(int number, const CellCut& cut)
  {
    this->Packed.Cells[this->Count] = static_cast<std::uint8_t>(number);
    PiecePoints& points = this->Points[this->Count++];
    if (this->Packed.AreInTetrahedra)
    {
      cut.FindPolygon(points);
    }
    else
    {
      cut.FindHull(points);
    }
  }

  bool IsFull() const { return this->Count == PackedPieces::Capacity; }

  /// Appends the set, if there is anything in it, and begins another.
  void Finish(std::vector<PackedPieces>& sets)
  {
    if (this->Count == 0)
    {
      return;
    }
    this->Packed.Count = static_cast<std::uint8_t>(this->Count);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->FindBox(axis);
    }
    this->PackPolygons();
    sets.push_back(this->Packed);
    this->Count = 0;
  }

private:
  void FindBox(std::size_t axis)
  {
    double lower = Infinity;
    double upper = -Infinity;
    for (int i = 0; i < this->Count; ++i)
    {
      for (int k = 0; k < this->Points[i].Count; ++k)
      {
        lower = std::min(lower, this->Points[i].Points[k][axis]);
        upper = std::max(upper, this->Points[i].Points[k][axis]);
      }
    }
    this->Packed.Lower[axis] = RoundDown(lower);
    this->Packed.Upper[axis] = RoundUp(upper);
  }

  void PackPolygons()
  {
    for (auto& corners : this->Packed.Polygons)
    {
      std::fill_n(corners, PackedPieces::Capacity, 0U);
    }
    for (std::size_t axis = 0; axis < 3 && this->Packed.AreInTetrahedra; ++axis)
    {
      const auto lower = static_cast<double>(this->Packed.Lower[axis]);
      const double size = static_cast<double>(this->Packed.Upper[axis]) - lower;
      const double steps = size > 0.0 && size < Infinity ? PackedPieces::Steps / size : 0.0;
      for (int i = 0; i < this->Count; ++i)
      {
        for (int k = 0; k < PackedPieces::Corners; ++k)
        {
          const double step =
            steps > 0.0 ? (this->Points[i].Points[k][axis] - lower) * steps + 0.5 : 0.0;
          this->Packed.Polygons[k][i] |=
            std::min(static_cast<unsigned int>(step), PackedPieces::Steps)
            << (PackedPieces::Bits * axis);
        }
      }
    }
  }

  PackedPieces Packed = {};
  PiecePoints Points[PackedPieces::Capacity];
  int Count = 0;
};

}

//------------------------------------------------------------------------------
SurfacePieces::SurfacePieces(
  const MeshCells& cells, const CellTree& tree, double isovalue, double scale)
  : Cells(&cells)
  , Tree(&tree)
  , Isovalue(isovalue)
  , Scale(scale)
  , NumberOfLeaves((tree.GetNumberOfBlocks() + CellTree::Width - 1) / CellTree::Width)
  , Leaves(new std::atomic<const PackedPieces*>[this->NumberOfLeaves]())
{
}

//------------------------------------------------------------------------------
SurfacePieces::~SurfacePieces()
{
  for (std::size_t leaf = 0; leaf < this->NumberOfLeaves; ++leaf)
  {
    const PackedPieces* made = this->Leaves[leaf].load();
    if (made != &NoPieces)
    {
      delete[] made;
    }
  }
}

//------------------------------------------------------------------------------
const PackedPieces* SurfacePieces::Make(std::size_t leaf)
{
  std::vector<PackedPieces> found = this->Find(leaf);
  std::unique_ptr<PackedPieces[]> made;
  if (!found.empty())
  {
    found.front().Sets = static_cast<std::uint16_t>(found.size());
    made.reset(new PackedPieces[found.size()]);
    std::copy(found.begin(), found.end(), made.get());
  }
  const PackedPieces* ours = made ? made.get() : &NoPieces;
  const PackedPieces* others = nullptr;
  if (!this->Leaves[leaf].compare_exchange_strong(others, ours))
  {
    return others;
  }
  this->Memory += found.size() * sizeof(PackedPieces);
  made.release();
  return ours;
}

//------------------------------------------------------------------------------
std::vector<PackedPieces> SurfacePieces::Find(std::size_t leaf) const
{
  std::vector<PackedPieces> sets;
  SetOfPieces inTetrahedra(true);
  SetOfPieces inOthers(false);
  const CellTreeNode& node = this->Tree->GetNode(0, leaf);
  for (int child = 0; child < CellTree::Width; ++child)
  {
    if (!CellTree::HasBothSides(node, child, this->Isovalue))
    {
      continue;
    }
    std::uint32_t numbers[CellTree::Width];
    const int count =
      this->Tree->GetCells(leaf * CellTree::Width + static_cast<std::size_t>(child), numbers);
    for (unsigned int active = this->Cells->FindStraddling(numbers, count, this->Isovalue);
         active != 0; active &= active - 1)
    {
      const int i = __builtin_ctz(active);
      MeshCell cell;
      if (!this->Cells->Load(numbers[i], cell))
      {
        continue;
      }
      SetOfPieces& set = cell.Shape == CellShape::Tetrahedron ? inTetrahedra : inOthers;
      set.Add(child * CellTree::Width + i, CellCut(cell, this->Isovalue, this->Scale));
      if (set.IsFull())
      {
        set.Finish(sets);
      }
    }
  }
  inTetrahedra.Finish(sets);
  inOthers.Finish(sets);
  return sets;
}

}
