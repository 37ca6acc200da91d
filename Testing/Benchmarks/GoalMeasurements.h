// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef GoalMeasurements_h
#define GoalMeasurements_h

#include "Setup.h"

namespace Benchmark
{

/// Goal 3: from nothing built to the first picture, against reading the volume once.
void MeasureColdStart(const Setup& setup, double isovalue, Report& report);

/// Goal 5: the frame in a window of 1024 x 1024 pixels against its trace. Needs a display.
void MeasureWholeFrame(const Setup& setup, double isovalue, Report& report);

/// Goal 6, past this machine: threads that share the tiles of a picture, each of measured cost.
void MeasureScaling(const Setup& setup, double isovalue, Report& report);

}

#endif
