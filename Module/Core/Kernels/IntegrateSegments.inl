// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The light of segments, step by step: through a piece of the transfer functions, as far as the
// series of EmissionAbsorption.h goes. Most segments take one step, for which single precision
// suffices. Included by Kernels.inl only.

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

/// The intervals that values are in: for those that are no number, the last one.
SIMD_INLINE void FindBins(const TransferPieces& transfer, Doubles values, int* bins)
{
  const Doubles bin = Floor((values - transfer.First) * transfer.BinsPerUnit);
  StoreTruncated(Max(Doubles(0.0), Min(Doubles(transfer.Bins - 1), bin)), bins);
}

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
  SIMD_INLINE SegmentValues(const TransferPieces& transfer, Doubles begin, Doubles end, int count)
    : Begin(begin)
    , Change(end - begin)
    , Rising(ToBits(0.0 < this->Change))
    , Inverse(1.0 / this->Change)
  {
    double values[DoubleWidth];
    Store(begin, values);
    FindBins(transfer, begin, this->Numbers);
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      this->Numbers[lane] = lane < count
        ? FindPiece(transfer, this->Numbers[lane], values[lane], this->IsRising(lane))
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
  const Doubles depth = Load(&segments.Depth[1][first]) - Load(&segments.Depth[0][first]);
  if (count == DoubleWidth)
  {
    return Gather(tile.Length, &segments.Pixel[first]) * depth;
  }
  int pixels[DoubleWidth] = {};
  for (int lane = 0; lane < count; ++lane)
  {
    pixels[lane] = segments.Pixel[first + lane];
  }
  return Gather(tile.Length, pixels) * depth;
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

/// A vector of floats: segments that are in one piece each, and not deeper than a step.
class ShallowSegments
{
public:
  SIMD_INLINE ShallowSegments(const CloudTile& tile, const TransferPieces& transfer,
    const CloudSegments& segments, int first, int count)
  {
    const float* functions[FloatWidth];
    Doubles lengths[2];
    Doubles places[2][2];
    unsigned int inside = 0;
    for (int half = 0; half < 2; ++half)
    {
      const int lane = half * DoubleWidth;
      const int left = LargerOf(SmallerOf(count - lane, DoubleWidth), 0);
      lengths[half] = FindLengths(tile, segments, first + lane, left);
      const Mask isInside =
        FindPlaces(transfer, segments, first + lane, places[half], functions + lane);
      // Beyond them single precision may lose what their product with the attenuation is.
      const Mask isUsual = (0x1p-60 < lengths[half]) & (lengths[half] < 0x1p60);
      inside |= ToBits(isInside & isUsual & FirstLanes(left)) << lane;
    }
    this->Length = Round(lengths[0], lengths[1]);
    this->Place[0] = Round(places[0][0], places[1][0]);
    this->Place[1] = Round(places[0][1], places[1][1]);
    LoadFours(functions, this->Start);
    LoadFours(functions, this->Change, 4);
    const Floats depths[2] = { this->GetFunction(0, 0) * this->Length,
      this->GetFunction(0, 1) * this->Length };
    this->Linear = depths[0];
    this->Square = 0.5F * (depths[1] - depths[0]);
    const Floats depth = this->Linear + this->Square;
    // Not where a depth is no number.
    this->Found = inside & ToBits(depth < static_cast<float>(LargestStepDepth));
  }

  /// Those that are such segments; a bit for each.
  unsigned int Found;

  /// Finds red, green and blue, and the part of the light that passes; see AbsorptionStep.
  SIMD_INLINE void FindLight(Floats light[4]) const
  {
    const Floats opacity = FindOpacity(this->Linear + this->Square);
    const Floats first = FindMeanOpacity(this->Linear, this->Square);
    for (int i = 0; i < 3; ++i)
    {
      light[i] =
        this->GetFunction(1 + i, 0) * first + this->GetFunction(1 + i, 1) * (opacity - first);
    }
    light[3] = 1.0F - opacity;
  }

private:
  /// Finds the places of both values in the piece that the first of them may be in: from 0 to 1.
  /// Returns whether both are in it.
  SIMD_INLINE static Mask FindPlaces(const TransferPieces& transfer, const CloudSegments& segments,
    int first, Doubles places[2], const float** functions)
  {
    const Doubles values[2] = { Load(&segments.Value[0][0][first]),
      Load(&segments.Value[0][1][first]) };
    int bins[DoubleWidth];
    FindBins(transfer, values[0], bins);
    const double* rows[DoubleWidth];
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      const TransferPiece& piece = transfer.Pieces[transfer.FirstInBin[bins[lane]]];
      rows[lane] = &piece.Low;
      functions[lane] = piece.Functions;
    }
    Doubles piece[4];
    LoadFours(rows, piece);
    Mask isInside = piece[3] < Infinity;
    for (int end = 0; end < 2; ++end)
    {
      isInside = isInside & (piece[0] <= values[end]) & (values[end] <= piece[1]);
      places[end] = (values[end] - piece[2]) * piece[3];
    }
    return isInside;
  }

  /// The attenuation, or a colour, at an end.
  SIMD_INLINE Floats GetFunction(int function, int end) const
  {
    return Max(this->Start[function] + this->Change[function] * this->Place[end], Floats(0.0F));
  }

  /// 1 - exp(-depth).
  SIMD_INLINE static Floats FindOpacity(Floats depth)
  {
    Floats sum = 1.0F;
    for (int i = 5; i > 1; --i)
    {
      sum = 1.0F - depth * sum * (1.0F / static_cast<float>(i));
    }
    return depth * sum;
  }

  /// What the mean of exp(-d) lacks of one, where d = a x + b x^2.
  SIMD_INLINE static Floats FindMeanOpacity(Floats a, Floats b)
  {
    const Floats aa = a * a;
    const Floats ab = a * b;
    const Floats bb = b * b;
    const Floats first = a * (1.0F / 2.0F) + b * (1.0F / 3.0F);
    const Floats second = aa * (1.0F / 6.0F) + ab * (1.0F / 4.0F) + bb * (1.0F / 10.0F);
    const Floats third = aa * (a * (1.0F / 24.0F) + b * (1.0F / 10.0F)) +
      bb * (a * (1.0F / 12.0F) + b * (1.0F / 42.0F));
    const Floats fourth = aa * (aa * (1.0F / 120.0F) + ab * (1.0F / 36.0F)) +
      bb * (aa * (1.0F / 28.0F) + ab * (1.0F / 48.0F) + bb * (1.0F / 216.0F));
    return first - (second - (third - fourth));
  }

  Floats Length;
  Floats Place[2];
  Floats Start[4];
  Floats Change[4];
  /// The depth is Linear x + Square x^2.
  Floats Linear;
  Floats Square;
};

/// Less light than this is not followed.
constexpr double LeastTransmittance = 0x1p-20;

/// Integrates some of the segments, given their numbers, in as many steps as they take.
void IntegrateInSteps(const CloudTile& tile, const TransferPieces& transfer,
  const CloudSegments& segments, const int* numbers, int total, SegmentLight* lights)
{
  for (int first = 0; first < total; first += DoubleWidth)
  {
    const int count = SmallerOf(total - first, DoubleWidth);
    int some[DoubleWidth];
    int pixels[DoubleWidth];
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      some[lane] = numbers[first + (lane < count ? lane : 0)];
      pixels[lane] = segments.Pixel[some[lane]];
    }
    const Doubles length = Gather(tile.Length, pixels) *
      (Gather(segments.Depth[1], some) - Gather(segments.Depth[0], some));
    SegmentValues values(
      transfer, Gather(segments.Value[0][0], some), Gather(segments.Value[0][1], some), count);

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
    SegmentLight found[DoubleWidth];
    StoreLights(light, transmittance, count, found);
    for (int lane = 0; lane < count; ++lane)
    {
      lights[some[lane]] = found[lane];
    }
  }
}

void IntegrateSegments(const CloudTile& tile, const TransferPieces& transfer,
  const CloudSegments& segments, SegmentLight* lights)
{
  int numbers[CloudSegments::Capacity];
  int total = 0;
  for (int first = 0; first < segments.Count; first += FloatWidth)
  {
    const int count = SmallerOf(segments.Count - first, FloatWidth);
    const ShallowSegments shallow(tile, transfer, segments, first, count);
    Floats light[4];
    shallow.FindLight(light);
    StoreFours(light, lights[first].Color);
    unsigned int others = ~shallow.Found & ((1U << count) - 1U);
    for (; others != 0; others &= others - 1)
    {
      numbers[total++] = first + LowestBit(others);
    }
  }
  IntegrateInSteps(tile, transfer, segments, numbers, total, lights);
}

}
}
