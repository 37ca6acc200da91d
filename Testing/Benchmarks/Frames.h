// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Frames_h
#define Frames_h

#include "Judgement.h"
#include "Samples.h"

#include <memory>
#include <string>
#include <vector>

namespace Benchmark
{

/// What a picture shows, pixel by pixel, in rows from the bottom.
struct Picture
{
  /// Along the ray, as Judge takes it.
  std::vector<double> Found;
  /// The brightness, from 0 to 255.
  std::vector<double> Greys;
  /// The most by which two neighbouring numbers of the depth buffer differ at a hit, in cells.
  double DepthStep = 0.0;
};

/// Seconds. Only our mapper knows the parts: the rays, their colours, and all that it does.
struct FrameParts
{
  double Whole;
  double Trace;
  double Shade;
  double Mapper;
};

/// Draws the surface of an input in a window, white and matt, with a light at the eye.
class Painter
{
public:
  Painter(std::string family, std::string knob);
  virtual ~Painter() = default;

  /// As in Method.
  std::string Family;
  std::string Knob;

  virtual FrameParts Draw(const View& view) = 0;
  /// Draws, and reads what is seen.
  virtual Picture Look(const View& view) = 0;
};

/// Our mapper with each solver, Robust first; and its rivals in VTK: the polygons of flying edges,
/// vtkFixedPointVolumeRayCastMapper and vtkGPUVolumeRayCastMapper. Pictures are square, of so many
/// pixels along the edge. Says who is absent, and why; without a display that is everybody.
std::vector<std::unique_ptr<Painter>> MakePainters(
  const Input& input, int size, std::vector<std::string>& absent);

/// What a painter's frames were like.
struct FrameResult
{
  std::string Input;
  std::string Family;
  std::string Knob;
  /// Of the pixels asked about.
  Judgement Judged;
  /// How far the brightness is from that of the exact hit, of 255, over the rays hit by both, in
  /// ascending order.
  std::vector<double> GreyErrors;
  double DepthStep = 0.0;
  /// In seconds; the parts are empty unless it is our mapper.
  Samples Whole;
  Samples Trace;
  Samples Shade;
  Samples Mapper;
  /// The whole against that of Robust right before it.
  Samples TimesRobust;
};

/// The painters draw every view in turn, so often, after once that is not measured.
std::vector<FrameResult> MeasureFrames(const Input& input, const Rays& rays,
  const std::vector<double>& truth, int repeats, std::vector<std::string>& absent);

}

#endif
