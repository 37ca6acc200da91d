// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Crossover.h"

#include "vtkIsosurfaceComparisonFilter.h"

#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageResize.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace Compare
{
namespace
{

vtkSmartPointer<vtkImageData> Resize(vtkImageData* volume, double factor)
{
  if (factor == 1.0)
  {
    return volume;
  }
  vtkNew<vtkImageResize> resize;
  resize->SetInputData(volume);
  resize->SetResizeMethodToMagnificationFactors();
  resize->SetMagnificationFactors(factor, factor, factor);
  resize->Update();
  return resize->GetOutput();
}

}

//------------------------------------------------------------------------------
Verdict Judge(const Costs& triangles, const Costs& rays)
{
  const double head = triangles.First - rays.First;
  const double loss = rays.Next - triangles.Next;
  const double nowhere = std::numeric_limits<double>::quiet_NaN();
  if (head >= 0.0 && loss <= 0.0)
  {
    return { Verdict::AlwaysRays, nowhere };
  }
  if (head <= 0.0 && loss >= 0.0)
  {
    return { Verdict::AlwaysTriangles, nowhere };
  }
  return { head > 0.0 ? Verdict::RaysUpTo : Verdict::TrianglesUpTo, 1.0 + head / loss };
}

//------------------------------------------------------------------------------
std::string Describe(const Verdict& verdict)
{
  const double whole = std::isnan(verdict.Pictures) ? 0.0 : std::floor(verdict.Pictures);
  const std::string pictures =
    std::to_string(std::llround(whole)) + (whole == 1.0 ? " picture" : " pictures");
  switch (verdict.Kind)
  {
    case Verdict::RaysUpTo:
      return "rays up to " + pictures + ", triangles beyond";
    case Verdict::TrianglesUpTo:
      return "triangles up to " + pictures + ", rays beyond";
    case Verdict::AlwaysRays:
      return "rays, for any number of pictures";
    default:
      return "triangles, for any number of pictures";
  }
}

//------------------------------------------------------------------------------
std::vector<Crossover> MeasureCrossover(
  vtkImageData* volume, double isovalue, int repeats, vtkCamera* camera)
{
  std::vector<Crossover> crossovers;
  for (int halfSteps = -6; halfSteps <= 2; ++halfSteps)
  {
    const double factor = std::pow(2.0, 0.5 * halfSteps);
    const int* dimensions = volume->GetDimensions();
    const int smallest = std::min({ dimensions[0], dimensions[1], dimensions[2] });
    const double samples =
      static_cast<double>(volume->GetNumberOfPoints()) * factor * factor * factor;
    if (factor != 1.0 && (smallest * factor < 8.0 || samples > 1e8))
    {
      continue;
    }
    const vtkSmartPointer<vtkImageData> image = Resize(volume, factor);
    const int* size = image->GetDimensions();
    std::fprintf(stderr, "as %d x %d x %d samples\n", size[0], size[1], size[2]);
    vtkNew<vtkIsosurfaceComparisonFilter> comparison;
    comparison->SetInputData(image);
    comparison->SetValue(0, isovalue);
    comparison->SetCamera(camera);
    comparison->SetNumberOfRepeats(repeats);
    comparison->MarchingCubesOff();
    comparison->SynchronizedTemplatesOff();
    comparison->ContourFilterOff();
    comparison->SpanSpaceOff();
    comparison->AccuracyOff();
    comparison->Update();
    const auto getCosts = [&comparison](vtkIdType row) -> Costs
    {
      vtkTable* table = comparison->GetOutput();
      return { table->GetValueByName(row, "NewIsovaluePictureTime").ToDouble(),
        table->GetValueByName(row, "NextPictureTime").ToDouble() };
    };
    Crossover crossover;
    image->GetDimensions(crossover.Dimensions);
    crossover.Samples = static_cast<double>(image->GetNumberOfPoints());
    crossover.Triangles = getCosts(0);
    crossover.Rays = getCosts(1);
    crossovers.push_back(crossover);
  }
  return crossovers;
}

}
