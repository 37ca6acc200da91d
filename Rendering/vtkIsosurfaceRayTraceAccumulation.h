// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The mean of the frames of a scene that does not change, whose rays go through other places of the
// pixels in every frame.

#ifndef vtkIsosurfaceRayTraceAccumulation_h
#define vtkIsosurfaceRayTraceAccumulation_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                       // for vtkMTimeType

#include "Picture/RenderTiles.h"

#include <cstdint> // for std::uint16_t
#include <utility> // for std::pair
#include <vector>  // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkObject;

class vtkIsosurfaceRayTraceAccumulation
{
public:
  /// The most frames whose sums can be kept.
  static constexpr int MaximumNumberOfFrames = 256;

  /// All that a picture is made from. What the ray tracer has as numbers is compared by them: VTK
  /// gives cameras and lights new times in every frame of a stereo window. What is behind pointers
  /// goes by its time.
  struct Key
  {
    Key() = default;
    /// Some of the objects may be null. The distance of rays is in pixels.
    Key(const std::vector<vtkObject*>& objects, double distance,
      const vtkIsosurfaceRayTracing::Scene& scene);
    bool operator==(const Key& other) const;

    std::vector<std::pair<const vtkObject*, vtkMTimeType>> Objects;
    /// Of each field.
    std::vector<vtkIsosurfaceRayTracing::Camera> Views;
    std::vector<double> Numbers;
    std::vector<float> Depths;
  };

  /// How many frames there are of what the key says.
  int GetNumberOfFrames(const Key& key) const { return this->Of == key ? this->Frames : 0; }

  /// Turns a scene into that of a frame, by its number from 0: the first one stays as it is.
  static void SetFrame(int number, vtkIsosurfaceRayTracing::Scene& scene);

  /// Adds a complete frame. If there is none of what the key says, those that are there are
  /// dropped.
  void Add(const Key& key, const vtkIsosurfaceRayTracing::Frame& frame);

  /// Gives a frame the mean of the colours and the depths of the first one.
  void GetMean(vtkIsosurfaceRayTracing::Frame& frame) const;

private:
  Key Of;
  int Frames = 0;
  std::vector<std::uint16_t> Sums;
  std::vector<float> Depths;
};

VTK_ABI_NAMESPACE_END

#endif
