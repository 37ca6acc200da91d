// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PointGradients_h
#define PointGradients_h

#include "Kernels/MeshCellArrays.h"
#include "Math/Compiler.h"
#include "Mesh/CellTree.h"
#include "Mesh/MeshCells.h"
#include "Mesh/ShapeFunctions.h"
#include "Rays/RayPacket.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Gradients at the points of a mesh, for normals that are smooth across cells: each is the mean of
/// those of the cells around the point, weighted by their volumes. For the first isovalues they are
/// found where the surfaces are, at the corners of the cells that these pass: a small part of the
/// mesh. For others, since further ones are likely to follow, all are found.
class PointGradients
{
public:
  /// Cells and tree must outlive it. Gradients are multiplied by the unit, to have a size that a
  /// float holds.
  PointGradients(const MeshCells& cells, const CellTree& tree, double unit);

  /// Finds those at the corners of the cells with some isovalues, where they are not yet known.
  /// They are the same for any number of threads, and whatever was found before. If it throws,
  /// nothing is known any more. Returns whether all were known before.
  bool Find(const std::vector<double>& isovalues, int threads);

  /// The same for all points.
  bool FindAll(int threads);

  /// That of a point, times the unit; zero where there is none.
  const std::array<float, 3>& Get(std::int64_t point) const
  {
    return this->Gradients[static_cast<std::size_t>(point)];
  }

  /// The gradient at a point of a cell with one of these isovalues, by the weights of its corners.
  Vector3 Get(const MeshCell& cell, const CornerWeights& weights) const;

  /// The same at hits, stored from a number on.
  void Interpolate(
    const WeightedCorners& corners, int first, double (*gradients)[RayPacket::Capacity]) const;

  /// Begins to fetch those of some points.
  void Prefetch(const std::int64_t* points, int count) const
  {
    for (int i = 0; i < count; ++i)
    {
      PrefetchLine(&this->Get(points[i]));
    }
  }

  std::size_t GetMemory() const;

private:
  enum class State : unsigned char
  {
    NotNeeded,
    Wanted,
    Found
  };

  struct ValueRange
  {
    double Low;
    double High;
  };

  /// Points with consecutive ids.
  struct PointRange
  {
    std::int64_t First;
    std::int64_t Last;

    bool Has(std::int64_t id) const { return id >= this->First && id < this->Last; }
  };

  /// Cells with corners that are wanted, and the range all their corners are in.
  struct CellsAround
  {
    std::vector<std::uint32_t> Cells;
    PointRange Points;
  };

  /// A sum of gradients, each times the weight of its cell, and the sum of the weights.
  struct WeightedSum;
  class SumOfCells;

  ValueRange MarkCorners(double isovalue, int threads);
  ValueRange MarkAll(int threads);
  std::vector<CellsAround> FindCellsAround(const ValueRange& range, int threads) const;
  void AddCells(std::uint32_t block, CellsAround& around) const;
  template <int Corners>
  void AddIfWanted(const std::uint32_t* numbers, const std::int64_t (*ids)[Corners], int count,
    CellsAround& around) const;
  void FindMeans(const std::vector<CellsAround>& around, int threads);
  void FindMeans(const std::vector<CellsAround>& around, const PointRange& range);
  void SetMean(std::size_t point, const WeightedSum& sum);
  bool IsWanted(std::int64_t point) const
  {
    return this->States[static_cast<std::size_t>(point)].load(std::memory_order_relaxed) ==
      State::Wanted;
  }

  const MeshCells* Cells;
  const CellTree* Tree;
  double Unit;
  std::size_t NumberOfPoints;
  /// Those that gradients were found for, until all gradients are.
  std::vector<double> Isovalues;
  bool AreAllFound = false;
  std::vector<std::atomic<State>> States;
  /// Set where they were found.
  std::unique_ptr<std::array<float, 3>[]> Gradients;
};

}

#endif
