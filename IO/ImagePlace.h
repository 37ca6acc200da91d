// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ImagePlace_h
#define ImagePlace_h

#include <array>

namespace ImageFiles
{

/// Where a header puts the samples of its file, of which VTK's readers leave out the directions of
/// the axes.
struct ImagePlace
{
  /// From a sample to the next one along each axis. They need not be perpendicular; where the
  /// header is damaged they are zero.
  std::array<std::array<double, 3>, 3> Steps;
  /// That of the first sample.
  std::array<double, 3> Origin;

  /// Changes the directions of x and y: those of a patient are to the right and to the front here,
  /// and to the left and to the back in others.
  void Turn(double x, double y)
  {
    for (std::array<double, 3>* vector :
      { &this->Steps[0], &this->Steps[1], &this->Steps[2], &this->Origin })
    {
      (*vector)[0] *= x;
      (*vector)[1] *= y;
    }
  }
};

}

#endif
