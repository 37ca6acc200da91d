// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The pictures of a report, as PNG in base 64. All but DrawDifference need a display.

#ifndef Pictures_h
#define Pictures_h

#include <vtkType.h>

#include <string>

class vtkCamera;
class vtkImageData;
class vtkPolyData;

namespace Compare
{

/// The isosurface as triangles of vtkFlyingEdges3D, and ray traced: with the same lights and
/// colours.
std::string DrawTriangles(vtkImageData* volume, double isovalue, vtkCamera* camera);
std::string DrawRayTraced(vtkImageData* volume, double isovalue, vtkCamera* camera);

/// Triangles of the output 1 of vtkIsosurfaceComparisonFilter, of so many vertices before it cut
/// them, each in the colour of the distance at its centroid: logarithmically, from a thousandth of
/// a cell to one.
std::string DrawErrors(vtkPolyData* mesh, vtkIdType vertices, vtkCamera* camera);

/// The output 2 of vtkIsosurfaceComparisonFilter: grey where both surfaces are at the same depth,
/// red where the mesh is behind the isosurface and blue where it is before it, fully so at one
/// unit; yellow where one of them is missing.
std::string DrawDifference(vtkImageData* difference, double unit);

/// What draws here, in the words of OpenGL.
std::string GetOpenGLRenderer();

}

#endif
