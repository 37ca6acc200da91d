// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshSource_h
#define MeshSource_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkUnstructuredGrid;
VTK_ABI_NAMESPACE_END

namespace Benchmark
{

/// What the cells of a made mesh are: those of a lattice on the cube from -1 to 1 whose inner
/// points are moved at random by up to a fifth of their distance, or five tetrahedra for each.
enum class MeshShape
{
  Tetrahedra,
  Hexahedra
};

/// Makes a mesh of a lattice with so many cells along each axis. Points and cells are in the order
/// of the lattice, or in a random one, which is the same every time. The points have the arrays of
/// GetMeshFields, each with the isovalue 0.
vtkSmartPointer<vtkUnstructuredGrid> MakeMesh(MeshShape shape, int edge, bool isShuffled);

/// The number of cells along an axis that makes about so many cells in all.
int GetMeshEdge(MeshShape shape, double cells);

/// ball, whose surface passes few cells, and gyroid, whose surface passes many.
std::vector<std::string> GetMeshFields();

}

#endif
