// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The colours of hits under distant lights. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

SIMD_INLINE Doubles Power(Doubles base, int exponent)
{
  Doubles result = 1.0;
  Doubles square = base;
  for (; exponent > 0; exponent /= 2)
  {
    result = exponent % 2 == 1 ? result * square : result;
    square = square * square;
  }
  return result;
}

/// The light that is reflected, diffuse and specular.
struct Reflections
{
  Doubles Diffuse[3];
  Doubles Specular[3];
};

SIMD_INLINE void AddReflections(const DistantLight& light, int power, const Doubles normal[3],
  const Doubles toViewer[3], Reflections& reflections)
{
  const Doubles zero = 0.0;
  Doubles direction[3];
  for (int i = 0; i < 3; ++i)
  {
    direction[i] = light.Direction[i];
  }
  const Doubles cosine = Dot(normal, direction);
  const Mask isLit = zero < cosine;
  Doubles mirrored[3];
  for (int i = 0; i < 3; ++i)
  {
    mirrored[i] = normal[i] * (2.0 * cosine) - direction[i];
  }
  const Doubles highlight = Power(Max(zero, Dot(mirrored, toViewer)), power);
  for (int i = 0; i < 3; ++i)
  {
    Doubles& diffuse = reflections.Diffuse[i];
    Doubles& specular = reflections.Specular[i];
    diffuse = Select(isLit, diffuse + light.DiffuseColor[i] * cosine, diffuse);
    specular = Select(isLit, specular + light.SpecularColor[i] * highlight, specular);
  }
}

void Shade(const Phong& phong, ShadedHits& hits)
{
  const Doubles zero = 0.0;
  hits.Extreme.Words[0] = 0;
  hits.Extreme.Words[1] = 0;
  for (int i = 0; i < hits.Count; i += DoubleWidth)
  {
    Doubles gradient[3];
    Doubles direction[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      gradient[axis] = Load(&hits.Gradient[axis][i]);
      direction[axis] = Load(&hits.Direction[axis][i]);
    }
    Doubles toViewer[3];
    TransformDirection(phong.WorldFromObject, direction, toViewer);
    Mask safe = Normalize(toViewer, -1.0);
    safe = safe & Normalize(gradient, 1.0);
    Doubles normal[3];
    TransformDirection(phong.WorldFromGradient, gradient, normal);
    safe = safe & Normalize(normal, -1.0);
    const unsigned int extreme =
      ToBits(AndNot(FirstLanes(SmallerOf(hits.Count - i, DoubleWidth)), safe));
    hits.Extreme.Words[i >> 6] |= static_cast<std::uint64_t>(extreme) << (i & 63);
    if (phong.TwoSidedLighting)
    {
      const Mask isOutside = ToMask(GetLanes(hits.Entering, i));
      for (int axis = 0; axis < 3; ++axis)
      {
        normal[axis] = Select(isOutside, normal[axis], normal[axis] * -1.0);
      }
    }
    Reflections reflections = { { zero, zero, zero }, { zero, zero, zero } };
    for (int light = 0; light < phong.LightCount; ++light)
    {
      AddReflections(phong.Lights[light], phong.SpecularPower, normal, toViewer, reflections);
    }
    for (int k = 0; k < 3; ++k)
    {
      const Doubles color = Load(&hits.Color[k][i]);
      const Doubles shaded = color * phong.Ambient +
        color * reflections.Diffuse[k] * phong.Diffuse + reflections.Specular[k] * phong.Specular;
      // An extreme hit keeps the colour of its surface.
      Store(Select(ToMask(extreme), color, shaded), &hits.Color[k][i]);
    }
  }
}

}
}
