// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The rays of a picture, cast at the isosurface and at triangles, in double precision and without
// OpenGL.

#ifndef vtkIsosurfaceComparisonRays_h
#define vtkIsosurfaceComparisonRays_h

#include "vtkIsosurfaceRayTracingCompat.h"
#include "vtkNew.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkCamera;
class vtkDataSet;
class vtkDoubleArray;
class vtkImageData;
class vtkPoints;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace vtkIsosurfaceComparison
{

class TracedIsosurface;

/// A camera that looks at the centre of the data from the left, the front and above, with z up.
void LookAt(vtkDataSet* data, vtkCamera* camera);

/// Resets the clipping range of a camera to include all of the data in front of it.
void IncludeWhole(vtkDataSet* data, vtkCamera* camera);

/// A ray through the centre of each pixel, rows from the bottom, from the near clipping plane
/// (T = 0) to the far one (T = 1).
class PictureRays
{
public:
  PictureRays(vtkCamera* camera, int width, int height);

  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }

  /// The T of the first hit of each ray, NaN where there is none.
  std::vector<double> CastAt(TracedIsosurface& isosurface) const;
  std::vector<double> CastAt(vtkPolyData* triangles) const;

  /// The hits of an isosurface as points with normals. Returns whether rays could be cast.
  bool FindHits(TracedIsosurface& isosurface, vtkPolyData* hits) const;

  /// Casts the rays of a picture and discards the hits, which saves memory.
  void CastInPortions(TracedIsosurface& isosurface) const;

  /// The distance from the near clipping plane to the far one along each ray, in the world.
  std::vector<double> GetLengths() const;

private:
  int Width;
  int Height;
  vtkNew<vtkPoints> Origins;
  vtkNew<vtkDoubleArray> Directions;
};

/// The data of DepthDifference and Coverage in the output of the filter.
enum Coverage : unsigned char
{
  Neither = 0,
  Both = 1,
  IsosurfaceAlone = 2,
  MeshAlone = 3
};

/// Fills an image of the size of the picture with the differences of two sets of Ts.
void WriteDifference(const PictureRays& rays, const std::vector<double>& isosurface,
  const std::vector<double>& mesh, vtkImageData* image);

/// The number of pixels that show the first and not the second.
double CountPixelsAlone(const std::vector<double>& first, const std::vector<double>& second);
double CountCoveredPixels(const std::vector<double>& isosurface);

}

#endif
