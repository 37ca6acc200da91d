// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "AccuracyReport.h"

#include "Support/OutputFile.h"

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataWriter.h>

#include <algorithm>
#include <cmath>

namespace Benchmark
{
namespace
{

/// The errors that are exceeded by a share of 10^(-i / 50) of the rays.
Json::Value GetErrorDistribution(const HitAccuracy& accuracy)
{
  constexpr int perDecade = 50;
  constexpr int decades = 4;
  Json::Value distribution;
  for (int i = 0; i <= perDecade * decades; ++i)
  {
    const double share = std::pow(10.0, -1.0 * i / perDecade);
    Json::Value point;
    point.append(accuracy.GetError(1.0 - share));
    point.append(share);
    distribution.append(point);
  }
  return distribution;
}

}

//------------------------------------------------------------------------------
Json::Value ToJson(const Result& result)
{
  const HitAccuracy& accuracy = result.Accuracy;
  Json::Value row;
  row["method"] = result.Family;
  row["parameter"] = result.Parameter;
  row["missed"] = accuracy.Missed;
  row["invented"] = accuracy.Invented;
  if (!accuracy.Errors.empty())
  {
    row["displaced"] = accuracy.Displaced;
    row["medianError"] = accuracy.GetError(0.5);
    row["p99Error"] = accuracy.GetError(0.99);
    row["maximumError"] = accuracy.GetError(1.0);
    row["errorsAndSharesAbove"] = GetErrorDistribution(accuracy);
  }
  row["nanosecondsPerRay"] = ToJson(result.NanosecondsPerRay);
  row["nanosecondsPerCell"] = ToJson(result.NanosecondsPerCell);
  row["millisecondsPerFrame"] = ToJson(result.FrameMilliseconds);
  row["millisecondsTracing"] = ToJson(result.TraceMilliseconds);
  return row;
}

//------------------------------------------------------------------------------
void WriteErrorImage(
  const std::vector<PictureErrors>& pictures, int pixels, const std::string& fileName)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(pixels, pixels, 1);
  for (const PictureErrors& picture : pictures)
  {
    vtkNew<vtkFloatArray> errors;
    errors->SetName(picture.Title.c_str());
    errors->SetNumberOfValues(image->GetNumberOfPoints());
    std::transform(picture.Errors.begin(), picture.Errors.end(), errors->GetPointer(0),
      [](double error) { return static_cast<float>(error); });
    image->GetPointData()->AddArray(errors);
  }
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(image);
  writer->WriteToOutputStringOn();
  writer->Write();
  Programs::WriteFile(writer->GetOutputString(), fileName);
}

}
