// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Setup_h
#define Setup_h

#include "Report.h"
#include "Views.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace Benchmark
{

/// Reports progress.
inline void Log(const std::string& what)
{
  std::fprintf(stderr, "%s\n", what.c_str());
}

/// A number as people write it: whole ones with all digits.
inline std::string ToText(double number)
{
  char text[32];
  const bool isWhole = std::abs(number) < 1e15 && number == std::floor(number);
  std::snprintf(text, sizeof(text), isWhole ? "%.0f" : "%g", number);
  return text;
}

/// What is measured, and how long.
struct Setup
{
  vtkSmartPointer<vtkImageData> Image;
  std::vector<double> Isovalues;
  /// The edge of the pictures, in pixels.
  int Size;
  /// The number of views of the orbit.
  int Views;
  /// In ascending order.
  std::vector<int> Threads;
  int Repeats;
  /// Those that are available.
  std::vector<std::string> Baselines;

  int GetMostThreads() const { return this->Threads.back(); }
  Bounds GetBounds() const
  {
    Bounds bounds;
    this->Image->GetBounds(bounds.data());
    return bounds;
  }
  std::vector<View> GetOrbit() const { return MakeOrbit(this->GetBounds(), this->Views); }
  std::string GetPictureSize() const
  {
    return std::to_string(this->Size) + " x " + std::to_string(this->Size) + " pixels";
  }
  void LogTurn(const std::string& what, int repeat) const
  {
    Log(what + ", turn " + std::to_string(repeat + 1) + " of " + std::to_string(this->Repeats));
  }
  double GetDataBytes() const
  {
    return 1.0 * this->Image->GetNumberOfPoints() * this->Image->GetScalarSize() *
      this->Image->GetNumberOfScalarComponents();
  }
  /// As large as the Visible Woman, for which the goals are higher.
  bool IsLarge() const { return this->Image->GetNumberOfPoints() >= vtkIdType(400000000); }
};

}

#endif
