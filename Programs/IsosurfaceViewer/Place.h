// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Place_h
#define Place_h

namespace Viewer
{

/// A rectangle in the window, from 0 to 1.
struct Place
{
  double Left;
  double Bottom;
  double Right;
  double Top;
};

}

#endif
