// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceInputBounds.h"

#include "vtkAlgorithm.h"
#include "vtkBoundingBox.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkSmartPointer.h"
#include "vtkUniformGridAMR.h"
#include "vtkVolume.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace
{

/// Of AMR data, which VTK's function for this does not know.
void FindVisibleBounds(
  vtkCompositeDataSet* data, vtkCompositeDataDisplayAttributes* attributes, double bounds[6])
{
  vtkBoundingBox visible;
  const auto iterator = vtk::TakeSmartPointer(data->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    vtkDataObject* block = iterator->GetCurrentDataObject();
    auto* grid = vtkDataSet::SafeDownCast(block);
    if (grid && (!attributes->HasBlockVisibility(block) || attributes->GetBlockVisibility(block)))
    {
      visible.AddBounds(grid->GetBounds());
    }
  }
  vtkMath::UninitializeBounds(bounds);
  if (visible.IsValid())
  {
    visible.GetBounds(bounds);
  }
}

/// Makes bounds those of what is in them after a transformation.
void Transform(vtkMatrix4x4* matrix, double bounds[6])
{
  vtkBoundingBox moved;
  for (int corner = 0; corner < 8 && vtkMath::AreBoundsInitialized(bounds); ++corner)
  {
    const double point[4] = { bounds[corner & 1], bounds[2 + (corner >> 1 & 1)],
      bounds[4 + (corner >> 2)], 1.0 };
    double result[4];
    matrix->MultiplyPoint(point, result);
    moved.AddPoint(result);
  }
  if (moved.IsValid())
  {
    moved.GetBounds(bounds);
  }
}

}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceInputBounds::Find(vtkAlgorithm* mapper,
  const std::function<vtkVolume*(int connection)>& getConnectionVolume,
  vtkCompositeDataDisplayAttributes* attributes, int threads, double bounds[6])
{
  const int connections = mapper->GetNumberOfInputConnections(0);
  this->Blocks.resize(static_cast<std::size_t>(connections));
  vtkBoundingBox all;
  for (int i = 0; i < connections; ++i)
  {
    double own[6];
    vtkMath::UninitializeBounds(own);
    vtkDataObject* data = mapper->GetInputDataObject(0, i);
    if (auto* grid = vtkDataSet::SafeDownCast(data))
    {
      grid->GetBounds(own);
    }
    else if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
    {
      BlocksOfConnection& last = this->Blocks[static_cast<std::size_t>(i)];
      FindOfBlocks(composite, attributes, threads, last);
      std::copy(last.Bounds.begin(), last.Bounds.end(), own);
    }
    if (vtkVolume* volume = getConnectionVolume(i))
    {
      if (!volume->GetVisibility())
      {
        continue;
      }
      volume->ComputeMatrix();
      Transform(volume->GetMatrix(), own);
    }
    all.AddBounds(own);
  }
  if (all.IsValid())
  {
    all.GetBounds(bounds);
  }
}

//------------------------------------------------------------------------------
/// Finds those of composite data, unless they are the last ones of the connection as they were.
void vtkIsosurfaceRayTraceInputBounds::FindOfBlocks(vtkCompositeDataSet* data,
  vtkCompositeDataDisplayAttributes* attributes, int threads, BlocksOfConnection& last)
{
  if (last.Found.IsOf(data, attributes, threads))
  {
    return;
  }
  last.Found = {};
  const bool mayBeHidden = attributes && attributes->HasBlockVisibilities();
  if (mayBeHidden && vtkUniformGridAMR::SafeDownCast(data))
  {
    FindVisibleBounds(data, attributes, last.Bounds.data());
  }
  else if (mayBeHidden)
  {
    vtkCompositeDataDisplayAttributes::ComputeVisibleBounds(attributes, data, last.Bounds.data());
  }
  else
  {
    data->GetBounds(last.Bounds.data());
  }
  last.Found = { data, attributes };
}

VTK_ABI_NAMESPACE_END
