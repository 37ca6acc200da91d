// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "CellGrid.h"

#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Benchmark
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

}

//------------------------------------------------------------------------------
TetrahedronList::TetrahedronList(vtkUnstructuredGrid* grid)
  : Points(static_cast<std::size_t>(grid->GetNumberOfPoints()))
  , Cells(static_cast<std::size_t>(grid->GetNumberOfCells()))
{
  vtkDataArray* values = grid->GetPointData()->GetScalars();
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    const auto id = static_cast<vtkIdType>(i);
    const double* point = grid->GetPoint(id);
    this->Points[i] = { static_cast<float>(point[0]), static_cast<float>(point[1]),
      static_cast<float>(point[2]), static_cast<float>(values->GetComponent(id, 0)) };
  }
  vtkNew<vtkIdList> ids;
  for (std::size_t i = 0; i < this->Cells.size(); ++i)
  {
    grid->GetCellPoints(static_cast<vtkIdType>(i), ids);
    for (vtkIdType corner = 0; corner < 4; ++corner)
    {
      this->Cells[i][static_cast<std::size_t>(corner)] =
        static_cast<std::uint32_t>(ids->GetId(corner));
    }
  }
}

//------------------------------------------------------------------------------
TetrahedronList::Extent TetrahedronList::GetExtent(std::size_t cell) const
{
  Extent extent = { this->Points[this->Cells[cell][0]], this->Points[this->Cells[cell][0]] };
  for (const std::uint32_t id : this->Cells[cell])
  {
    for (std::size_t i = 0; i < 4; ++i)
    {
      extent.Lower[i] = std::min(extent.Lower[i], this->Points[id][i]);
      extent.Upper[i] = std::max(extent.Upper[i], this->Points[id][i]);
    }
  }
  return extent;
}

//------------------------------------------------------------------------------
double TetrahedronList::Intersect(
  std::size_t cell, const Triple& origin, const Triple& direction, double isovalue) const
{
  const std::array<std::uint32_t, 4>& ids = this->Cells[cell];
  const Point& corner = this->Points[ids[0]];
  int inside = corner[3] >= isovalue ? 1 : 0;
  double edges[3][3];
  double rises[3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Point& other = this->Points[ids[i + 1]];
    inside += other[3] >= isovalue ? 1 : 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      edges[i][axis] = static_cast<double>(other[axis]) - static_cast<double>(corner[axis]);
    }
    rises[i] = static_cast<double>(other[3]) - static_cast<double>(corner[3]);
  }
  if (inside == 0 || inside == 4)
  {
    return Infinity;
  }
  // A point's barycentric coordinates are its products with these, over the volume.
  double across[3][3];
  vtkMath::Cross(edges[1], edges[2], across[0]);
  vtkMath::Cross(edges[2], edges[0], across[1]);
  vtkMath::Cross(edges[0], edges[1], across[2]);
  const double volume = vtkMath::Dot(edges[0], across[0]);
  double gradient[3];
  double fromCorner[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    gradient[axis] =
      (rises[0] * across[0][axis] + rises[1] * across[1][axis] + rises[2] * across[2][axis]) /
      volume;
    fromCorner[axis] = origin[axis] - static_cast<double>(corner[axis]);
  }
  const double t =
    (isovalue - static_cast<double>(corner[3]) - vtkMath::Dot(gradient, fromCorner)) /
    vtkMath::Dot(gradient, direction.data());
  double rest = 1.0;
  bool isIn = t >= 0.0;
  for (auto& normal : across)
  {
    const double weight =
      (vtkMath::Dot(normal, fromCorner) + t * vtkMath::Dot(normal, direction.data())) / volume;
    isIn = isIn && weight >= 0.0;
    rest -= weight;
  }
  return isIn && rest >= 0.0 ? t : Infinity;
}

//------------------------------------------------------------------------------
void CellGrid::Level::Include(std::size_t box, float low, float high)
{
  this->Low[box] = std::min(this->Low[box], low);
  this->High[box] = std::max(this->High[box], high);
}

//------------------------------------------------------------------------------
CellGrid::CellGrid(const TetrahedronList& cells)
  : Cells(&cells)
  , Lower{ Infinity, Infinity, Infinity }
  , Upper{ -Infinity, -Infinity, -Infinity }
{
  for (std::size_t i = 0; i < cells.GetSize(); ++i)
  {
    const TetrahedronList::Extent extent = cells.GetExtent(i);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Lower[axis] = std::min(this->Lower[axis], static_cast<double>(extent.Lower[axis]));
      this->Upper[axis] = std::max(this->Upper[axis], static_cast<double>(extent.Upper[axis]));
    }
  }
  double volume = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    volume *= this->Upper[axis] - this->Lower[axis];
  }
  const double edge = std::cbrt(volume / static_cast<double>(cells.GetSize()));
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = this->Upper[axis] - this->Lower[axis];
    this->Boxes[0].Size[axis] = std::max(1, static_cast<int>(length / edge));
    this->BoxSize[axis] = length / this->Boxes[0].Size[axis];
  }
  for (int level = 1; level < Levels; ++level)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Boxes[level].Size[axis] =
        (this->Boxes[level - 1].Size[axis] + Branching - 1) / Branching;
    }
  }
  this->MakeLists();
  this->FindRanges();
}

//------------------------------------------------------------------------------
/// Calls a function with the index of each box that overlaps an extent.
template <typename Function>
void CellGrid::ForEachBox(const TetrahedronList::Extent& extent, const Function& function) const
{
  Index first;
  Index last;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // What lies on a border is in the boxes of both sides.
    const auto find = [&](float coordinate, double margin)
    {
      const double place =
        (static_cast<double>(coordinate) - this->Lower[axis]) / this->BoxSize[axis] + margin;
      return std::clamp(static_cast<int>(std::floor(place)), 0, this->Boxes[0].Size[axis] - 1);
    };
    first[axis] = find(extent.Lower[axis], -1e-6);
    last[axis] = find(extent.Upper[axis], 1e-6);
  }
  for (int z = first[2]; z <= last[2]; ++z)
  {
    for (int y = first[1]; y <= last[1]; ++y)
    {
      for (int x = first[0]; x <= last[0]; ++x)
      {
        function(Index{ x, y, z });
      }
    }
  }
}

//------------------------------------------------------------------------------
void CellGrid::MakeLists()
{
  const Level& boxes = this->Boxes[0];
  const Index& size = boxes.Size;
  this->First.assign(boxes.GetNumber({ size[0] - 1, size[1] - 1, size[2] - 1 }) + 2, 0);
  for (std::size_t i = 0; i < this->Cells->GetSize(); ++i)
  {
    this->ForEachBox(this->Cells->GetExtent(i),
      [&](const Index& box) { ++this->First[boxes.GetNumber(box) + 1]; });
  }
  std::partial_sum(this->First.begin(), this->First.end(), this->First.begin());
  this->Lists.resize(this->First.back());
  std::vector<std::uint32_t> next(this->First.begin(), this->First.end() - 1);
  for (std::size_t i = 0; i < this->Cells->GetSize(); ++i)
  {
    this->ForEachBox(this->Cells->GetExtent(i),
      [&](const Index& box)
      { this->Lists[next[boxes.GetNumber(box)]++] = static_cast<std::uint32_t>(i); });
  }
}

//------------------------------------------------------------------------------
void CellGrid::FindRanges()
{
  for (Level& level : this->Boxes)
  {
    const auto& size = level.Size;
    const std::size_t count = level.GetNumber({ size[0] - 1, size[1] - 1, size[2] - 1 }) + 1;
    level.Low.assign(count, std::numeric_limits<float>::infinity());
    level.High.assign(count, -std::numeric_limits<float>::infinity());
  }
  for (std::size_t i = 0; i < this->Cells->GetSize(); ++i)
  {
    const TetrahedronList::Extent extent = this->Cells->GetExtent(i);
    this->ForEachBox(extent,
      [&](Index box)
      {
        for (Level& level : this->Boxes)
        {
          level.Include(level.GetNumber(box), extent.Lower[3], extent.Upper[3]);
          std::for_each(box.begin(), box.end(), [](int& place) { place /= Branching; });
        }
      });
  }
}

//------------------------------------------------------------------------------
double CellGrid::GetMemory() const
{
  double bytes = 4.0 * static_cast<double>(this->First.size() + this->Lists.size());
  for (const Level& level : this->Boxes)
  {
    bytes += 8.0 * static_cast<double>(level.Low.size());
  }
  return bytes;
}

//------------------------------------------------------------------------------
/// A ray on its way through the grid.
class CellGrid::Walk
{
public:
  Walk(const CellGrid& grid, const Triple& origin, const Triple& direction, double isovalue)
    : Grid(grid)
    , Origin(origin)
    , Direction(direction)
    , Isovalue(isovalue)
  {
  }

  /// Goes through the boxes of a level from first to last, where the ray is from begin to end.
  /// Returns whether the first hit is found.
  bool Pass(int level, const Index& first, const Index& last, double begin, double end)
  {
    const double edge = std::pow(Branching, level);
    Index box;
    Triple next;
    Triple step;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double size = this->Grid.BoxSize[axis] * edge;
      const double place =
        this->Origin[axis] + begin * this->Direction[axis] - this->Grid.Lower[axis];
      box[axis] = std::clamp(static_cast<int>(std::floor(place / size)), first[axis], last[axis]);
      const int border = box[axis] + (this->Direction[axis] > 0.0 ? 1 : 0);
      const double way = this->Grid.Lower[axis] + border * size - this->Origin[axis];
      const bool isParallel = this->Direction[axis] == 0.0;
      next[axis] = isParallel ? Infinity : way / this->Direction[axis];
      step[axis] = isParallel ? Infinity : size / std::abs(this->Direction[axis]);
    }
    for (double t = begin; t <= end;)
    {
      const auto axis =
        static_cast<std::size_t>(std::min_element(next.begin(), next.end()) - next.begin());
      const double leave = std::min(next[axis], end);
      if (this->PassBox(level, box, t, leave))
      {
        return true;
      }
      t = std::max(t, next[axis]);
      next[axis] += step[axis];
      box[axis] += this->Direction[axis] > 0.0 ? 1 : -1;
      if (box[axis] < first[axis] || box[axis] > last[axis])
      {
        return false;
      }
    }
    return false;
  }

  double FirstHit = Infinity;

private:
  bool PassBox(int level, const Index& box, double begin, double end)
  {
    const Level& boxes = this->Grid.Boxes[level];
    const std::size_t number = boxes.GetNumber(box);
    if (!(static_cast<double>(boxes.Low[number]) < this->Isovalue &&
          this->Isovalue <= static_cast<double>(boxes.High[number])))
    {
      return false;
    }
    if (level > 0)
    {
      Index first;
      Index last;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        first[axis] = box[axis] * Branching;
        last[axis] = std::min(first[axis] + Branching, this->Grid.Boxes[level - 1].Size[axis]) - 1;
      }
      return this->Pass(level - 1, first, last, begin, end);
    }
    for (std::uint32_t i = this->Grid.First[number]; i < this->Grid.First[number + 1]; ++i)
    {
      this->FirstHit = std::min(this->FirstHit,
        this->Grid.Cells->Intersect(
          this->Grid.Lists[i], this->Origin, this->Direction, this->Isovalue));
    }
    // A cell may be hit in another box, behind hits that are there.
    return this->FirstHit <= end;
  }

  const CellGrid& Grid;
  const Triple& Origin;
  const Triple& Direction;
  double Isovalue;
};

//------------------------------------------------------------------------------
double CellGrid::FindFirst(const Triple& origin, const Triple& direction, double isovalue) const
{
  double begin = 0.0;
  double end = Infinity;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double lower = (this->Lower[axis] - origin[axis]) / direction[axis];
    const double upper = (this->Upper[axis] - origin[axis]) / direction[axis];
    begin = std::max(begin, std::min(lower, upper));
    end = std::min(end, std::max(lower, upper));
  }
  Walk walk(*this, origin, direction, isovalue);
  if (begin <= end)
  {
    const Index& size = this->Boxes[Levels - 1].Size;
    walk.Pass(Levels - 1, { 0, 0, 0 }, { size[0] - 1, size[1] - 1, size[2] - 1 }, begin, end);
  }
  return walk.FirstHit;
}

}
