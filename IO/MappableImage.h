// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MappableImage_h
#define MappableImage_h

#include "RawSamples.h"

#include <array>
#include <string>

namespace ImageFiles
{

/// An image whose samples can be used where they are in a file, x fastest and z slowest.
struct MappableImage
{
  RawSamples Samples;
  /// The name of the array, its type and its number of components, as VTK has them.
  std::string ArrayName;
  int ScalarType;
  int NumberOfComponents;
  std::array<int, 6> Extent;
  std::array<double, 3> Spacing;
  std::array<double, 3> Origin;
  std::array<double, 9> Direction;
  /// The class of VTK that reads the file into the memory.
  std::string Reader;

  /// The number of all components of all samples. Of headers that are wrong it may be more than an
  /// integer holds.
  double GetNumberOfValues() const;
  /// In bytes.
  double GetSize() const;

  /// Whether it differs from another in nothing but its values.
  bool IsLike(const MappableImage& other) const;

  /// Counts the samples along an axis from its other end, so that each stays where it is in space.
  /// For files whose samples VTK's readers reverse.
  void Reverse(std::size_t axis);

  /// Throws std::runtime_error if the samples are not in the file, or cannot be used where they
  /// are. Finds the place of those that are at the end of the file.
  void Check();

  /// Throws std::runtime_error.
  [[noreturn]] void Throw(const std::string& problem) const;
};

}

#endif
