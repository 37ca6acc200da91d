// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The light of segments in a mixture of several components, step by step as in
// IntegrateSegments.inl: no piece of any transfer function ends within a step. The same for clouds
// that are lit, of one component, too. Included by Kernels.inl only.

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
template <bool IsLit>
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

  /// Sets what each of them reflects, given that of the segments, of which it is a part.
  SIMD_INLINE void SetLight(const ReflectedLight* ofSegments, Doubles from, Doubles to)
  {
    for (int i = 0; i < this->Count; ++i)
    {
      this->Reflected[i] = ofSegments[i].GetPart(from, to);
    }
  }

  /// Ends the step after a part of its length.
  SIMD_INLINE void Shorten(Doubles part)
  {
    for (int i = 0; i < this->Count; ++i)
    {
      if constexpr (IsLit)
      {
        this->Reflected[i] = this->Reflected[i].GetPart(0.0, part);
      }
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

  /// How many moments that takes: one more than the degree of the light.
  static constexpr int Moments = IsLit ? 4 : 3;

  /// The light of a unit of length, given the moments of what passes.
  SIMD_INLINE Doubles FindGlow(int color, const Doubles (&moments)[Moments]) const
  {
    Doubles sum = 0.0;
    for (int i = 0; i < this->Count; ++i)
    {
      const auto& attenuation = this->Clouds[i].AtEnds[0];
      if constexpr (IsLit)
      {
        const auto& plus = this->Reflected[i].Plus[color];
        LinearProduct shown(this->Clouds[i].AtEnds[1 + color], this->Reflected[i].Times[color]);
        shown.Coefficients[0] = shown.Coefficients[0] + plus[0];
        shown.Coefficients[1] = shown.Coefficients[1] + (plus[1] - plus[0]);
        const Doubles change = attenuation[1] - attenuation[0];
        for (int k = 0; k < 3; ++k)
        {
          sum =
            sum + shown.Coefficients[k] * (attenuation[0] * moments[k] + change * moments[k + 1]);
        }
        continue;
      }
      const LinearProduct product(attenuation, this->Clouds[i].AtEnds[1 + color]);
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
        if constexpr (IsLit)
        {
          const ReflectedLight& reflected = this->Reflected[i];
          color[k] =
            color[k] + weight * (atEnds[1 + k][0] * reflected.Times[k][0] + reflected.Plus[k][0]);
        }
        else
        {
          color[k] = color[k] + weight * atEnds[1 + k][0];
        }
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
  ReflectedLight Reflected[IsLit ? MaximumCloudComponents : 1];
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
      this->Values[i] = SegmentValues(*mixed.Transfers[i], Load(&segments.Value[i][0][first]),
        Load(&segments.Value[i][1][first]), count);
    }
  }

  /// Finds the mixture from x to where the first piece of a component ends.
  template <bool IsLit>
  SIMD_INLINE MixtureOfStep<IsLit> FindStep(Doubles x, Doubles& end)
  {
    end = 1.0;
    LoadedPieces pieces[MaximumCloudComponents];
    for (int i = 0; i < this->Mixed.Components; ++i)
    {
      pieces[i] = LoadedPieces(*this->Mixed.Transfers[i], this->Values[i].Numbers);
      this->Border[i] = Max(this->Values[i].FindBorder(pieces[i]), x);
      end = Min(end, this->Border[i]);
    }
    MixtureOfStep<IsLit> mixture(this->Mixed.AreIndependent);
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

/// Segments that are lit have a lighting.
template <bool IsLit>
SIMD_INLINE void IntegrateAnyMixture(const CloudTile& tile, const MixedTransfers& mixed,
  const CloudLighting* lighting, const CloudSegments& segments, SegmentLight* lights)
{
  for (int first = 0; first < segments.Count; first += DoubleWidth)
  {
    const int count = SmallerOf(segments.Count - first, DoubleWidth);
    const Doubles length = FindLengths(tile, segments, first, count);
    SegmentsOfMixture mixture(mixed, segments, first, count);
    ReflectedLight reflected[MaximumCloudComponents];
    if constexpr (IsLit)
    {
      LightSegments(tile, mixed, *lighting, segments, first, count, reflected);
    }

    // What is left of each segment begins at x.
    Doubles x = 0.0;
    Doubles light[3] = { 0.0, 0.0, 0.0 };
    Doubles transmittance = 1.0;
    Mask isOpen = FirstLanes(count);
    while (Any(isOpen))
    {
      Doubles end;
      MixtureOfStep<IsLit> step = mixture.FindStep<IsLit>(x, end);
      if constexpr (IsLit)
      {
        step.SetLight(reflected, x, end);
      }
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
      Doubles moments[MixtureOfStep<IsLit>::Moments];
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

void IntegrateMixture(const CloudTile& tile, const MixedTransfers& mixed,
  const CloudSegments& segments, SegmentLight* lights)
{
  IntegrateAnyMixture<false>(tile, mixed, nullptr, segments, lights);
}

void IntegrateLitMixture(const CloudTile& tile, const MixedTransfers& mixed,
  const CloudLighting& lighting, const CloudSegments& segments, SegmentLight* lights)
{
  IntegrateAnyMixture<true>(tile, mixed, &lighting, segments, lights);
}

}
}
