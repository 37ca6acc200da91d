// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Quad_h
#define Quad_h

// Doubles are promoted on purpose.
#ifdef __clang__
#pragma clang diagnostic ignored "-Wdouble-promotion"
#endif

namespace vtkIsosurfaceRayTracing
{

/// Precise arithmetic for reference solutions: 113 bits where the compiler has them. Only + - * /
/// and comparisons are used, which need no library.
#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Quad;
#else
using Quad = long double;
#endif

}

#endif
