// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Single rays as they come to boxes. Included by Kernels.inl only.

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
    const Doubles begin = Load(&packet.Begin[first]);
    for (int axis = 0; axis < 3; ++axis)
    {
      direction[axis] = Load(&packet.Direction[axis][first]);
      const Doubles start = Load(&packet.Origin[axis][first]);
      // Where the ray begins; and, in the reach, many times over what rounding takes of that.
      origin[axis] = start + begin * direction[axis];
      reach = reach + 0x1p-30 * Abs(start);
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
      Store(across, &rays.Slope[k][first]);
      Store(origins[k + 1] - across * origins[0], &rays.Center[k][first]);
    }
    StoreRounded(0x1p-45 * (3.0 * largest + reach), &rays.Error[first]);
    StoreRounded(-0x1p-20 * reach, &rays.Begin[first]);
    Store(begin, &rays.FirstT[first]);
    Store(size, &rays.DepthOfT[first]);
    Store(reach, &rays.Reach[first]);
  }
}

/// A ray as it comes to boxes, whose lower ends along each axis have the numbers 0 to 2 and whose
/// upper ones have 3 to 5.
struct RayThroughBoxes
{
  /// Which of the ends of boxes it comes to first, and last.
  int First[3];
  int Last[3];
  float Rate[3];
  float Earlier[3];
  float Later[3];
  float Begin;
  float End;

  SIMD_INLINE RayThroughBoxes(const ScatteredRays& rays, int ray)
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

  /// As it comes to boxes in steps from a place, which may be off by an error.
  SIMD_INLINE RayThroughBoxes InSteps(const float lower[3], const float step[3], float error) const
  {
    RayThroughBoxes inSteps = *this;
    for (int axis = 0; axis < 3; ++axis)
    {
      const float atLower = this->Rate[axis] * lower[axis];
      inSteps.Rate[axis] = this->Rate[axis] * step[axis];
      const float room = error * std::fabs(inSteps.Rate[axis]);
      inSteps.Earlier[axis] = this->Earlier[axis] + atLower - room;
      inSteps.Later[axis] = this->Later[axis] + atLower + room;
    }
    return inSteps;
  }

  /// Of 16 boxes those that it may meet; a bit for each. Given the number of an end and of the
  /// first of a vector of boxes, the function returns their ends.
  template <typename GetEnds>
  SIMD_INLINE unsigned int FindMet(const GetEnds& getEnds) const
  {
    constexpr int count = PieceTreeNode::Width;
    unsigned int found = 0;
    for (int i = 0; i < count; i += FloatWidth)
    {
      Floats entry = this->Begin;
      Floats exit = this->End;
      for (int axis = 0; axis < 3; ++axis)
      {
        const Floats first = getEnds(this->First[axis], i);
        const Floats last = getEnds(this->Last[axis], i);
        entry = Max(entry, MultiplyAdd(this->Rate[axis], first, this->Earlier[axis]));
        exit = Min(exit, MultiplyAdd(this->Rate[axis], last, this->Later[axis]));
      }
      found |= (~ToBits(exit < entry) & ((1U << FloatWidth) - 1U)) << i;
    }
    return found;
  }

  /// Whether it may meet a box.
  SIMD_INLINE bool Meets(const float lower[3], const float upper[3]) const
  {
    float entry = this->Begin;
    float exit = this->End;
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool isDown = this->First[axis] != axis;
      const float first = isDown ? upper[axis] : lower[axis];
      const float last = isDown ? lower[axis] : upper[axis];
      entry = LargerOf(entry, this->Rate[axis] * first + this->Earlier[axis]);
      exit = SmallerOf(exit, this->Rate[axis] * last + this->Later[axis]);
    }
    return !(exit < entry);
  }
};

}
}
