// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/MeshCloud.h"

#include "Math/Arithmetic.h"
#include "Math/Matrix.h"
#include "Math/PrefetchLines.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The largest product of a row with the points (x, y, z, 1) of a child of a node.
double FindLargest(const double (&row)[4], const CellTreeNode& node, int child)
{
  double sum = row[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double lower = row[axis] * static_cast<double>(node.Lower[axis][child]);
    const double upper = row[axis] * static_cast<double>(node.Upper[axis][child]);
    sum += std::max(lower, upper);
  }
  return sum;
}

/// Makes the largest slope of a side one, for kernels in single precision.
void ScaleSide(double (&side)[4])
{
  const double largest =
    std::max(std::max(std::abs(side[0]), std::abs(side[1])), std::abs(side[2]));
  const double scale = largest > 0.0 ? 1.0 / largest : 1.0;
  for (double& number : side)
  {
    number *= scale;
  }
}

/// The most numbers that a corner has.
constexpr int MaximumNumbers = 4 * MaximumCloudComponents;

/// Scales numbers so that the largest is about one. Returns whether any is not zero.
template <std::size_t Count>
bool Scale(double (&numbers)[Count])
{
  double largest = 0.0;
  for (const double number : numbers)
  {
    largest = std::max(largest, std::abs(number));
  }
  for (double& number : numbers)
  {
    number /= largest;
  }
  return largest > 0.0;
}

/// The direction of the gradient in a tetrahedron, of length one, given the edges from a corner and
/// the rises of the value along them; zero if there is none.
Vector3 FindGradientDirection(double (&edges)[9], double (&rises)[3])
{
  if (!Scale(edges) || !Scale(rises))
  {
    return {};
  }
  const auto edge = [&edges](int i) {
    return Vector3{ edges[3 * i], edges[3 * i + 1], edges[3 * i + 2] };
  };
  const Vector3 across[3] = { Cross(edge(1), edge(2)), Cross(edge(2), edge(0)),
    Cross(edge(0), edge(1)) };
  const Vector3 sum = across[0] * rises[0] + across[1] * rises[1] + across[2] * rises[2];
  const double volume = Dot(edge(0), across[0]);
  return volume == 0.0 ? Vector3{} : Normalized(sum) * std::copysign(1.0, volume);
}

/// Whether any of the values from low to high is shown; not if low > high.
bool AreShown(const ValueIntervals& intervals, double low, double high)
{
  return low <= high &&
    std::any_of(intervals.begin(), intervals.end(),
      [low, high](const ValueInterval& shown) { return shown.Low <= high && low <= shown.High; });
}

bool AreShown(const ValueIntervals& intervals, const std::array<double, 4>& values)
{
  return AreShown(intervals,
    std::min(std::min(values[0], values[1]), std::min(values[2], values[3])),
    std::max(std::max(values[0], values[1]), std::max(values[2], values[3])));
}

}

//------------------------------------------------------------------------------
MeshCloud::MeshCloud(
  const MeshSelection& selection, const std::vector<ValueIntervals>& shown, const Kernels& kernels)
  : Selection(selection)
  , TheKernels(kernels)
  , AreTetrahedra(selection.Tree->AreAllFinite() && !selection.Request.Visible.HiddenCells)
  , Shown(shown)
  , Components(static_cast<int>(shown.size()))
  , Gradients(selection.Request.LitComponents)
{
  if (this->Components > 1 || this->Gradients > 0)
  {
    this->Numbers = this->Components + 3 * this->Gradients;
    this->NumbersOfCorners.resize(static_cast<std::size_t>(MostLoaded * this->Numbers));
  }
  if (this->Gradients > 0)
  {
    this->GradientsOfProjected.reset(
      new double[static_cast<std::size_t>(3 * this->Gradients)][4][ProjectedTetrahedra::Capacity]);
    this->Projected.Gradient = this->GradientsOfProjected.get();
  }
}

//------------------------------------------------------------------------------
void MeshCloud::Begin(
  const Camera& view, const PixelRectangle& pixels, const CloudTile& tile, double from)
{
  this->From = from;
  this->Blocks.clear();
  this->NextBlock = 0;
  this->Loaded = 0;
  this->Projected.Count = 0;
  this->Searched = 0;
  this->Tile.Columns = tile.Columns;
  this->Tile.Rows = tile.Rows;
  this->FindCoordinates(view, pixels);
  this->FindSides();
  const CellTree& tree = *this->Selection.Tree;
  if (tree.GetNumberOfBlocks() == 0 || !this->IsSeen(tree.GetBounds()))
  {
    return;
  }
  this->FindMargin();
  this->CutRays(view, pixels, tile);
  this->FindBlocks(tree.GetNumberOfLevels() - 1, 0);
  std::sort(this->Blocks.begin(), this->Blocks.end(),
    [](const Block& a, const Block& b)
    { return a.Depth < b.Depth || (a.Depth == b.Depth && a.Number < b.Number); });
  this->FindNextCells();
}

//------------------------------------------------------------------------------
/// Labels count pixels from the middle of the tile: X is that of the clip coordinates, without the
/// part that the middle has, in pixels.
void MeshCloud::FindCoordinates(const Camera& view, const PixelRectangle& pixels)
{
  const Matrix4& clip = view.GetClipFromObject();
  const double middleX = (pixels.X + CloudTile::Middle + 0.5) * (2.0 / view.GetWidth()) - 1.0;
  const double middleY = (pixels.Y + CloudTile::Middle + 0.5) * (2.0 / view.GetHeight()) - 1.0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const double w = clip[12 + i];
    this->Tile.FromPoint[0][i] = (clip[i] - middleX * w) * (0.5 * view.GetWidth());
    this->Tile.FromPoint[1][i] = (clip[4 + i] - middleY * w) * (0.5 * view.GetHeight());
    this->Tile.FromPoint[2][i] = w;
    this->Tile.FromPoint[3][i] = clip[8 + i] + w;
  }
}

//------------------------------------------------------------------------------
/// The planes through the pixels at the edges of the tile, and the near plane.
void MeshCloud::FindSides()
{
  const auto& from = this->Tile.FromPoint;
  const double margin = 1.0; // more than rounding
  const double low = -CloudTile::Middle - margin;
  const double right = this->Tile.Columns - CloudTile::Middle + margin;
  const double top = this->Tile.Rows - CloudTile::Middle + margin;
  for (std::size_t i = 0; i < 4; ++i)
  {
    this->Sides[0][i] = from[0][i] - low * from[2][i];
    this->Sides[1][i] = right * from[2][i] - from[0][i];
    this->Sides[2][i] = from[1][i] - low * from[2][i];
    this->Sides[3][i] = top * from[2][i] - from[1][i];
    this->Sides[4][i] = from[3][i];
  }
  for (auto& side : this->Sides)
  {
    ScaleSide(side);
  }
}

//------------------------------------------------------------------------------
/// The depths of blocks and of the points in them are rounded in different ways.
void MeshCloud::FindMargin()
{
  const auto& row = this->Tile.FromPoint[3];
  const Bounds box = this->Selection.Tree->GetBounds();
  this->Margin = std::abs(row[3]);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->Margin +=
      std::abs(row[axis]) * std::max(std::abs(box.Lower[axis]), std::abs(box.Upper[axis]));
  }
  this->Margin *= 0x1p-48;
}

//------------------------------------------------------------------------------
/// Takes the rays of a tile, cut to the half-spaces.
void MeshCloud::CutRays(const Camera& view, const PixelRectangle& pixels, const CloudTile& tile)
{
  std::copy(std::begin(tile.Begin), std::end(tile.Begin), this->Tile.Begin);
  std::copy(std::begin(tile.End), std::end(tile.End), this->Tile.End);
  for (int y = 0; y < pixels.Height && !this->Selection.HalfSpaces.empty(); ++y)
  {
    for (int x = 0; x < pixels.Width; ++x)
    {
      this->CutRay(view.GetRay(pixels.X + x, pixels.Y + y, 1.0), tile, y * CloudTile::Edge + x);
    }
  }
  this->LastEnd = -Infinity;
  for (int y = 0; y < pixels.Height; ++y)
  {
    const double* row = this->Tile.End + y * CloudTile::Edge;
    this->LastEnd = std::max(this->LastEnd, *std::max_element(row, row + pixels.Width));
  }
}

//------------------------------------------------------------------------------
void MeshCloud::CutRay(const Camera::PixelRay& ray, const CloudTile& tile, int pixel)
{
  double& begin = this->Tile.Begin[pixel];
  double& end = this->Tile.End[pixel];
  for (const HalfSpace& half : this->Selection.HalfSpaces)
  {
    const PlaneCrossing crossing = FindCrossing(half, ray.Origin, ray.Direction);
    const double depth = crossing.T * tile.DepthOfT[pixel];
    begin = crossing.Slope > 0.0 ? std::max(begin, depth) : begin;
    end = crossing.Slope < 0.0 ? std::min(end, depth) : end;
    end = crossing.Slope == 0.0 && crossing.Height < 0.0 ? begin : end;
  }
}

//------------------------------------------------------------------------------
/// Whether a box may be seen by the tile.
bool MeshCloud::IsSeen(const Bounds& box) const
{
  return std::all_of(std::begin(this->Sides), std::end(this->Sides),
    [&box](const auto& side)
    {
      double sum = side[3];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        sum += std::max(side[axis] * box.Lower[axis], side[axis] * box.Upper[axis]);
      }
      return sum >= 0.0;
    });
}

//------------------------------------------------------------------------------
/// The tree has the values of the traced component alone.
bool MeshCloud::IsShown(const CellTreeNode& node, int child) const
{
  const auto low = static_cast<double>(node.Low[child]);
  const auto high = static_cast<double>(node.High[child]);
  return this->Components > 1 ? low <= high : AreShown(this->Shown.front(), low, high);
}

//------------------------------------------------------------------------------
/// Whether a tetrahedron that is loaded shows anything of any component.
bool MeshCloud::IsShown(int tetrahedron)
{
  if (!this->HasNumbers())
  {
    const auto& corners = this->Corners[tetrahedron];
    return AreShown(
      this->Shown.front(), { corners[0][3], corners[1][3], corners[2][3], corners[3][3] });
  }
  const std::array<double, 4>* values = this->GetNumbers(tetrahedron);
  return std::any_of(this->Shown.begin(), this->Shown.end(),
    [&values](const ValueIntervals& shown) { return AreShown(shown, *values++); });
}

//------------------------------------------------------------------------------
/// Moves some of the tetrahedra that are loaded to earlier places.
void MeshCloud::Move(int from, int to, int count)
{
  std::copy_n(&this->Corners[from][0][0], 16 * count, &this->Corners[to][0][0]);
  if (this->HasNumbers())
  {
    std::copy_n(this->GetNumbers(from), this->Numbers * count, this->GetNumbers(to));
  }
}

//------------------------------------------------------------------------------
/// Keeps those tetrahedra of the last that are loaded which show anything. Returns how many.
int MeshCloud::KeepShown(int count)
{
  int kept = 0;
  for (int i = 0; i < count; ++i)
  {
    const int from = this->Loaded + i;
    const int to = this->Loaded + kept;
    if (!this->IsShown(from))
    {
      continue;
    }
    if (kept < i)
    {
      this->Move(from, to, 1);
    }
    ++kept;
  }
  return kept;
}

//------------------------------------------------------------------------------
/// Finds the blocks below a node that the tile may see.
void MeshCloud::FindBlocks(int level, std::size_t node)
{
  const CellTree& tree = *this->Selection.Tree;
  const CellTreeNode& parent = tree.GetNode(level, node);
  unsigned int met =
    this->TheKernels.FindMetChildren(parent, this->Sides, static_cast<int>(std::size(this->Sides)));
  for (; met != 0; met &= met - 1)
  {
    const int child = LowestBit(met);
    if (!this->IsShown(parent, child))
    {
      continue;
    }
    const std::size_t number = node * CellTree::Width + static_cast<std::size_t>(child);
    if (level > 0)
    {
      this->FindBlocks(level - 1, number);
      continue;
    }
    const auto& row = this->Tile.FromPoint[3];
    const double opposite[4] = { -row[0], -row[1], -row[2], -row[3] };
    const double depth = -FindLargest(opposite, parent, child) - this->Margin;
    if (this->From <= depth && depth <= this->LastEnd)
    {
      this->Blocks.push_back({ depth, number });
    }
  }
}

//------------------------------------------------------------------------------
double MeshCloud::GetNextDepth() const
{
  if (this->Searched < this->Projected.Count)
  {
    return this->DepthOfProjected;
  }
  if (this->Loaded > 0)
  {
    return this->DepthOfLast;
  }
  return this->NextBlock < this->Blocks.size() ? this->Blocks[this->NextBlock].Depth : Infinity;
}

//------------------------------------------------------------------------------
bool MeshCloud::IsPaused() const
{
  return this->Searched == this->Projected.Count && this->Loaded == 0 && this->MayPause();
}

//------------------------------------------------------------------------------
/// Whether the next block begins behind all that have been loaded.
bool MeshCloud::MayPause() const
{
  return this->NextBlock == 0 || this->NextBlock == this->Blocks.size() ||
    this->Blocks[this->NextBlock - 1].Depth < this->Blocks[this->NextBlock].Depth;
}

//------------------------------------------------------------------------------
void MeshCloud::FindMore(
  const std::uint32_t (&open)[CloudTile::Edge], bool pauses, CloudSegments& segments)
{
  std::copy(std::begin(open), std::end(open), this->Tile.Open);
  while (segments.Count < segments.Enough)
  {
    if (this->Searched == this->Projected.Count)
    {
      // Those that are loaded must be finished to pause.
      const int most =
        std::clamp(segments.Enough / 32, CellTree::Width, ProjectedTetrahedra::Capacity);
      this->LoadCells(most, pauses);
      if (this->Projected.Count == 0)
      {
        return;
      }
    }
    const auto findSegments = this->TheKernels.FindSegments[this->Components - 1][this->Gradients];
    this->Searched = findSegments(this->Tile, this->Projected, this->Searched, segments);
  }
}

//------------------------------------------------------------------------------
/// Loads cells of the next blocks, until there are so many tetrahedra or it may pause, and projects
/// them.
void MeshCloud::LoadCells(int most, bool pauses)
{
  this->DepthOfProjected = this->GetNextDepth();
  while (
    this->Loaded < most && this->NextBlock < this->Blocks.size() && !(pauses && this->MayPause()))
  {
    std::uint32_t cells[CellTree::Width];
    const int count = this->NextCount;
    std::copy_n(this->NextCells, count, cells);
    this->DepthOfLast = this->Blocks[this->NextBlock++].Depth;
    this->FindNextCells();
    this->Loaded += this->KeepShown(this->LoadTetrahedra(cells, count));
  }
  const int count = std::min(this->Loaded, ProjectedTetrahedra::Capacity);
  this->TheKernels.ProjectTetrahedra(this->Tile, this->Corners, count, this->Projected);
  this->Searched = 0;
  this->Loaded -= count;
  if (this->HasNumbers())
  {
    this->SetNumbers();
  }
  if (this->Loaded > 0)
  {
    this->Move(count, 0, this->Loaded);
  }
}

//------------------------------------------------------------------------------
/// Gives the projected tetrahedra, whose corners are in order, their values and gradients.
void MeshCloud::SetNumbers()
{
  for (int i = 0; i < this->Projected.Count; ++i)
  {
    const std::array<double, 4>* numbers = this->GetNumbers(i);
    for (std::size_t corner = 0; corner < 4; ++corner)
    {
      for (int k = 0; k < this->Components; ++k)
      {
        this->Projected.Value[k][corner][i] =
          std::clamp(numbers[k][corner], -LargestCloudValue, LargestCloudValue);
      }
      for (int k = this->Components; k < this->Numbers; ++k)
      {
        this->GradientsOfProjected[k - this->Components][corner][i] = numbers[k][corner];
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Finds the cells of the next block that the tile may see, and begins to fetch what is read of
/// them and of blocks after that.
void MeshCloud::FindNextCells()
{
  constexpr std::size_t ahead = 4;
  if (this->NextBlock + ahead < this->Blocks.size())
  {
    const std::size_t later = this->Blocks[this->NextBlock + ahead].Number;
    PrefetchLines(&this->Selection.Boxes->Get(later), sizeof(BlockOfBoxes));
  }
  this->NextCount = 0;
  if (this->NextBlock == this->Blocks.size())
  {
    return;
  }
  const CellTree& tree = *this->Selection.Tree;
  const std::size_t block = this->Blocks[this->NextBlock].Number;
  const unsigned int met = this->TheKernels.FindMetCells(tree.GetNode(0, block / CellTree::Width),
    static_cast<int>(block % CellTree::Width), this->Selection.Boxes->Get(block), this->Sides,
    static_cast<int>(std::size(this->Sides)));
  for (unsigned int left = met & ((1U << tree.GetNumberOfCells(block)) - 1U); left != 0;
       left &= left - 1)
  {
    const std::uint32_t cell = tree.GetCell(block, LowestBit(left));
    this->Selection.Cells->Prefetch(cell);
    this->NextCells[this->NextCount++] = cell;
  }
}

//------------------------------------------------------------------------------
/// Loads the tetrahedra of some cells behind those that are loaded. Returns how many there are.
int MeshCloud::LoadTetrahedra(const std::uint32_t* numbers, int count)
{
  const MeshCells& cells = *this->Selection.Cells;
  const bool areTetrahedra = count > 0 && this->AreTetrahedra && !this->HasNumbers() &&
    std::all_of(numbers, numbers + count,
      [&](std::uint32_t number) { return cells.GetShape(number) == CellShape::Tetrahedron; });
  if (areTetrahedra)
  {
    cells.LoadTetrahedra(numbers, count, this->Corners + this->Loaded);
    return count;
  }
  int added = 0;
  for (int i = 0; i < count; ++i)
  {
    if (!this->Selection.Request.Visible.IsHidden(numbers[i]))
    {
      added += this->LoadCell(numbers[i], this->Loaded + added);
    }
  }
  return added;
}

//------------------------------------------------------------------------------
/// Loads the tetrahedra of a cell, from a place on. Returns how many there are.
int MeshCloud::LoadCell(std::uint32_t number, int place)
{
  MeshCell cell;
  if (!this->Selection.Cells->Load(number, cell))
  {
    return 0;
  }
  if (!this->HasNumbers())
  {
    return SubdivideCell(cell, this->Corners + place);
  }
  double numbers[MaximumNumbers][MaximumCorners];
  this->LoadNumbers(cell, numbers);
  for (int i = 0; i < this->Components; ++i)
  {
    if (!std::all_of(
          numbers[i], numbers[i] + cell.Count, [](double value) { return std::isfinite(value); }))
    {
      return 0;
    }
  }
  const int count =
    SubdivideCell(cell, numbers, this->Numbers, this->Corners + place, this->GetNumbers(place));
  for (int i = 0; i < count && this->Selection.GradientsOfCloud.empty(); ++i)
  {
    this->FindGradients(place + i);
  }
  return count;
}

//------------------------------------------------------------------------------
/// Loads the values at the corners of a cell, and the gradients there, or zeros if they are those
/// of its tetrahedra.
void MeshCloud::LoadNumbers(const MeshCell& cell, double (*numbers)[MaximumCorners]) const
{
  if (this->Components > 1)
  {
    this->Selection.Cells->LoadComponents(cell, numbers);
  }
  else
  {
    std::copy_n(cell.Values, cell.Count, numbers[0]);
  }
  std::fill_n(numbers[this->Components], 3 * this->Gradients * MaximumCorners, 0.0);
  double(*coordinates)[MaximumCorners] = numbers + this->Components;
  for (const PointGradients* gradients : this->Selection.GradientsOfCloud)
  {
    for (int corner = 0; corner < cell.Count; ++corner)
    {
      const std::array<float, 3>& gradient = gradients->Get(cell.Ids[corner]);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        coordinates[axis][corner] = static_cast<double>(gradient[axis]);
      }
    }
    coordinates += 3;
  }
}

//------------------------------------------------------------------------------
/// Finds the gradients in a tetrahedron that is loaded, up to their lengths.
void MeshCloud::FindGradients(int tetrahedron)
{
  std::array<double, 4>* numbers = this->GetNumbers(tetrahedron);
  const auto& corners = this->Corners[tetrahedron];
  for (int i = 0; i < this->Gradients; ++i)
  {
    const std::array<double, 4>& values = numbers[this->Components - this->Gradients + i];
    double edges[9];
    double rises[3];
    for (std::size_t k = 0; k < 3; ++k)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        edges[3 * k + axis] = corners[k + 1][axis] - corners[0][axis];
      }
      rises[k] = values[k + 1] - values[0];
    }
    const Vector3 gradient = FindGradientDirection(edges, rises);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      numbers[this->Components + 3 * i + static_cast<int>(axis)].fill(gradient[axis]);
    }
  }
}

}
