// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What a single ray may meet in a mesh. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

unsigned int FindChildrenOnRay(const CellTreeNode& node, const RayThroughBoxes& ray, float end,
  const IsovalueSpan* isovalues, int count, float* near)
{
  unsigned int found = 0;
  for (int i = 0; i < CellTreeNode::Width; i += FloatWidth)
  {
    const unsigned int active = FindActive(node, i, isovalues, count);
    if (active == 0)
    {
      continue;
    }
    Floats entry = ray.Begin;
    Floats exit = end;
    for (int axis = 0; axis < 3; ++axis)
    {
      const float* lower = &node.Lower[axis][i];
      const float* upper = &node.Upper[axis][i];
      const Floats first = LoadFloats(ray.IsUp[axis] ? lower : upper);
      const Floats last = LoadFloats(ray.IsUp[axis] ? upper : lower);
      entry = Max(entry, MultiplyAdd(ray.Rate[axis], first, ray.Earlier[axis]));
      exit = Min(exit, MultiplyAdd(ray.Rate[axis], last, ray.Later[axis]));
    }
    StoreFloats(entry, &near[i]);
    found |= (active & ~ToBits(exit < entry)) << i;
  }
  return found;
}

/// Without branches: whether a ray meets a box is unpredictable.
unsigned int FindSetsOnRay(
  const PackedPieces* sets, int count, const RayThroughBoxes& ray, float end)
{
  unsigned int found = 0;
  for (int i = 0; i < count; ++i)
  {
    float entry = ray.Begin;
    float exit = end;
    for (int axis = 0; axis < 3; ++axis)
    {
      const float lower = sets[i].Lower[axis];
      const float upper = sets[i].Upper[axis];
      const float first = ray.Rate[axis] * (ray.IsUp[axis] ? lower : upper) + ray.Earlier[axis];
      const float last = ray.Rate[axis] * (ray.IsUp[axis] ? upper : lower) + ray.Later[axis];
      entry = entry < first ? first : entry;
      exit = last < exit ? last : exit;
    }
    found |= static_cast<unsigned int>(!(exit < entry)) << i;
  }
  return found;
}

/// A ray as it comes to points that are packed in steps of a box, which are half a step off at
/// most.
struct RayThroughSteps
{
  float Rate[3];
  float Earlier[3];
  float Later[3];

  SIMD_INLINE RayThroughSteps(const PackedPieces& packed, const RayThroughBoxes& ray)
  {
    constexpr float perStep = 1.0F / static_cast<float>(PackedPieces::Steps);
    for (int axis = 0; axis < 3; ++axis)
    {
      const float lower = packed.Lower[axis];
      this->Rate[axis] = ray.Rate[axis] * ((packed.Upper[axis] - lower) * perStep);
      const float first =
        ray.Rate[axis] * static_cast<float>(static_cast<double>(lower) - ray.Place[axis]);
      const float room = ray.Room[axis] + 0.51F * std::fabs(this->Rate[axis]);
      this->Earlier[axis] = first - room;
      this->Later[axis] = first + room;
    }
  }
};

/// The pieces of a set with so many corners whose boxes a ray may meet before a depth; a bit for
/// each.
template <int Corners>
SIMD_INLINE unsigned int FindBoxedPiecesOnRay(
  const PackedPieces& packed, const RayThroughBoxes& ray, float end)
{
  constexpr unsigned int mask = PackedPieces::Steps;
  const RayThroughSteps steps(packed, ray);
  unsigned int found = 0;
  for (int i = 0; i < packed.Count; i += FloatWidth)
  {
    Floats entry = ray.Begin;
    Floats exit = end;
    for (int axis = 0; axis < 3; ++axis)
    {
      Floats lower = GetBits(&packed.Polygons[0][i], PackedPieces::Bits * axis, mask);
      Floats upper = lower;
      for (int corner = 1; corner < Corners; ++corner)
      {
        const Floats place = GetBits(&packed.Polygons[corner][i], PackedPieces::Bits * axis, mask);
        lower = Min(lower, place);
        upper = Max(upper, place);
      }
      const Floats first = ray.IsUp[axis] ? lower : upper;
      const Floats last = ray.IsUp[axis] ? upper : lower;
      entry = Max(entry, MultiplyAdd(steps.Rate[axis], first, steps.Earlier[axis]));
      exit = Min(exit, MultiplyAdd(steps.Rate[axis], last, steps.Later[axis]));
    }
    found |= (~ToBits(exit < entry) & ((1U << FloatWidth) - 1U)) << i;
  }
  return found & ((1U << packed.Count) - 1U);
}

/// Those of some polygons of a set that a ray may meet, given its frame, in which it has the label
/// 0; a bit for each. A polygon that it meets has all edges on one side of it, so it does not have
/// two on different sides by more than the margin moves them. (What rounding does to areas is a
/// part of the margin, in which there is an error of 2^-21 of the largest labels.)
SIMD_INLINE unsigned int FindPolygonsOnRay(
  const PackedPieces& packed, const BeamNumbers& frame, unsigned int among)
{
  constexpr int corners = PackedPieces::Corners;
  constexpr unsigned int mask = PackedPieces::Steps;
  constexpr unsigned int lanes = (1U << FloatWidth) - 1U;
  const PackedProjection projection(packed, frame);
  const float errors[2] = { projection.X.Error, projection.Y.Error };
  const float margin = (errors[0] < errors[1] ? errors[1] : errors[0]) + frame.Margin + LabelMargin;
  unsigned int beside = 0;
  for (int first = 0; first < packed.Count && projection.IsBounded(); first += FloatWidth)
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
      const Floats z = GetBits(words, PackedPieces::Bits * frame.Along, mask);
      x[i] = projection.X.Get(GetBits(words, PackedPieces::Bits * frame.Across[0], mask), z);
      y[i] = projection.Y.Get(GetBits(words, PackedPieces::Bits * frame.Across[1], mask), z);
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

/// Boxes come first: of most sets none is met.
unsigned int FindPiecesOnRay(
  const PackedPieces& packed, const BeamNumbers& frame, const RayThroughBoxes& ray, float end)
{
  if (!packed.AreInTetrahedra)
  {
    return FindBoxedPiecesOnRay<2>(packed, ray, end);
  }
  const unsigned int found = FindBoxedPiecesOnRay<PackedPieces::Corners>(packed, ray, end);
  return found == 0 ? 0 : FindPolygonsOnRay(packed, frame, found);
}

}
}
