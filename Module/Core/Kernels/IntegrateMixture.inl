// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The light of segments in a mixture of several components, step by step as in
// IntegrateSegments.inl: no piece of any transfer function ends within a step. Included by
// Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// A product of two functions, linear in x, from 0 to 1: a polynomial in x.
struct LinearProduct
{
  Doubles Coefficients[3];

  SIMD_INLINE LinearProduct(const Doubles one[2], const Doubles other[2])
  {
    const Doubles changes[2] = { one[1] - one[0], other[1] - other[0] };
    this->Coefficients[0] = one[0] * other[0];
    this->Coefficients[1] = one[0] * changes[1] + changes[0] * other[0];
    this->Coefficients[2] = changes[0] * changes[1];
  }
};

/// The transfer functions at both ends of a step: the attenuation, red, green and blue.
struct FunctionsOfStep
{
  Doubles AtEnds[4][2];

  SIMD_INLINE void Add(const FunctionsOfStep& other)
  {
    for (int i = 0; i < 4; ++i)
    {
      this->AtEnds[i][0] = this->AtEnds[i][0] + other.AtEnds[i][0];
      this->AtEnds[i][1] = this->AtEnds[i][1] + other.AtEnds[i][1];
    }
  }
};

/// The clouds in a mixture, in a step: as many as there are independent components, else one.
class MixtureOfStep
{
public:
  SIMD_INLINE explicit MixtureOfStep(bool areIndependent)
    : AreIndependent(areIndependent)
  {
  }

  SIMD_INLINE void Add(const FunctionsOfStep& functions)
  {
    if (this->Count > 0 && !this->AreIndependent)
    {
      this->Clouds[0].Add(functions);
      return;
    }
    this->Clouds[this->Count++] = functions;
  }

  /// Ends the step after a part of its length.
  SIMD_INLINE void Shorten(Doubles part)
  {
    for (int i = 0; i < this->Count; ++i)
    {
      for (Doubles(&atEnds)[2] : this->Clouds[i].AtEnds)
      {
        atEnds[1] = Lerp(atEnds[0], atEnds[1], part);
      }
    }
  }

  SIMD_INLINE AbsorptionStep<Doubles> FindAbsorption(Doubles length) const
  {
    Doubles sums[2] = { 0.0, 0.0 };
    for (int i = 0; i < this->Count; ++i)
    {
      sums[0] = sums[0] + this->Clouds[i].AtEnds[0][0];
      sums[1] = sums[1] + this->Clouds[i].AtEnds[0][1];
    }
    return { sums[0] * length, sums[1] * length };
  }

  /// The light of a unit of length, given the moments of what passes.
  SIMD_INLINE Doubles FindGlow(int color, const Doubles moments[3]) const
  {
    Doubles sum = 0.0;
    for (int i = 0; i < this->Count; ++i)
    {
      const LinearProduct product(this->Clouds[i].AtEnds[0], this->Clouds[i].AtEnds[1 + color]);
      for (int k = 0; k < 3; ++k)
      {
        sum = sum + product.Coefficients[k] * moments[k];
      }
    }
    return sum;
  }

  /// The colour of what is so dense that its beginning alone is seen: the mean of those there,
  /// weighted by attenuations. These may begin at zero: so what they rise to counts, too, as little
  /// as the length of a step that is lost by rounding.
  SIMD_INLINE void FindOpaqueColor(Doubles color[3]) const
  {
    Doubles weights = 0.0;
    for (int i = 0; i < this->Count; ++i)
    {
      const auto& atEnds = this->Clouds[i].AtEnds;
      const Doubles weight = atEnds[0][0] + 0x1p-54 * atEnds[0][1];
      weights = weights + weight;
      for (int k = 0; k < 3; ++k)
      {
        color[k] = color[k] + weight * atEnds[1 + k][0];
      }
    }
    for (int k = 0; k < 3; ++k)
    {
      color[k] = color[k] / weights;
    }
  }

private:
  bool AreIndependent;
  int Count = 0;
  FunctionsOfStep Clouds[MaximumCloudComponents];
};

/// A vector of segments of a mixture.
class SegmentsOfMixture
{
public:
  SIMD_INLINE SegmentsOfMixture(
    const MixedTransfers& mixed, const CloudSegments& segments, int first, int count)
    : Mixed(mixed)
  {
    for (int i = 0; i < mixed.Components; ++i)
    {
      this->Values[i] = SegmentValues(*mixed.Transfers[i], segments.Value[i], first, count);
    }
  }

  /// Finds the mixture from x to where the first piece of a component ends.
  SIMD_INLINE MixtureOfStep FindStep(Doubles x, Doubles& end)
  {
    end = 1.0;
    LoadedPieces pieces[MaximumCloudComponents];
    for (int i = 0; i < this->Mixed.Components; ++i)
    {
      pieces[i] = LoadedPieces(*this->Mixed.Transfers[i], this->Values[i].Numbers);
      this->Border[i] = Max(this->Values[i].FindBorder(pieces[i]), x);
      end = Min(end, this->Border[i]);
    }
    MixtureOfStep mixture(this->Mixed.AreIndependent);
    for (int i = 0; i < this->Mixed.Components; ++i)
    {
      FunctionsOfStep functions;
      for (int k = 0; k < 4; ++k)
      {
        functions.AtEnds[k][0] = pieces[i].Get(k, this->Values[i].Get(x));
        functions.AtEnds[k][1] = pieces[i].Get(k, this->Values[i].Get(end));
      }
      mixture.Add(functions);
    }
    return mixture;
  }

  /// Goes on to the next pieces of the components whose last ones end there.
  SIMD_INLINE void Move(Mask isMoved, Doubles end)
  {
    for (int i = 0; i < this->Mixed.Components; ++i)
    {
      this->Values[i].Move(isMoved & (this->Border[i] <= end));
    }
  }

private:
  const MixedTransfers& Mixed;
  SegmentValues Values[MaximumCloudComponents];
  /// Where the pieces of the last step end.
  Doubles Border[MaximumCloudComponents];
};

void IntegrateMixture(const CloudTile& tile, const MixedTransfers& mixed,
  const CloudSegments& segments, SegmentLight* lights)
{
  for (int first = 0; first < segments.Count; first += DoubleWidth)
  {
    const int count = SmallerOf(segments.Count - first, DoubleWidth);
    const Doubles length = FindLengths(tile, segments, first, count);
    SegmentsOfMixture mixture(mixed, segments, first, count);

    // What is left of each segment begins at x.
    Doubles x = 0.0;
    Doubles light[3] = { 0.0, 0.0, 0.0 };
    Doubles transmittance = 1.0;
    Mask isOpen = FirstLanes(count);
    while (Any(isOpen))
    {
      Doubles end;
      MixtureOfStep step = mixture.FindStep(x, end);
      Doubles next = end;
      AbsorptionStep<Doubles> absorption = step.FindAbsorption(length * (end - x));
      Mask isOpaque = Doubles(1.0) < Doubles(0.0);
      Doubles opaque[3] = { 0.0, 0.0, 0.0 };
      const Mask isTooDeep = isOpen & (LargestStepDepth < absorption.GetDepth());
      if (Any(isTooDeep))
      {
        const Doubles part = Select(isTooDeep, absorption.FindLargest(), Doubles(1.0));
        next = Select(isTooDeep, x + part * (end - x), end);
        // So deep that a step has no length: nothing passes.
        isOpaque = AndNot(x < end, x < next);
        step.FindOpaqueColor(opaque);
        step.Shorten(part);
        absorption = step.FindAbsorption(length * (next - x));
      }
      Doubles moments[3];
      absorption.GetMoments(moments);
      const Doubles unit = length * (next - x);
      for (int i = 0; i < 3; ++i)
      {
        const Doubles added = Select(isOpaque, opaque[i], step.FindGlow(i, moments) * unit);
        light[i] = Select(isOpen, light[i] + transmittance * added, light[i]);
      }
      const Doubles passing = Select(isOpaque, Doubles(0.0), absorption.GetTransmittance());
      transmittance = Select(isOpen, transmittance * passing, transmittance);
      const Mask isStep = next < end;
      x = next;
      isOpen = isOpen & (isStep | (end < 1.0)) & (LeastTransmittance < transmittance);
      mixture.Move(AndNot(isOpen, isStep), end);
    }
    StoreLights(light, transmittance, count, lights + first);
  }
}

}
}
