// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The mean of the frames of a scene that does not change. In every frame the rays go through other
// points of the pixels.

#ifndef vtkIsosurfaceRayTraceAccumulation_h
#define vtkIsosurfaceRayTraceAccumulation_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                       // for vtkMTimeType

#include "Picture/RenderTiles.h"

#include <array>   // for std::array
#include <cstdint> // for std::uint16_t
#include <utility> // for std::pair
#include <vector>  // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkObject;

class vtkIsosurfaceRayTraceAccumulation
{
public:
  /// The maximum number of frames whose sums do not overflow.
  static constexpr int MaximumNumberOfFrames = 256;

  /// Everything that a picture depends on. What the ray tracer has as numbers is compared by value:
  /// VTK gives cameras and lights new modification times in every frame of a stereo window. What is
  /// behind pointers is compared by modification time.
  struct Key
  {
    Key() = default;
    /// Some of the objects may be null. The distance of rays is in pixels.
    Key(const std::vector<vtkObject*>& objects, double distance,
      const vtkIsosurfaceRayTracing::Scene& scene);
    bool operator==(const Key& other) const;

    std::vector<std::pair<const vtkObject*, vtkMTimeType>> Objects;
    /// Of each field, and where in the picture the corners of its box are: x, y, z, w.
    std::vector<vtkIsosurfaceRayTracing::Camera> Views;
    std::vector<std::array<double, 4>> Corners;
    std::vector<double> Numbers;
    std::vector<float> Depths;
  };

  /// The number of frames for the key.
  int GetNumberOfFrames(const Key& key) const { return this->Of == key ? this->Frames : 0; }

  /// Turns a scene into that of a frame, by its number from 0: the first one is unchanged.
  static void SetFrame(int number, vtkIsosurfaceRayTracing::Scene& scene);

  /// Adds a complete frame. If the frames so far have another key, they are dropped.
  void Add(const Key& key, const vtkIsosurfaceRayTracing::Frame& frame);

  /// Replaces the colours of a frame by their mean, and the depths by those of the first one.
  void GetMean(vtkIsosurfaceRayTracing::Frame& frame) const;

private:
  Key Of;
  int Frames = 0;
  std::vector<std::uint16_t> Sums;
  std::vector<float> Depths;
};

VTK_ABI_NAMESPACE_END

#endif
