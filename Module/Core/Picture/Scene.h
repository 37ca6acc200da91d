// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Scene_h
#define Scene_h

#include "Field/TracedField.h"
#include "Rays/Camera.h"
#include "Rays/PixelRectangle.h"

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

/// A field as a scene shows it.
struct SceneField
{
  /// Selected before rays are traced.
  TracedField* Field = nullptr;
  /// The camera, seen from the object space of the field.
  Camera View;
  /// The colour of each surface of the request.
  std::vector<Vector3> Colors;
  /// If there is one, it says the colours instead.
  const HitColors* ColorsOfHits = nullptr;
  /// For a projection, which is not lit; and for caps, which have the colours of the values there.
  const ValueColors* ColorsOfValues = nullptr;
  Material Surface;
};

/// Everything a frame is made from. It does not change while rays are traced, so the threads share
/// it.
struct Scene
{
  /// Their cameras show one world in one viewport.
  std::vector<SceneField> Fields;
  /// The pixels to draw: those that the fields may cover.
  PixelRectangle Pixels;
  /// The depth of what is drawn already, for the pixels of the rectangle, in rows from the bottom;
  /// null where there is nothing.
  const float* Depth = nullptr;

  std::vector<Light> Lights;
  bool TwoSidedLighting = true;
  /// Whether surfaces cast shadows on each other, those of other fields included.
  bool Shadows = false;
  /// How many rays look from a hit for what is in the way of ambient light; 0 does without. They
  /// look so far, in the world.
  int OcclusionRays = 0;
  double OcclusionRadius = std::numeric_limits<double>::infinity();
  /// Frames with other numbers have other such rays, so that there is less noise in their mean.
  int OcclusionFrame = 0;
  /// Whether the first hit of every pixel is to be kept besides its colour.
  bool KeepHits = false;

  /// The tiles that the image is handed out in.
  int TileWidth = 16;
  int TileHeight = 8;
};

}

#endif
