// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceAccumulation.h"

#include "vtkObject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

static_assert(vtkIsosurfaceRayTraceAccumulation::MaximumNumberOfFrames *
      std::numeric_limits<std::uint8_t>::max() <=
    std::numeric_limits<std::uint16_t>::max(),
  "The sums would overflow.");

namespace
{

template <typename Range>
void Append(const Range& range, std::vector<double>& numbers)
{
  numbers.insert(numbers.end(), range.begin(), range.end());
}

/// Whether two cameras have one place and size; the projections may differ.
bool AreAlike(const vtkirt::Camera& a, const vtkirt::Camera& b)
{
  return a.GetWorldFromObject() == b.GetWorldFromObject() && a.GetWidth() == b.GetWidth() &&
    a.GetHeight() == b.GetHeight();
}

/// Where a corner of a box is, of which the bits of the number tell the sides.
std::array<double, 4> Project(
  const vtkirt::Camera& view, const vtkirt::Bounds& box, std::size_t number)
{
  const auto get = [&](std::size_t axis)
  { return (number >> axis & 1) != 0 ? box.Upper[axis] : box.Lower[axis]; };
  std::array<double, 4> place;
  for (std::size_t row = 0; row < 4; ++row)
  {
    const double* numbers = view.GetClipFromObject().data() + 4 * row;
    place[row] = numbers[0] * get(0) + numbers[1] * get(1) + numbers[2] * get(2) + numbers[3];
  }
  return place;
}

/// Whether two places are the same to within much less than a pixel. vtkWindowToImageFilter takes
/// the sine of the view angle and the angle of that sine, which differ in the last bits.
bool AreTheSame(const std::array<double, 4>& a, const std::array<double, 4>& b)
{
  constexpr double tolerance = 1e-7;
  const double size = std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]) + std::abs(a[3]);
  bool areTheSame = true;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    // Those of an empty box are not numbers.
    areTheSame = areTheSame && !(std::abs(a[i] - b[i]) > tolerance * size);
  }
  return areTheSame;
}

/// Whether two depth buffers are the same to within a few steps of their 24 bits, for that reason.
bool AreTheSame(const std::vector<float>& a, const std::vector<float>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](float x, float y) { return std::abs(x - y) <= 0x1p-22F; });
}

void AppendRequest(const vtkirt::TraceRequest& request, std::vector<double>& numbers)
{
  numbers.push_back(static_cast<double>(request.Surfaces.size()));
  for (const vtkirt::Isosurface& surface : request.Surfaces)
  {
    Append(std::array<double, 2>{ surface.Isovalue, surface.Opacity }, numbers);
  }
  for (const std::optional<double>& opacity : request.MemberOpacities)
  {
    numbers.push_back(opacity.value_or(-1.0));
  }
  for (const vtkirt::HalfSpace& half : request.Visible.HalfSpaces)
  {
    Append(half.Normal, numbers);
    numbers.push_back(half.Offset);
  }
}

void AppendLight(const vtkirt::Light& light, std::vector<double>& numbers)
{
  for (const vtkirt::Vector3& vector :
    { light.DiffuseColor, light.SpecularColor, light.Direction, light.Position, light.Attenuation })
  {
    Append(vector, numbers);
  }
  Append(std::array<double, 3>{ light.Positional ? 1.0 : 0.0, light.ConeAngle, light.Exponent },
    numbers);
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceAccumulation::Key::Key(
  const std::vector<vtkObject*>& objects, double distance, const vtkirt::Scene& scene)
  : Numbers(
      { distance, scene.TwoSidedLighting ? 1.0 : 0.0, static_cast<double>(scene.OcclusionRays) })
{
  for (vtkObject* object : objects)
  {
    this->Objects.emplace_back(object, object ? object->GetMTime() : 0);
  }
  const vtkirt::PixelRectangle& pixels = scene.Pixels;
  Append(std::array<int, 4>{ pixels.X, pixels.Y, pixels.Width, pixels.Height }, this->Numbers);
  for (const vtkirt::SceneField& field : scene.Fields)
  {
    this->Views.push_back(field.View);
    const vtkirt::Bounds box = field.Field->GetBounds();
    for (std::size_t corner = 0; corner < 8; ++corner)
    {
      this->Corners.push_back(Project(field.View, box, corner));
    }
    AppendRequest(field.Field->GetRequest(), this->Numbers);
  }
  for (const vtkirt::Light& light : scene.Lights)
  {
    AppendLight(light, this->Numbers);
  }
  if (scene.Depth)
  {
    this->Depths.assign(
      scene.Depth, scene.Depth + vtkirt::Count({ pixels.Width, pixels.Height, 1 }));
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceAccumulation::Key::operator==(const Key& other) const
{
  return this->Objects == other.Objects && this->Numbers == other.Numbers &&
    std::equal(
      this->Views.begin(), this->Views.end(), other.Views.begin(), other.Views.end(), AreAlike) &&
    std::equal(this->Corners.begin(), this->Corners.end(), other.Corners.begin(),
      other.Corners.end(), [](const auto& a, const auto& b) { return AreTheSame(a, b); }) &&
    AreTheSame(this->Depths, other.Depths);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceAccumulation::SetFrame(int number, vtkirt::Scene& scene)
{
  if (number == 0)
  {
    return;
  }
  // M. Roberts: The Unreasonable Effectiveness of Quasirandom Sequences, 2018. The first of its
  // points is the centre of the pixel; the others, each with its opposite, are balanced.
  const int pair = (number + 1) / 2;
  const double side = number % 2 == 0 ? -1.0 : 1.0;
  const double x = 0.7548776662466927 * pair;
  const double y = 0.5698402909980532 * pair;
  for (vtkirt::SceneField& field : scene.Fields)
  {
    field.View =
      field.View.Shifted(side * (x - std::floor(x + 0.5)), side * (y - std::floor(y + 0.5)));
  }
  scene.OcclusionFrame = number;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceAccumulation::Add(const Key& key, const vtkirt::Frame& frame)
{
  if (!(this->Of == key))
  {
    this->Frames = 0; // First: copying the key may fail.
    this->Of = key;
  }
  if (this->Frames == 0)
  {
    this->Sums.assign(frame.Colors.size(), 0);
    this->Depths = frame.Depths;
  }
  ++this->Frames;
  for (std::size_t i = 0; i < this->Sums.size(); ++i)
  {
    this->Sums[i] = static_cast<std::uint16_t>(this->Sums[i] + frame.Colors[i]);
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceAccumulation::GetMean(vtkirt::Frame& frame) const
{
  frame.Depths = this->Depths;
  frame.Colors.resize(this->Sums.size());
  for (std::size_t i = 0; i < this->Sums.size(); ++i)
  {
    frame.Colors[i] =
      static_cast<std::uint8_t>((2 * this->Sums[i] + this->Frames) / (2 * this->Frames));
  }
}

VTK_ABI_NAMESPACE_END
