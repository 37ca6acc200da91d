// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TraceLine_h
#define TraceLine_h

#include "Image/ImageField.h"
#include "TestLines.h"
#include "TestVolume.h"

#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// An opacity so small that a ray passes any number of such surfaces.
inline constexpr double Glass = 1e-9;

template <typename T>
std::unique_ptr<ImageField> NewTraced(
  const TestVolume<T>& volume, const TraceRequest& request, const ImageSettings& settings = {})
{
  auto traced = ImageField::New(volume.View(), settings, 2);
  traced->Select(request, 2);
  return traced;
}

template <typename T>
std::unique_ptr<ImageField> NewTraced(const TestVolume<T>& volume,
  const std::vector<Isosurface>& surfaces, const ImageSettings& settings = {})
{
  return NewTraced(volume, TraceRequest(surfaces), settings);
}

/// The hits of the part of a line from its origin to tEnd.
inline std::vector<Hit> Trace(ImageField& volume, const Line& line, double tEnd = Infinity,
  const UnevenPlanes* planes = nullptr)
{
  RayHits hits;
  volume.Trace(
    { ClipToVolume(line.Origin, line.Direction, 0.0, tEnd, volume.GetDimensions(), planes) }, hits);
  return hits.Hits;
}

}

#endif
