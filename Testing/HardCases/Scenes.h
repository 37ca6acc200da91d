// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef HardCases_Scenes_h
#define HardCases_Scenes_h

#include "ExactCrossings.h"
#include "Image/ImageField.h"
#include "Picture/CastRays.h"
#include "RandomNumbers.h"

#include <memory>

namespace HardCases
{

using Oracle::Field;
using Oracle::Index;
using Oracle::Line;
using Oracle::Triple;
using vtkIsosurfaceRayTracing::Hit;
using vtkIsosurfaceRayTracing::ImageSettings;
using vtkIsosurfaceRayTracing::Isosurface;
using vtkIsosurfaceRayTracing::RandomNumbers;
using vtkIsosurfaceRayTracing::RayHits;
using vtkIsosurfaceRayTracing::RootSolver;
using vtkIsosurfaceRayTracing::ScalarType;
using vtkIsosurfaceRayTracing::TraceRequest;

/// Which hits of a ray are requested.
enum class Reach
{
  First,
  All
};

/// An opacity so small that a ray passes any number of such surfaces.
inline constexpr double Glass = 1e-12;

std::vector<vtkIsosurfaceRayTracing::CastRay> ToCastRays(const std::vector<Line>& lines);

/// A field, ready to be traced.
class Tracer
{
public:
  explicit Tracer(
    const Field& field, const ImageSettings& settings = {}, ScalarType type = ScalarType::Float64);

  /// The hits of every line. All: with a surface so transparent that the ray never ends at it.
  RayHits Cast(const std::vector<Line>& lines, double isovalue,
    RootSolver solver = RootSolver::Robust, Reach reach = Reach::All, int threads = 1);

  vtkIsosurfaceRayTracing::ImageField& GetField() { return *this->Traced; }

  Index GetCell(const Hit& hit) const { return this->Traced->GetLattice().GetCell(hit); }

private:
  std::vector<unsigned char> Bytes;
  std::unique_ptr<vtkIsosurfaceRayTracing::ImageField> Traced;
};

/// A field by a function of the point.
template <typename Function>
Field Sample(const Index& dimensions, const Function& function)
{
  Field field{ dimensions, {} };
  for (int z = 0; z < dimensions[2]; ++z)
  {
    for (int y = 0; y < dimensions[1]; ++y)
    {
      for (int x = 0; x < dimensions[0]; ++x)
      {
        field.Values.push_back(function(x, y, z));
      }
    }
  }
  return field;
}

Field RandomField(
  RandomNumbers& random, const Index& dimensions, double low = -1.0, double high = 1.0);

/// Values are positive within the ball: the isovalue is 0.
Field Ball(const Index& dimensions, const Triple& center, double radius);

/// A line through the volume, from some cells before it.
Line RandomLine(RandomNumbers& random, const Index& dimensions, double distance = 3.0);
std::vector<Line> RandomLines(
  RandomNumbers& random, const Index& dimensions, std::size_t count, double distance = 3.0);

/// Whether two sets of hits are the same, to the last bit.
bool IsSame(const RayHits& a, const RayHits& b);

/// Whether the long form of the tests is requested (environment variable HARD_CASES_LONG).
bool IsLongRun();

/// The number in an environment variable; otherwise another.
std::uint64_t GetNumber(const char* variable, std::uint64_t otherwise);

}

#endif
