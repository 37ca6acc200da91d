// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/MeshCells.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{
namespace
{

template <typename Id>
bool ReadListedIds(const MeshView& view, std::int64_t number, MeshCell& cell)
{
  cell.Shape = static_cast<CellShape>(view.Shapes[number]);
  cell.Count = GetTraits(cell.Shape).Corners;
  if (cell.Count == 0)
  {
    return false; // Its offset may be anything.
  }
  const Id* ids =
    static_cast<const Id*>(view.Connectivity) + static_cast<const Id*>(view.Offsets)[number];
  for (int i = 0; i < cell.Count; ++i)
  {
    cell.Ids[i] = ids[i];
  }
  return true;
}

template <typename Coordinate>
void ReadTypedPoints(const MeshView& view, MeshCell& cell)
{
  for (int i = 0; i < cell.Count; ++i)
  {
    const Coordinate* point = static_cast<const Coordinate*>(view.Points) + 3 * cell.Ids[i];
    cell.Points[i] = { static_cast<double>(point[0]), static_cast<double>(point[1]),
      static_cast<double>(point[2]) };
  }
}

template <typename Value>
void ReadTypedValues(const MeshView& view, MeshCell& cell)
{
  for (int i = 0; i < cell.Count; ++i)
  {
    cell.Values[i] =
      static_cast<double>(static_cast<const Value*>(view.Values)[cell.Ids[i] * view.ValueStride]);
  }
}

constexpr int Capacity = PassedCellRecords::Capacity;

template <typename Id>
void ReadListedTetrahedra(const MeshView& view, const std::uint32_t* numbers, int count,
  CornerOrder* orders, std::int64_t (&ids)[PassedCellRecords::Corners][Capacity])
{
  for (int i = 0; i < count; ++i)
  {
    const Id* listed =
      static_cast<const Id*>(view.Connectivity) + static_cast<const Id*>(view.Offsets)[numbers[i]];
    orders[i] = CornerOrder(listed);
    for (std::size_t corner = 0; corner < 4; ++corner)
    {
      ids[corner][i] = listed[orders[i].Corners[corner]];
    }
  }
}

template <typename Coordinate>
void ReadTypedRecordPoints(const MeshView& view,
  const std::int64_t (&ids)[PassedCellRecords::Corners][Capacity], int corners, int count,
  PassedCellRecords& records)
{
  for (int i = 0; i < count; ++i)
  {
    for (int corner = 0; corner < corners; ++corner)
    {
      const Coordinate* point = static_cast<const Coordinate*>(view.Points) + 3 * ids[corner][i];
      double* numbers = records.Corner[i][corner];
      numbers[0] = static_cast<double>(point[0]);
      numbers[1] = static_cast<double>(point[1]);
      numbers[2] = static_cast<double>(point[2]);
    }
  }
}

template <typename Value>
void ReadTypedRecordValues(const MeshView& view,
  const std::int64_t (&ids)[PassedCellRecords::Corners][Capacity], int corners, int count,
  PassedCellRecords& records)
{
  for (int i = 0; i < count; ++i)
  {
    for (int corner = 0; corner < corners; ++corner)
    {
      records.Corner[i][corner][3] = static_cast<double>(
        static_cast<const Value*>(view.Values)[ids[corner][i] * view.ValueStride]);
    }
  }
}

/// The number of the first listed cell that has too few or too many corners, or a corner that is no
/// point; that of cells, if there is none.
template <typename Id>
std::int64_t FindBadCell(const MeshView& view, std::int64_t lengthOfConnectivity, int threads)
{
  const auto* offsets = static_cast<const Id*>(view.Offsets);
  const auto* ids = static_cast<const Id*>(view.Connectivity);
  std::int64_t bad = view.NumberOfCells;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(min : bad)
  for (std::int64_t cell = 0; cell < view.NumberOfCells; ++cell)
  {
    const int corners = GetTraits(static_cast<CellShape>(view.Shapes[cell])).Corners;
    if (corners == 0)
    {
      continue;
    }
    const std::int64_t first = offsets[cell];
    const std::int64_t last = offsets[cell + 1];
    const bool isList =
      first >= 0 && first <= last && last <= lengthOfConnectivity && last - first == corners;
    if (!isList ||
      !std::all_of(ids + first, ids + last,
        [&view](std::int64_t id) { return id >= 0 && id < view.NumberOfPoints; }))
    {
      bad = std::min(bad, cell);
    }
  }
  return bad;
}

}

//------------------------------------------------------------------------------
MeshCells::MeshCells(const MeshView& view)
  : View(view)
  , NumberOfCells(view.NumberOfCells)
{
  if (view.IsLattice())
  {
    const Index3& n = view.Dimensions;
    this->NumberOfCells = std::int64_t{ n[0] - 1 } * (n[1] - 1) * (n[2] - 1);
  }
  else if (view.NumberOfCells > 0)
  {
    this->LengthOfConnectivity = view.IdType == ScalarType::Int32
      ? static_cast<const std::int32_t*>(view.Offsets)[view.NumberOfCells]
      : static_cast<const std::int64_t*>(view.Offsets)[view.NumberOfCells];
  }
  this->ReadIds =
    view.IdType == ScalarType::Int32 ? ReadListedIds<std::int32_t> : ReadListedIds<std::int64_t>;
  const bool hasFloats = view.PointType == ScalarType::Float32;
  this->ReadPoints = hasFloats ? ReadTypedPoints<float> : ReadTypedPoints<double>;
  this->ReadRecordPoints = hasFloats ? ReadTypedRecordPoints<float> : ReadTypedRecordPoints<double>;
  this->ReadTetrahedra = view.IdType == ScalarType::Int32 ? ReadListedTetrahedra<std::int32_t>
                                                          : ReadListedTetrahedra<std::int64_t>;
  DispatchScalarType(view.ValueType,
    [this](auto value)
    {
      this->ReadValues = ReadTypedValues<decltype(value)>;
      this->ReadRecordValues = ReadTypedRecordValues<decltype(value)>;
    });
}

//------------------------------------------------------------------------------
bool MeshCells::LoadIds(std::int64_t number, MeshCell& cell) const
{
  if (!this->View.IsLattice())
  {
    return this->ReadIds(this->View, number, cell);
  }
  this->LoadLatticeIds(number, cell);
  return true;
}

//------------------------------------------------------------------------------
void MeshCells::Prefetch(std::int64_t first, int count) const
{
  if (this->View.IsLattice())
  {
    return;
  }
  const std::int64_t size = this->View.IdType == ScalarType::Int32 ? 4 : 8;
  const auto* offsets = static_cast<const char*>(this->View.Offsets);
  const auto* connectivity = static_cast<const char*>(this->View.Connectivity);
  __builtin_prefetch(this->View.Shapes + first);
  __builtin_prefetch(offsets + size * first);
  __builtin_prefetch(offsets + size * (first + count));
  // Where they are if all cells have as many corners.
  const std::int64_t corners =
    std::clamp<std::int64_t>(this->LengthOfConnectivity / this->NumberOfCells, 0, MaximumCorners);
  const char* begin = connectivity + size * corners * first;
  for (std::int64_t line = 0; line < size * corners * count; line += 64)
  {
    __builtin_prefetch(begin + line);
  }
}

//------------------------------------------------------------------------------
void MeshCells::LoadRecords(const std::uint32_t* numbers, int count, bool areTetrahedra,
  CornerOrder* orders, PassedCellRecords& records) const
{
  RecordIds ids;
  if (areTetrahedra)
  {
    this->ReadTetrahedra(this->View, numbers, count, orders, ids);
  }
  else
  {
    for (int i = 0; i < count; ++i)
    {
      MeshCell cell;
      this->LoadIds(numbers[i], cell);
      const ShapeTraits& traits = GetTraits(cell.Shape);
      for (int corner = 0; corner < PassedCellRecords::Corners; ++corner)
      {
        ids[corner][i] = cell.Ids[traits.Trilinear[corner]];
      }
    }
  }
  const int corners = areTetrahedra ? 4 : PassedCellRecords::Corners;
  this->ReadRecordPoints(this->View, ids, corners, count, records);
  this->ReadRecordValues(this->View, ids, corners, count, records);
}

//------------------------------------------------------------------------------
void MeshCells::LoadLatticeIds(std::int64_t number, MeshCell& cell) const
{
  const Index3& n = this->View.Dimensions;
  const std::int64_t x = number % (n[0] - 1);
  const std::int64_t y = number / (n[0] - 1) % (n[1] - 1);
  const std::int64_t z = number / (n[0] - 1) / (n[1] - 1);
  const std::int64_t row = n[0];
  const std::int64_t slice = row * n[1];
  const std::int64_t first = x + row * y + slice * z;
  cell.Shape = CellShape::Hexahedron;
  cell.Count = 8;
  for (const int level : { 0, 4 })
  {
    const std::int64_t id = first + (level == 0 ? 0 : slice);
    cell.Ids[level] = id;
    cell.Ids[level + 1] = id + 1;
    cell.Ids[level + 2] = id + row + 1;
    cell.Ids[level + 3] = id + row;
  }
}

//------------------------------------------------------------------------------
bool MeshCells::LoadCorners(MeshCell& cell) const
{
  this->ReadPoints(this->View, cell);
  this->ReadValues(this->View, cell);
  // Zero times a number that is not finite is NaN.
  double sum = 0.0;
  for (int i = 0; i < cell.Count; ++i)
  {
    const Vector3& p = cell.Points[i];
    sum += 0.0 * p[0] + 0.0 * p[1] + 0.0 * p[2] + 0.0 * cell.Values[i];
  }
  return sum == 0.0;
}

//------------------------------------------------------------------------------
std::string FindProblem(const MeshView& view, std::int64_t lengthOfConnectivity, int threads)
{
  if (view.IsLattice())
  {
    return {};
  }
  const std::int64_t bad = view.IdType == ScalarType::Int32
    ? FindBadCell<std::int32_t>(view, lengthOfConnectivity, threads)
    : FindBadCell<std::int64_t>(view, lengthOfConnectivity, threads);
  return bad < view.NumberOfCells ? "Cell " + std::to_string(bad) +
      " has a wrong number of points, or refers to a point that is not there."
                                  : std::string();
}

}
