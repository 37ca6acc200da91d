// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The lattices of the levels of AMR data, found from the places and spacings of blocks.

#ifndef vtkIsosurfaceRayTraceAmrLevels_h
#define vtkIsosurfaceRayTraceAmrLevels_h

#include "vtkIsosurfaceRayTraceLeaves.h"   // for arguments
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Amr/AmrPatches.h"

#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTraceAmrLevels
{
public:
  /// There must be a block.
  explicit vtkIsosurfaceRayTraceAmrLevels(const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves);

  /// Finds the place of a block. Returns why it has none; empty if it has.
  std::string Place(
    const vtkIsosurfaceRayTraceLeaf& leaf, vtkIsosurfaceRayTracing::AmrPatch& patch) const;

  /// Of the levels that are not too fine, coarsest first.
  const std::vector<vtkIsosurfaceRayTracing::Index3>& GetRatios() const { return this->Ratios; }

  static vtkIsosurfaceRayTracing::Vector3 GetSpacing(const vtkIsosurfaceRayTraceLeaf& leaf);

  /// The position of the first point.
  static vtkIsosurfaceRayTracing::Vector3 GetCorner(const vtkIsosurfaceRayTraceLeaf& leaf);

private:
  double FindReach(const vtkIsosurfaceRayTraceLeaf& leaf) const;
  void LeaveOutTooFine(const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves);

  vtkIsosurfaceRayTracing::Vector3 Origin;
  std::vector<vtkIsosurfaceRayTracing::Vector3> Spacings;
  std::vector<vtkIsosurfaceRayTracing::Index3> Ratios;
};

VTK_ABI_NAMESPACE_END

#endif
