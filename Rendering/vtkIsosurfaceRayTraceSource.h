// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The volume that a mapper traces: made of the scalars of an image, and kept while they are the
// same.

#ifndef vtkIsosurfaceRayTraceSource_h
#define vtkIsosurfaceRayTraceSource_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"               // for ivars
#include "vtkType.h"                       // for vtkIdType

#include "TracedVolume.h"

#include <array>    // for std::array
#include <memory>   // for std::unique_ptr
#include <optional> // for std::optional
#include <string>   // for std::string
#include <vector>   // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkDataArray;
class vtkImageData;

class vtkIsosurfaceRayTraceSource
{
public:
  /// Scalars of an image. Those of cells are samples at the centres of the cells.
  struct Selection
  {
    vtkDataArray* Scalars = nullptr;
    bool AreOfCells = false;
    /// Magnitude takes the length of the vector instead of a component.
    int Component = 0;

    static constexpr int Magnitude = -1;
  };

  vtkIsosurfaceRayTraceSource();
  ~vtkIsosurfaceRayTraceSource();
  vtkIsosurfaceRayTraceSource(const vtkIsosurfaceRayTraceSource&) = delete;
  void operator=(const vtkIsosurfaceRayTraceSource&) = delete;

  /// What stands in the way of tracing; empty if nothing does.
  static std::string FindProblem(vtkImageData* image, const Selection& selection);

  /// Makes sure that the volume is that of the input, which must have no problem. Returns whether
  /// it had to be built.
  bool Update(vtkImageData* image, const Selection& selection,
    const vtkIsosurfaceRayTracing::VolumeSettings& settings, int threads);

  /// Null before the first update.
  vtkIsosurfaceRayTracing::TracedVolume* GetVolume() const { return this->Volume.get(); }

  /// From the indices of samples, counted from the first one, to the coordinates of the image.
  const vtkIsosurfaceRayTracing::Matrix4& GetPhysicalFromIndex() const
  {
    return this->PhysicalFromIndex;
  }

  /// The index of a place along an axis of the image, given as origin + spacing * index.
  double GetIndex(std::size_t axis, double place) const;

  /// One for every cell of the volume, not zero where it is blanked or belongs to another piece;
  /// null if all are to be seen.
  const unsigned char* GetHiddenCells() const;

  /// The cell of the image that a hit is in, and the point in its coordinates.
  vtkIdType FindCell(
    const vtkIsosurfaceRayTracing::Hit& hit, vtkIsosurfaceRayTracing::Vector3& parametric) const;

  /// The point of the image that is nearest to a hit.
  vtkIdType FindPoint(const vtkIsosurfaceRayTracing::Hit& hit) const;

private:
  struct Geometry;
  struct Key;

  void UpdateGeometry(const Geometry& geometry, bool areOfCells);
  void UpdateHiddenCells(vtkImageData* image, bool areOfCells);
  vtkDataArray* GetPlainScalars(const Selection& selection, int& component);

  std::unique_ptr<vtkIsosurfaceRayTracing::TracedVolume> Volume;
  std::unique_ptr<Key> Built;
  std::unique_ptr<Geometry> ImageGeometry;
  vtkMTimeType ImageTime = 0;
  vtkIsosurfaceRayTracing::Matrix4 PhysicalFromIndex = {};
  /// The number of cells of the image, and where the first sample is among them.
  vtkIsosurfaceRayTracing::Index3 Cells = {};
  double FirstSample = 0.0;
  /// A copy of scalars that are not plain arrays in memory.
  vtkSmartPointer<vtkDataArray> PlainScalars;
  std::vector<unsigned char> HiddenCells;
};

VTK_ABI_NAMESPACE_END

#endif
