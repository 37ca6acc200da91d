// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Compositor_h
#define Compositor_h

#include "Field/HitCollector.h"
#include "Math/ByteColor.h"
#include "Math/Vector.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

// From hits to pixels: the fragments of each ray, whatever field they are of. Fragments of several
// fields are put in order by T and composited front to back (T. Porter, T. Duff: Compositing
// Digital Images, SIGGRAPH 1984). Colours are rounded to 8 bits at the very end.

namespace vtkIsosurfaceRayTracing
{

/// What a hit contributes to its ray.
struct Fragment
{
  double T;
  /// Multiplied by the opacity.
  Vector3 Color;
  /// In (0, 1].
  double Opacity;
  /// In [0, 1] as in the depth buffer, or PixelWithoutDepth for a projection, which hides nothing.
  /// It is told where the fragment is opaque, or the scene keeps fragments.
  float Depth;
};

/// Takes the fragments of the pixels of a tile.
class FragmentSink
{
public:
  virtual ~FragmentSink() = default;

  /// Sets those of the pixel (x, y) of the tile, front to back. Pixels without are passed over.
  virtual void SetFragments(int x, int y, const Fragment* fragments, std::size_t count) = 0;
};

/// What a pixel shows.
struct CompositedPixel
{
  /// Red, green and blue, multiplied by the opacity, and the opacity.
  std::uint8_t Rgba[4];
  /// That of the opaque fragment; PixelWithoutDepth if there is none.
  float Depth;
};

constexpr float PixelWithoutDepth = 2.0F;

/// The fragments of the rays of a packet: ray i has those from First[i] to First[i + 1], front to
/// back.
struct Fragments
{
  std::vector<Fragment> List;
  std::vector<std::size_t> First;

  void Clear()
  {
    this->List.clear();
    this->First.assign(1, 0);
  }
};

/// A fragment, and the number of its pixel.
struct FragmentOfPixel
{
  std::size_t Pixel;
  Fragment Own;
};

/// The pixel of a single fragment.
inline CompositedPixel ToPixel(const Fragment& fragment)
{
  return { { ToByte(fragment.Color[0]), ToByte(fragment.Color[1]), ToByte(fragment.Color[2]),
             ToByte(fragment.Opacity) },
    fragment.Depth };
}

/// Merges the fragments of several fields, for the same rays: in order by T; of equal T, those of
/// the field that comes first.
inline void Merge(const std::vector<Fragments>& fields, Fragments& merged)
{
  merged.Clear();
  for (std::size_t ray = 0; ray + 1 < fields.front().First.size(); ++ray)
  {
    const auto begin = static_cast<std::ptrdiff_t>(merged.List.size());
    for (const Fragments& field : fields)
    {
      merged.List.insert(merged.List.end(),
        field.List.begin() + static_cast<std::ptrdiff_t>(field.First[ray]),
        field.List.begin() + static_cast<std::ptrdiff_t>(field.First[ray + 1]));
    }
    std::stable_sort(merged.List.begin() + begin, merged.List.end(),
      [](const Fragment& a, const Fragment& b) { return a.T < b.T; });
    merged.First.push_back(merged.List.size());
  }
}

/// Composites the fragments of one ray, as far as anything of them is seen.
inline CompositedPixel Composite(const Fragment* fragments, std::size_t count)
{
  Vector3 color = { 0.0, 0.0, 0.0 };
  double transmittance = 1.0;
  float depth = PixelWithoutDepth;
  for (std::size_t i = 0; i < count && transmittance >= NegligibleTransmittance; ++i)
  {
    const Fragment& fragment = fragments[i];
    color = color + fragment.Color * transmittance;
    transmittance *= 1.0 - fragment.Opacity;
    depth = fragment.Opacity >= 1.0 ? fragment.Depth : depth;
  }
  return { { ToByte(color[0]), ToByte(color[1]), ToByte(color[2]), ToByte(1.0 - transmittance) },
    depth };
}

}

#endif
