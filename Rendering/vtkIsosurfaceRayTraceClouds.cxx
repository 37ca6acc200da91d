// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceRayTraceClouds.h"

#include "vtkIsosurfaceRayTraceValueColors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// Whatever the unit distance is, numbers stay finite.
constexpr double LargestAttenuation = 1e30;
/// How far a function may be from the line between two nodes.
constexpr double Tolerance = 1e-4;
/// How often the interval between two nodes is halved at most, next to jumps.
constexpr int MaximumHalvings = 16;

using Rgba = std::array<double, 4>;

class NodeMaker
{
public:
  NodeMaker(const vtkIsosurfaceRayTraceValueColors& colors, double unitDistance)
    : Colors(colors)
    , UnitDistance(unitDistance)
  {
  }

  std::vector<vtkirt::CloudNode> Make()
  {
    const std::vector<double> values = this->Colors.FindNodes();
    if (values.empty())
    {
      this->Add(0.0, this->Colors.Get(0.0));
      return this->Nodes;
    }
    // Where functions are not clamped, they jump to zero.
    this->Add(values.front(), this->Colors.Get(std::nextafter(values.front(), -HUGE_VAL)));
    Rgba last = this->Colors.Get(values.front());
    this->Add(values.front(), last);
    for (std::size_t i = 1; i < values.size(); ++i)
    {
      const Rgba next = this->Colors.Get(values[i]);
      this->AddBetween(values[i - 1], last, values[i], next, MaximumHalvings);
      this->Add(values[i], next);
      last = next;
    }
    this->Add(values.back(), this->Colors.Get(std::nextafter(values.back(), HUGE_VAL)));
    return this->Nodes;
  }

private:
  void Add(double value, const Rgba& rgba)
  {
    const double attenuation = std::min(rgba[3] / this->UnitDistance, LargestAttenuation);
    this->Nodes.push_back(
      { value, rgba[3] > 0.0 ? attenuation : 0.0, { rgba[0], rgba[1], rgba[2] } });
  }

  /// Adds nodes between two.
  void AddBetween(double low, const Rgba& atLow, double high, const Rgba& atHigh, int halvings)
  {
    if (halvings == 0 || this->IsLinear(low, atLow, high, atHigh))
    {
      return;
    }
    const double middle = low + 0.5 * (high - low);
    const Rgba there = this->Colors.Get(middle);
    this->AddBetween(low, atLow, middle, there, halvings - 1);
    this->Add(middle, there);
    this->AddBetween(middle, there, high, atHigh, halvings - 1);
  }

  bool IsLinear(double low, const Rgba& atLow, double high, const Rgba& atHigh) const
  {
    // Functions that are symmetric about the middle must not pass for linear.
    for (const double fraction : { 0.125, 0.3, 0.5, 0.7, 0.875 })
    {
      const Rgba there = this->Colors.Get(low + fraction * (high - low));
      for (std::size_t i = 0; i < 4; ++i)
      {
        const double linear = atLow[i] + fraction * (atHigh[i] - atLow[i]);
        if (std::abs(there[i] - linear) > Tolerance)
        {
          return false;
        }
      }
    }
    return true;
  }

  const vtkIsosurfaceRayTraceValueColors& Colors;
  double UnitDistance;
  std::vector<vtkirt::CloudNode> Nodes;
};

}

namespace vtkIsosurfaceRayTraceClouds
{

//------------------------------------------------------------------------------
std::unique_ptr<vtkirt::CloudTransfer> MakeTransfer(
  const vtkIsosurfaceRayTraceValueColors& colors, double unitDistance)
{
  return std::make_unique<vtkirt::CloudTransfer>(NodeMaker(colors, unitDistance).Make());
}

}

VTK_ABI_NAMESPACE_END
