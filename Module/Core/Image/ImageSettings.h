// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ImageSettings_h
#define ImageSettings_h

#include <vector>

namespace vtkIsosurfaceRayTracing
{

enum class BrickLayout
{
  Unbricked,
  Apron,
  TwoLevel
};

/// What is built over the samples of an image, and how.
struct ImageSettings
{
  /// The branching of the macrocell levels, finest first.
  std::vector<int> MacrocellBranching = { 8, 8 };
  BrickLayout Layout = BrickLayout::Apron;
  int BrickSize = 8;
  /// For BrickLayout::TwoLevel, in bricks.
  int BrickGroupSize = 4;

  bool operator==(const ImageSettings& other) const
  {
    return this->MacrocellBranching == other.MacrocellBranching && this->Layout == other.Layout &&
      this->BrickSize == other.BrickSize && this->BrickGroupSize == other.BrickGroupSize;
  }
};

}

#endif
