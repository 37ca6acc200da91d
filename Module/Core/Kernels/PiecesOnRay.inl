// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What single rays may meet in a mesh. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

unsigned int FindChildrenInPencil(const CellTreeNode& node, const PencilThroughBoxes& pencil,
  float end, const IsovalueSpan* isovalues, int count, float* near)
{
  unsigned int found = 0;
  for (int i = 0; i < CellTreeNode::Width; i += FloatWidth)
  {
    const unsigned int active = FindActive(node, i, isovalues, count);
    if (active == 0)
    {
      continue;
    }
    const auto getDepths = [&node, i](const PencilThroughBoxes::Side& side)
    {
      const auto& coordinates = side.IsUpper ? node.Upper : node.Lower;
      return MultiplyAdd(side.Rate, LoadFloats(&coordinates[side.Axis][i]), side.Depth);
    };
    Floats entry = pencil.Begin;
    Floats exit = end;
    for (int side = 0; side < pencil.NumberOfEntries; ++side)
    {
      entry = Max(entry, getDepths(pencil.Bounds[side]));
    }
    for (int side = pencil.NumberOfEntries; side < PencilThroughBoxes::Sides; ++side)
    {
      exit = Min(exit, getDepths(pencil.Bounds[side]));
    }
    StoreFloats(entry, &near[i]);
    found |= (active & ~ToBits(exit < entry)) << i;
  }
  return found;
}

/// As many rays as a vector has numbers, as they come to boxes.
struct RaysThroughBoxes
{
  Floats Rate[3];
  Floats Earlier[3];
  Floats Later[3];
  Floats Begin;
  Floats End;

  /// Those in consecutive places.
  SIMD_INLINE RaysThroughBoxes(const LoneRays& rays, int firstPlace)
    : Begin(LoadFloats(&rays.Begin[firstPlace]))
    , End(LoadFloats(&rays.End[firstPlace]))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Rate[axis] = LoadFloats(&rays.Rate[axis][firstPlace]);
      this->Earlier[axis] = LoadFloats(&rays.Earlier[axis][firstPlace]);
      this->Later[axis] = LoadFloats(&rays.Later[axis][firstPlace]);
    }
  }

  /// Which of the first ones may meet a set of pieces; a bit for each.
  SIMD_INLINE unsigned int FindAtSet(const PackedPieces& set, int count) const
  {
    Floats entry = this->Begin;
    Floats exit = this->End;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Floats lower = this->Rate[axis] * set.Lower[axis];
      const Floats upper = this->Rate[axis] * set.Upper[axis];
      entry = Max(entry, Min(lower, upper) + this->Earlier[axis]);
      exit = Min(exit, Max(lower, upper) + this->Later[axis]);
    }
    return ~ToBits(exit < entry) & ((1U << count) - 1U);
  }
};

/// Those of some rays in consecutive places that may meet a set of pieces, counted from the first
/// of them.
SIMD_INLINE RaySet FindRaysAtSet(
  const PackedPieces& set, const LoneRays& rays, int firstPlace, int count)
{
  RaySet found = {};
  for (int word = 0; 64 * word < count; ++word)
  {
    std::uint64_t bits = 0;
    const int last = count < 64 * (word + 1) ? count : 64 * (word + 1);
    for (int i = 64 * word; i < last; i += FloatWidth)
    {
      const int some = last - i < FloatWidth ? last - i : FloatWidth;
      const RaysThroughBoxes these(rays, firstPlace + i);
      bits |= static_cast<std::uint64_t>(these.FindAtSet(set, some)) << (i % 64);
    }
    found.Words[word] = bits;
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

/// The boxes of the pieces of a set, in steps of its own.
struct BoxesInSteps
{
  alignas(64) float Lower[3][PackedPieces::Capacity];
  alignas(64) float Upper[3][PackedPieces::Capacity];

  /// Of pieces with so many corners.
  template <int Corners>
  SIMD_INLINE void Unpack(const PackedPieces& packed)
  {
    constexpr unsigned int mask = PackedPieces::Steps;
    for (int i = 0; i < packed.Count; i += FloatWidth)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        Floats lower = GetBits(&packed.Polygons[0][i], PackedPieces::Bits * axis, mask);
        Floats upper = lower;
        for (int corner = 1; corner < Corners; ++corner)
        {
          const Floats place =
            GetBits(&packed.Polygons[corner][i], PackedPieces::Bits * axis, mask);
          lower = Min(lower, place);
          upper = Max(upper, place);
        }
        StoreFloats(lower, &this->Lower[axis][i]);
        StoreFloats(upper, &this->Upper[axis][i]);
      }
    }
  }
};

/// Those of the pieces of a set whose boxes a ray may meet before a depth; a bit for each.
SIMD_INLINE unsigned int FindBoxesOnRay(
  const PackedPieces& packed, const BoxesInSteps& boxes, const RayThroughBoxes& ray, float end)
{
  const RayThroughSteps steps(packed, ray);
  unsigned int found = 0;
  for (int i = 0; i < packed.Count; i += FloatWidth)
  {
    Floats entry = ray.Begin;
    Floats exit = end;
    for (int axis = 0; axis < 3; ++axis)
    {
      const float* lower = &boxes.Lower[axis][i];
      const float* upper = &boxes.Upper[axis][i];
      const Floats first = LoadFloats(ray.IsUp[axis] ? lower : upper);
      const Floats last = LoadFloats(ray.IsUp[axis] ? upper : lower);
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

/// Those of the pieces of a set that a ray may meet. Boxes come first: of most sets none is met.
SIMD_INLINE unsigned int FindPiecesOnRay(
  const PackedPieces& packed, const BoxesInSteps& boxes, const LoneRays& rays, int place)
{
  const int ray = rays.Ray[place];
  const unsigned int found = FindBoxesOnRay(packed, boxes, rays.Through[ray], rays.End[place]);
  return found != 0 && packed.AreInTetrahedra ? FindPolygonsOnRay(packed, rays.Frame[ray], found)
                                              : found;
}

int FindPiecesOnRays(const PackedPieces* sets, int firstSet, int numberOfSets, const LoneRays& rays,
  int firstPlace, int count, MetPieces& met)
{
  met.Count = 0;
  int set = firstSet;
  while (met.Count == 0 && set < numberOfSets)
  {
    const PackedPieces& packed = sets[set++];
    const RaySet atSet = FindRaysAtSet(packed, rays, firstPlace, count);
    // (Not by functions of RaySet: they may be compiled as such, for this instruction set.)
    if ((atSet.Words[0] | atSet.Words[1]) == 0)
    {
      continue;
    }
    BoxesInSteps boxes;
    if (packed.AreInTetrahedra)
    {
      boxes.Unpack<PackedPieces::Corners>(packed);
    }
    else
    {
      boxes.Unpack<2>(packed);
    }
    for (int word = 0; word < 2; ++word)
    {
      for (std::uint64_t left = atSet.Words[word]; left != 0; left &= left - 1)
      {
        const int place = firstPlace + 64 * word + LowestBit(left);
        const unsigned int found = FindPiecesOnRay(packed, boxes, rays, place);
        met.Place[met.Count] = place;
        met.Pieces[met.Count] = found;
        met.Count += found != 0 ? 1 : 0;
      }
    }
  }
  return set;
}

}
}
