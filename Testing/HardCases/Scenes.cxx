// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Scenes.h"

#include "AnalyticFields.h"
#include "SameBits.h"

#include <cstdlib>
#include <cstring>

namespace HardCases
{
namespace
{

template <typename T>
std::vector<unsigned char> ToBytes(const std::vector<double>& values)
{
  std::vector<T> typed;
  for (const double value : values)
  {
    typed.push_back(static_cast<T>(value));
  }
  std::vector<unsigned char> bytes(typed.size() * sizeof(T));
  std::memcpy(bytes.data(), typed.data(), bytes.size());
  return bytes;
}

std::vector<unsigned char> ToBytes(const std::vector<double>& values, ScalarType type)
{
  switch (type)
  {
    case ScalarType::UInt8:
      return ToBytes<std::uint8_t>(values);
    case ScalarType::Int16:
      return ToBytes<std::int16_t>(values);
    case ScalarType::Float32:
      return ToBytes<float>(values);
    default:
      return ToBytes<double>(values);
  }
}

}

//------------------------------------------------------------------------------
std::vector<vtkIsosurfaceRayTracing::CastRay> ToCastRays(const std::vector<Line>& lines)
{
  std::vector<vtkIsosurfaceRayTracing::CastRay> rays;
  for (const Line& line : lines)
  {
    rays.push_back({ line.Origin, line.Direction, line.Begin, line.End });
  }
  return rays;
}

//------------------------------------------------------------------------------
Tracer::Tracer(const Field& field, const ImageSettings& settings, ScalarType type)
  : Bytes(ToBytes(field.Values, type))
  , Traced(vtkIsosurfaceRayTracing::ImageField::New(
      { this->Bytes.data(), type, field.Dimensions, 1 }, settings, 1))
{
}

//------------------------------------------------------------------------------
RayHits Tracer::Cast(
  const std::vector<Line>& lines, double isovalue, RootSolver solver, Reach reach, int threads)
{
  TraceRequest request;
  request.Surfaces = { { isovalue, reach == Reach::First ? 1.0 : Glass } };
  request.Solver = solver;
  this->Traced->Select(request, { threads });
  return CastRays(*this->Traced, ToCastRays(lines), threads);
}

//------------------------------------------------------------------------------
Field RandomField(RandomNumbers& random, const Index& dimensions, double low, double high)
{
  return Sample(
    dimensions, [&random, low, high](int, int, int) { return random.Uniform(low, high); });
}

//------------------------------------------------------------------------------
Field Ball(const Index& dimensions, const Triple& center, double radius)
{
  return { dimensions,
    AnalyticFields::Sample<double>(dimensions, AnalyticFields::Sphere{ center, radius }) };
}

//------------------------------------------------------------------------------
Line RandomLine(RandomNumbers& random, const Index& dimensions, double distance)
{
  const Triple target = random.PointInVolume(dimensions);
  const Triple direction = random.Direction();
  Triple origin;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    origin[axis] = target[axis] - distance * dimensions[axis] * direction[axis];
  }
  return { origin, direction };
}

//------------------------------------------------------------------------------
std::vector<Line> RandomLines(
  RandomNumbers& random, const Index& dimensions, std::size_t count, double distance)
{
  std::vector<Line> lines;
  for (std::size_t i = 0; i < count; ++i)
  {
    lines.push_back(RandomLine(random, dimensions, distance));
  }
  return lines;
}

//------------------------------------------------------------------------------
bool IsSame(const RayHits& a, const RayHits& b)
{
  return a.First == b.First && AreSame(a.Hits, b.Hits);
}

//------------------------------------------------------------------------------
bool IsLongRun()
{
  return std::getenv("HARD_CASES_LONG") != nullptr;
}

//------------------------------------------------------------------------------
std::uint64_t GetNumber(const char* variable, std::uint64_t otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}
}
