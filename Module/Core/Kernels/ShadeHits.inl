// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The colours of hits under distant lights. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

void Shade(const Phong& phong, ShadedHits& hits)
{
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
    PhongReflection<Doubles> reflection;
    for (int k = 0; k < phong.LightCount; ++k)
    {
      const DistantLight& light = phong.Lights[k];
      const Doubles toLight[3] = { light.Direction[0], light.Direction[1], light.Direction[2] };
      reflection.Add(normal, toViewer, toLight, light.DiffuseColor, light.SpecularColor,
        hits.Lights ? Load(&hits.Lights[k].Parts[i]) : Doubles(1.0),
        [&phong](Doubles cosine) { return Power(cosine, phong.SpecularPower); });
    }
    Doubles ambient = phong.Ambient;
    if (hits.Ambient)
    {
      ambient = ambient * Load(&hits.Ambient->Parts[i]);
    }
    for (int k = 0; k < 3; ++k)
    {
      const Doubles color = Load(&hits.Color[k][i]);
      const Doubles shaded =
        reflection.GetChannel(k, color, ambient, phong.Diffuse, phong.Specular);
      // An extreme hit keeps the colour of its surface.
      Store(Select(ToMask(extreme), color, shaded), &hits.Color[k][i]);
    }
  }
}

}
}
