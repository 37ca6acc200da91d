// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "BenchmarkInputs.h"

#include "AnalyticFields.h"
#include "ReadImage.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <random>

namespace Benchmark
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

template <typename Function>
Input Sample(const std::string& name, int n, double isovalue, const Function& function)
{
  Input input{ name + " " + std::to_string(n) + "^3", { { n, n, n }, {} }, isovalue };
  for (int z = 0; z < n; ++z)
  {
    for (int y = 0; y < n; ++y)
    {
      for (int x = 0; x < n; ++x)
      {
        input.Field.Values.push_back(function(x, y, z));
      }
    }
  }
  return input;
}

/// A square of lines with so many on a side, that looks at the middle of the volume from an angle.
void AddSquare(const Input& input, double angle, int side, std::vector<Oracle::Line>& lines)
{
  Oracle::Triple middle;
  double diagonal = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    middle[axis] = 0.5 * (input.Field.Dimensions[axis] - 1);
    diagonal += 4.0 * middle[axis] * middle[axis];
  }
  diagonal = std::sqrt(diagonal);
  const double height = 0.3 / std::sqrt(1.09);
  const double width = 1.0 / std::sqrt(1.09);
  const Oracle::Triple direction = { -width * std::sin(angle), width * std::cos(angle), -height };
  const Oracle::Triple right = { std::cos(angle), std::sin(angle), 0.0 };
  const Oracle::Triple up = { -height * std::sin(angle), height * std::cos(angle), width };
  for (int row = 0; row < side; ++row)
  {
    for (int column = 0; column < side; ++column)
    {
      // No line is meant to be special: those of a lattice through the samples would be.
      const double u = 0.6 * diagonal * ((column + 0.5123) / side - 0.5);
      const double v = 0.6 * diagonal * ((row + 0.4871) / side - 0.5);
      Oracle::Line line;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        line.Origin[axis] =
          middle[axis] - diagonal * direction[axis] + u * right[axis] + v * up[axis];
      }
      line.Direction = direction;
      lines.push_back(line);
    }
  }
}

}

//------------------------------------------------------------------------------
Input MakeMarschnerLobb(int n)
{
  return Sample("Marschner-Lobb", n, 0.5,
    [n](int x, int y, int z)
    {
      const double scale = 2.0 / (n - 1);
      return AnalyticFields::MarschnerLobb()({ x * scale - 1.0, y * scale - 1.0, z * scale - 1.0 });
    });
}

//------------------------------------------------------------------------------
Input MakeGyroid(int n)
{
  const AnalyticFields::Gyroid gyroid = { n / 2.5 };
  return Sample("gyroid", n, 0.1,
    [gyroid](int x, int y, int z) {
      return gyroid({ static_cast<double>(x), static_cast<double>(y), static_cast<double>(z) });
    });
}

//------------------------------------------------------------------------------
Input MakeRandom(int n)
{
  std::mt19937_64 bits(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  // Few cells have the surface, or no ray would get beyond the first.
  return Sample("random corners", n, 0.93, [&](int, int, int) { return uniform(bits); });
}

//------------------------------------------------------------------------------
Input MakeNearTangent(int n)
{
  // Sheets that all but vanish: their crests come to the isovalue, a little above or below.
  std::mt19937_64 bits(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return Sample("near tangent", n, 0.0,
    [&](int, int y, int)
    {
      const bool isCrest = y % 4 == 2;
      return isCrest ? 1e-3 * uniform(bits) : -1.0 + 0.1 * uniform(bits);
    });
}

//------------------------------------------------------------------------------
Input MakePlateaus(int n)
{
  const AnalyticFields::Gyroid gyroid = { n / 3.0 };
  return Sample("integer plateaus", n, 2.0,
    [gyroid](int x, int y, int z)
    {
      return std::floor(
        2.5 * gyroid({ static_cast<double>(x), static_cast<double>(y), static_cast<double>(z) }));
    });
}

//------------------------------------------------------------------------------
Input ReadInput(const std::string& fileName, double isovalue)
{
  const vtkSmartPointer<vtkImageData> image = ReadImage(fileName);
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  Input input{ vtksys::SystemTools::GetFilenameWithoutExtension(fileName), {}, isovalue };
  image->GetDimensions(input.Field.Dimensions.data());
  input.Field.Values.resize(static_cast<std::size_t>(scalars->GetNumberOfTuples()));
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    input.Field.Values[static_cast<std::size_t>(i)] = scalars->GetComponent(i, 0);
  }
  return input;
}

//------------------------------------------------------------------------------
std::vector<Oracle::Line> MakeLines(const Input& input, int count)
{
  constexpr int views = 8;
  const int side = std::max(2, static_cast<int>(std::sqrt(static_cast<double>(count) / views)));
  std::vector<Oracle::Line> lines;
  for (int view = 0; view < views; ++view)
  {
    AddSquare(input, 2.0 * Pi * (view + 0.17) / views, side, lines);
  }
  return lines;
}

//------------------------------------------------------------------------------
std::vector<Oracle::Line> MakePicture(const Input& input, int pixels)
{
  std::vector<Oracle::Line> lines;
  AddSquare(input, 0.5, pixels, lines);
  return lines;
}

}
