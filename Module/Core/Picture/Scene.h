// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Scene_h
#define Scene_h

#include "Image/ImageField.h"
#include "Rays/Camera.h"

#include <array>
#include <limits>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A light as VTK has it, in world coordinates.
struct Light
{
  Vector3 DiffuseColor = { 1.0, 1.0, 1.0 };
  Vector3 SpecularColor = { 1.0, 1.0, 1.0 };
  /// From a surface to a light that is infinitely far, of length one.
  Vector3 Direction = { 0.0, 0.0, 1.0 };
  /// A positional light shines from a point, weaker with distance, into a cone about -Direction.
  bool Positional = false;
  Vector3 Position = { 0.0, 0.0, 1.0 };
  /// The half angle of the cone, in degrees; 90 and more shine everywhere.
  double ConeAngle = 180.0;
  double Exponent = 1.0;
  /// Constant, linear and quadratic.
  Vector3 Attenuation = { 1.0, 0.0, 0.0 };
};

struct Material
{
  bool Shade = false;
  double Ambient = 0.1;
  double Diffuse = 0.7;
  double Specular = 0.2;
  double SpecularPower = 10.0;
};

/// Colours that differ from hit to hit.
class HitColors
{
public:
  virtual ~HitColors() = default;
  /// The colour of a hit. Many threads ask at once.
  virtual Vector3 Get(const Hit& hit) const = 0;
};

/// What values look like.
class ValueColors
{
public:
  virtual ~ValueColors() = default;
  /// Red, green, blue and opacity of a value. Many threads ask at once.
  virtual std::array<double, 4> Get(double value) const = 0;
};

/// A rectangle of pixels, counted from the lower left of the viewport.
struct PixelRectangle
{
  int X = 0;
  int Y = 0;
  int Width = 0;
  int Height = 0;
};

/// Everything a frame is made from, besides the volume. It does not change while rays are traced,
/// so the threads share it.
struct Scene
{
  Camera View;
  /// The pixels to draw: those that the volume may cover.
  PixelRectangle Pixels;
  /// The depth of what is drawn already, for the pixels of the rectangle, in rows from the bottom;
  /// null where there is nothing.
  const float* Depth = nullptr;

  TraceRequest Request;
  /// The colour of each surface.
  std::vector<Vector3> Colors;
  /// If there is one, it says the colours instead.
  const HitColors* ColorsOfHits = nullptr;
  /// For a projection, which is not lit and has none of what follows; and for caps, which have the
  /// colours of the values there.
  const ValueColors* ColorsOfValues = nullptr;
  NormalMode Normals = NormalMode::CentralDifferences;
  Material Look;
  std::vector<Light> Lights;
  bool TwoSidedLighting = true;
  /// Whether the surfaces cast shadows on each other.
  bool Shadows = false;
  /// How many rays look from a hit for what is in the way of ambient light; 0 does without. They
  /// look so far, in the world.
  int OcclusionRays = 0;
  double OcclusionRadius = std::numeric_limits<double>::infinity();
  /// Frames with other numbers have other such rays, so that there is less grain in their mean.
  int OcclusionFrame = 0;
  /// Whether the first hit of every pixel is wanted besides its colour.
  bool KeepHits = false;

  /// What the image is worked through in, and by how many threads.
  int TileWidth = 16;
  int TileHeight = 8;
  int Threads = 1;
};

}

#endif
