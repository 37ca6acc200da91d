// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Setup_h
#define Setup_h

#include "Report.h"
#include "Schedule.h"
#include "Views.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace Benchmark
{

/// What is measured, and how long.
struct Setup : Schedule
{
  vtkSmartPointer<vtkImageData> Image;
  std::vector<double> Isovalues;
  /// Those that are available.
  std::vector<std::string> Baselines;

  Bounds GetBounds() const
  {
    Bounds bounds;
    this->Image->GetBounds(bounds.data());
    return bounds;
  }
  std::vector<View> GetOrbit() const { return MakeOrbit(this->GetBounds(), this->Views); }
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
