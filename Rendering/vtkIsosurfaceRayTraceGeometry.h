// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The coordinates of the samples of an image or a rectilinear grid, without the volume's own
// matrix.

#ifndef vtkIsosurfaceRayTraceGeometry_h
#define vtkIsosurfaceRayTraceGeometry_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Image/Lattice/UnevenPlanes.h"

#include <array>    // for std::array
#include <optional> // for std::optional
#include <string>   // for std::string
#include <vector>   // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkDataSet;
class vtkImageData;
class vtkRectilinearGrid;

class vtkIsosurfaceRayTraceGeometry
{
public:
  /// The number of points along each axis; 0 if the data are neither image nor rectilinear grid.
  static vtkIsosurfaceRayTracing::Index3 GetDimensions(vtkDataSet* grid);

  /// The problem with the geometry; empty if there is none. There must be two samples or more along
  /// each axis. (All functions below require it.)
  static std::string FindProblem(vtkDataSet* grid);

  vtkIsosurfaceRayTraceGeometry() = default;
  /// Samples are the points of the grid, or the centres of its cells.
  vtkIsosurfaceRayTraceGeometry(vtkDataSet* grid, bool atCenters);

  /// Whether the points have the same coordinates.
  bool HasSamePoints(const vtkIsosurfaceRayTraceGeometry& other) const;

  /// From the object space of the field to the coordinates of the grid. The first sample is at 0
  /// there, and the spacing is 1; its mean, if it is uneven.
  const vtkIsosurfaceRayTracing::Matrix4& GetPhysicalFromObject() const
  {
    return this->PhysicalFromObject;
  }

  /// The planes of uneven samples in that space; null if they are at whole numbers.
  const vtkIsosurfaceRayTracing::UnevenPlanes* GetPlanes() const
  {
    return this->Planes ? &*this->Planes : nullptr;
  }

  /// The position in that space of a coordinate on an axis of the grid (for an image: origin +
  /// spacing * index).
  double GetIndex(std::size_t axis, double coordinate) const;

  /// The part of the segment from one cell's centre to the next that lies in the first cell.
  double GetShareOfFirst(std::size_t axis, int sample) const
  {
    return this->Coordinates[axis].empty() ? 0.5 : this->ComputeShareOfFirst(axis, sample);
  }

private:
  void SetImage(vtkImageData* image);
  void SetRectilinear(vtkRectilinearGrid* grid);
  double ComputeShareOfFirst(std::size_t axis, int sample) const;

  bool AtCenters = false;
  /// Of an image; of a rectilinear grid, the first sample and the mean spacing.
  std::array<double, 3> Origin = {};
  std::array<double, 3> Spacing = {};
  std::array<double, 9> Direction = {};
  std::array<int, 3> FirstIndex = {};
  /// Of the points of a rectilinear grid; empty for an image.
  std::array<std::vector<double>, 3> Coordinates;

  /// The index of the first sample, counted from the first point.
  double FirstSample = 0.0;
  vtkIsosurfaceRayTracing::Matrix4 PhysicalFromObject = {};
  std::optional<vtkIsosurfaceRayTracing::UnevenPlanes> Planes;
};

VTK_ABI_NAMESPACE_END

#endif
