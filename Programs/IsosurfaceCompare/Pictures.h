// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The pictures of a report, as PNG in base 64. All but DrawDifference need a display.

#ifndef Pictures_h
#define Pictures_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkType.h>

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkCamera;
class vtkDataSet;
class vtkImageData;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace Compare
{

/// The isosurface of an image or a mesh as triangles of the filter that GetExtractionName names,
/// and ray traced: with the same lights and colours.
std::string DrawTriangles(vtkDataSet* data, double isovalue, vtkCamera* camera);
std::string DrawRayTraced(vtkDataSet* data, double isovalue, vtkCamera* camera);
std::string GetExtractionName(vtkDataSet* data);

/// The triangles of output 1 of vtkIsosurfaceComparisonFilter, each coloured by the distance at its
/// centroid, logarithmically from a thousandth of a cell to one cell. The number of vertices is
/// that of the mesh before the filter split its triangles.
std::string DrawErrors(vtkPolyData* mesh, vtkIdType vertices, vtkCamera* camera);

/// Output 2 of vtkIsosurfaceComparisonFilter: grey where both surfaces are at the same depth, red
/// where the mesh is behind the isosurface and blue where it is in front, saturated at one unit;
/// yellow where one of them is missing.
std::string DrawDifference(vtkImageData* difference, double unit);

/// The name of the OpenGL renderer.
std::string GetOpenGLRenderer();

}

#endif
