// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The way of single rays through a tree of pieces. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// On each axis, how rays come to coordinates; see ScatteredRays.
SIMD_INLINE void ScatterAxes(
  const Doubles origin[3], const Doubles slope[3], Doubles reach, int first, ScatteredRays& rays)
{
  // A smaller slope would move a ray by less than the room that there is for rounding.
  constexpr double least = 0x1p-22;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Doubles rate = 1.0 / CopySign(Max(Abs(slope[axis]), least), slope[axis]);
    const Doubles atZero = 0.0 - origin[axis] * rate;
    const Doubles room = 0x1p-19 * reach * Abs(rate) + 0x1p-21 * Abs(atZero);
    StoreRounded(rate, &rays.Rate[axis][first]);
    StoreRounded(atZero - room, &rays.Earlier[axis][first]);
    StoreRounded(atZero + room, &rays.Later[axis][first]);
  }
}

void ScatterRays(
  const RayPacket& packet, const double lower[3], const double upper[3], ScatteredRays& rays)
{
  for (int first = 0; first < packet.Count; first += DoubleWidth)
  {
    Doubles origin[3];
    Doubles direction[3];
    Doubles size = 0.0;
    Doubles reach = 0.0;
    Doubles largest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      origin[axis] = Load(&packet.Origin[axis][first]);
      direction[axis] = Load(&packet.Direction[axis][first]);
      size = Max(size, Abs(direction[axis]));
      reach = reach + Max(Abs(lower[axis] - origin[axis]), Abs(upper[axis] - origin[axis]));
      largest = Max(largest, Abs(origin[axis]));
    }
    const Doubles inverse = 1.0 / size;
    const Doubles slope[3] = { direction[0] * inverse, direction[1] * inverse,
      direction[2] * inverse };
    ScatterAxes(origin, slope, reach, first, rays);
    const LongestAxes axes(direction);
    Doubles origins[3];
    Doubles slopes[3];
    axes.Turn(origin, origins);
    axes.Turn(slope, slopes);
    axes.StoreNumbers(&rays.Along[first]);
    for (int k = 0; k < 2; ++k)
    {
      const Doubles across = slopes[k + 1] * slopes[0];
      StoreRounded(across, &rays.Slope[k][first]);
      StoreRounded(origins[k + 1] - across * origins[0], &rays.Center[k][first]);
    }
    StoreRounded(0x1p-20 * (3.0 * largest + reach), &rays.Error[first]);
    const Doubles begin = Load(&packet.Begin[first]) * size;
    StoreRounded(ScatteredRays::GetDepth(begin, reach, -1.0), &rays.Begin[first]);
    Store(size, &rays.DepthOfT[first]);
    Store(reach, &rays.Reach[first]);
  }
}

/// A ray as it comes to the boxes of nodes.
struct RayThroughNodes
{
  /// Which of the ends of boxes it comes to first, and last.
  int First[3];
  int Last[3];
  float Rate[3];
  float Earlier[3];
  float Later[3];
  float Begin;
  float End;

  SIMD_INLINE RayThroughNodes(const ScatteredRays& rays, int ray)
    : Begin(rays.Begin[ray])
    , End(rays.End[ray])
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Rate[axis] = rays.Rate[axis][ray];
      this->Earlier[axis] = rays.Earlier[axis][ray];
      this->Later[axis] = rays.Later[axis][ray];
      const int down = this->Rate[axis] < 0.0F ? 3 : 0;
      this->First[axis] = axis + down;
      this->Last[axis] = axis + 3 - down;
    }
  }

  /// Those of the children of a node that it may meet; a bit for each.
  SIMD_INLINE unsigned int FindChildren(const PieceTreeNode& node) const
  {
    unsigned int found = 0;
    for (int i = 0; i < PieceTreeNode::Width; i += FloatWidth)
    {
      Floats entry = this->Begin;
      Floats exit = this->End;
      for (int axis = 0; axis < 3; ++axis)
      {
        const Floats first = LoadFloats(&node.Ends[this->First[axis]][i]);
        const Floats last = LoadFloats(&node.Ends[this->Last[axis]][i]);
        entry = Max(entry, MultiplyAdd(this->Rate[axis], first, this->Earlier[axis]));
        exit = Min(exit, MultiplyAdd(this->Rate[axis], last, this->Later[axis]));
      }
      found |= (~ToBits(exit < entry) & ((1U << FloatWidth) - 1U)) << i;
    }
    return found;
  }

  /// Those of the pieces of a set whose boxes it may meet; a bit for each.
  SIMD_INLINE unsigned int FindBoxes(const PieceBoxes& boxes) const
  {
    float rate[3];
    float earlier[3];
    float later[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      rate[axis] = this->Rate[axis] * boxes.Step[axis];
      const float atLower = this->Rate[axis] * boxes.Lower[axis];
      const float room = PieceBoxes::Error * std::fabs(rate[axis]);
      earlier[axis] = this->Earlier[axis] + atLower - room;
      later[axis] = this->Later[axis] + atLower + room;
    }
    unsigned int found = 0;
    for (int i = 0; i < PieceBoxes::Capacity; i += FloatWidth)
    {
      Floats entry = this->Begin;
      Floats exit = this->End;
      for (int axis = 0; axis < 3; ++axis)
      {
        const Floats first = LoadBytes(&boxes.Ends[this->First[axis]][i]);
        const Floats last = LoadBytes(&boxes.Ends[this->Last[axis]][i]);
        entry = Max(entry, MultiplyAdd(rate[axis], first, earlier[axis]));
        exit = Min(exit, MultiplyAdd(rate[axis], last, later[axis]));
      }
      found |= (~ToBits(exit < entry) & ((1U << FloatWidth) - 1U)) << i;
    }
    return found & ((1U << boxes.Count) - 1U);
  }
};

/// Begins to fetch the children of a node.
SIMD_INLINE void PrefetchChildren(
  const PieceTreeLevels& tree, int level, std::uint32_t first, unsigned int children)
{
  constexpr std::size_t line = 64;
  for (; children != 0; children &= children - 1)
  {
    const std::uint32_t child = first + static_cast<std::uint32_t>(LowestBit(children));
    const void* begin = level > 0 ? static_cast<const void*>(&tree.Nodes[level - 1][child])
                                  : static_cast<const void*>(&tree.Boxes[child]);
    const std::size_t size = level > 0 ? sizeof(PieceTreeNode) : sizeof(PieceBoxes);
    for (std::size_t i = 0; i < size; i += line)
    {
      PrefetchLine(static_cast<const char*>(begin) + i);
    }
  }
}

/// Brings a ray to a node.
SIMD_INLINE void Enter(const PieceTreeLevels& tree, int level, std::uint32_t number,
  const RayThroughNodes& ray, WayThroughPieces& way)
{
  constexpr std::uint32_t width = PieceTreeNode::Width;
  const std::uint32_t first = number * width;
  const std::uint32_t count = tree.Children[level] - first;
  const unsigned int met =
    ray.FindChildren(tree.Nodes[level][number]) & ((1U << (count < width ? count : width)) - 1U);
  PrefetchChildren(tree, level, first, met);
  way.First[level] = first;
  way.Left[level] = met;
}

/// A coordinate of packed points beside a ray.
SIMD_INLINE StepFunction GetBesideRay(
  const PackedPieces& packed, const ScatteredRays& rays, int ray, int across, int k)
{
  const int along = rays.Along[ray];
  const auto slope = static_cast<double>(rays.Slope[k][ray]);
  const double start = static_cast<double>(packed.Lower[across]) -
    static_cast<double>(rays.Center[k][ray]) - slope * static_cast<double>(packed.Lower[along]);
  return StepFunction(start, PackedProjection::GetStep(packed, across),
    -slope * PackedProjection::GetStep(packed, along));
}

/// Those of some polygons of a set that a ray may meet; a bit for each.
SIMD_INLINE unsigned int FindPolygonsOnRay(
  const PackedPieces& packed, const ScatteredRays& rays, int ray, unsigned int among)
{
  constexpr int next[3] = { 1, 2, 0 };
  const int along = rays.Along[ray];
  const int across[2] = { next[along], next[next[along]] };
  const StepFunction ofX = GetBesideRay(packed, rays, ray, across[0], 0);
  const StepFunction ofY = GetBesideRay(packed, rays, ray, across[1], 1);
  const float margin = LargerOf(ofX.Error, ofY.Error) + rays.Error[ray];
  return FindPolygonsAround(packed, ofX, ofY, along, across, margin, among);
}

/// Those that are not in a cell.
SIMD_INLINE unsigned int ExceptIn(
  std::uint32_t cell, const std::uint32_t* cells, unsigned int pieces)
{
  unsigned int left = pieces;
  for (; pieces != 0; pieces &= pieces - 1)
  {
    const int piece = LowestBit(pieces);
    left &= ~(static_cast<unsigned int>(cells[piece] == cell) << piece);
  }
  return left;
}

int FindSetOnRay(const PieceTreeLevels& tree, const ScatteredRays& rays, int ray,
  std::uint32_t startCell, WayThroughPieces& way, unsigned int& pieces)
{
  const RayThroughNodes through(rays, ray);
  int level = way.Level;
  while (level <= tree.Count)
  {
    const unsigned int left = way.Left[level];
    if (left == 0)
    {
      ++level;
      continue;
    }
    way.Left[level] = left & (left - 1);
    const std::uint32_t child = way.First[level] + static_cast<std::uint32_t>(LowestBit(left));
    if (level > 0)
    {
      Enter(tree, --level, child, through, way);
      continue;
    }
    unsigned int met = through.FindBoxes(tree.Boxes[child]);
    if (met != 0 && tree.Polygons)
    {
      met = ExceptIn(startCell, &tree.Cells[child * PieceBoxes::Capacity], met);
      met = met != 0 ? FindPolygonsOnRay(tree.Polygons[child], rays, ray, met) : 0;
    }
    if (met != 0)
    {
      way.Level = 0;
      pieces = met;
      return static_cast<int>(child);
    }
  }
  return -1;
}

}
}
