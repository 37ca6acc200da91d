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

void IntegrateSegments(const CloudTile& tile, const TransferPieces& transfer,
  const CloudSegments& segments, SegmentLight* lights)
{
  for (int first = 0; first < segments.Count; first += DoubleWidth)
  {
    const int count = SmallerOf(segments.Count - first, DoubleWidth);
    const Doubles begin = Load(&segments.Value[0][first]);
    const Doubles change = Load(&segments.Value[1][first]) - begin;
    int numbers[DoubleWidth] = {};
    for (int lane = 0; lane < count; ++lane)
    {
      numbers[lane] = segments.Pixel[first + lane];
    }
    const Doubles length = Gather(tile.Length, numbers) *
      (Load(&segments.Depth[1][first]) - Load(&segments.Depth[0][first]));

    const Doubles bin = Floor((begin - transfer.First) * transfer.BinsPerUnit);
    StoreTruncated(Max(Min(bin, Doubles(transfer.Bins - 1)), Doubles(0.0)), numbers);
    const unsigned int rising = ToBits(0.0 < change);
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      numbers[lane] = lane < count ? FindPiece(transfer, numbers[lane],
                                       segments.Value[0][first + lane], (rising >> lane & 1U) != 0)
                                   : numbers[0];
    }

    // What is left of each segment begins at x.
    Doubles x = 0.0;
    Doubles light[3] = { 0.0, 0.0, 0.0 };
    Doubles transmittance = 1.0;
    Mask isOpen = FirstLanes(count);
    const Doubles inverse = 1.0 / change;
    while (Any(isOpen))
    {
      const LoadedPieces pieces(transfer, numbers);
      const Doubles ahead = Select(0.0 < change, pieces.High, pieces.Low);
      const Doubles border = Select(change == 0.0, Doubles(1.0), (ahead - begin) * inverse);
      const Doubles end = Min(Max(border, x), Doubles(1.0));
      const Doubles valueHere = begin + x * change;
      const Doubles here = pieces.Get(0, valueHere);
      Doubles next = end;
      AbsorptionStep<Doubles> step(
        here * (length * (end - x)), pieces.Get(0, begin + end * change) * (length * (end - x)));
      const Mask isTooDeep = isOpen & (LargestStepDepth < step.GetDepth());
      if (Any(isTooDeep))
      {
        next = Select(isTooDeep, x + step.FindLargest() * (end - x), end);
        step = AbsorptionStep<Doubles>(here * (length * (next - x)),
          pieces.Get(0, begin + next * change) * (length * (next - x)));
      }
      // So deep that a step has no length: nothing passes.
      const Mask isPassed = (x < next) | (end <= x);
      const Doubles passing = Select(isPassed, step.GetTransmittance(), Doubles(0.0));
      const Doubles mean = Select(isPassed, step.GetMeanTransmittance(), Doubles(0.0));
      const Doubles weights[2] = { transmittance * (1.0 - mean), transmittance * (mean - passing) };
      const Doubles valueNext = begin + next * change;
      for (int i = 0; i < 3; ++i)
      {
        const Doubles added =
          pieces.Get(1 + i, valueHere) * weights[0] + pieces.Get(1 + i, valueNext) * weights[1];
        light[i] = Select(isOpen, light[i] + added, light[i]);
      }
      transmittance = Select(isOpen, transmittance * passing, transmittance);
      const Mask isStep = next < end;
      x = next;
      isOpen = isOpen & (isStep | (end < 1.0)) & (0x1p-20 < transmittance);
      const unsigned int moving = ToBits(AndNot(isOpen, isStep));
      for (int lane = 0; lane < DoubleWidth; ++lane)
      {
        if ((moving >> lane & 1U) != 0)
        {
          numbers[lane] += (rising >> lane & 1U) != 0 ? 1 : -1;
        }
      }
    }

    double stored[4][DoubleWidth];
    for (int i = 0; i < 3; ++i)
    {
      Store(light[i], stored[i]);
    }
    Store(transmittance, stored[3]);
    for (int lane = 0; lane < count; ++lane)
    {
      lights[first + lane] = { { static_cast<float>(stored[0][lane]),
                                 static_cast<float>(stored[1][lane]),
                                 static_cast<float>(stored[2][lane]) },
        static_cast<float>(stored[3][lane]) };
    }
  }
}

}
}
