// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceGridLists.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

VTK_ABI_NAMESPACE_BEGIN

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceGridLists::vtkIsosurfaceRayTraceGridLists(vtkPointSet* grid)
  : Points(FindPoints(grid))
{
  if (auto* listed = vtkUnstructuredGrid::SafeDownCast(grid))
  {
    vtkDataArray* types = GetTypes(listed);
    this->Cells = listed->GetCells();
    this->Types = types;
    this->TimeOfTypes = types ? types->GetMTime() : 0;
  }
}

//------------------------------------------------------------------------------
const void* vtkIsosurfaceRayTraceGridLists::FindPoints(vtkPointSet* grid)
{
  vtkDataArray* points = grid->GetPoints() ? grid->GetPoints()->GetData() : nullptr;
  return points && points->HasStandardMemoryLayout() ? points->GetVoidPointer(0) : nullptr;
}

//------------------------------------------------------------------------------
/// From VTK 9.6 on they may be an array that has no memory of its own, which GetVoidPointer makes a
/// copy of.
vtkDataArray* vtkIsosurfaceRayTraceGridLists::GetTypes(vtkUnstructuredGrid* grid)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  return grid->GetCellTypes();
#else
  return grid->GetCellTypesArray();
#endif
}

VTK_ABI_NAMESPACE_END
