// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Scene_h
#define Scene_h

#include "Field/TracedField.h"
#include "Rays/Camera.h"
#include "Rays/PixelRectangle.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A light as VTK has it, in world coordinates.
struct Light
{
  Vector3 DiffuseColor = { 1.0, 1.0, 1.0 };
  Vector3 SpecularColor = { 1.0, 1.0, 1.0 };
  /// The direction from a surface to a distant light, of length one.
  Vector3 Direction = { 0.0, 0.0, 1.0 };
  /// A positional light shines from a point, weaker with distance, into a cone about -Direction.
  bool Positional = false;
  Vector3 Position = { 0.0, 0.0, 1.0 };
  /// The half angle of the cone, in degrees; 90 and more shine everywhere.
  double ConeAngle = 180.0;
  double Exponent = 1.0;
  /// Constant, linear and quadratic.
  Vector3 Attenuation = { 1.0, 0.0, 0.0 };

  /// The cosine of the half angle.
  double FindLeastCosine() const
  {
    return std::cos(this->ConeAngle * (3.14159265358979323846 / 180.0));
  }
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
  /// The colour of a hit. Called by many threads at once.
  virtual Vector3 Get(const Hit& hit) const = 0;
};

/// The colours of values.
class ValueColors
{
public:
  virtual ~ValueColors() = default;
  /// Red, green, blue and opacity of a value. Called by many threads at once.
  virtual std::array<double, 4> Get(double value) const = 0;
};

class CloudMedium;

/// A field as part of a scene.
struct SceneField
{
  /// Selected before rays are traced.
  TracedField* Field = nullptr;
  /// The camera, in the object space of the field.
  Camera View;
  /// The size of its cells in object space, about.
  double CellSize = 1.0;
  /// The pixels that the field may cover. Its rays are made for these alone.
  PixelRectangle Pixels = { 0, 0, std::numeric_limits<int>::max(),
    std::numeric_limits<int>::max() };
  /// The colour of each surface of the request.
  std::vector<Vector3> Colors;
  /// If not null, it overrides these colours.
  const HitColors* ColorsOfHits = nullptr;
  /// For a projection, which is not lit; and for caps, which have the colours of the values there.
  const ValueColors* ColorsOfValues = nullptr;
  Material Surface;
  /// If not null, the field is drawn as a cloud of it, too.
  const CloudMedium* Cloud = nullptr;
  /// Whether a cloud shows the largest traced value along each ray, by ColorsOfValues, and not its
  /// light.
  bool IsMaximum = false;
};

/// Everything that a frame is made from. It does not change while rays are traced, so all threads
/// share it.
struct Scene
{
  /// Their cameras show one world in one viewport: they differ by WorldFromObject alone, so that T
  /// is the same in all.
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
  /// The number of rays from each hit that test for occluders of ambient light; 0 for none.
  int OcclusionRays = 0;
  /// The length of these rays, in units of the world.
  double OcclusionRadius = std::numeric_limits<double>::infinity();
  /// Frames with different numbers have different rays, so that their mean has less noise.
  int OcclusionFrame = 0;
  /// Whether the first hit of every pixel is to be kept besides its colour.
  bool KeepHits = false;
  /// Whether the fragments of every pixel are to be kept.
  bool KeepFragments = false;

  /// The tiles that the image is handed out in.
  int TileWidth = 16;
  int TileHeight = 8;
};

}

#endif
