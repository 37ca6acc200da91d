// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Boxes of a tree over cells that reach above all of some sides: rows whose products with
// (x, y, z, 1) are positive above them. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// More than single precision loses in the sum of a side, in parts of its terms.
constexpr float SideRounding = 1e-6F;

/// The lanes that are met, given the least of their sums; a bit for each, from the first child on.
/// Undefined sums are met, too.
SIMD_INLINE unsigned int FindMetLanes(Floats least, int first)
{
  return (~ToBits(least < 0.0F) & ((1U << FloatWidth) - 1U)) << first;
}

unsigned int FindMetChildren(const CellTreeNode& node, const double (*sides)[4], int count)
{
  unsigned int met = 0;
  for (int first = 0; first < CellTreeNode::Width; first += FloatWidth)
  {
    Floats least = FloatInfinity;
    for (int i = 0; i < count; ++i)
    {
      const Floats base = static_cast<float>(sides[i][3]);
      Floats sum = base;
      Floats size = Abs(base);
      for (int axis = 0; axis < 3; ++axis)
      {
        const Floats slope = static_cast<float>(sides[i][axis]);
        const Floats lower = slope * LoadFloats(&node.Lower[axis][first]);
        const Floats upper = slope * LoadFloats(&node.Upper[axis][first]);
        sum = sum + Max(lower, upper);
        size = size + MaxAbs(lower, upper);
      }
      least = Min(least, sum + SideRounding * size);
    }
    met |= FindMetLanes(least, first);
  }
  return met;
}

/// A side, in steps of the box of a block.
struct SideOfBlock
{
  float Base;
  float Slope[3];
  /// The ends of boxes that are higher, along each axis.
  int Higher[3];

  SIMD_INLINE SideOfBlock(const double side[4], const CellTreeNode& node, int block)
  {
    double base = side[3];
    float reach = 0.0F;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto low = static_cast<double>(node.Lower[axis][block]);
      const auto high = static_cast<double>(node.Upper[axis][block]);
      base += side[axis] * low;
      this->Slope[axis] = static_cast<float>(side[axis] * ((high - low) / BlockOfBoxes::Steps));
      this->Higher[axis] = side[axis] > 0.0 ? 3 + axis : axis;
      reach += std::fabs(this->Slope[axis]);
    }
    this->Base = static_cast<float>(base);
    this->Base += SideRounding * (std::fabs(this->Base) + BlockOfBoxes::Steps * reach);
  }
};

unsigned int FindMetCells(const CellTreeNode& node, int block, const BlockOfBoxes& boxes,
  const double (*sides)[4], int count)
{
  Floats least[CellTreeNode::Width / FloatWidth];
  for (Floats& some : least)
  {
    some = FloatInfinity;
  }
  for (int i = 0; i < count; ++i)
  {
    const SideOfBlock side(sides[i], node, block);
    int first = 0;
    for (Floats& some : least)
    {
      Floats sum = side.Base;
      for (int axis = 0; axis < 3; ++axis)
      {
        sum = sum + side.Slope[axis] * LoadBytes(&boxes.Ends[side.Higher[axis]][first]);
      }
      some = Min(some, sum);
      first += FloatWidth;
    }
  }
  unsigned int met = 0;
  int first = 0;
  for (const Floats& some : least)
  {
    met |= FindMetLanes(some, first);
    first += FloatWidth;
  }
  return met;
}

}
}
