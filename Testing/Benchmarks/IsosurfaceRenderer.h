// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef IsosurfaceRenderer_h
#define IsosurfaceRenderer_h

#include "Views.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace Benchmark
{

constexpr double NotMeasured = std::numeric_limits<double>::quiet_NaN();

/// What is found along a ray is a distance, or one of these.
constexpr double NoHit = std::numeric_limits<double>::quiet_NaN();
constexpr double HitAtUnknownDistance = std::numeric_limits<double>::infinity();

/// The seconds that a picture took; NotMeasured where there is no such thing.
struct FrameTimes
{
  /// Up to the finished frame in the window.
  double Whole = NotMeasured;
  /// Making the rays and finding what they hit first.
  double Trace = NotMeasured;

  /// Of the picture, finished or not.
  double GetSeconds() const { return std::isnan(this->Whole) ? this->Trace : this->Whole; }

  /// The time by which renderers are compared: what both have.
  double GetCommon(const FrameTimes& other) const
  {
    return std::isnan(this->Trace) || std::isnan(other.Trace) ? this->Whole : this->Trace;
  }
};

/// A way to show an isosurface of a volume.
class IsosurfaceRenderer
{
public:
  virtual ~IsosurfaceRenderer() = default;

  virtual std::string GetName() const = 0;
  /// Does all that a new isovalue requires, up to the first picture; returns the seconds.
  virtual double ChangeIsovalue(double isovalue, const View& view) = 0;
  /// Draws one more picture of the isosurface.
  virtual FrameTimes Draw(const View& view, int threads) = 0;
  /// Whether Draw makes pictures: some methods only extract triangles.
  virtual bool HasPictures() const { return true; }
  /// Whether the threads of Draw can be chosen.
  virtual bool HasThreads() const { return false; }
  /// Numbers about the last change of the isovalue, with their names.
  virtual std::vector<std::pair<std::string, double>> GetDetails() const { return {}; }
  /// The share of the pixels of the last picture that show the surface.
  virtual double GetHitShare() { return NotMeasured; }
  /// The distance of the surface from the eye in every pixel of the last picture, in rows from the
  /// bottom. HitAtUnknownDistance, where it is visible but its distance is not known. Empty if
  /// there is no picture.
  virtual std::vector<double> GetDistances() { return {}; }
};

}

#endif
