// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Operations for which only AVX-512 has instructions, composed of those that every set has.
// Included by Vectors.h only; see VectorsAvx512.h for what the functions do.

namespace vtkIsosurfaceRayTracing
{
namespace
{

SIMD_INLINE Mask ToMask(unsigned int bits)
{
  double lanes[DoubleWidth];
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    lanes[lane] = static_cast<double>(bits >> lane & 1U);
  }
  return Doubles(0.0) < Load(lanes);
}
SIMD_INLINE void StorePairs(Doubles first, Doubles second, float (*pairs)[2])
{
  double lanes[2][DoubleWidth];
  Store(first, lanes[0]);
  Store(second, lanes[1]);
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    pairs[lane][0] = static_cast<float>(lanes[0][lane]);
    pairs[lane][1] = static_cast<float>(lanes[1][lane]);
  }
}
SIMD_INLINE int AppendLanes(int first, unsigned int lanes, int* numbers)
{
  int count = 0;
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    numbers[count] = first + lane;
    count += static_cast<int>(lanes >> lane & 1U);
  }
  return count;
}
SIMD_INLINE void StoreLanes(Doubles a, unsigned int lanes, double* to)
{
  double all[DoubleWidth];
  Store(a, all);
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    *to = all[lane];
    to += lanes >> lane & 1U;
  }
}
SIMD_INLINE int CopyLanes(const int* from, unsigned int lanes, int* to)
{
  int count = 0;
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    to[count] = from[lane];
    count += static_cast<int>(lanes >> lane & 1U);
  }
  return count;
}
SIMD_INLINE Floats MaxAbs(Floats a, Floats b)
{
  return Max(Abs(a), Abs(b));
}

}
}
