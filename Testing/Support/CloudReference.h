// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CloudReference_h
#define CloudReference_h

#include "Mesh/CellSubdivision.h"
#include "Mesh/MeshCells.h"
#include "Picture/CloudTransfer.h"
#include "Picture/Scene.h"
#include "Rays/Camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <vector>

// The light of rays in a cloud, found in another way than the library does: by rays that are
// intersected with tetrahedra, and by quadrature. The type Real is more precise than double: long
// double, or Quad.

namespace vtkIsosurfaceRayTracing
{

/// What is left of light at an optical depth.
template <typename Real>
Real FindTransmittance(Real depth)
{
  if constexpr (std::is_same_v<Real, long double>)
  {
    return std::exp(-depth);
  }
  else
  {
    // The series of a small part of the depth, and its square, again and again.
    int halvings = 0;
    for (; depth > Real(0.0625); depth /= 2)
    {
      ++halvings;
    }
    Real sum = 1;
    for (int i = 18; i > 0; --i)
    {
      sum = 1 - sum * depth / i;
    }
    for (; halvings > 0; --halvings)
    {
      sum *= sum;
    }
    return sum;
  }
}

//------------------------------------------------------------------------------
/// The light of segments by quadrature: transmittances are exact, since the attenuation is linear
/// between nodes, and colours are integrated by Gauss and Legendre in small steps.
template <typename Extended>
struct ReferenceLight
{
  Extended Color[3] = { 0, 0, 0 };
  Extended Transmittance = 1;
};

/// The transfer functions between two neighbouring nodes.
template <typename Extended>
struct CloudInterval
{
  CloudNode Low;
  CloudNode High;

  Extended Get(int function, Extended value) const
  {
    const auto get = [function](const CloudNode& node) -> Extended {
      return function == 0 ? node.Attenuation : node.Color[static_cast<std::size_t>(function - 1)];
    };
    const Extended width = static_cast<Extended>(this->High.Value) - this->Low.Value;
    const Extended fraction = width > 0 && width < std::numeric_limits<double>::infinity()
      ? (value - this->Low.Value) / width
      : 0;
    return get(this->Low) + fraction * (get(this->High) - get(this->Low));
  }
};

/// Goes on with a part of a segment in which the functions are linear.
template <typename Extended>
void AddPart(const CloudInterval<Extended>& interval, Extended length, Extended from, Extended to,
  ReferenceLight<Extended>& light)
{
  const Extended first = interval.Get(0, from) * length;
  const Extended last = interval.Get(0, to) * length;
  const auto depth = [&](Extended x) { return first * x + (last - first) * x * x / 2; };
  constexpr long double places[4] = { 0.069431844202973712388L, 0.33000947820757186760L,
    0.66999052179242813240L, 0.93056815579702628761L };
  constexpr long double weights[4] = { 0.17392742256872692869L, 0.32607257743127307131L,
    0.32607257743127307131L, 0.17392742256872692869L };
  // As far as anything is seen.
  Extended end = 1;
  while (depth(end / 2) > 50)
  {
    end /= 2;
  }
  const int steps = 8 + static_cast<int>(8 * depth(end));
  for (int step = 0; step < steps; ++step)
  {
    for (int k = 0; k < 4; ++k)
    {
      const Extended x = end * (step + places[k]) / steps;
      const Extended seen = light.Transmittance * FindTransmittance(depth(x)) *
        (first + (last - first) * x) * weights[k] * end / steps;
      for (int i = 0; i < 3; ++i)
      {
        light.Color[i] += seen * interval.Get(1 + i, from + (to - from) * x);
      }
    }
  }
  light.Transmittance *= FindTransmittance(depth(1));
}

/// Goes on with a segment.
template <typename Extended>
void AddSegment(const std::vector<CloudNode>& nodes, Extended length, Extended from, Extended to,
  ReferenceLight<Extended>& light)
{
  std::vector<CloudInterval<Extended>> intervals = { { nodes.front(), nodes.front() } };
  intervals.front().Low.Value = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < nodes.size(); ++i)
  {
    intervals.push_back({ nodes[i - 1], nodes[i] });
  }
  intervals.push_back({ nodes.back(), nodes.back() });
  intervals.back().High.Value = std::numeric_limits<double>::infinity();
  if (to < from)
  {
    std::reverse(intervals.begin(), intervals.end());
  }
  for (const CloudInterval<Extended>& interval : intervals)
  {
    const auto clamp = [&](Extended value)
    { return std::clamp<Extended>(value, interval.Low.Value, interval.High.Value); };
    if (from == to && (interval.Low.Value < from && from <= interval.High.Value))
    {
      AddPart(interval, length, from, to, light);
    }
    else if (clamp(from) != clamp(to))
    {
      AddPart(
        interval, length * (clamp(to) - clamp(from)) / (to - from), clamp(from), clamp(to), light);
    }
  }
}

/// The transfer functions of several components, and whether these are clouds of their own.
struct ReferenceMixture
{
  std::vector<std::vector<CloudNode>> Nodes;
  bool AreIndependent;
};

/// The light that a cloud of a colour reflects at both ends of a segment, and linear between them:
/// Times the colour, and Plus.
template <typename Extended>
struct ReferenceReflection
{
  Extended Times[3][2];
  Extended Plus[3][2];

  Extended Get(int color, Extended own, Extended x) const
  {
    const auto& times = this->Times[color];
    const auto& plus = this->Plus[color];
    return own * (times[0] + (times[1] - times[0]) * x) + plus[0] + (plus[1] - plus[0]) * x;
  }
};

/// Goes on with a segment of a mixture, by the values of each component at both ends. If it is lit,
/// there is a reflection for each cloud.
template <typename Extended>
void AddMixedSegment(const ReferenceMixture& mixture, Extended length,
  const std::vector<std::array<Extended, 2>>& values, ReferenceLight<Extended>& light,
  const std::vector<ReferenceReflection<Extended>>& reflections = {})
{
  const std::size_t components = mixture.Nodes.size();
  // Where any function bends or jumps.
  std::vector<Extended> places = { 0, 1 };
  for (std::size_t i = 0; i < components; ++i)
  {
    for (const CloudNode& node : mixture.Nodes[i])
    {
      const Extended x = (node.Value - values[i][0]) / (values[i][1] - values[i][0]);
      if (x > 0 && x < 1)
      {
        places.push_back(x);
      }
    }
  }
  std::sort(places.begin(), places.end());
  constexpr long double gauss[4] = { 0.069431844202973712388L, 0.33000947820757186760L,
    0.66999052179242813240L, 0.93056815579702628761L };
  constexpr long double weights[4] = { 0.17392742256872692869L, 0.32607257743127307131L,
    0.32607257743127307131L, 0.17392742256872692869L };
  for (std::size_t part = 1; part < places.size(); ++part)
  {
    const Extended begin = places[part - 1];
    const Extended width = places[part] - begin;
    const auto find = [&](std::size_t i, Extended x)
    { return values[i][0] + x * (values[i][1] - values[i][0]); };
    std::vector<CloudInterval<Extended>> intervals;
    for (std::size_t i = 0; i < components; ++i)
    {
      const std::vector<CloudNode>& nodes = mixture.Nodes[i];
      const Extended middle = find(i, begin + width / 2);
      CloudInterval<Extended> own = { nodes.back(), nodes.back() };
      if (middle <= nodes.front().Value)
      {
        own = { nodes.front(), nodes.front() };
      }
      for (std::size_t k = 1; k < nodes.size(); ++k)
      {
        if (nodes[k - 1].Value < middle && middle <= nodes[k].Value)
        {
          own = { nodes[k - 1], nodes[k] };
        }
      }
      intervals.push_back(own);
    }
    const auto get = [&](int function, std::size_t i, Extended x)
    { return intervals[i].Get(function, find(i, begin + width * x)); };
    const auto sum = [&](int function, Extended x)
    {
      Extended all = 0;
      for (std::size_t i = 0; i < components; ++i)
      {
        all += get(function, i, x);
      }
      return all;
    };
    const auto reflect = [&](int color, std::size_t cloud, Extended own, Extended x)
    { return reflections.empty() ? own : reflections[cloud].Get(color, own, begin + width * x); };
    const auto glow = [&](int color, Extended x)
    {
      if (!mixture.AreIndependent)
      {
        return sum(0, x) * reflect(color, 0, sum(1 + color, x), x);
      }
      Extended all = 0;
      for (std::size_t i = 0; i < components; ++i)
      {
        all += get(0, i, x) * reflect(color, i, get(1 + color, i, x), x);
      }
      return all;
    };
    const Extended unit = length * width;
    const Extended first = sum(0, 0) * unit;
    const Extended change = sum(0, 1) * unit - first;
    const auto depth = [&](Extended x) { return first * x + change * x * x / 2; };
    Extended end = 1;
    while (depth(end / 2) > 50)
    {
      end /= 2;
    }
    const int steps = 8 + static_cast<int>(8 * depth(end));
    for (int step = 0; step < steps; ++step)
    {
      for (int k = 0; k < 4; ++k)
      {
        const Extended x = end * (step + gauss[k]) / steps;
        const Extended seen =
          light.Transmittance * FindTransmittance(depth(x)) * unit * weights[k] * end / steps;
        for (int i = 0; i < 3; ++i)
        {
          light.Color[i] += seen * glow(i, x);
        }
      }
    }
    light.Transmittance *= FindTransmittance(depth(1));
  }
}

/// All tetrahedra of a mesh: corners and values.
using Tetrahedron = std::array<std::array<double, 4>, 4>;
inline std::vector<Tetrahedron> Subdivide(const MeshCells& cells)
{
  std::vector<Tetrahedron> all;
  for (std::int64_t i = 0; i < cells.GetNumberOfCells(); ++i)
  {
    MeshCell cell;
    if (!cells.Load(i, cell))
    {
      throw std::logic_error("a cell without corners");
    }
    double corners[MaximumTetrahedra][4][4];
    const int count = SubdivideCell(cell, corners);
    for (int k = 0; k < count; ++k)
    {
      Tetrahedron tetrahedron;
      for (std::size_t corner = 0; corner < 4; ++corner)
      {
        std::copy_n(corners[k][corner], 4, tetrahedron[corner].begin());
      }
      all.push_back(tetrahedron);
    }
  }
  return all;
}

template <typename Extended>
Extended Determinant(const Extended (&a)[3], const Extended (&b)[3], const Extended (&c)[3])
{
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// The segment of a ray in a tetrahedron, by its barycentric coordinates, which are linear in t.
template <typename Extended>
struct ReferenceSegment
{
  Extended T[2];
  Extended Value[2];
  /// The barycentric coordinates at both ends.
  Extended Weights[2][4];
};

/// Returns whether there is one.
template <typename Extended>
bool Intersect(
  const Tetrahedron& tetrahedron, const Camera::PixelRay& ray, ReferenceSegment<Extended>& segment)
{
  Extended edges[3][3];
  Extended origin[3];
  Extended direction[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      edges[i][axis] = static_cast<Extended>(tetrahedron[i + 1][axis]) - tetrahedron[0][axis];
    }
    origin[axis] = static_cast<Extended>(ray.Origin[axis]) - tetrahedron[0][axis];
    direction[axis] = ray.Direction[axis];
  }
  const Extended volume = Determinant(edges[0], edges[1], edges[2]);
  if (volume == 0)
  {
    return false;
  }
  const auto solve = [&](const Extended(&point)[3], Extended(&weights)[4], bool isPoint)
  {
    weights[1] = Determinant(point, edges[1], edges[2]) / volume;
    weights[2] = Determinant(edges[0], point, edges[2]) / volume;
    weights[3] = Determinant(edges[0], edges[1], point) / volume;
    weights[0] = (isPoint ? 1 : 0) - weights[1] - weights[2] - weights[3];
  };
  Extended at[4];
  Extended slope[4];
  solve(origin, at, true);
  solve(direction, slope, false);
  segment.T[0] = 0;
  segment.T[1] = ray.End;
  for (int i = 0; i < 4; ++i)
  {
    const Extended t = -at[i] / slope[i];
    segment.T[0] = slope[i] > 0 ? std::max<Extended>(segment.T[0], t) : segment.T[0];
    segment.T[1] = slope[i] < 0 ? std::min<Extended>(segment.T[1], t) : segment.T[1];
    segment.T[1] = slope[i] == 0 && at[i] < 0 ? -1 : segment.T[1];
  }
  for (int end = 0; end < 2; ++end)
  {
    segment.Value[end] = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      segment.Weights[end][i] = at[i] + slope[i] * segment.T[end];
      segment.Value[end] += segment.Weights[end][i] * tetrahedron[i][3];
    }
  }
  return segment.T[0] < segment.T[1];
}

/// What lights a cloud: the lights of a scene, and of each cloud of a mixture a material and
/// gradients.
struct ReferenceLighting
{
  const Scene* Shown;
  std::vector<Material> Materials;
  /// At every corner of every tetrahedron.
  std::vector<std::vector<std::array<Vector3, 4>>> Gradients;
};

/// The gradient in a tetrahedron, by Cramer's rule.
template <typename Extended>
std::array<Extended, 3> FindGradient(const Tetrahedron& tetrahedron)
{
  Extended across[3][3];
  Extended rises[3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // Columns are axes.
      across[axis][i] = static_cast<Extended>(tetrahedron[i + 1][axis]) - tetrahedron[0][axis];
    }
    rises[i] = static_cast<Extended>(tetrahedron[i + 1][3]) - tetrahedron[0][3];
  }
  const Extended volume = Determinant(across[0], across[1], across[2]);
  return { Determinant(rises, across[1], across[2]) / volume,
    Determinant(across[0], rises, across[2]) / volume,
    Determinant(across[0], across[1], rises) / volume };
}

/// What is reflected at an end of a segment, by the gradient there.
template <typename Extended>
void Reflect(const ReferenceLighting& lighting, std::size_t cloud, const Camera& view,
  const Camera::PixelRay& ray, Extended t, const std::array<Extended, 3>& gradient, int end,
  ReferenceReflection<Extended>& reflection)
{
  using Triple = std::array<Extended, 3>;
  const auto dot = [](const Triple& a, const Triple& b)
  { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const auto normalized = [&dot](const Triple& a)
  {
    const Extended length = std::sqrt(dot(a, a));
    return length > 0 ? Triple{ a[0] / length, a[1] / length, a[2] / length } : Triple{};
  };
  const Matrix4& m = view.GetWorldFromObject();
  Extended rows[3][3];
  Extended own[3];
  Triple direction;
  Triple point;
  for (std::size_t i = 0; i < 3; ++i)
  {
    direction[i] = 0;
    point[i] = m[4 * i + 3];
    for (std::size_t k = 0; k < 3; ++k)
    {
      rows[i][k] = m[4 * i + k];
      direction[i] -= rows[i][k] * ray.Direction[k];
      point[i] += rows[i][k] * (ray.Origin[k] + t * ray.Direction[k]);
    }
    own[i] = gradient[i];
  }
  const Triple toViewer = normalized(direction);
  // That of the world is what, seen from the object, is the gradient: transposed it is carried
  // back.
  const Extended volume = Determinant(rows[0], rows[1], rows[2]);
  Triple normal = normalized({ -Determinant(own, rows[1], rows[2]) / volume,
    -Determinant(rows[0], own, rows[2]) / volume, -Determinant(rows[0], rows[1], own) / volume });
  if (lighting.Shown->TwoSidedLighting && dot(normal, toViewer) < 0)
  {
    normal = { -normal[0], -normal[1], -normal[2] };
  }
  const Material& material = lighting.Materials[cloud];
  for (int i = 0; i < 3; ++i)
  {
    reflection.Times[i][end] = material.Shade ? material.Ambient : 1;
    reflection.Plus[i][end] = 0;
  }
  for (const Light& light : lighting.Shown->Lights)
  {
    Triple toLight = { light.Direction[0], light.Direction[1], light.Direction[2] };
    Extended strength = 1;
    if (light.Positional)
    {
      const Triple shone = toLight;
      toLight = { light.Position[0] - point[0], light.Position[1] - point[1],
        light.Position[2] - point[2] };
      const Extended distance = std::sqrt(dot(toLight, toLight));
      toLight = normalized(toLight);
      strength /= light.Attenuation[0] + light.Attenuation[1] * distance +
        light.Attenuation[2] * distance * distance;
      const Extended cosine = dot(toLight, shone);
      const Extended degrees = std::acos(cosine) * 180 / std::acos(static_cast<Extended>(-1));
      if (light.ConeAngle < 90.0)
      {
        strength *=
          degrees <= light.ConeAngle ? std::pow(cosine, static_cast<Extended>(light.Exponent)) : 0;
      }
    }
    const Extended cosine = dot(normal, toLight);
    if (cosine <= 0 || !material.Shade)
    {
      continue;
    }
    const Extended mirrored = 2 * cosine * dot(normal, toViewer) - dot(toLight, toViewer);
    const Extended highlight = mirrored > 0
      ? std::pow(mirrored, static_cast<Extended>(material.SpecularPower))
      : static_cast<Extended>(0);
    for (int i = 0; i < 3; ++i)
    {
      const auto k = static_cast<std::size_t>(i);
      reflection.Times[i][end] += material.Diffuse * strength * cosine * light.DiffuseColor[k];
      reflection.Plus[i][end] += material.Specular * strength * highlight * light.SpecularColor[k];
    }
  }
}

/// The light of a pixel, by a ray that is intersected with tetrahedra.
template <typename Extended>
ReferenceLight<Extended> FindLight(const std::vector<Tetrahedron>& tetrahedra, const Camera& view,
  const std::vector<CloudNode>& nodes, int x, int y)
{
  const Camera::PixelRay ray = view.GetRay(x, y, 1.0);
  std::vector<ReferenceSegment<Extended>> segments;
  for (const Tetrahedron& tetrahedron : tetrahedra)
  {
    ReferenceSegment<Extended> segment;
    if (Intersect(tetrahedron, ray, segment))
    {
      segments.push_back(segment);
    }
  }
  std::sort(
    segments.begin(), segments.end(), [](const auto& a, const auto& b) { return a.T[0] < b.T[0]; });
  const Extended unit = Length(TransformDirection(view.GetWorldFromObject(), ray.Direction));
  ReferenceLight<Extended> light;
  for (const ReferenceSegment<Extended>& segment : segments)
  {
    AddSegment<Extended>(
      nodes, (segment.T[1] - segment.T[0]) * unit, segment.Value[0], segment.Value[1], light);
  }
  return light;
}

/// The same of a mixture, by the tetrahedra with the values of each component.
template <typename Extended>
ReferenceLight<Extended> FindMixedLight(const std::vector<std::vector<Tetrahedron>>& ofComponents,
  const Camera& view, const ReferenceMixture& mixture, int x, int y,
  const ReferenceLighting& lighting = {})
{
  const Camera::PixelRay ray = view.GetRay(x, y, 1.0);
  struct Segments
  {
    std::size_t Tetrahedron;
    std::vector<ReferenceSegment<Extended>> OfComponents;
  };
  std::vector<Segments> segments;
  for (std::size_t i = 0; i < ofComponents.front().size(); ++i)
  {
    std::vector<ReferenceSegment<Extended>> own;
    for (const std::vector<Tetrahedron>& tetrahedra : ofComponents)
    {
      ReferenceSegment<Extended> segment;
      if (Intersect(tetrahedra[i], ray, segment))
      {
        own.push_back(segment);
      }
    }
    if (!own.empty())
    {
      segments.push_back({ i, own });
    }
  }
  std::sort(segments.begin(), segments.end(),
    [](const Segments& a, const Segments& b)
    { return a.OfComponents.front().T[0] < b.OfComponents.front().T[0]; });
  const Extended unit = Length(TransformDirection(view.GetWorldFromObject(), ray.Direction));
  ReferenceLight<Extended> light;
  for (const auto& [tetrahedron, own] : segments)
  {
    std::vector<ReferenceReflection<Extended>> reflections(lighting.Materials.size());
    for (std::size_t cloud = 0; cloud < reflections.size(); ++cloud)
    {
      for (int end = 0; end < 2; ++end)
      {
        std::array<Extended, 3> gradient = { 0, 0, 0 };
        for (std::size_t corner = 0; corner < 4; ++corner)
        {
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            gradient[axis] += own.front().Weights[end][corner] *
              lighting.Gradients[cloud][tetrahedron][corner][axis];
          }
        }
        Reflect(lighting, cloud, view, ray, own.front().T[end], gradient, end, reflections[cloud]);
      }
    }
    std::vector<std::array<Extended, 2>> values;
    for (const ReferenceSegment<Extended>& segment : own)
    {
      values.push_back({ segment.Value[0], segment.Value[1] });
    }
    const Extended length = own.front().T[1] - own.front().T[0];
    AddMixedSegment<Extended>(mixture, length * unit, values, light, reflections);
  }
  return light;
}

/// The largest difference of colours and opacities.
template <typename Extended>
double FindError(const std::array<double, 4>& light, const ReferenceLight<Extended>& reference)
{
  double error = std::abs(light[3] - static_cast<double>(1 - reference.Transmittance));
  for (std::size_t i = 0; i < 3; ++i)
  {
    error = std::max(error, std::abs(light[i] - static_cast<double>(reference.Color[i])));
  }
  return error;
}

}

#endif
