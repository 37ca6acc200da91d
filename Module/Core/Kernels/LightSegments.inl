// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What segments of a cloud reflect, at both of their ends. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The light that a cloud of a colour reflects at both ends of a segment or of a step, and linear
/// between them: Times the colour, and Plus, in red, green and blue.
struct ReflectedLight
{
  Doubles Times[3][2];
  Doubles Plus[3][2];

  /// That of the part from one x to another, from 0 to 1.
  SIMD_INLINE ReflectedLight GetPart(Doubles from, Doubles to) const
  {
    ReflectedLight part;
    for (int i = 0; i < 3; ++i)
    {
      part.Times[i][0] = Lerp(this->Times[i][0], this->Times[i][1], from);
      part.Times[i][1] = Lerp(this->Times[i][0], this->Times[i][1], to);
      part.Plus[i][0] = Lerp(this->Plus[i][0], this->Plus[i][1], from);
      part.Plus[i][1] = Lerp(this->Plus[i][0], this->Plus[i][1], to);
    }
    return part;
  }
};

/// A power of a number that is not negative.
SIMD_INLINE Doubles AnyPower(Doubles base, double exponent)
{
  if (exponent >= 0.0 && exponent <= 128.0 && exponent == std::floor(exponent))
  {
    return Power(base, static_cast<int>(exponent));
  }
  double lanes[DoubleWidth];
  Store(base, lanes);
  for (double& lane : lanes)
  {
    lane = std::pow(lane, exponent);
  }
  return Load(lanes);
}

/// Finds the direction to a light, of length one, and its strength.
SIMD_INLINE Doubles Illuminate(const CloudLight& light, const Doubles point[3], Doubles toLight[3])
{
  if (!light.IsPositional)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      toLight[axis] = light.Direction[axis];
    }
    return 1.0;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    toLight[axis] = light.Position[axis] - point[axis];
  }
  const Doubles distance = Sqrt(Dot(toLight, toLight));
  const Doubles inverse = Select(0.0 < distance, 1.0 / distance, Doubles(0.0));
  for (int axis = 0; axis < 3; ++axis)
  {
    toLight[axis] = toLight[axis] * inverse;
  }
  const Doubles strength = 1.0 /
    (light.Attenuation[0] + distance * (light.Attenuation[1] + distance * light.Attenuation[2]));
  if (!light.HasCone)
  {
    return strength;
  }
  const Doubles direction[3] = { light.Direction[0], light.Direction[1], light.Direction[2] };
  const Doubles cosine = Dot(toLight, direction);
  return Select(light.LeastCosine <= cosine,
    strength * AnyPower(Max(cosine, Doubles(0.0)), light.Exponent), Doubles(0.0));
}

/// Finds what a cloud with a gradient reflects at a point: as an isosurface there. Without a
/// gradient it is ambient light alone.
SIMD_INLINE PhongReflection<Doubles> FindReflection(const CloudLighting& lighting,
  double specularPower, const Doubles gradient[3], const Doubles point[3],
  const Doubles toViewer[3])
{
  Doubles normal[3];
  TransformDirection(lighting.WorldFromGradient, gradient, normal);
  const Doubles square = Dot(normal, normal);
  // The outside is where values are smaller; or where the viewer is.
  Doubles factor = Select(IsSafeSquare(square), -1.0 / Sqrt(square), Doubles(0.0));
  if (lighting.AreTwoSided)
  {
    factor = CopySign(factor, Dot(normal, toViewer));
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    normal[axis] = normal[axis] * factor;
  }
  PhongReflection<Doubles> reflection;
  for (int i = 0; i < lighting.LightCount; ++i)
  {
    const CloudLight& light = lighting.Lights[i];
    Doubles toLight[3];
    const Doubles strength = Illuminate(light, point, toLight);
    reflection.Add(normal, toViewer, toLight, light.DiffuseColor, light.SpecularColor, strength,
      [specularPower](Doubles cosine) { return AnyPower(cosine, specularPower); });
  }
  return reflection;
}

/// Finds what a vector of segments reflects, by each of their gradients.
SIMD_INLINE void LightSegments(const CloudTile& tile, const MixedTransfers& mixed,
  const CloudLighting& lighting, const CloudSegments& segments, int first, int count,
  ReflectedLight* reflected)
{
  int pixels[DoubleWidth] = {};
  for (int lane = 0; lane < count; ++lane)
  {
    pixels[lane] = segments.Pixel[first + lane];
  }
  const Doubles unit = Gather(tile.Length, pixels);
  Doubles toViewer[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    toViewer[axis] = Gather(lighting.ToViewer[axis], pixels);
  }
  for (int end = 0; end < 2; ++end)
  {
    const Doubles along = unit * Load(&segments.Depth[end][first]);
    Doubles point[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      point[axis] = Gather(lighting.Origin[axis], pixels) - toViewer[axis] * along;
    }
    for (int number = 0; number < segments.Gradients; ++number)
    {
      Doubles gradient[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        double lanes[DoubleWidth];
        for (int lane = 0; lane < DoubleWidth; ++lane)
        {
          const float* all = segments.Gradient[3 * number + axis][end];
          lanes[lane] = static_cast<double>(all[first + lane]);
        }
        gradient[axis] = Load(lanes);
      }
      const CloudMaterial& material = mixed.Materials[number];
      const PhongReflection<Doubles> reflection =
        FindReflection(lighting, material.SpecularPower, gradient, point, toViewer);
      for (int i = 0; i < 3; ++i)
      {
        reflected[number].Times[i][end] =
          material.Ambient + material.Diffuse * reflection.Diffuse[i];
        reflected[number].Plus[i][end] = material.Specular * reflection.Specular[i];
      }
    }
  }
}

}
}
