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

/// Of as many sets of pieces as a vector has numbers, from one on, those that rays of a pencil may
/// meet; a bit for each.
SIMD_INLINE unsigned int FindSetsInPencil(
  const PackedPieces* sets, int first, int numberOfSets, const RaysInPencil& some)
{
  const float* lower[FloatWidth];
  for (int lane = 0; lane < FloatWidth; ++lane)
  {
    lower[lane] = sets[SmallerOf(first + lane, numberOfSets - 1)].Lower;
  }
  // The lower bounds and, behind them, the upper ones.
  Floats bounds[8];
  LoadFours(lower, bounds);
  LoadFours(lower, bounds + 4, 2);
  const auto getDepths = [&bounds](const PencilThroughBoxes::Side& side)
  {
    const Floats& bound = bounds[side.Axis + (side.IsUpper ? 5 : 0)];
    return MultiplyAdd(side.Rate, bound, side.Depth);
  };
  const PencilThroughBoxes& pencil = some.Pencil;
  Floats entry = pencil.Begin;
  Floats exit = some.End;
  for (int side = 0; side < pencil.NumberOfEntries; ++side)
  {
    entry = Max(entry, getDepths(pencil.Bounds[side]));
  }
  for (int side = pencil.NumberOfEntries; side < PencilThroughBoxes::Sides; ++side)
  {
    exit = Min(exit, getDepths(pencil.Bounds[side]));
  }
  const int count = SmallerOf(numberOfSets - first, FloatWidth);
  return ~ToBits(exit < entry) & ((1U << count) - 1U);
}

/// The box of a set of pieces as rays of a pencil come to it, which have one axis and sign. A ray
/// that comes into it is, at its middle depth, no farther from its middle than half of its size and
/// half of what the ray moves across within its depths. So is what is between rays.
struct BoxOnRays
{
  float Depth;
  float HalfDepth;
  float Middle[2];
  float Half[2];

  SIMD_INLINE BoxOnRays(const PackedPieces& set, const BeamNumbers& frame, float error)
  {
    const auto getMiddle = [&set](int axis) { return 0.5F * (set.Lower[axis] + set.Upper[axis]); };
    const auto getHalf = [&set, error](int axis)
    { return 0.5F * (set.Upper[axis] - set.Lower[axis]) + error; };
    this->Depth =
      static_cast<float>(frame.Sign * (static_cast<double>(getMiddle(frame.Along)) - frame.Plane));
    this->HalfDepth = getHalf(frame.Along);
    for (int k = 0; k < 2; ++k)
    {
      this->Middle[k] = getMiddle(frame.Across[k]);
      this->Half[k] = getHalf(frame.Across[k]);
    }
  }

  /// Which of the rays in places from one on, as many as a vector has numbers, may come to it; a
  /// bit for each.
  SIMD_INLINE unsigned int FindRays(const LoneRays& rays, int firstPlace) const
  {
    FloatMask isBeside = this->IsBeside(&rays.Begin[firstPlace], &rays.End[firstPlace]);
    for (int k = 0; k < 2; ++k)
    {
      const Floats rate = LoadFloats(&rays.Rate[k][firstPlace]);
      const Floats center = LoadFloats(&rays.Center[k][firstPlace]) - this->Middle[k];
      const Floats distance = Abs(MultiplyAdd(rate, this->Depth, center));
      const Floats most = MultiplyAdd(Abs(rate), this->HalfDepth, this->Half[k]);
      isBeside = isBeside | (most < distance);
    }
    return ~ToBits(isBeside) & ((1U << FloatWidth) - 1U);
  }

  /// The same of groups.
  SIMD_INLINE unsigned int FindGroups(const LoneRays& rays, int firstGroup) const
  {
    FloatMask isBeside = this->IsBeside(&rays.GroupBegin[firstGroup], &rays.GroupEnd[firstGroup]);
    for (int k = 0; k < 2; ++k)
    {
      const Floats lowerRate = LoadFloats(&rays.LowerRate[k][firstGroup]);
      const Floats upperRate = LoadFloats(&rays.UpperRate[k][firstGroup]);
      const Floats lower = LoadFloats(&rays.Lower[k][firstGroup]) - this->Middle[k];
      const Floats upper = LoadFloats(&rays.Upper[k][firstGroup]) - this->Middle[k];
      const Floats mostLower = MultiplyAdd(Abs(lowerRate), this->HalfDepth, this->Half[k]);
      const Floats mostUpper = MultiplyAdd(Abs(upperRate), this->HalfDepth, this->Half[k]);
      isBeside = isBeside | (mostLower < MultiplyAdd(lowerRate, this->Depth, lower)) |
        (MultiplyAdd(upperRate, this->Depth, upper) + mostUpper < 0.0F);
    }
    return ~ToBits(isBeside) & ((1U << FloatWidth) - 1U);
  }

  /// Which of many begin behind it, or end before it.
  SIMD_INLINE FloatMask IsBeside(const float* begin, const float* end) const
  {
    return (LoadFloats(end) < this->Depth - this->HalfDepth) |
      (this->Depth + this->HalfDepth < LoadFloats(begin));
  }
};

/// Those of the groups of a pencil that may meet a set of pieces; a bit for each.
SIMD_INLINE unsigned int FindGroupsAtSet(
  const BoxOnRays& box, const LoneRays& rays, const RaysInPencil& some)
{
  const int first = some.FirstPlace / LoneRays::GroupSize;
  const int last = (some.FirstPlace + some.Count - 1) / LoneRays::GroupSize;
  if (first == last)
  {
    return 1U << first; // It is the pencil.
  }
  unsigned int found = 0;
  for (int group = first; group <= last; group += FloatWidth)
  {
    found |= box.FindGroups(rays, group) << group;
  }
  return found & ((2U << last) - 1U);
}

/// Those of the rays of a pencil in a group that may meet a set of pieces; a bit for each place.
SIMD_INLINE unsigned int FindRaysAtSet(
  const BoxOnRays& box, const LoneRays& rays, const RaysInPencil& some, int firstPlace)
{
  constexpr int size = LoneRays::GroupSize;
  unsigned int found = 0;
  for (int i = 0; i < size; i += FloatWidth)
  {
    found |= box.FindRays(rays, firstPlace + i) << i;
  }
  const int before = some.FirstPlace < firstPlace ? 0 : some.FirstPlace - firstPlace;
  const int end = SmallerOf(some.FirstPlace + some.Count - firstPlace, size);
  return found & ((1U << end) - (1U << before));
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

/// Those of some polygons of a set that a ray may meet, given its frame, in which it has the label
/// 0; a bit for each.
SIMD_INLINE unsigned int FindPolygonsOnRay(
  const PackedPieces& packed, const BeamNumbers& frame, unsigned int among)
{
  const PackedProjection projection(packed, frame);
  const float error = LargerOf(projection.X.Error, projection.Y.Error);
  return FindPolygonsAround(packed, projection.X, projection.Y, frame.Along, frame.Across,
    error + frame.Margin + LabelMargin, among);
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

/// The boxes of the pieces of a set.
SIMD_INLINE void UnpackBoxes(const PackedPieces& packed, BoxesInSteps& boxes)
{
  if (packed.AreInTetrahedra)
  {
    boxes.Unpack<PackedPieces::Corners>(packed);
  }
  else
  {
    boxes.Unpack<2>(packed);
  }
}

/// Adds what a ray may meet.
SIMD_INLINE void AddPiecesOnRay(const PackedPieces& packed, const BoxesInSteps& boxes,
  const LoneRays& rays, int place, MetPieces& met)
{
  const unsigned int found = FindPiecesOnRay(packed, boxes, rays, place);
  met.Place[met.Count] = place;
  met.Pieces[met.Count] = found;
  met.Count += found != 0 ? 1 : 0;
}

/// Those that the rays of a pencil may meet in a set that the pencil comes to.
SIMD_INLINE void FindPiecesInSet(
  const PackedPieces& packed, const LoneRays& rays, const RaysInPencil& some, MetPieces& met)
{
  BoxesInSteps boxes;
  if (some.Count == 1) // The pencil is the ray.
  {
    UnpackBoxes(packed, boxes);
    AddPiecesOnRay(packed, boxes, rays, some.FirstPlace, met);
    return;
  }
  const BoxOnRays box(packed, rays.Frame[rays.Ray[some.FirstPlace]], rays.Error);
  bool areUnpacked = false;
  for (unsigned int groups = FindGroupsAtSet(box, rays, some); groups != 0; groups &= groups - 1)
  {
    const int firstPlace = LowestBit(groups) * LoneRays::GroupSize;
    const unsigned int atSet = FindRaysAtSet(box, rays, some, firstPlace);
    if (atSet != 0 && !areUnpacked)
    {
      UnpackBoxes(packed, boxes);
      areUnpacked = true;
    }
    for (unsigned int left = atSet; left != 0; left &= left - 1)
    {
      AddPiecesOnRay(packed, boxes, rays, firstPlace + LowestBit(left), met);
    }
  }
}

int FindPiecesOnRays(const PackedPieces* sets, int firstSet, int numberOfSets, const LoneRays& rays,
  const RaysInPencil& some, MetPieces& met)
{
  met.Count = 0;
  for (int first = firstSet; first < numberOfSets; first += FloatWidth)
  {
    for (unsigned int left = FindSetsInPencil(sets, first, numberOfSets, some); left != 0;
         left &= left - 1)
    {
      const int set = first + LowestBit(left);
      FindPiecesInSet(sets[set], rays, some, met);
      if (met.Count > 0)
      {
        return set + 1;
      }
    }
  }
  return numberOfSets;
}

}
}
