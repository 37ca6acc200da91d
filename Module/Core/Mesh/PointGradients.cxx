// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/PointGradients.h"

#include "Field/FirstException.h"
#include "Kernels/InstructionSets.h"
#include "Kernels/Kernels.h"
#include "Math/Arithmetic.h"
#include "Math/Compiler.h"
#include "Math/ThreadsOfLoop.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Returns false if the cell is flat there.
bool FindGradientAtCorner(const MeshCell& cell, int corner, Vector3& gradient)
{
  CornerWeights weights = {};
  weights[corner] = 1.0;
  return FindGradient(cell, GetParametric(cell.Shape, weights), gradient);
}

}

//------------------------------------------------------------------------------
struct PointGradients::WeightedSum
{
  /// The gradient, and the weight.
  double Numbers[4] = {};

  void Add(const double (&numbers)[4])
  {
    for (int i = 0; i < 4; ++i)
    {
      this->Numbers[i] += numbers[i];
    }
  }
};

//------------------------------------------------------------------------------
/// Adds cells to the sums of those of their corners that are wanted and in a range, one after the
/// other.
class PointGradients::SumOfCells
{
public:
  SumOfCells(const PointGradients& gradients, const PointRange& range)
    : All(&gradients)
    , Range(range)
    , Places(new std::uint32_t[static_cast<std::size_t>(range.Last - range.First)])
  {
    std::uint32_t count = 0;
    for (std::int64_t id = range.First; id < range.Last; ++id)
    {
      if (gradients.IsWanted(id))
      {
        this->Places[static_cast<std::size_t>(id - range.First)] = count++;
      }
    }
    this->Sums.resize(count);
  }

  /// That of a point that is wanted.
  WeightedSum& Get(std::int64_t id)
  {
    return this->Sums[this->Places[static_cast<std::size_t>(id - this->Range.First)]];
  }

  void Add(const CellsAround& around)
  {
    const std::vector<std::uint32_t>& numbers = around.Cells;
    const bool areAllIn =
      this->Range.First <= around.Points.First && around.Points.Last <= this->Range.Last;
    for (std::size_t first = 0; first < numbers.size();)
    {
      const std::size_t later = std::min(first + 2 * Capacity, numbers.size());
      std::for_each(numbers.data() + later,
        numbers.data() + std::min(later + Capacity, numbers.size()),
        [this](std::uint32_t number) { this->All->Cells->Prefetch(number); });
      const int count = this->GetRun(numbers, first);
      this->AddRun(&numbers[first], count, areAllIn);
      first += static_cast<std::size_t>(count);
    }
  }

  /// Adds those that wait to be added together.
  void AddWaiting()
  {
    this->Add(this->Tetrahedra);
    this->Add(this->Hexahedra);
  }

private:
  static constexpr int Capacity = WeightedGradients::Capacity;
  static_assert(Capacity == CornerGradients::Capacity);

  /// How many of the cells from the first on have its shape, and are looked at together.
  int GetRun(const std::vector<std::uint32_t>& numbers, std::size_t first) const
  {
    const int most = static_cast<int>(std::min<std::size_t>(numbers.size() - first, Capacity));
    const MeshCells& cells = *this->All->Cells;
    int count = 1;
    while (count < most &&
      cells.GetShape(numbers[first + static_cast<std::size_t>(count)]) ==
        cells.GetShape(numbers[first]))
    {
      ++count;
    }
    return count;
  }

  /// Adds cells of one shape. Those of others that wait come before them.
  void AddRun(const std::uint32_t* numbers, int count, bool areAllIn)
  {
    switch (this->All->Cells->GetShape(numbers[0]))
    {
      case CellShape::Tetrahedron:
      {
        std::int64_t ids[Capacity][4];
        this->All->Cells->LoadIdsOfTetrahedra(numbers, count, ids);
        this->Add(this->Hexahedra);
        this->Wait(numbers, ids, count, areAllIn, this->Tetrahedra);
        return;
      }
      case CellShape::Hexahedron:
      case CellShape::Voxel:
      {
        std::int64_t ids[Capacity][8];
        this->All->Cells->LoadTrilinearIds(numbers, count, ids);
        this->Add(this->Tetrahedra);
        this->Wait(numbers, ids, count, areAllIn, this->Hexahedra);
        return;
      }
      case CellShape::Wedge:
      case CellShape::Pyramid:
        this->AddWaiting();
        std::for_each_n(numbers, count, [this](std::uint32_t number) { this->AddOther(number); });
        return;
    }
  }

  bool Has(std::int64_t id) const { return this->Range.Has(id) && this->All->IsWanted(id); }

  bool HasCorner(const std::int64_t* ids, int count) const
  {
    return std::any_of(ids, ids + count, [this](std::int64_t id) { return this->Has(id); });
  }

  /// Cells of one shape that wait to be added together: their corners, those of hexahedra as of
  /// trilinear cells.
  template <int Corners>
  struct WaitingCells
  {
    int Count = 0;
    std::uint32_t Numbers[Capacity];
    std::int64_t Ids[Capacity][Corners];
  };

  /// Lets those wait that have corners here, and adds them when there are enough.
  template <int Corners>
  void Wait(const std::uint32_t* numbers, const std::int64_t (*ids)[Corners], int count,
    bool areAllIn, WaitingCells<Corners>& waiting)
  {
    for (int i = 0; i < count; ++i)
    {
      if (areAllIn || this->HasCorner(ids[i], Corners))
      {
        waiting.Numbers[waiting.Count] = numbers[i];
        std::copy_n(ids[i], Corners, waiting.Ids[waiting.Count++]);
        if (waiting.Count == Capacity)
        {
          this->Add(waiting);
        }
      }
    }
  }

  /// Adds tetrahedra that wait...
  void Add(WaitingCells<4>& waiting)
  {
    if (waiting.Count == 0)
    {
      return;
    }
    double corners[Capacity][4][4];
    this->All->Cells->LoadTetrahedra(waiting.Ids, waiting.Count, corners);
    WeightedGradients found;
    this->Kernel->WeightGradients(corners, waiting.Count, found);
    // The weight of the other shapes is about their volume.
    constexpr double part = 1.0 / 8.0;
    for (int i = 0; i < waiting.Count; ++i)
    {
      const double numbers[4] = { part * found.Gradient[0][i], part * found.Gradient[1][i],
        part * found.Gradient[2][i], part * found.Weight[i] };
      if (!(numbers[3] < Infinity))
      {
        continue;
      }
      for (const std::int64_t id : waiting.Ids[i])
      {
        if (this->Has(id))
        {
          this->Get(id).Add(numbers);
        }
      }
    }
    waiting.Count = 0;
  }

  /// ...or hexahedra.
  void Add(WaitingCells<8>& waiting)
  {
    if (waiting.Count == 0)
    {
      return;
    }
    double corners[Capacity][8][4];
    this->All->Cells->LoadTrilinear(waiting.Ids, waiting.Count, corners);
    CornerGradients found;
    this->Kernel->FindCornerGradients(corners, waiting.Count, found);
    for (int i = 0; i < waiting.Count; ++i)
    {
      const std::uint32_t number = waiting.Numbers[i];
      const ShapeTraits& traits = GetTraits(this->All->Cells->GetShape(number));
      const double volume = found.Volume[i];
      for (int corner = 0; corner < 8 && volume < Infinity; ++corner)
      {
        const std::int64_t id = waiting.Ids[i][corner];
        const double(&gradient)[3][Capacity] = found.Gradient[corner];
        if (this->Has(id))
        {
          this->AddCorner(number, traits.Trilinear[corner], id,
            { gradient[0][i], gradient[1][i], gradient[2][i] }, volume);
        }
      }
    }
    waiting.Count = 0;
  }

  void AddOther(std::uint32_t number)
  {
    MeshCell cell;
    if (!this->All->Cells->LoadIds(number, cell) || !this->HasCorner(cell.Ids, cell.Count) ||
      !this->All->Cells->LoadCorners(cell))
    {
      return;
    }
    int wanted[MaximumCorners];
    int count = 0;
    for (int corner = 0; corner < cell.Count; ++corner)
    {
      if (this->Has(cell.Ids[corner]))
      {
        wanted[count++] = corner;
      }
    }
    const double volume = GetVolume(cell);
    const WeightedGradients found = this->FindAtCorners(cell, wanted, count);
    for (int i = 0; i < count; ++i)
    {
      const Vector3 product = { found.Gradient[0][i], found.Gradient[1][i], found.Gradient[2][i] };
      this->AddCorner(
        number, wanted[i], cell.Ids[wanted[i]], product * (volume / found.Weight[i]), volume);
    }
  }

  /// At a corner with three edges the gradient is that in the tetrahedron between their ends. Of
  /// the apex of a pyramid that is flat: it has no gradient.
  WeightedGradients FindAtCorners(const MeshCell& cell, const int* wanted, int count) const
  {
    double numbers[MaximumCorners][4];
    for (int i = 0; i < cell.Count; ++i)
    {
      std::copy_n(cell.Points[i].begin(), 3, numbers[i]);
      numbers[i][3] = cell.Values[i];
    }
    double corners[MaximumCorners][4][4];
    const ShapeTraits& traits = GetTraits(cell.Shape);
    for (int i = 0; i < count; ++i)
    {
      const int* neighbors = traits.Neighbors[wanted[i]];
      std::copy_n(numbers[wanted[i]], 4, corners[i][0]);
      for (int k = 0; k < 3; ++k)
      {
        std::copy_n(numbers[neighbors[k]], 4, corners[i][k + 1]);
      }
    }
    WeightedGradients found;
    this->Kernel->WeightGradients(corners, count, found);
    return found;
  }

  /// Adds the gradient at a corner of a cell, times the volume; given the id of the corner. Where
  /// the cell is flat it has none.
  void AddCorner(
    std::uint32_t number, int corner, std::int64_t id, const Vector3& gradient, double volume)
  {
    Vector3 sum = gradient;
    if (!std::isfinite(sum[0] + sum[1] + sum[2]))
    {
      MeshCell cell;
      this->All->Cells->Load(number, cell);
      Vector3 slow;
      if (!FindGradientAtCorner(cell, corner, slow))
      {
        return;
      }
      sum = slow * volume;
    }
    this->Get(id).Add({ sum[0], sum[1], sum[2], volume });
  }

  const PointGradients* All;
  PointRange Range;
  /// Of the points of the range that are wanted: only there it is set.
  std::unique_ptr<std::uint32_t[]> Places;
  std::vector<WeightedSum> Sums;
  const Kernels* Kernel = &GetBestKernels();
  WaitingCells<4> Tetrahedra;
  WaitingCells<8> Hexahedra;
};

//------------------------------------------------------------------------------
PointGradients::PointGradients(const MeshCells& cells, const CellTree& tree, double unit)
  : Cells(&cells)
  , Tree(&tree)
  , Unit(unit)
  , NumberOfPoints(static_cast<std::size_t>(cells.GetNumberOfPoints()))
  , States(this->NumberOfPoints)
  , Gradients(new std::array<float, 3>[this->NumberOfPoints])
{
}

//------------------------------------------------------------------------------
bool PointGradients::Find(const std::vector<double>& isovalues, int threads)
{
  const auto isKnown = [this](double isovalue)
  {
    return std::find(this->Isovalues.begin(), this->Isovalues.end(), isovalue) !=
      this->Isovalues.end();
  };
  if (this->AreAllFound || std::all_of(isovalues.begin(), isovalues.end(), isKnown))
  {
    return true;
  }
  if (!this->Isovalues.empty())
  {
    return this->FindAll(threads);
  }
  this->Isovalues = isovalues;
  ValueRange range = { Infinity, -Infinity };
  for (const double isovalue : isovalues)
  {
    const ValueRange marked = this->MarkCorners(isovalue, threads);
    range = { std::min(range.Low, marked.Low), std::max(range.High, marked.High) };
  }
  this->FindMeans(this->FindCellsAround(range, threads), threads);
  return false;
}

//------------------------------------------------------------------------------
bool PointGradients::FindAll(int threads)
{
  if (this->AreAllFound)
  {
    return true;
  }
  this->AreAllFound = true;
  this->FindMeans(this->FindCellsAround(this->MarkAll(threads), threads), threads);
  return false;
}

//------------------------------------------------------------------------------
PointGradients::ValueRange PointGradients::MarkAll(int threads)
{
#pragma omp parallel for schedule(static)                                                          \
  num_threads(GetThreadsOfLoop(this->NumberOfPoints, 1.0, threads))
  for (std::int64_t id = 0; id < static_cast<std::int64_t>(this->NumberOfPoints); ++id)
  {
    std::atomic<State>& state = this->States[static_cast<std::size_t>(id)];
    if (state.load(std::memory_order_relaxed) == State::NotNeeded)
    {
      state.store(State::Wanted, std::memory_order_relaxed);
    }
  }
  return { -Infinity, Infinity };
}

//------------------------------------------------------------------------------
/// Marks the corners of the cells with an isovalue as wanted, and returns the range of their
/// values.
PointGradients::ValueRange PointGradients::MarkCorners(double isovalue, int threads)
{
  constexpr std::size_t ahead = 2;
  double low = Infinity;
  double high = -Infinity;
  const std::vector<std::uint32_t> blocks = this->Tree->FindBlocks(isovalue, isovalue, threads);
  const int worth = GetThreadsOfLoop(blocks.size(), 300.0, threads);
#pragma omp parallel for schedule(static) num_threads(worth) reduction(min                         \
                                                                       : low) reduction(max        \
                                                                                        : high)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(blocks.size()); ++i)
  {
    const auto number = static_cast<std::size_t>(i);
    this->Tree->PrefetchCells(*this->Cells, blocks[std::min(number + ahead, blocks.size() - 1)]);
    std::uint32_t numbers[CellTree::Width];
    const int count = this->Tree->GetCells(blocks[number], numbers);
    for (unsigned int active = this->Cells->FindStraddling(numbers, count, isovalue); active != 0;
         active &= active - 1)
    {
      MeshCell cell;
      this->Cells->LoadIds(numbers[LowestBit(active)], cell);
      if (this->Tree->AreAllFinite())
      {
        this->Cells->LoadValues(cell);
      }
      else if (!this->Cells->LoadCorners(cell))
      {
        continue;
      }
      for (int corner = 0; corner < cell.Count; ++corner)
      {
        this->States[static_cast<std::size_t>(cell.Ids[corner])].store(
          State::Wanted, std::memory_order_relaxed);
        low = std::min(low, cell.Values[corner]);
        high = std::max(high, cell.Values[corner]);
      }
    }
  }
  return { low, high };
}

//------------------------------------------------------------------------------
/// The cells with a corner that is wanted. Its value is in the range.
std::vector<PointGradients::CellsAround> PointGradients::FindCellsAround(
  const ValueRange& range, int threads) const
{
  constexpr std::size_t blocksOfPart = 256;
  constexpr std::size_t ahead = 2;
  const std::vector<std::uint32_t> blocks = this->Tree->FindBlocks(range.Low, range.High, threads);
  std::vector<CellsAround> around((blocks.size() + blocksOfPart - 1) / blocksOfPart);
  FirstException exception;
#pragma omp parallel for schedule(dynamic)                                                         \
  num_threads(GetThreadsOfLoop(blocks.size(), 200.0, threads))
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(around.size()); ++i)
  {
    exception.Guard(
      [&]()
      {
        const auto part = static_cast<std::size_t>(i);
        around[part].Points = { std::numeric_limits<std::int64_t>::max(), 0 };
        const std::size_t last = std::min((part + 1) * blocksOfPart, blocks.size());
        for (std::size_t block = part * blocksOfPart; block < last; ++block)
        {
          this->Tree->PrefetchCells(*this->Cells, blocks[std::min(block + ahead, last - 1)]);
          this->AddCells(blocks[block], around[part]);
        }
      });
  }
  exception.Rethrow();
  return around;
}

//------------------------------------------------------------------------------
/// Adds the cells of a block that have a corner that is wanted.
void PointGradients::AddCells(std::uint32_t block, CellsAround& around) const
{
  std::uint32_t numbers[CellTree::Width] = {};
  const int count = this->Tree->GetCells(block, numbers);
  if (this->Cells->AreTetrahedra())
  {
    std::int64_t ids[CellTree::Width][4];
    this->Cells->LoadIdsOfTetrahedra(numbers, count, ids);
    this->AddIfWanted(numbers, ids, count, around);
    return;
  }
  // Those that are not traced may have any ids.
  const std::uint32_t* end = std::remove_if(numbers, numbers + count,
    [this](std::uint32_t number) { return GetTraits(this->Cells->GetShape(number)).Corners == 0; });
  const int traced = static_cast<int>(end - numbers);
  std::int64_t ids[CellTree::Width][8];
  this->Cells->LoadTrilinearIds(numbers, traced, ids);
  this->AddIfWanted(numbers, ids, traced, around);
}

//------------------------------------------------------------------------------
/// Adds those of some cells that have a corner that is wanted, given their ids.
template <int Corners>
void PointGradients::AddIfWanted(const std::uint32_t* numbers, const std::int64_t (*ids)[Corners],
  int count, CellsAround& around) const
{
  for (int i = 0; i < count; ++i)
  {
    bool hasWanted = false;
    PointRange points = around.Points;
    for (const std::int64_t id : ids[i])
    {
      hasWanted = hasWanted || this->IsWanted(id);
      points = { std::min(points.First, id), std::max(points.Last, id + 1) };
    }
    if (hasWanted)
    {
      around.Points = points;
      around.Cells.push_back(numbers[i]);
    }
  }
}

//------------------------------------------------------------------------------
/// Finds what is wanted, given the cells around.
void PointGradients::FindMeans(const std::vector<CellsAround>& around, int threads)
{
  const auto points = static_cast<std::int64_t>(this->NumberOfPoints);
  // Each thread sums at points of its own, and asks for the states of these alone: the order is
  // always the same.
  FirstException exception;
  const int parts = GetThreadsOfLoop(this->NumberOfPoints, 20.0, threads);
#pragma omp parallel for schedule(static) num_threads(parts)
  for (int part = 0; part < parts; ++part)
  {
    exception.Guard(
      [&]() {
        this->FindMeans(around, { points * part / parts, points * (part + 1) / parts });
      });
  }
  exception.Rethrow();
}

//------------------------------------------------------------------------------
void PointGradients::FindMeans(const std::vector<CellsAround>& around, const PointRange& range)
{
  SumOfCells sum(*this, range);
  for (const CellsAround& part : around)
  {
    if (part.Points.First < range.Last && range.First < part.Points.Last)
    {
      sum.Add(part);
    }
  }
  sum.AddWaiting();
  for (std::int64_t id = range.First; id < range.Last; ++id)
  {
    if (this->IsWanted(id))
    {
      this->SetMean(static_cast<std::size_t>(id), sum.Get(id));
    }
  }
}

//------------------------------------------------------------------------------
void PointGradients::SetMean(std::size_t point, const WeightedSum& sum)
{
  constexpr double largest = 1e30;
  const double* numbers = sum.Numbers;
  const Vector3 mean = Vector3{ numbers[0], numbers[1], numbers[2] } * (this->Unit / numbers[3]);
  const bool isFinite = std::abs(mean[0]) + std::abs(mean[1]) + std::abs(mean[2]) < largest;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Of zeros the gradient of the cell is taken instead.
    this->Gradients[point][axis] = isFinite ? static_cast<float>(mean[axis]) : 0.0F;
  }
  this->States[point].store(State::Found, std::memory_order_relaxed);
}

//------------------------------------------------------------------------------
Vector3 PointGradients::Get(const MeshCell& cell, const CornerWeights& weights) const
{
  Vector3 gradient = {};
  for (int i = 0; i < cell.Count; ++i)
  {
    const std::array<float, 3>& corner = this->Gradients[static_cast<std::size_t>(cell.Ids[i])];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      gradient[axis] += weights[i] * static_cast<double>(corner[axis]);
    }
  }
  return gradient * (1.0 / this->Unit);
}

//------------------------------------------------------------------------------
void PointGradients::Interpolate(
  const WeightedCorners& corners, int first, double (*gradients)[RayPacket::Capacity]) const
{
  GetBestKernels().SumAtCorners(this->Gradients.get(), true, corners, first, gradients);
  const double factor = 1.0 / this->Unit;
  for (int axis = 0; axis < 3; ++axis)
  {
    double* numbers = gradients[axis] + first;
    std::transform(
      numbers, numbers + corners.Count, numbers, [factor](double sum) { return sum * factor; });
  }
}

//------------------------------------------------------------------------------
std::size_t PointGradients::GetMemory() const
{
  return this->NumberOfPoints * (sizeof(this->States[0]) + sizeof(this->Gradients[0]));
}

}
