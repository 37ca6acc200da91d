// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTracePiece.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkIsosurfaceGhostBlocks.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkNonOverlappingAMR.h"
#include "vtkPartitionedDataSet.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredData.h"
#include "vtkUniformGridAMR.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <vector>

namespace
{
//------------------------------------------------------------------------------
std::vector<vtkDataSet*> GetBlocks(vtkDataObject* data)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    return vtkCompositeDataSet::GetDataSets(composite);
  }
  auto* block = vtkDataSet::SafeDownCast(data);
  return block ? std::vector<vtkDataSet*>{ block } : std::vector<vtkDataSet*>{};
}

//------------------------------------------------------------------------------
bool IsOwn(vtkUnsignedCharArray* ghosts, vtkIdType cell)
{
  return (ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) == 0;
}

//------------------------------------------------------------------------------
// The own cells of a grid are a box: from the first to the last of them. Cropping the grid without
// its arrays keeps what its class knows of its geometry.
template <typename Grid>
vtkBoundingBox GetOwnBoundsOfGrid(Grid* grid, vtkUnsignedCharArray* ghosts)
{
  vtkIdType first = 0;
  vtkIdType last = ghosts->GetNumberOfValues() - 1;
  for (; first <= last && !IsOwn(ghosts, first); ++first)
  {
  }
  for (; last > first && !IsOwn(ghosts, last); --last)
  {
  }
  if (first > last)
  {
    return {};
  }
  int* extent = grid->GetExtent();
  int low[3];
  int high[3];
  vtkStructuredData::ComputeCellStructuredCoordsForExtent(first, extent, low);
  vtkStructuredData::ComputeCellStructuredCoordsForExtent(last, extent, high);
  const int ownExtent[6] = { low[0], high[0] + 1, low[1], high[1] + 1, low[2], high[2] + 1 };
  vtkNew<Grid> own;
  own->CopyStructure(grid);
  own->Crop(ownExtent);
  return vtkBoundingBox(own->GetBounds());
}

//------------------------------------------------------------------------------
vtkBoundingBox GetOwnBoundsOfMesh(vtkDataSet* mesh, vtkUnsignedCharArray* ghosts)
{
  vtkBoundingBox bounds;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    if (IsOwn(ghosts, cell))
    {
      double cellBounds[6];
      mesh->GetCellBounds(cell, cellBounds);
      bounds.AddBounds(cellBounds);
    }
  }
  return bounds;
}

//------------------------------------------------------------------------------
vtkBoundingBox GetOwnBoundsOfBlock(vtkDataSet* block)
{
  vtkUnsignedCharArray* ghosts = block->GetCellGhostArray();
  if (!ghosts)
  {
    return vtkBoundingBox(block->GetBounds());
  }
  if (auto* image = vtkImageData::SafeDownCast(block))
  {
    return GetOwnBoundsOfGrid(image, ghosts);
  }
  if (auto* grid = vtkRectilinearGrid::SafeDownCast(block))
  {
    return GetOwnBoundsOfGrid(grid, ghosts);
  }
  return GetOwnBoundsOfMesh(block, ghosts);
}
}

VTK_ABI_NAMESPACE_BEGIN

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataObject> vtkIsosurfaceRayTracePiece::MakeInput(vtkDataObject* data)
{
  auto copy = vtk::TakeSmartPointer(data->NewInstance());
  copy->ShallowCopy(data);
  if (copy->IsA("vtkCompositeDataSet") || copy->IsA("vtkImageData") ||
    copy->IsA("vtkRectilinearGrid"))
  {
    return copy;
  }
  auto composite = vtkSmartPointer<vtkPartitionedDataSet>::New();
  composite->SetPartition(0, copy);
  return composite;
}

//------------------------------------------------------------------------------
vtkBoundingBox vtkIsosurfaceRayTracePiece::GetOwnBounds(
  vtkDataObject* data, vtkCompositeDataDisplayAttributes* attributes)
{
  vtkBoundingBox bounds;
  for (vtkDataSet* block : GetBlocks(data))
  {
    if (attributes->GetBlockVisibility(block))
    {
      bounds.AddBox(GetOwnBoundsOfBlock(block));
    }
  }
  return bounds;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTracePiece::Together vtkIsosurfaceRayTracePiece::Gather(
  const double bounds[6], int numberOfComponents, bool isNewAmr)
{
  constexpr std::size_t count = 8;
  std::array<double, count> own;
  std::copy_n(bounds, 6, own.begin());
  own[6] = numberOfComponents;
  own[7] = isNewAmr ? 1.0 : 0.0;
  auto* controller = vtkMultiProcessController::GetGlobalController();
  std::vector<double> all(own.begin(), own.end());
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    all.resize(count * static_cast<std::size_t>(controller->GetNumberOfProcesses()));
    controller->AllGather(own.data(), all.data(), static_cast<vtkIdType>(count));
  }
  Together together;
  for (std::size_t i = 0; i < all.size(); i += count)
  {
    together.NumberOfComponents =
      std::max(together.NumberOfComponents, static_cast<int>(all[i + 6]));
    together.HasNewAmr = together.HasNewAmr || all[i + 7] > 0.0;
    together.Bounds.push_back(
      vtkMath::AreBoundsInitialized(&all[i]) ? vtkBoundingBox(&all[i]) : vtkBoundingBox());
  }
  return together;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTracePiece::IsAmr(vtkDataObject* data)
{
  return vtkUniformGridAMR::SafeDownCast(data) != nullptr;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDataObject> vtkIsosurfaceRayTracePiece::AddGhostBlocks(vtkDataObject* data)
{
  vtkNew<vtkNonOverlappingAMR> nothing;
  vtkNew<vtkIsosurfaceGhostBlocks> ghosts;
  ghosts->SetInputDataObject(IsAmr(data) ? data : nothing);
  ghosts->Update();
  return IsAmr(data) ? ghosts->GetOutputDataObject(0) : data;
}

//------------------------------------------------------------------------------
vtkDataArray* vtkIsosurfaceRayTracePiece::FindArray(
  vtkDataObject* data, int association, const std::string& name)
{
  for (vtkDataSet* block : GetBlocks(data))
  {
    vtkDataSetAttributes* attributes = block->GetAttributes(association);
    vtkDataArray* array = attributes ? attributes->GetArray(name.c_str()) : nullptr;
    if (array && block->GetNumberOfCells() > 0)
    {
      return array;
    }
  }
  return nullptr;
}

VTK_ABI_NAMESPACE_END
