// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What single rays may meet in a mesh, in its tree or in one over the pieces of a surface. Included
// by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Those of some polygons of a set that are around a point, or so near to it that a margin moves
/// them there; a bit for each. The point is 0; coordinates across, and along an axis that they
/// depend on, too, are given as functions of steps. A polygon around it has all edges on one side
/// of it, so it does not have two on different sides. (What rounding does to areas is a part of the
/// margin, in which there is an error of 2^-21 of the largest coordinates.)
SIMD_INLINE unsigned int FindPolygonsAround(const PackedPieces& packed, const StepFunction& ofX,
  const StepFunction& ofY, int along, const int across[2], float margin, unsigned int among)
{
  constexpr int corners = PackedPieces::Corners;
  constexpr unsigned int mask = PackedPieces::Steps;
  constexpr unsigned int lanes = (1U << FloatWidth) - 1U;
  if (!(margin < static_cast<float>(LargestCoordinate) * 0x1p-10F))
  {
    return among; // Single precision does not tell.
  }
  unsigned int beside = 0;
  for (int first = 0; first < packed.Count; first += FloatWidth)
  {
    if ((among >> first & lanes) == 0)
    {
      continue;
    }
    Floats x[corners];
    Floats y[corners];
    for (int i = 0; i < corners; ++i)
    {
      const std::uint32_t* words = &packed.Polygons[i][first];
      const Floats z = GetBits(words, PackedPieces::Bits * along, mask);
      x[i] = ofX.Get(GetBits(words, PackedPieces::Bits * across[0], mask), z);
      y[i] = ofY.Get(GetBits(words, PackedPieces::Bits * across[1], mask), z);
    }
    Floats leftmost = -static_cast<float>(Infinity);
    Floats rightmost = -static_cast<float>(Infinity);
    for (int i = 0; i < corners; ++i)
    {
      const int j = (i + 1) % corners;
      const Floats area = MultiplyAdd(x[i], y[j], 0.0F - x[j] * y[i]);
      const Floats room = margin * (Abs(x[i]) + Abs(y[i]) + Abs(x[j]) + Abs(y[j]) + 2.0F * margin);
      leftmost = Max(leftmost, area - room);
      rightmost = Max(rightmost, 0.0F - area - room);
    }
    beside |= ToBits((0.0F < leftmost) & (0.0F < rightmost)) << first;
  }
  return among & ~beside;
}

/// A coordinate of packed points beside a ray.
SIMD_INLINE StepFunction GetBesideRay(
  const PackedPieces& packed, const ScatteredRays& rays, int ray, int across, int k)
{
  const int along = rays.Along[ray];
  const double slope = rays.Slope[k][ray];
  const double start = static_cast<double>(packed.Lower[across]) - rays.Center[k][ray] -
    slope * static_cast<double>(packed.Lower[along]);
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

unsigned int FindChildrenOnRay(const CellTreeNode& node, const ScatteredRays& rays, int ray,
  const IsovalueSpan* isovalues, int count)
{
  unsigned int active = 0;
  for (int i = 0; i < CellTreeNode::Width; i += FloatWidth)
  {
    active |= FindActive(node, i, isovalues, count) << i;
  }
  if (active == 0)
  {
    return 0;
  }
  const auto getEnds = [&node](int end, int i)
  { return LoadFloats(end < 3 ? &node.Lower[end][i] : &node.Upper[end - 3][i]); };
  return active & RayThroughBoxes(rays, ray).FindMet(getEnds);
}

/// Those of the pieces of a set whose boxes are packed that a ray may meet; a bit for each.
SIMD_INLINE unsigned int FindBoxesOnRay(const PackedPieces& packed, const RayThroughBoxes& ray)
{
  // Half a step.
  constexpr float error = 0.51F;
  constexpr float perStep = 1.0F / static_cast<float>(PackedPieces::Steps);
  float step[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    step[axis] = (packed.Upper[axis] - packed.Lower[axis]) * perStep;
  }
  const auto getEnds = [&packed](int end, int i)
  {
    return GetBits(
      &packed.Polygons[end / 3][i], PackedPieces::Bits * (end % 3), PackedPieces::Steps);
  };
  return ray.InSteps(packed.Lower, step, error).FindMet(getEnds);
}

int FindPiecesOnRay(const PackedPieces* sets, int firstSet, int numberOfSets,
  const ScatteredRays& rays, int ray, unsigned int& pieces)
{
  const RayThroughBoxes through(rays, ray);
  for (int set = firstSet; set < numberOfSets; ++set)
  {
    const PackedPieces& packed = sets[set];
    if (through.Meets(packed.Lower, packed.Upper))
    {
      const unsigned int all = (1U << packed.Count) - 1U;
      // To unpack boxes of polygons takes as long as to look at these.
      pieces = packed.AreInTetrahedra ? FindPolygonsOnRay(packed, rays, ray, all)
                                      : all & FindBoxesOnRay(packed, through);
      if (pieces != 0)
      {
        return set;
      }
    }
  }
  return numberOfSets;
}

/// Those of the pieces of a set whose boxes a ray may meet; a bit for each.
SIMD_INLINE unsigned int FindBoxesOnRay(const PieceBoxes& boxes, const RayThroughBoxes& ray)
{
  const auto getEnds = [&boxes](int end, int i) { return LoadBytes(&boxes.Ends[end][i]); };
  return ray.InSteps(boxes.Lower, boxes.Step, PieceBoxes::Error).FindMet(getEnds) &
    ((1U << boxes.Count) - 1U);
}

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
SIMD_INLINE void EnterNode(const PieceTreeLevels& tree, std::uint32_t number,
  const RayThroughBoxes& ray, WayThroughTree& way)
{
  constexpr std::uint32_t width = PieceTreeNode::Width;
  const int level = way.Level - 1;
  const PieceTreeNode& node = tree.Nodes[level][number];
  const std::uint32_t count = tree.Children[level] - number * width;
  const auto getEnds = [&node](int end, int i) { return LoadFloats(&node.Ends[end][i]); };
  const unsigned int met = ray.FindMet(getEnds) & ((1U << (count < width ? count : width)) - 1U);
  PrefetchChildren(tree, level, number * width, met);
  way.Enter(number, met);
}

int FindSetOnRay(const PieceTreeLevels& tree, const ScatteredRays& rays, int ray,
  std::uint32_t startCell, WayThroughTree& way, unsigned int& pieces)
{
  const RayThroughBoxes through(rays, ray);
  std::uint32_t child;
  while (way.Take(child))
  {
    if (way.Level > 0)
    {
      EnterNode(tree, child, through, way);
      continue;
    }
    unsigned int met = FindBoxesOnRay(tree.Boxes[child], through);
    if (met != 0 && tree.Polygons)
    {
      met = ExceptIn(startCell, &tree.Cells[child * PieceBoxes::Capacity], met);
      met = met != 0 ? FindPolygonsOnRay(tree.Polygons[child], rays, ray, met) : 0;
    }
    if (met != 0)
    {
      pieces = met;
      return static_cast<int>(child);
    }
  }
  return -1;
}

}
}
