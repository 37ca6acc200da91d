// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/CellTree.h"

#include "Kernels/InstructionSets.h"
#include "Kernels/Kernels.h"
#include "Math/Arithmetic.h"
#include "Math/Compiler.h"
#include "Math/RoundOutward.h"
#include "Math/ThreadsOfLoop.h"
#include "Mesh/CodeOrder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// A box and a range of values: x, y, z and value.
template <typename T>
struct ExtentOf
{
  T Lower[4];
  T Upper[4];

  bool IsEmpty() const { return !(this->Lower[3] <= this->Upper[3]); }

  Vector3 GetMiddle() const
  {
    Vector3 middle;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      middle[axis] =
        static_cast<double>(this->Lower[axis]) * 0.5 + static_cast<double>(this->Upper[axis]) * 0.5;
    }
    return middle;
  }
};

/// Half of the longest extent, which itself may overflow.
double GetLongestHalf(const Bounds& box)
{
  double longest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    longest = std::max(longest, 0.5 * box.Upper[axis] - 0.5 * box.Lower[axis]);
  }
  return longest;
}

/// Two zeros before each of the lower ten bits.
std::uint32_t Spread(std::uint32_t bits)
{
  bits = (bits | bits << 16U) & 0x030000ffU;
  bits = (bits | bits << 8U) & 0x0300f00fU;
  bits = (bits | bits << 4U) & 0x030c30c3U;
  bits = (bits | bits << 2U) & 0x09249249U;
  return bits;
}

}

//------------------------------------------------------------------------------
/// That of some cells.
struct CellTree::Extent : ExtentOf<double>
{
  static Extent MakeEmpty()
  {
    return { { { Infinity, Infinity, Infinity, Infinity },
      { -Infinity, -Infinity, -Infinity, -Infinity } } };
  }

  void Include(const double (&lower)[4], const double (&upper)[4])
  {
    for (int i = 0; i < 4; ++i)
    {
      this->Lower[i] = std::min(this->Lower[i], lower[i]);
      this->Upper[i] = std::max(this->Upper[i], upper[i]);
    }
  }

  Bounds GetBox() const
  {
    Bounds box;
    std::copy_n(this->Lower, 3, box.Lower.begin());
    std::copy_n(this->Upper, 3, box.Upper.begin());
    return box;
  }

  /// Half of the surface of the box.
  double GetArea() const
  {
    const double x = this->Upper[0] - this->Lower[0];
    const double y = this->Upper[1] - this->Lower[1];
    const double z = this->Upper[2] - this->Lower[2];
    return this->IsEmpty() ? 0.0 : x * y + y * z + z * x;
  }
};

//------------------------------------------------------------------------------
/// The same in single precision, rounded outward. It is not initialized, so that the threads that
/// fill an array of them are the first to touch its memory.
struct alignas(32) CellTree::RoundedExtent : ExtentOf<float>
{
  RoundedExtent() = default;

  explicit RoundedExtent(const Extent& extent)
  {
    std::transform(extent.Lower, extent.Lower + 4, this->Lower, RoundDown);
    std::transform(extent.Upper, extent.Upper + 4, this->Upper, RoundUp);
  }

  static RoundedExtent MakeEmpty() { return RoundedExtent(Extent::MakeEmpty()); }

  void SetChild(CellTreeNode& node, int child, double margin) const
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      node.Lower[axis][child] = RoundDown(static_cast<double>(this->Lower[axis]) - margin);
      node.Upper[axis][child] = RoundUp(static_cast<double>(this->Upper[axis]) + margin);
    }
    node.Low[child] = this->Lower[3];
    node.High[child] = this->Upper[3];
  }
};

//------------------------------------------------------------------------------
/// Finds three times ten bits for the position in a box.
class CellTree::MortonCoder
{
public:
  explicit MortonCoder(const Bounds& box)
    : Lower(box.Lower)
  {
    const double longest = GetLongestHalf(box);
    this->Scale = longest > 0.0 ? 1.0 / longest : 0.0;
  }

  std::uint32_t GetCode(const Vector3& point) const
  {
    std::uint32_t code = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double part = (0.5 * point[axis] - 0.5 * this->Lower[axis]) * this->Scale;
      // NaN is the middle of what is too large for a float on both sides.
      const double inBox = part > 0.0 ? std::min(part, 1.0) : 0.0;
      code |= Spread(static_cast<std::uint32_t>(inBox * 1023.0)) << axis;
    }
    return code;
  }

private:
  Vector3 Lower;
  /// Of half a way.
  double Scale;
};

//------------------------------------------------------------------------------
/// Reads cells, up to 16 together, and finds their extents.
class CellTree::CellReader
{
public:
  explicit CellReader(const MeshCells& cells)
    : Cells(&cells)
    , Arrays(cells.GetPointArrays())
    , FindExtents(GetBestKernels().FindExtents[static_cast<int>(cells.GetValueType())])
  {
  }

  /// Those that are traced and finite.
  void Read(const std::uint32_t* numbers, int count)
  {
    this->Tetrahedra.Count = 0;
    this->Others.Count = 0;
    if (this->Cells->AreTetrahedra())
    {
      std::copy_n(numbers, count, this->Tetrahedra.Numbers);
      this->Tetrahedra.Count = count;
    }
    else
    {
      this->Sort(numbers, count);
    }
    if (this->Tetrahedra.Count > 0)
    {
      std::int64_t ids[Width][4];
      this->Cells->LoadIdsOfTetrahedra(this->Tetrahedra.Numbers, this->Tetrahedra.Count, ids);
      this->FindExtents(this->Arrays, ids[0], 4, this->Tetrahedra.Count, this->Tetrahedra.Extents);
    }
    if (this->Others.Count > 0)
    {
      constexpr int corners = PassedCellRecords::Corners;
      std::int64_t ids[Width][corners];
      this->Cells->LoadTrilinearIds(this->Others.Numbers, this->Others.Count, ids);
      this->FindExtents(this->Arrays, ids[0], corners, this->Others.Count, this->Others.Extents);
    }
  }

  /// Those with consecutive numbers of a block.
  void ReadBlock(std::int64_t block)
  {
    std::uint32_t numbers[Width];
    std::iota(numbers, numbers + Width, static_cast<std::uint32_t>(block * Width));
    const std::int64_t left = this->Cells->GetNumberOfCells() - block * Width;
    const int count = static_cast<int>(std::min<std::int64_t>(left, Width));
    const std::int64_t* ids = this->Cells->FindIdsInPlace(block * Width);
    if (!ids)
    {
      this->Read(numbers, count);
      return;
    }
    const bool areTetrahedra = this->Cells->AreTetrahedra();
    Group& group = areTetrahedra ? this->Tetrahedra : this->Others;
    group.Count = count;
    std::copy_n(numbers, count, group.Numbers);
    this->FindExtents(this->Arrays, ids, areTetrahedra ? 4 : 8, count, group.Extents);
  }

  /// Whether none of those that are traced was left out.
  bool AreAllFinite() const { return this->Tetrahedra.AreFinite() && this->Others.AreFinite(); }

  /// The extent of all.
  Extent GetExtent() const
  {
    Extent extent = Extent::MakeEmpty();
    for (const Group* group : { &this->Tetrahedra, &this->Others })
    {
      if (group->Count > 0)
      {
        extent.Include(group->Extents.LowerOfAll, group->Extents.UpperOfAll);
      }
    }
    return extent;
  }

  /// The sum of half the surfaces of their boxes.
  double GetArea() const { return this->Tetrahedra.GetArea() + this->Others.GetArea(); }

  /// Calls a function with the number and the middle of each.
  template <typename Function>
  void ForMiddles(const Function& function) const
  {
    for (const Group* group : { &this->Tetrahedra, &this->Others })
    {
      for (int i = 0; i < group->Count; ++i)
      {
        if ((group->Extents.Finite >> i & 1U) != 0)
        {
          function(group->Numbers[i], group->GetExtent(i).GetMiddle());
        }
      }
    }
  }

private:
  struct Group
  {
    int Count = 0;
    std::uint32_t Numbers[Width];
    CellExtents Extents;

    bool AreFinite() const
    {
      return this->Count == 0 || this->Extents.Finite == (1U << this->Count) - 1U;
    }
    double GetArea() const { return this->Count > 0 ? this->Extents.Area : 0.0; }
    Extent GetExtent(int cell) const
    {
      Extent extent;
      for (int i = 0; i < 4; ++i)
      {
        extent.Lower[i] = this->Extents.Lower[cell][i];
        extent.Upper[i] = this->Extents.Upper[cell][i];
      }
      return extent;
    }
  };

  /// Puts cells that are traced into the groups.
  void Sort(const std::uint32_t* numbers, int count)
  {
    for (int i = 0; i < count; ++i)
    {
      const int corners = GetTraits(this->Cells->GetShape(numbers[i])).Corners;
      if (corners != 0)
      {
        Group& group = corners == 4 ? this->Tetrahedra : this->Others;
        group.Numbers[group.Count++] = numbers[i];
      }
    }
  }

  const MeshCells* Cells;
  PointArrays Arrays;
  void (*FindExtents)(const PointArrays& arrays, const std::int64_t* ids, int corners, int count,
    CellExtents& extents);
  Group Tetrahedra;
  Group Others;
};

//------------------------------------------------------------------------------
CellTree::CellTree(const MeshCells& cells, int threads)
  : Cells(static_cast<std::size_t>(cells.GetNumberOfCells()))
{
  this->IsSorted = this->AreScattered(cells);
  if (this->IsSorted || !this->SortBlocks(cells, threads))
  {
    this->SortCells(cells, threads);
  }
  while (!this->Levels.empty() && this->Levels.back().Count > 1)
  {
    this->BuildLevelAbove(threads);
  }
}

//------------------------------------------------------------------------------
/// Whether most consecutive cells of a large mesh are far apart, by a sample of their blocks: then
/// no time is spent on blocks in vain. The box becomes that of the sample.
bool CellTree::AreScattered(const MeshCells& cells)
{
  constexpr std::int64_t samples = 64;
  constexpr std::int64_t leastBlocks = 64 * samples;
  constexpr double share = 4.0;
  const std::int64_t blocks = cells.GetNumberOfCells() / Width;
  CellReader reader(cells);
  Extent whole = Extent::MakeEmpty();
  std::int64_t scattered = 0;
  for (std::int64_t i = 0; blocks >= leastBlocks && i < samples; ++i)
  {
    reader.ReadBlock(blocks * i / samples);
    const Extent block = reader.GetExtent();
    whole.Include(block.Lower, block.Upper);
    scattered += block.GetArea() > share * reader.GetArea() ? 1 : 0;
  }
  this->Box = whole.GetBox();
  return scattered > samples / 2;
}

//------------------------------------------------------------------------------
/// Reads all cells, block by block, and finds their extent, and whether they are finite. Calls a
/// function with the number of each block and the reader. Returns whether the boxes of blocks are
/// not so large, compared with those of all cells, that the cells must be sorted.
template <typename Function>
bool CellTree::ReadBlocks(const MeshCells& cells, int threads, const Function& function)
{
  /// Sixteen cubes in a row have 0.7 of the surface of all of them; in a cluster, 0.4.
  constexpr double largestShare = 0.75;
  const auto blocks = static_cast<std::int64_t>((this->Cells + Width - 1) / Width);
  Extent whole = Extent::MakeEmpty();
  bool areFinite = true;
  double areaOfCells = 0.0;
  double areaOfBlocks = 0.0;
#pragma omp declare reduction(unite:Extent                                                         \
                              : omp_out.Include(omp_in.Lower, omp_in.Upper))                       \
  initializer(omp_priv = Extent::MakeEmpty())
  const int worth = GetThreadsOfLoop(this->Cells, 20.0, threads);
#pragma omp parallel num_threads(worth) reduction(unite : whole)                                   \
  reduction(+ : areaOfCells, areaOfBlocks) reduction(&& : areFinite)
  {
    CellReader reader(cells);
#pragma omp for schedule(static)
    for (std::int64_t i = 0; i < blocks; ++i)
    {
      reader.ReadBlock(i);
      const Extent block = reader.GetExtent();
      whole.Include(block.Lower, block.Upper);
      areaOfCells += reader.GetArea();
      areaOfBlocks += block.GetArea();
      areFinite = areFinite && reader.AreAllFinite();
      function(static_cast<std::size_t>(i), reader);
    }
  }
  this->Box = whole.GetBox();
  this->Low = whole.Lower[3];
  this->High = whole.Upper[3];
  this->AreFinite = areFinite;
  return areaOfBlocks <= largestShare * areaOfCells;
}

//------------------------------------------------------------------------------
/// Makes blocks of consecutive cells, and puts these in Morton order. Returns false if the cells
/// must be sorted.
bool CellTree::SortBlocks(const MeshCells& cells, int threads)
{
  const std::size_t blocks = (this->Cells + Width - 1) / Width;
  const std::unique_ptr<RoundedExtent[]> extents(new RoundedExtent[blocks]);
  this->IsSorted = !this->ReadBlocks(cells, threads,
    [&extents](std::size_t block, const CellReader& reader)
    { extents[block] = RoundedExtent(reader.GetExtent()); });
  if (this->IsSorted)
  {
    return false;
  }
  CodeOrder order(blocks);
  const MortonCoder coder(this->Box);
#pragma omp parallel for schedule(static) num_threads(GetThreadsOfLoop(blocks, 10.0, threads))
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(blocks); ++i)
  {
    const RoundedExtent& extent = extents[static_cast<std::size_t>(i)];
    const auto number = static_cast<std::uint32_t>(i);
    if (extent.IsEmpty())
    {
      order.LeaveOut(number);
    }
    else
    {
      order.SetCode(number, coder.GetCode(extent.GetMiddle()));
    }
  }
  this->Order = order.Find(threads);
  this->Blocks = this->Order.size();
  const auto getExtent = [this, &extents](std::size_t block)
  {
    constexpr std::size_t ahead = 16;
    PrefetchLine(&extents[this->Order[std::min(block + ahead, this->Blocks - 1)]]);
    return extents[this->Order[block]];
  };
  this->BuildLevel(this->Blocks, this->GetMargin(), getExtent, threads);
  return true;
}

//------------------------------------------------------------------------------
/// Codes the cells that are traced, by their place in a box. Those outside are coded as if they
/// were on its border.
void CellTree::CodeCells(const MeshCells& cells, const Bounds& box, int threads, CodeOrder& order)
{
  const MortonCoder coder(box);
  const auto setCode = [&order, &coder](std::uint32_t number, const Vector3& middle)
  { order.SetCode(number, coder.GetCode(middle)); };
  this->ReadBlocks(cells, threads,
    [this, &order, &setCode](std::size_t block, const CellReader& reader)
    {
      const std::size_t last = std::min((block + 1) * Width, this->Cells);
      for (std::size_t number = block * Width; number < last; ++number)
      {
        order.LeaveOut(static_cast<std::uint32_t>(number));
      }
      reader.ForMiddles(setCode);
    });
}

//------------------------------------------------------------------------------
/// Puts the cells that are traced in Morton order, and makes their blocks.
void CellTree::SortCells(const MeshCells& cells, int threads)
{
  CodeOrder order(this->Cells);
  // The box of a sample is that of all, but for a few cells, if these are in random order.
  constexpr double largest = 1.25;
  Bounds coded;
  do
  {
    coded = this->Box;
    this->CodeCells(cells, coded, threads, order);
  } while (GetLongestHalf(this->Box) > largest * GetLongestHalf(coded));
  this->Order = order.Find(threads);
  this->Blocks = (this->Order.size() + Width - 1) / Width;
  const std::unique_ptr<RoundedExtent[]> extents(new RoundedExtent[this->Blocks]);
#pragma omp parallel num_threads(GetThreadsOfLoop(this->Cells, 20.0, threads))
  {
    constexpr std::size_t ahead = 3;
    CellReader reader(cells);
#pragma omp for schedule(static)
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(this->Blocks); ++i)
    {
      const auto block = static_cast<std::size_t>(i);
      this->PrefetchCells(cells, std::min(block + ahead, this->Blocks - 1));
      std::uint32_t numbers[Width];
      reader.Read(numbers, this->GetCells(block, numbers));
      extents[block] = RoundedExtent(reader.GetExtent());
    }
  }
  this->BuildLevel(
    this->Blocks, this->GetMargin(), [&extents](std::size_t block) { return extents[block]; },
    threads);
}

//------------------------------------------------------------------------------
double CellTree::GetMargin() const
{
  double largest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    largest =
      std::max({ largest, std::abs(this->Box.Lower[axis]), std::abs(this->Box.Upper[axis]) });
  }
  // Boxes without a thickness get one.
  return largest * 0x1p-40 + static_cast<double>(std::numeric_limits<float>::min());
}

//------------------------------------------------------------------------------
/// Builds a level of nodes, from the extents of their children, which a function gives.
template <typename Function>
void CellTree::BuildLevel(
  std::size_t children, double margin, const Function& getExtent, int threads)
{
  if (children == 0)
  {
    return;
  }
  Level level((children + Width - 1) / Width);
#pragma omp parallel for schedule(static) num_threads(GetThreadsOfLoop(level.Count, 200.0, threads))
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(level.Count); ++i)
  {
    const auto node = static_cast<std::size_t>(i);
    for (int child = 0; child < Width; ++child)
    {
      const std::size_t number = node * Width + static_cast<std::size_t>(child);
      const RoundedExtent extent =
        number < children ? getExtent(number) : RoundedExtent::MakeEmpty();
      extent.SetChild(level.Nodes[node], child, margin);
    }
  }
  this->Levels.push_back(std::move(level));
}

//------------------------------------------------------------------------------
void CellTree::BuildLevelAbove(int threads)
{
  const Level& below = this->Levels.back();
  const auto getExtent = [&below](std::size_t number)
  {
    const CellTreeNode& node = below.Nodes[number];
    RoundedExtent extent;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      extent.Lower[axis] = *std::min_element(node.Lower[axis], node.Lower[axis] + Width);
      extent.Upper[axis] = *std::max_element(node.Upper[axis], node.Upper[axis] + Width);
    }
    extent.Lower[3] = *std::min_element(node.Low, node.Low + Width);
    extent.Upper[3] = *std::max_element(node.High, node.High + Width);
    return extent;
  };
  this->BuildLevel(below.Count, 0.0, getExtent, threads);
}

//------------------------------------------------------------------------------
std::vector<std::uint32_t> CellTree::FindBlocks(double low, double high, int threads) const
{
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> blocks((this->Cells + Width - 1) / Width, none);
#pragma omp parallel for schedule(static) num_threads(GetThreadsOfLoop(this->Blocks, 2.0, threads))
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(this->Blocks); ++i)
  {
    const auto block = static_cast<std::size_t>(i);
    const CellTreeNode& node = this->GetNode(0, block / Width);
    if (static_cast<double>(node.Low[block % Width]) <= high &&
      low <= static_cast<double>(node.High[block % Width]))
    {
      blocks[this->IsSorted ? block : this->Order[block]] = static_cast<std::uint32_t>(i);
    }
  }
  blocks.erase(std::remove(blocks.begin(), blocks.end(), none), blocks.end());
  return blocks;
}

//------------------------------------------------------------------------------
std::size_t CellTree::GetMemory() const
{
  std::size_t memory = this->Order.capacity() * sizeof(this->Order[0]);
  for (const Level& level : this->Levels)
  {
    memory += level.Count * sizeof(CellTreeNode);
  }
  return memory;
}

}
