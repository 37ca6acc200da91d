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

//------------------------------------------------------------------------------
double CountSamples(vtkImageData* volume, double factor)
{
  return static_cast<double>(volume->GetNumberOfPoints()) * factor * factor * factor;
}

//------------------------------------------------------------------------------
/// Those of the sizes that are measured.
std::vector<double> FindFactors(vtkImageData* volume)
{
  const int* dimensions = volume->GetDimensions();
  const int smallest = std::min({ dimensions[0], dimensions[1], dimensions[2] });
  std::vector<double> factors;
  for (int halfSteps = -6; halfSteps <= 2; ++halfSteps)
  {
    const double factor = std::pow(2.0, 0.5 * halfSteps);
    if (factor == 1.0 || (smallest * factor >= 8.0 && CountSamples(volume, factor) <= 1e8))
    {
      factors.push_back(factor);
    }
  }
  return factors;
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
double CountCrossoverSamples(vtkImageData* volume)
{
  double samples = 0.0;
  for (const double factor : FindFactors(volume))
  {
    samples += CountSamples(volume, factor);
  }
  return samples;
}

//------------------------------------------------------------------------------
std::vector<Crossover> MeasureCrossover(vtkImageData* volume, double isovalue, int repeats,
  vtkCamera* camera, const std::function<void(double)>& report)
{
  const double all = CountCrossoverSamples(volume);
  double done = 0.0;
  std::vector<Crossover> crossovers;
  for (const double factor : FindFactors(volume))
  {
    const vtkSmartPointer<vtkImageData> image = Resize(volume, factor);
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
    done += CountSamples(volume, factor);
    report(done / all);
  }
  return crossovers;
}

}
