// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Macros that define the settings of mappers.

#ifndef vtkIsosurfaceRayTraceSetMacros_h
#define vtkIsosurfaceRayTraceSetMacros_h

#include "vtkSetGet.h"

#include <cmath> // for std::isnan

/// As vtkSetClampMacro, but NaN, which passes its comparisons, is an error and changes nothing.
#define vtkIsosurfaceSetClampMacro(name, type, min, max)                                           \
  virtual void Set##name(type value)                                                               \
  {                                                                                                \
    if (std::isnan(value))                                                                         \
    {                                                                                              \
      vtkErrorMacro(#name " cannot be NaN, and remains " << this->name << ". Give a number.");     \
      return;                                                                                      \
    }                                                                                              \
    const type clamped = value < (min) ? (min) : (value > (max) ? (max) : value);                  \
    if (this->name != clamped)                                                                     \
    {                                                                                              \
      this->name = clamped;                                                                        \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  virtual type Get##name##MinValue()                                                               \
  {                                                                                                \
    return min;                                                                                    \
  }                                                                                                \
  virtual type Get##name##MaxValue()                                                               \
  {                                                                                                \
    return max;                                                                                    \
  }

#endif
