// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Chart_h
#define Chart_h

#include <array>
#include <string>
#include <vector>

namespace Compare
{

/// A polyline through points.
struct Curve
{
  std::string Name;
  std::vector<std::array<double, 2>> Points;
  bool IsDashed = false;
  bool HasMarkers = true;
};

/// Draws curves on logarithmic axes, as a PNG in base 64. Points that are not positive and finite
/// are left out; returns an empty string if none remain. Needs a display.
std::string DrawChart(const std::string& title, const std::string& xTitle,
  const std::string& yTitle, const std::vector<Curve>& curves);

}

#endif
