// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceSnapshot.h"

#include "vtkCellData.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"
#include "vtkUniformGridAMR.h"
#include "vtkUnstructuredGrid.h"

#include "Math/PrefetchLines.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN

namespace
{

vtkMTimeType GetTime(vtkCompositeDataDisplayAttributes* attributes)
{
  return attributes ? attributes->GetMTime() : 0;
}

/// When a block was modified. Lists of cells that are set do not modify the grid, nor does what is
/// done to coordinates.
vtkMTimeType GetTime(vtkDataObject* block)
{
  vtkMTimeType time = block->GetMTime();
  if (block->GetDataObjectType() == VTK_UNSTRUCTURED_GRID)
  {
    time = std::max(time, static_cast<vtkUnstructuredGrid*>(block)->GetMeshMTime());
  }
  else if (block->GetDataObjectType() == VTK_RECTILINEAR_GRID)
  {
    auto* grid = static_cast<vtkRectilinearGrid*>(block);
    for (vtkDataArray* coordinates :
      { grid->GetXCoordinates(), grid->GetYCoordinates(), grid->GetZCoordinates() })
    {
      time = coordinates ? std::max(time, coordinates->GetMTime()) : time;
    }
  }
  return time;
}

/// The lists of a block that is a mesh; else none.
vtkIsosurfaceRayTraceGridLists FindLists(vtkDataObject* block)
{
  const int type = block->GetDataObjectType();
  return type == VTK_UNSTRUCTURED_GRID || type == VTK_STRUCTURED_GRID
    ? vtkIsosurfaceRayTraceGridLists(static_cast<vtkPointSet*>(block))
    : vtkIsosurfaceRayTraceGridLists{};
}

/// When a tree itself was modified, whatever became of what is in it.
vtkMTimeType GetOwnTime(vtkDataObject* tree)
{
  return tree->vtkObject::GetMTime();
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSnapshot::vtkIsosurfaceRayTraceSnapshot(
  vtkCompositeDataSet* data, vtkCompositeDataDisplayAttributes* attributes)
  : DisplayTime(GetTime(attributes))
{
  const auto iterator = vtk::TakeSmartPointer(data->NewIterator());
  // From VTK 9.6 on AMR data are trees, too, but they show their leaves alone.
  auto* ofTree = vtkDataObjectTreeIterator::SafeDownCast(iterator);
  if (ofTree && !vtkUniformGridAMR::SafeDownCast(data))
  {
    ofTree->VisitOnlyLeavesOff();
    this->Trees.push_back({ data, 0, GetOwnTime(data) });
  }
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    vtkDataObject* node = iterator->GetCurrentDataObject();
    const unsigned int index = iterator->GetCurrentFlatIndex();
    if (vtkDataObjectTree::SafeDownCast(node))
    {
      this->Trees.push_back({ node, index, GetOwnTime(node) });
    }
    else
    {
      this->Blocks.push_back(MakeBlock(node, index));
    }
  }
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSnapshot::Block vtkIsosurfaceRayTraceSnapshot::MakeBlock(
  vtkDataObject* data, unsigned int flatIndex)
{
  Block block = { { data, flatIndex, GetTime(data) }, FindLists(data),
    { data, data->GetFieldData() } };
  if (auto* set = vtkDataSet::SafeDownCast(data))
  {
    vtkPointData* points = set->GetPointData();
    block.Parts[2] = points;
    block.Parts[3] = points->GetAbstractArray(0);
    block.Parts[4] = set->GetCellData();
    block.Parts[5] = set->GetCellData()->GetAbstractArray(0);
    block.Parts[6] = block.Lists.Cells;
    block.Parts[7] = block.Lists.Types;
  }
  if (auto* mesh = vtkPointSet::SafeDownCast(data))
  {
    block.Parts[8] = mesh->GetPoints();
  }
  return block;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceSnapshot::IsOf(
  vtkCompositeDataSet* data, vtkCompositeDataDisplayAttributes* attributes, int threads) const
{
  return this->IsOfAttributes(attributes) && this->IsOfBlocks(data, threads);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceSnapshot::IsOfBlocks(vtkCompositeDataSet* data, int threads) const
{
  return this->HasBlocksOf(data) && this->AreBlocksUnmodified(threads);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceSnapshot::IsOfAttributes(
  vtkCompositeDataDisplayAttributes* attributes) const
{
  return GetTime(attributes) == this->DisplayTime;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceSnapshot::HasBlocksOf(vtkCompositeDataSet* data) const
{
  if (!this->Trees.empty())
  {
    return this->Trees.front().Data == data &&
      std::all_of(this->Trees.begin(), this->Trees.end(),
        [](const Node& tree) { return GetOwnTime(tree.Data) == tree.Time; });
  }
  // AMR data, which have their blocks one after another.
  const auto iterator = vtk::TakeSmartPointer(data->NewIterator());
  auto block = this->Blocks.begin();
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    if (block == this->Blocks.end() || iterator->GetCurrentDataObject() != block->Data ||
      iterator->GetCurrentFlatIndex() != block->FlatIndex)
    {
      return false;
    }
    ++block;
  }
  return !this->Blocks.empty() && block == this->Blocks.end();
}

//------------------------------------------------------------------------------
/// With all threads, and prefetched, since they are far apart in memory.
bool vtkIsosurfaceRayTraceSnapshot::AreBlocksUnmodified(int threads) const
{
  constexpr std::int64_t many = 256;
  constexpr std::int64_t ahead = 8;
  constexpr std::size_t sizeOfPart = 128; // What is read of it, about.
  const auto count = static_cast<std::int64_t>(this->Blocks.size());
  bool areUnmodified = true;
#pragma omp parallel for num_threads(threads) if (count > many) reduction(&& : areUnmodified)
  for (std::int64_t i = 0; i < count; ++i)
  {
    const Block& next = this->Blocks[static_cast<std::size_t>(std::min(i + ahead, count - 1))];
    for (const void* part : next.Parts)
    {
      vtkIsosurfaceRayTracing::PrefetchLines(part, sizeOfPart);
    }
    const Block& block = this->Blocks[static_cast<std::size_t>(i)];
    areUnmodified =
      areUnmodified && GetTime(block.Data) == block.Time && FindLists(block.Data) == block.Lists;
  }
  return areUnmodified;
}

VTK_ABI_NAMESPACE_END
