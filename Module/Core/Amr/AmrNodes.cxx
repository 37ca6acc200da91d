// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Amr/AmrNodes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void AmrNodes::Shorten()
{
  constexpr double largest = std::numeric_limits<float>::max();
  std::vector<double> rounded = this->Values;
  for (const std::size_t place : this->Continued)
  {
    double& value = rounded[place];
    value = std::abs(value) <= largest ? static_cast<double>(static_cast<float>(value)) : value;
  }
  const bool areSame = std::all_of(rounded.begin(), rounded.end(),
    [](double value)
    {
      return !std::isfinite(value) ||
        (std::abs(value) <= largest && static_cast<double>(static_cast<float>(value)) == value);
    });
  if (areSame)
  {
    this->Singles.assign(rounded.begin(), rounded.end());
    this->Values = {};
  }
  this->Continued = {};
}

//------------------------------------------------------------------------------
VolumeView AmrNodes::GetSamples() const
{
  const std::size_t first = Offset({ 1, 1, 1 }, this->Dimensions);
  const bool areSingle = this->Values.empty();
  VolumeView view;
  view.Type = areSingle ? ScalarType::Float32 : ScalarType::Float64;
  view.Samples = areSingle ? static_cast<const void*>(this->Singles.data() + first)
                           : this->Values.data() + first;
  view.Dimensions = { this->Dimensions[0] - 1, this->Dimensions[1] - 1, this->Dimensions[2] - 1 };
  view.Before = 1;
  return view;
}

//------------------------------------------------------------------------------
std::size_t AmrNodes::GetMemory() const
{
  return this->Values.size() * sizeof(double) + this->Singles.size() * sizeof(float) +
    this->HiddenCells.size();
}

}
