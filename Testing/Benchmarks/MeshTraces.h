// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshTraces_h
#define MeshTraces_h

#include "MeshCase.h"
#include "Report.h"
#include "Schedule.h"

namespace Benchmark
{

/// How fast rays are traced, beside those that Embree traces through the triangles of
/// vtkContour3DLinearGrid, and whether both hit the same.
void MeasureMeshTraces(const Schedule& schedule, const MeshCase& mesh, Report& report);

/// How fast rays are traced through the cells of a mesh, beside the same cells split into
/// tetrahedra. For meshes that have them.
void MeasureMeshSplit(const Schedule& schedule, const MeshCase& mesh, Report& report);

/// How fast rays are traced through other hierarchies over the cells, one by one: a uniform grid
/// with lists of cells, and Embree's tree. For meshes of up to two million cells, all tetrahedra.
void MeasureMeshHierarchies(const Schedule& schedule, const MeshCase& mesh, Report& report);

}

#endif
