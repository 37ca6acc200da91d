// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "RandomScenes.h"

#include "TestLines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <type_traits>

namespace HardCases
{
namespace
{

using vtkIsosurfaceRayTracing::BrickLayout;
using vtkIsosurfaceRayTracing::CroppingRegions;
using vtkIsosurfaceRayTracing::Extremum;
using vtkIsosurfaceRayTracing::HalfSpace;
using vtkIsosurfaceRayTracing::Interpolant;
using vtkIsosurfaceRayTracing::LineKind;
using vtkIsosurfaceRayTracing::NormalMode;

constexpr double Infinity = std::numeric_limits<double>::infinity();

Index DrawDimensions(RandomNumbers& random)
{
  Index dimensions;
  for (int& size : dimensions)
  {
    size = random.Integer(0, 4) == 0 ? random.Integer(2, 3) : random.Integer(2, 13);
  }
  return dimensions;
}

ScalarType DrawType(RandomNumbers& random)
{
  const ScalarType types[] = { ScalarType::UInt8, ScalarType::Int16, ScalarType::Float32,
    ScalarType::Float64 };
  return types[random.Integer(0, 3)];
}

/// A value from -1 to 1 as the nearest one of a type, which uses much of its range.
double ToType(ScalarType type, double value)
{
  switch (type)
  {
    case ScalarType::UInt8:
      return std::nearbyint(127.5 + 127.5 * value);
    case ScalarType::Int16:
      return std::nearbyint(32767.0 * value);
    case ScalarType::Float32:
      return static_cast<double>(static_cast<float>(value));
    default:
      return value;
  }
}

/// One of several kinds of functions of a lattice point, of values from -1 to 1.
Field DrawShape(RandomNumbers& random, const Index& dimensions)
{
  const Triple wave = random.PointInBox({ -1.5, -1.5, -1.5 }, { 1.5, 1.5, 1.5 });
  const Triple center = random.PointInVolume(dimensions);
  const double radius = random.Uniform(0.5, 8.0);
  const int labels = random.Integer(1, 4);
  const double level = random.Uniform(-1.0, 1.0);
  const double noise = std::pow(10.0, random.Uniform(-17.0, -1.0));
  switch (random.Integer(0, 6))
  {
    case 0:
      return RandomField(random, dimensions);
    case 1: // smooth
      return Sample(dimensions,
        [&](int x, int y, int z) { return std::sin(wave[0] * x + wave[1] * y + wave[2] * z); });
    case 2: // a distance
      return Sample(dimensions,
        [&](int x, int y, int z)
        {
          const Triple way = { x - center[0], y - center[1], z - center[2] };
          return (radius - Oracle::Length(way)) / 32.0;
        });
    case 3: // labels, in blocks
      return Sample(dimensions,
        [&](int x, int y, int z)
        {
          const double label = std::sin(1.0 + x / 3 + 2 * (y / 2) + 3 * (z / 4)) * labels;
          return std::nearbyint(label) / labels;
        });
    case 4: // nearly constant
      return Sample(dimensions,
        [&](int, int, int)
        { return std::clamp(level + noise * random.Uniform(-1.0, 1.0), -1.0, 1.0); });
    case 5: // a wall between constants
      return Sample(dimensions,
        [&](int x, int y, int z)
        { return x + (random.Integer(0, 8) == 0 ? y - z : 0) < center[0] ? -level : level; });
    default: // a few peaks
      return Sample(dimensions,
        [&](int, int, int)
        { return random.Integer(0, 40) == 0 ? random.Uniform(-1.0, 1.0) : 0.0; });
  }
}

Field DrawField(RandomNumbers& random, ScalarType type)
{
  Field field = DrawShape(random, DrawDimensions(random));
  const bool isReal = type == ScalarType::Float32 || type == ScalarType::Float64;
  const double scale = isReal && random.Integer(0, 3) == 0 ? random.WideMagnitude(-30, 30) : 1.0;
  const int holes = isReal ? random.Integer(0, 5) : 0;
  const double bad[] = { std::numeric_limits<double>::quiet_NaN(), Infinity, -Infinity };
  for (double& value : field.Values)
  {
    const bool isHole = holes == 1 && random.Integer(0, 20) == 0;
    value = isHole ? bad[random.Integer(0, 2)] : ToType(type, value * scale);
  }
  return field;
}

Line DrawLine(RandomNumbers& random, const Index& dimensions)
{
  vtkIsosurfaceRayTracing::Line drawn;
  switch (random.Integer(0, 3))
  {
    case 0:
      drawn = vtkIsosurfaceRayTracing::RandomLine(random, dimensions);
      break;
    case 1:
      drawn = vtkIsosurfaceRayTracing::LatticeLine(random, dimensions);
      break;
    default:
      const LineKind kinds[] = { LineKind::Any, LineKind::AlongAxis, LineKind::BesidePlane,
        LineKind::InFace, LineKind::ThroughVertices, LineKind::Diagonal };
      const auto axis = static_cast<std::size_t>(random.Integer(0, 2));
      drawn = vtkIsosurfaceRayTracing::LineAlong(
        random, kinds[random.Integer(0, 5)], axis, random.Integer(0, 1) ? 1.0 : -1.0, dimensions);
  }
  Line line{ drawn.Origin, drawn.Direction };
  if (random.Integer(0, 3) == 0)
  {
    line.Begin = random.Uniform(0.0, 10.0);
    line.End = line.Begin + random.Uniform(0.0, 20.0);
  }
  return line;
}

HalfSpace DrawHalfSpace(RandomNumbers& random, const Index& dimensions)
{
  HalfSpace half{ random.Direction(), 0.0, random.Integer(0, 1) == 0 };
  Triple point = random.PointInVolume(dimensions);
  if (random.Integer(0, 2) == 0) // in a plane of the lattice, perhaps in a face of the volume
  {
    half.Normal = {};
    half.Normal[static_cast<std::size_t>(random.Integer(0, 2))] = random.Integer(0, 1) ? 1.0 : -1.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] = random.Integer(0, dimensions[axis] - 1);
    }
  }
  half.Offset = -vtkIsosurfaceRayTracing::Dot(half.Normal, point);
  return half;
}

CroppingRegions DrawRegions(RandomNumbers& random, const Index& dimensions)
{
  CroppingRegions regions;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double a = random.Uniform(0.0, dimensions[axis] - 1.0);
    const double b = random.Integer(0, dimensions[axis] - 1);
    regions.Planes[axis] = { std::min(a, b), std::max(a, b) };
  }
  regions.Visible = static_cast<unsigned int>(random.Bits()) & CroppingRegions::All;
  return regions;
}

}

//------------------------------------------------------------------------------
RandomScene::RandomScene(RandomNumbers& random)
  : Type(DrawType(random))
  , Samples(DrawField(random, this->Type))
{
  const Index& n = this->Samples.Dimensions;
  for (int i = random.Integer(1, 300); i > 0; --i)
  {
    this->Lines.push_back(DrawLine(random, n));
  }
  for (int cell = (n[0] - 1) * (n[1] - 1) * (n[2] - 1); cell > 0; --cell)
  {
    this->HiddenCells.push_back(random.Integer(0, 3) == 0 ? 1 : 0);
  }
}

//------------------------------------------------------------------------------
double RandomScene::DrawIsovalue(RandomNumbers& random) const
{
  const auto last = static_cast<int>(this->Samples.Values.size()) - 1;
  const double a = this->Samples.Values[static_cast<std::size_t>(random.Integer(0, last))];
  const double b = this->Samples.Values[static_cast<std::size_t>(random.Integer(0, last))];
  if (!std::isfinite(a) || !std::isfinite(b))
  {
    return 0.0;
  }
  switch (random.Integer(0, 3))
  {
    case 0:
      return a;
    case 1:
      return std::nextafter(a, random.Integer(0, 1) ? Infinity : -Infinity);
    default:
      return a + (b - a) * random.Uniform(0.0, 1.0);
  }
}

//------------------------------------------------------------------------------
std::vector<Isosurface> RandomScene::DrawSurfaces(RandomNumbers& random, double opacity) const
{
  std::vector<double> isovalues;
  for (int i = random.Integer(1, 3); i > 0; --i)
  {
    isovalues.push_back(this->DrawIsovalue(random));
  }
  std::sort(isovalues.begin(), isovalues.end());
  isovalues.erase(std::unique(isovalues.begin(), isovalues.end()), isovalues.end());
  std::vector<Isosurface> surfaces;
  for (const double isovalue : isovalues)
  {
    surfaces.push_back({ isovalue, opacity });
  }
  return surfaces;
}

//------------------------------------------------------------------------------
TraceRequest RandomScene::DrawRequest(RandomNumbers& random) const
{
  const Index& n = this->Samples.Dimensions;
  TraceRequest request;
  request.Surfaces = this->DrawSurfaces(random, 1.0);
  for (Isosurface& surface : request.Surfaces)
  {
    surface.Opacity = random.Integer(0, 2) == 0 ? 1.0 : random.Uniform(0.05, 0.95);
  }
  request.Interpolation = static_cast<Interpolant>(random.Integer(0, 2));
  request.Solver = static_cast<RootSolver>(random.Integer(0, 3));
  request.Interpolations = random.Integer(1, 6);
  request.Normals = static_cast<NormalMode>(random.Integer(0, 1));
  if (random.Integer(0, 3) == 0)
  {
    request.Surfaces.clear();
    request.Interpolation = Interpolant::Trilinear;
    request.Projection = static_cast<Extremum>(random.Integer(0, 1));
  }
  for (int i = random.Integer(-2, 2); i > 0; --i)
  {
    request.Visible.HalfSpaces.push_back(DrawHalfSpace(random, n));
  }
  if (random.Integer(0, 3) == 0)
  {
    request.Visible.Regions = DrawRegions(random, n);
  }
  if (random.Integer(0, 3) == 0)
  {
    request.Visible.HiddenCells = this->HiddenCells.data();
  }
  return request;
}

//------------------------------------------------------------------------------
RandomWay::RandomWay(RandomNumbers& random)
{
  this->Settings.MacrocellBranching.clear();
  for (int level = random.Integer(0, 3); level > 0; --level)
  {
    this->Settings.MacrocellBranching.push_back(random.Integer(1, 9));
  }
  this->Settings.Layout = static_cast<BrickLayout>(random.Integer(0, 2));
  this->Settings.BrickSize = random.Integer(1, 12);
  this->Settings.BrickGroupSize = random.Integer(1, 4);
  this->How.Threads = random.Integer(1, 3);
  const auto kernels = vtkIsosurfaceRayTracing::GetKernels();
  const int which = random.Integer(-1, static_cast<int>(kernels.size()) - 1);
  this->How.PacketKernels = which < 0 ? nullptr : kernels[static_cast<std::size_t>(which)];
  if (random.Integer(0, 2) == 0)
  {
    this->Budget.CacheBytes = static_cast<std::size_t>(random.Integer(0, 20000));
  }
}

//------------------------------------------------------------------------------
std::string RandomWay::ToText() const
{
  std::ostringstream text;
  text << "macrocells";
  for (const int branching : this->Settings.MacrocellBranching)
  {
    text << ' ' << branching;
  }
  text << ", layout " << static_cast<int>(this->Settings.Layout) << ", bricks "
       << this->Settings.BrickSize << " x " << this->Settings.BrickGroupSize << ", threads "
       << this->How.Threads << ", kernels " << this->How.PacketKernels << ", bytes "
       << this->Budget.CacheBytes;
  return text.str();
}

}
