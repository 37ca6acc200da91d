// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef HardCases_Certificate_h
#define HardCases_Certificate_h

#include "ExactCrossings.h"

namespace Oracle
{

/// The claim that the first hit of a line lies in [Low, High], within the cell, and is where the
/// line enters or leaves.
struct Claim
{
  Index Cell;
  double Low;
  double High;
  bool Entering;
};

enum class Verdict
{
  Proven,
  NotInCell,
  NoSignChange,
  EarlierRoot
};

/// Proves a claim in rational numbers, where nothing is rounded, or says what is wrong with it.
Verdict Judge(const Field& field, double isovalue, const Line& line, const Claim& claim);

}

#endif
