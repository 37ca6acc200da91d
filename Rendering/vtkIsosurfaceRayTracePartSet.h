// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The fields of several parts as one, which is kept while they lie as they did.

#ifndef vtkIsosurfaceRayTracePartSet_h
#define vtkIsosurfaceRayTracePartSet_h

#include "vtkIsosurfaceRayTracePart.h"     // for arguments
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Field/FieldSet.h"

#include <memory> // for std::unique_ptr
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTracePartSet
{
public:
  /// Makes the set of the fields of parts, unless it is that of the same fields in the same places:
  /// then it is to look at all of them again. Parts must outlive it.
  ///
  /// Its object space is that of the data, counted from their centre: data far from the origin lose
  /// no digits.
  void Join(const std::vector<std::unique_ptr<vtkIsosurfaceRayTracePart>>& parts);

  void Clear();

  /// Null before Join, and after Clear.
  vtkIsosurfaceRayTracing::FieldSet* Get() const { return this->Set.get(); }

  ///@{
  /// Of the set.
  vtkIsosurfaceRayTracing::Matrix4 GetPhysicalFromObject() const;
  double GetCellSize() const { return this->CellSize; }
  ///@}

private:
  std::unique_ptr<vtkIsosurfaceRayTracing::FieldSet> Set;
  std::vector<vtkIsosurfaceRayTracing::PlacedField> Placed;
  vtkIsosurfaceRayTracing::Vector3 Center = { 0.0, 0.0, 0.0 };
  double CellSize = 1.0;
};

VTK_ABI_NAMESPACE_END

#endif
