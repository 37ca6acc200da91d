// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PhongReflection_h
#define PhongReflection_h

#include "Math/Arithmetic.h"
#include "Math/Vector.h"

namespace vtkIsosurfaceRayTracing
{

/// A power of a small whole number, by squaring.
template <typename Number>
SIMD_INLINE Number Power(Number base, int exponent)
{
  Number result = 1.0;
  Number square = base;
  for (; exponent > 0; exponent /= 2)
  {
    result = exponent % 2 == 1 ? result * square : result;
    square = square * square;
  }
  return result;
}

/// The light that a surface reflects at a point, diffuse and specular, by the model that VTK lights
/// surfaces with (B. T. Phong: Illumination for Computer Generated Pictures, CACM 18(6), 1975), but
/// for a headlight that is the only light: its highlights on polygons are wider.
template <typename Number>
struct PhongReflection
{
  Number Diffuse[3] = { 0.0, 0.0, 0.0 };
  Number Specular[3] = { 0.0, 0.0, 0.0 };

  /// Adds a light. Directions point away from the surface and have length one; power(cosine) is the
  /// strength of the highlight.
  template <typename HighlightPower>
  SIMD_INLINE void Add(const Number normal[3], const Number toViewer[3], const Number toLight[3],
    const double diffuseColor[3], const double specularColor[3], Number strength,
    const HighlightPower& power)
  {
    const Number cosine = Dot(normal, toLight);
    const auto isUnlit = cosine <= Number(0.0);
    Number mirrored[3];
    for (int i = 0; i < 3; ++i)
    {
      mirrored[i] = normal[i] * (2.0 * cosine) - toLight[i];
    }
    const Number diffuse = cosine * strength;
    const Number specular = power(Max(Number(0.0), Dot(mirrored, toViewer))) * strength;
    for (int i = 0; i < 3; ++i)
    {
      this->Diffuse[i] =
        Select(isUnlit, this->Diffuse[i], this->Diffuse[i] + diffuseColor[i] * diffuse);
      this->Specular[i] =
        Select(isUnlit, this->Specular[i], this->Specular[i] + specularColor[i] * specular);
    }
  }

  /// A channel of the light that a surface of a colour reflects; the coefficients are those of the
  /// material, the ambient one times what reaches it of the ambient light.
  SIMD_INLINE Number GetChannel(
    int i, Number color, Number ambient, double diffuse, double specular) const
  {
    return color * ambient + color * this->Diffuse[i] * diffuse + this->Specular[i] * specular;
  }
};

}

#endif
