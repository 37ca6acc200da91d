// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The light of segments, step by step: through a piece of the transfer functions, as far as the
// series of EmissionAbsorption.h goes. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// A piece of the transfer functions for each segment of a vector.
struct LoadedPieces
{
  Doubles Low;
  Doubles High;
  Doubles Anchor;
  Doubles AtAnchor[4];
  Doubles Slope[4];

  LoadedPieces() = default;
  SIMD_INLINE LoadedPieces(const TransferPieces& transfer, const int* numbers)
  {
    const double* rows[3][DoubleWidth];
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      const TransferPiece& piece = transfer.Pieces[numbers[lane]];
      rows[0][lane] = &piece.Low;
      rows[1][lane] = piece.AtAnchor;
      rows[2][lane] = piece.Slope;
    }
    Doubles ends[4];
    LoadFours(rows[0], ends);
    this->Low = ends[0];
    this->High = ends[1];
    this->Anchor = ends[2];
    LoadFours(rows[1], this->AtAnchor);
    LoadFours(rows[2], this->Slope);
  }

  /// The attenuation, or a colour.
  SIMD_INLINE Doubles Get(int function, Doubles value) const
  {
    const Doubles clamped = Min(Max(value, this->Low), this->High);
    return Max(
      this->AtAnchor[function] + this->Slope[function] * (clamped - this->Anchor), Doubles(0.0));
  }
};

/// The piece that a segment begins in, given its first value and whether its values rise.
SIMD_INLINE int FindPiece(const TransferPieces& transfer, int bin, double value, bool isRising)
{
  int piece = transfer.FirstInBin[bin];
  while (transfer.Pieces[piece].High < value)
  {
    ++piece;
  }
  return isRising && transfer.Pieces[piece].High == value ? piece + 1 : piece;
}

/// A vector of segments: the values of a component along them, and the pieces of its transfer
/// functions that they are in.
class SegmentValues
{
public:
  Doubles Begin;
  Doubles Change;
  int Numbers[DoubleWidth];

  SegmentValues() = default;
  SIMD_INLINE SegmentValues(const TransferPieces& transfer,
    const double (&values)[2][CloudSegments::Capacity], int first, int count)
    : Begin(Load(&values[0][first]))
    , Change(Load(&values[1][first]) - this->Begin)
    , Rising(ToBits(0.0 < this->Change))
    , Inverse(1.0 / this->Change)
  {
    const Doubles bin = Floor((this->Begin - transfer.First) * transfer.BinsPerUnit);
    StoreTruncated(Max(Min(bin, Doubles(transfer.Bins - 1)), Doubles(0.0)), this->Numbers);
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      this->Numbers[lane] = lane < count
        ? FindPiece(transfer, this->Numbers[lane], values[0][first + lane], this->IsRising(lane))
        : this->Numbers[0];
    }
  }

  /// The value at x, from 0 to 1.
  SIMD_INLINE Doubles Get(Doubles x) const { return this->Begin + x * this->Change; }

  /// The x at which the pieces end; 1 where values do not change.
  SIMD_INLINE Doubles FindBorder(const LoadedPieces& pieces) const
  {
    const Doubles ahead = Select(0.0 < this->Change, pieces.High, pieces.Low);
    return Select(this->Change == 0.0, Doubles(1.0), (ahead - this->Begin) * this->Inverse);
  }

  /// Goes on to the next pieces.
  SIMD_INLINE void Move(Mask isMoved)
  {
    const unsigned int moving = ToBits(isMoved);
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      if ((moving >> lane & 1U) != 0)
      {
        this->Numbers[lane] += this->IsRising(lane) ? 1 : -1;
      }
    }
  }

private:
  SIMD_INLINE bool IsRising(int lane) const { return (this->Rising >> lane & 1U) != 0; }

  unsigned int Rising;
  Doubles Inverse;
};

/// The lengths of segments in the world.
SIMD_INLINE Doubles FindLengths(
  const CloudTile& tile, const CloudSegments& segments, int first, int count)
{
  int pixels[DoubleWidth] = {};
  for (int lane = 0; lane < count; ++lane)
  {
    pixels[lane] = segments.Pixel[first + lane];
  }
  return Gather(tile.Length, pixels) *
    (Load(&segments.Depth[1][first]) - Load(&segments.Depth[0][first]));
}

SIMD_INLINE void StoreLights(
  const Doubles color[3], Doubles transmittance, int count, SegmentLight* lights)
{
  double stored[4][DoubleWidth];
  for (int i = 0; i < 3; ++i)
  {
    Store(color[i], stored[i]);
  }
  Store(transmittance, stored[3]);
  for (int lane = 0; lane < count; ++lane)
  {
    lights[lane] = { { static_cast<float>(stored[0][lane]), static_cast<float>(stored[1][lane]),
                       static_cast<float>(stored[2][lane]) },
      static_cast<float>(stored[3][lane]) };
  }
}

/// Less light than this is not followed.
constexpr double LeastTransmittance = 0x1p-20;

void IntegrateSegments(const CloudTile& tile, const TransferPieces& transfer,
  const CloudSegments& segments, SegmentLight* lights)
{
  for (int first = 0; first < segments.Count; first += DoubleWidth)
  {
    const int count = SmallerOf(segments.Count - first, DoubleWidth);
    const Doubles length = FindLengths(tile, segments, first, count);
    SegmentValues values(transfer, segments.Value[0], first, count);

    // What is left of each segment begins at x.
    Doubles x = 0.0;
    Doubles light[3] = { 0.0, 0.0, 0.0 };
    Doubles transmittance = 1.0;
    Mask isOpen = FirstLanes(count);
    while (Any(isOpen))
    {
      const LoadedPieces pieces(transfer, values.Numbers);
      const Doubles end = Min(Max(values.FindBorder(pieces), x), Doubles(1.0));
      const Doubles valueHere = values.Get(x);
      const Doubles here = pieces.Get(0, valueHere);
      Doubles next = end;
      AbsorptionStep<Doubles> step(
        here * (length * (end - x)), pieces.Get(0, values.Get(end)) * (length * (end - x)));
      const Mask isTooDeep = isOpen & (LargestStepDepth < step.GetDepth());
      if (Any(isTooDeep))
      {
        next = Select(isTooDeep, x + step.FindLargest() * (end - x), end);
        step = AbsorptionStep<Doubles>(
          here * (length * (next - x)), pieces.Get(0, values.Get(next)) * (length * (next - x)));
      }
      // So deep that a step has no length: nothing passes.
      const Mask isPassed = (x < next) | (end <= x);
      const Doubles passing = Select(isPassed, step.GetTransmittance(), Doubles(0.0));
      const Doubles mean = Select(isPassed, step.GetMeanTransmittance(), Doubles(0.0));
      const Doubles weights[2] = { transmittance * (1.0 - mean), transmittance * (mean - passing) };
      const Doubles valueNext = values.Get(next);
      for (int i = 0; i < 3; ++i)
      {
        const Doubles added =
          pieces.Get(1 + i, valueHere) * weights[0] + pieces.Get(1 + i, valueNext) * weights[1];
        light[i] = Select(isOpen, light[i] + added, light[i]);
      }
      transmittance = Select(isOpen, transmittance * passing, transmittance);
      const Mask isStep = next < end;
      x = next;
      isOpen = isOpen & (isStep | (end < 1.0)) & (LeastTransmittance < transmittance);
      values.Move(AndNot(isOpen, isStep));
    }
    StoreLights(light, transmittance, count, lights + first);
  }
}

}
}
