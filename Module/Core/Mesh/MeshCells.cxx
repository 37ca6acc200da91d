// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/MeshCells.h"

#include "Kernels/InstructionSets.h"
#include "Kernels/Kernels.h"
#include "Math/ThreadsOfLoop.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <numeric>
#include <type_traits>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The ids of the corners of listed cells.
template <typename Id>
class IdsOfCells
{
public:
  explicit IdsOfCells(const MeshView& view)
    : CornersOfAll(view.CornersOfAll)
    , Offsets(static_cast<const Id*>(view.Offsets))
    , Connectivity(static_cast<const Id*>(view.Connectivity))
  {
  }

  const Id* Get(std::int64_t number) const
  {
    return this->Connectivity +
      (this->CornersOfAll != 0 ? number * this->CornersOfAll
                               : std::int64_t{ this->Offsets[number] });
  }

private:
  std::int64_t CornersOfAll;
  const Id* Offsets;
  const Id* Connectivity;
};

template <typename Id>
CellShape ReadListedIds(const MeshView& view, std::int64_t number, std::int64_t* ids)
{
  const CellShape shape = view.GetShape(number);
  const int count = GetTraits(shape).Corners;
  // The offset of a cell without corners may be anything.
  const Id* listed = count != 0 ? IdsOfCells<Id>(view).Get(number) : nullptr;
  for (int i = 0; i < count; ++i)
  {
    ids[i] = listed[i];
  }
  return shape;
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

template <typename Value>
void ReadTypedComponents(
  const MeshView& view, const MeshCell& cell, double (*values)[MaximumCorners])
{
  for (int i = 0; i < cell.Count; ++i)
  {
    const Value* ofPoint =
      static_cast<const Value*>(view.Components) + cell.Ids[i] * view.ValueStride;
    for (int component = 0; component < view.NumberOfComponents; ++component)
    {
      values[component][i] = static_cast<double>(ofPoint[component]);
    }
  }
}

template <typename Id>
void ReadListedTetrahedra(
  const MeshView& view, const std::uint32_t* numbers, int count, std::int64_t (*ids)[4])
{
  const IdsOfCells<Id> all(view);
  for (int i = 0; i < count; ++i)
  {
    const Id* listed = all.Get(numbers[i]);
    for (std::size_t corner = 0; corner < 4; ++corner)
    {
      ids[i][corner] = listed[corner];
    }
  }
}

template <typename Id>
void ReadOrderedListedTetrahedra(const MeshView& view, const std::uint32_t* numbers, int count,
  CornerOrder* orders, std::int64_t (*ids)[4])
{
  const IdsOfCells<Id> all(view);
  for (int i = 0; i < count; ++i)
  {
    const Id* listed = all.Get(numbers[i]);
    orders[i] = CornerOrder(listed);
    for (std::size_t corner = 0; corner < 4; ++corner)
    {
      ids[i][corner] = listed[orders[i].Corners[corner]];
    }
  }
}

template <typename Id>
void ReadListedTrilinear(const MeshView& view, const std::uint32_t* numbers, int count,
  std::int64_t (*ids)[PassedCellRecords::Corners])
{
  const IdsOfCells<Id> all(view);
  for (int i = 0; i < count; ++i)
  {
    const Id* listed = all.Get(numbers[i]);
    const ShapeTraits& traits = GetTraits(view.GetShape(numbers[i]));
    for (int corner = 0; corner < PassedCellRecords::Corners; ++corner)
    {
      ids[i][corner] = listed[traits.Trilinear[corner]];
    }
  }
}

/// The ids of the corners of the cells of a lattice.
class IdsOfLattice
{
public:
  explicit IdsOfLattice(const MeshView& view)
    : Cells{ view.Dimensions[0] - 1, view.Dimensions[1] - 1 }
    , Row(view.Dimensions[0])
    , Slice(this->Row * view.Dimensions[1])
  {
  }

  /// Those of a cell, as corners of a trilinear cell.
  void Get(std::int64_t number, std::int64_t (&ids)[PassedCellRecords::Corners]) const
  {
    const std::int64_t x = number % this->Cells[0];
    const std::int64_t y = number / this->Cells[0] % this->Cells[1];
    const std::int64_t z = number / this->Cells[0] / this->Cells[1];
    const std::int64_t first = x + this->Row * y + this->Slice * z;
    for (int corner = 0; corner < PassedCellRecords::Corners; ++corner)
    {
      ids[corner] = first + (corner & 1) + ((corner & 2) != 0 ? this->Row : 0) +
        ((corner & 4) != 0 ? this->Slice : 0);
    }
  }

private:
  std::int64_t Cells[2];
  std::int64_t Row;
  std::int64_t Slice;
};

void ReadLatticeTrilinear(const MeshView& view, const std::uint32_t* numbers, int count,
  std::int64_t (*ids)[PassedCellRecords::Corners])
{
  const IdsOfLattice all(view);
  for (int i = 0; i < count; ++i)
  {
    all.Get(numbers[i], ids[i]);
  }
}

template <typename Coordinate>
void ReadTypedCornerPoints(
  const MeshView& view, const std::int64_t* ids, int count, double (*corners)[4])
{
  for (int i = 0; i < count; ++i)
  {
    const Coordinate* point = static_cast<const Coordinate*>(view.Points) + 3 * ids[i];
    for (int axis = 0; axis < 3; ++axis)
    {
      corners[i][axis] = static_cast<double>(point[axis]);
    }
  }
}

template <typename Value>
void ReadTypedCornerValues(
  const MeshView& view, const std::int64_t* ids, int count, double (*corners)[4])
{
  for (int i = 0; i < count; ++i)
  {
    corners[i][3] =
      static_cast<double>(static_cast<const Value*>(view.Values)[ids[i] * view.ValueStride]);
  }
}

/// Of points with some ids, how many have values below an isovalue.
template <typename Value, typename Id>
SIMD_INLINE int CountBelow(const MeshView& view, const Id* ids, int count, double isovalue)
{
  int below = 0;
  for (int i = 0; i < count; ++i)
  {
    const Value value = static_cast<const Value*>(view.Values)[ids[i] * view.ValueStride];
    below += static_cast<double>(value) < isovalue ? 1 : 0;
  }
  return below;
}

/// If all listed cells have as many corners, how many; else 0.
template <typename Id>
std::int64_t FindCornersOfAll(const MeshView& view, int threads)
{
  // Offsets of cells of other shapes may be anything: unsigned differences do not overflow.
  using Offset = std::make_unsigned_t<Id>;
  const auto* offsets = static_cast<const Offset*>(view.Offsets);
  const Offset corners = offsets[1] - offsets[0];
  if (offsets[0] != 0 || corners > MaximumCorners)
  {
    return 0;
  }
  Offset differences = 0;
  const int worth = GetThreadsOfLoop(static_cast<std::size_t>(view.NumberOfCells), 0.5, threads);
  // (Not simd: with clang 14 some differences are lost at -O1.)
#pragma omp parallel for schedule(static) num_threads(worth) reduction(| : differences)
  for (std::int64_t i = 0; i < view.NumberOfCells; ++i)
  {
    differences |= (offsets[i + 1] - offsets[i]) ^ corners;
  }
  return differences == 0 ? static_cast<std::int64_t>(corners) : 0;
}

/// How many corners a listed cell has, about.
template <typename Id>
std::int64_t FindMeanCorners(const MeshView& view)
{
  if (view.CornersOfAll != 0)
  {
    return view.CornersOfAll;
  }
  const std::int64_t length = static_cast<const Id*>(view.Offsets)[view.NumberOfCells];
  return std::clamp<std::int64_t>(length / view.NumberOfCells, 0, MaximumCorners);
}

/// The shape that all listed cells have; 0 if there are several.
unsigned char FindShapeOfAll(const MeshView& view)
{
  // As each of them has the shape of the next.
  const auto others = static_cast<std::size_t>(view.NumberOfCells - 1);
  return std::memcmp(view.Shapes, view.Shapes + 1, others) == 0 ? view.Shapes[0] : 0;
}

/// Whether ids are those of points.
template <typename Id>
bool ArePoints(const MeshView& view, std::int64_t count, int threads)
{
  // Negative ids are larger than any other as unsigned numbers.
  using Unsigned = std::make_unsigned_t<Id>;
  const auto* ids = static_cast<const Unsigned*>(view.Connectivity);
  Unsigned largest = 0;
  const int worth = GetThreadsOfLoop(static_cast<std::size_t>(count), 0.5, threads);
  // Four at once: one comparison waits for another less often.
#pragma omp parallel for schedule(static) num_threads(worth) reduction(max : largest)
  for (std::int64_t i = 0; i < count / 4; ++i)
  {
    const Unsigned* four = ids + 4 * i;
    largest = std::max(largest, std::max(std::max(four[0], four[1]), std::max(four[2], four[3])));
  }
  largest = std::accumulate(ids + count / 4 * 4, ids + count, largest,
    [](Unsigned a, Unsigned b) { return std::max(a, b); });
  return largest <= static_cast<Unsigned>(std::numeric_limits<Id>::max()) &&
    static_cast<std::int64_t>(largest) < view.NumberOfPoints;
}

/// Whether all listed cells have one shape, lists of as many ids, and corners that are points: as
/// most meshes are, and much faster to see than which cell is bad.
template <typename Id>
bool AreAlikeAndGood(const MeshView& view, std::int64_t lengthOfConnectivity, int threads)
{
  const std::int64_t corners = FindCornersOfAll<Id>(view, threads);
  return corners != 0 &&
    corners == GetTraits(static_cast<CellShape>(FindShapeOfAll(view))).Corners &&
    view.NumberOfCells <= lengthOfConnectivity / corners &&
    ArePoints<Id>(view, view.NumberOfCells * corners, threads);
}

/// The number of the first listed cell that has too few or too many corners, or a corner that is no
/// point; that of cells, if there is none.
template <typename Id>
std::int64_t FindBadCell(
  const MeshView& view, std::int64_t lengthOfConnectivity, int threads, CheckedCells checked)
{
  const auto* offsets = static_cast<const Id*>(view.Offsets);
  const auto* ids = static_cast<const Id*>(view.Connectivity);
  std::int64_t bad = view.NumberOfCells;
  const int worth = GetThreadsOfLoop(static_cast<std::size_t>(view.NumberOfCells), 10.0, threads);
#pragma omp parallel for schedule(static) num_threads(worth) reduction(min : bad)
  for (std::int64_t cell = 0; cell < view.NumberOfCells; ++cell)
  {
    const int corners = GetTraits(static_cast<CellShape>(view.Shapes[cell])).Corners;
    if (corners == 0 && checked == CheckedCells::Traced)
    {
      continue;
    }
    const std::int64_t first = offsets[cell];
    const std::int64_t last = offsets[cell + 1];
    const bool isList = first >= 0 && first <= last && last <= lengthOfConnectivity &&
      (corners == 0 || last - first == corners);
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
MeshCells::MeshCells(const MeshView& view, int threads)
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
    const bool isShort = view.IdType == ScalarType::Int32;
    if (view.ShapeOfAll == 0)
    {
      this->View.CornersOfAll = isShort ? FindCornersOfAll<std::int32_t>(view, threads)
                                        : FindCornersOfAll<std::int64_t>(view, threads);
      this->View.ShapeOfAll = FindShapeOfAll(view);
    }
    this->BytesOfCell = isShort ? 4 * FindMeanCorners<std::int32_t>(this->View)
                                : 8 * FindMeanCorners<std::int64_t>(this->View);
  }
  this->ReadIds =
    view.IdType == ScalarType::Int32 ? ReadListedIds<std::int32_t> : ReadListedIds<std::int64_t>;
  const bool hasFloats = view.PointType == ScalarType::Float32;
  this->BytesOfPoint = 3 * (hasFloats ? sizeof(float) : sizeof(double));
  this->ReadPoints = hasFloats ? ReadTypedPoints<float> : ReadTypedPoints<double>;
  this->ReadCornerPoints = hasFloats ? ReadTypedCornerPoints<float> : ReadTypedCornerPoints<double>;
  this->ReadTetrahedra = view.IdType == ScalarType::Int32 ? ReadListedTetrahedra<std::int32_t>
                                                          : ReadListedTetrahedra<std::int64_t>;
  this->ReadOrderedTetrahedra = view.IdType == ScalarType::Int32
    ? ReadOrderedListedTetrahedra<std::int32_t>
    : ReadOrderedListedTetrahedra<std::int64_t>;
  this->ReadTrilinear = view.IsLattice() ? ReadLatticeTrilinear
    : view.IdType == ScalarType::Int32   ? ReadListedTrilinear<std::int32_t>
                                         : ReadListedTrilinear<std::int64_t>;
  DispatchScalarType(view.ValueType,
    [this](auto value)
    {
      this->BytesOfValue = this->View.ValueStride * static_cast<std::int64_t>(sizeof(value));
      this->ReadValues = ReadTypedValues<decltype(value)>;
      this->ReadComponents = ReadTypedComponents<decltype(value)>;
      this->ReadCornerValues = ReadTypedCornerValues<decltype(value)>;
      this->ReadStraddling = this->View.IsLattice() ? FindLatticeStraddling<decltype(value)>
        : this->View.IdType == ScalarType::Int32
        ? FindListedStraddling<std::int32_t, decltype(value)>
        : FindListedStraddling<std::int64_t, decltype(value)>;
    });
}

//------------------------------------------------------------------------------
MeshCells MeshCells::OfComponent(int component) const
{
  MeshCells cells = *this;
  DispatchScalarType(this->View.ValueType,
    [&cells, component](auto value) {
      cells.View.Values = static_cast<const decltype(value)*>(cells.View.Components) + component;
    });
  return cells;
}

//------------------------------------------------------------------------------
CellShape MeshCells::LoadIds(std::int64_t number, std::int64_t* ids) const
{
  return this->View.IsLattice() ? this->LoadLatticeIds(number, ids)
                                : this->ReadIds(this->View, number, ids);
}

//------------------------------------------------------------------------------
bool MeshCells::LoadIds(std::int64_t number, MeshCell& cell) const
{
  cell.Shape = this->LoadIds(number, cell.Ids);
  cell.Count = GetTraits(cell.Shape).Corners;
  return cell.Count > 0;
}

//------------------------------------------------------------------------------
void MeshCells::LoadTetrahedra(
  const std::uint32_t* numbers, int count, double (*corners)[4][4]) const
{
  std::int64_t ids[MaximumCells][4];
  this->LoadIdsOfTetrahedra(numbers, count, ids);
  this->LoadTetrahedra(ids, count, corners);
}

//------------------------------------------------------------------------------
void MeshCells::LoadTetrahedra(
  const std::int64_t (*ids)[4], int count, double (*corners)[4][4]) const
{
  this->ReadCornerPoints(this->View, ids[0], 4 * count, corners[0]);
  this->ReadCornerValues(this->View, ids[0], 4 * count, corners[0]);
}

//------------------------------------------------------------------------------
void MeshCells::ReadCornerIds(
  const std::uint32_t* numbers, int count, CornerOrder* orders, std::int64_t (*ids)[4]) const
{
  this->ReadOrderedTetrahedra(this->View, numbers, count, orders, ids);
  this->PrefetchPoints(ids[0], 4 * count);
}

//------------------------------------------------------------------------------
void MeshCells::LoadTrilinear(
  const std::uint32_t* numbers, int count, double (*corners)[PassedCellRecords::Corners][4]) const
{
  std::int64_t ids[MaximumCells][PassedCellRecords::Corners];
  this->LoadTrilinearIds(numbers, count, ids);
  this->PrefetchPoints(ids[0], PassedCellRecords::Corners * count);
  this->LoadTrilinear(ids, count, corners);
}

//------------------------------------------------------------------------------
void MeshCells::LoadTrilinear(const std::int64_t (*ids)[PassedCellRecords::Corners], int count,
  double (*corners)[PassedCellRecords::Corners][4]) const
{
  this->ReadCornerPoints(this->View, ids[0], PassedCellRecords::Corners * count, corners[0]);
  this->ReadCornerValues(this->View, ids[0], PassedCellRecords::Corners * count, corners[0]);
}

//------------------------------------------------------------------------------
void MeshCells::InterpolatePoints(
  const WeightedCorners& corners, int first, double (*points)[RayPacket::Capacity]) const
{
  GetBestKernels().SumAtCorners(
    this->View.Points, this->View.PointType == ScalarType::Float32, corners, first, points);
}

//------------------------------------------------------------------------------
/// Begins to fetch points with some ids, and their values.
void MeshCells::PrefetchPoints(const std::int64_t* ids, int count) const
{
  for (int i = 0; i < count; ++i)
  {
    PrefetchLine(static_cast<const char*>(this->View.Points) + ids[i] * this->BytesOfPoint);
    PrefetchLine(static_cast<const char*>(this->View.Values) + ids[i] * this->BytesOfValue);
  }
}

//------------------------------------------------------------------------------
CellShape MeshCells::LoadLatticeIds(std::int64_t number, std::int64_t* ids) const
{
  constexpr CellShape shape = CellShape::Hexahedron;
  std::int64_t trilinear[PassedCellRecords::Corners];
  IdsOfLattice(this->View).Get(number, trilinear);
  for (int corner = 0; corner < PassedCellRecords::Corners; ++corner)
  {
    ids[GetTraits(shape).Trilinear[corner]] = trilinear[corner];
  }
  return shape;
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
/// Reads no more than it needs: it is called for all cells that may be active.
template <typename Id, typename Value>
unsigned int MeshCells::FindListedStraddling(
  const MeshCells& cells, const std::uint32_t* numbers, int count, double isovalue)
{
  const MeshView& view = cells.View;
  const IdsOfCells<Id> all(view);
  unsigned int mask = 0;
  for (int i = 0; i < count; ++i)
  {
    const int corners = GetTraits(view.GetShape(numbers[i])).Corners;
    const Id* ids = corners != 0 ? all.Get(numbers[i]) : nullptr;
    // Of known numbers loops are unrolled.
    const int below = corners == 4 ? CountBelow<Value>(view, ids, 4, isovalue)
      : corners == 8               ? CountBelow<Value>(view, ids, 8, isovalue)
                                   : CountBelow<Value>(view, ids, corners, isovalue);
    mask |= static_cast<unsigned int>(below > 0 && below < corners) << i;
  }
  return mask;
}

//------------------------------------------------------------------------------
template <typename Value>
unsigned int MeshCells::FindLatticeStraddling(
  const MeshCells& cells, const std::uint32_t* numbers, int count, double isovalue)
{
  const IdsOfLattice all(cells.View);
  unsigned int mask = 0;
  for (int i = 0; i < count; ++i)
  {
    std::int64_t ids[PassedCellRecords::Corners];
    all.Get(numbers[i], ids);
    const int below = CountBelow<Value>(cells.View, ids, PassedCellRecords::Corners, isovalue);
    mask |= static_cast<unsigned int>(below > 0 && below < PassedCellRecords::Corners) << i;
  }
  return mask;
}

//------------------------------------------------------------------------------
std::string FindProblem(
  const MeshView& view, std::int64_t lengthOfConnectivity, int threads, CheckedCells checked)
{
  const bool isShort = view.IdType == ScalarType::Int32;
  if (view.IsLattice() || view.NumberOfCells == 0 ||
    (isShort ? AreAlikeAndGood<std::int32_t>(view, lengthOfConnectivity, threads)
             : AreAlikeAndGood<std::int64_t>(view, lengthOfConnectivity, threads)))
  {
    return {};
  }
  const std::int64_t bad = isShort
    ? FindBadCell<std::int32_t>(view, lengthOfConnectivity, threads, checked)
    : FindBadCell<std::int64_t>(view, lengthOfConnectivity, threads, checked);
  return bad < view.NumberOfCells ? "Cell " + std::to_string(bad) +
      " has a wrong number of points, or refers to a point that is not there."
                                  : std::string();
}

}
