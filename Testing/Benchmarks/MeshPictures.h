// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshPictures_h
#define MeshPictures_h

#include "MeshCase.h"
#include "Report.h"
#include "Schedule.h"

namespace Benchmark
{

/// The bytes that the mapper keeps of a mesh. It comes before what else needs memory.
void MeasureMeshMemory(const Schedule& schedule, const MeshCase& mesh, Report& report);

/// The times of pictures in a window, which must be possible: the first one, those of a new
/// isovalue and from another side; beside the polygons that VTK's filters extract.
void MeasureMeshPictures(const Schedule& schedule, const MeshCase& mesh, Report& report);

}

#endif
