// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "BenchmarkInputs.h"

#include "AnalyticFields.h"
#include "ReadImage.h"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkNew.h>
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

/// The image of samples, in index space.
vtkSmartPointer<vtkImageData> NewImage(const Oracle::Index& dimensions, vtkDataArray* scalars)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(dimensions.data());
  image->GetPointData()->SetScalars(scalars);
  return image;
}

template <typename Function>
Input Sample(const std::string& name, int n, double isovalue, const Function& function)
{
  Input input{ name + " " + std::to_string(n) + "^3", { { n, n, n }, {} }, isovalue, {} };
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
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetNumberOfTuples(static_cast<vtkIdType>(input.Field.Values.size()));
  std::copy(input.Field.Values.begin(), input.Field.Values.end(), scalars->GetPointer(0));
  input.Image = NewImage(input.Field.Dimensions, scalars);
  return input;
}

std::vector<View> MakeViews(const Input& input, int count)
{
  Bounds bounds;
  input.Image->GetBounds(bounds.data());
  return MakeOrbit(bounds, count);
}

/// Fills in the lines of all views.
Rays AddLines(Rays rays)
{
  for (const View& view : rays.Views)
  {
    const PictureRays picture(view, rays.Size);
    rays.ForEachPixel(
      [&](int x, int y)
      {
        Oracle::Line line{ picture.GetOrigin(), picture.GetDirection(x, y) };
        vtkMath::Normalize(line.Direction.data());
        rays.Lines.push_back(line);
      });
  }
  return rays;
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
Input ReadInput(const std::string& fileName, double isovalue, double maxMemory)
{
  const vtkSmartPointer<vtkImageData> image = ReadImage(fileName, maxMemory);
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  Input input{ vtksys::SystemTools::GetFilenameWithoutExtension(fileName), {}, isovalue, {} };
  image->GetDimensions(input.Field.Dimensions.data());
  input.Field.Values.resize(static_cast<std::size_t>(scalars->GetNumberOfTuples()));
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    input.Field.Values[static_cast<std::size_t>(i)] = scalars->GetComponent(i, 0);
  }
  auto first = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(scalars->GetDataType()));
  first->SetNumberOfTuples(scalars->GetNumberOfTuples());
  first->CopyComponent(0, scalars, 0);
  input.Image = NewImage(input.Field.Dimensions, first);
  return input;
}

//------------------------------------------------------------------------------
Rays MakeRays(const Input& input, int count, int size)
{
  constexpr int views = 8;
  const int side = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(count) / views)));
  return AddLines({ MakeViews(input, views), size, std::max(1, size / side), {} });
}

//------------------------------------------------------------------------------
Rays MakePicture(const Input& input, int size)
{
  return AddLines({ { MakeViews(input, 8)[1] }, size, 1, {} });
}

}
