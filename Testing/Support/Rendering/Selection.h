// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Selection_h
#define Selection_h

#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkProp.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkSmartPointer.h>

#include <set>
#include <utility>

namespace MapperTesting
{

/// The flat index of a block, or -1 where there are no blocks, and an id there.
using IdInBlock = std::pair<int, vtkIdType>;

/// The ids of a prop that vtkHardwareSelector finds in the whole window: those of cells or points,
/// by the association (vtkDataObject::FIELD_ASSOCIATION_CELLS).
inline std::set<IdInBlock> SelectInBlocks(vtkRenderer* renderer, vtkProp* prop, int association)
{
  const int* size = renderer->GetRenderWindow()->GetSize();
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(renderer);
  selector->SetArea(
    0, 0, static_cast<unsigned int>(size[0] - 1), static_cast<unsigned int>(size[1] - 1));
  selector->SetFieldAssociation(association);
  const auto selection = vtk::TakeSmartPointer(selector->Select());
  std::set<IdInBlock> ids;
  for (unsigned int i = 0; selection && i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection->GetNode(i);
    auto* list = vtkIdTypeArray::SafeDownCast(node->GetSelectionList());
    vtkInformation* properties = node->GetProperties();
    if (properties->Get(vtkSelectionNode::PROP()) != prop || !list)
    {
      continue;
    }
    const int block = properties->Has(vtkSelectionNode::COMPOSITE_INDEX())
      ? properties->Get(vtkSelectionNode::COMPOSITE_INDEX())
      : -1;
    for (vtkIdType k = 0; k < list->GetNumberOfTuples(); ++k)
    {
      ids.emplace(block, list->GetValue(k));
    }
  }
  return ids;
}

/// The same of a prop without blocks.
inline std::set<vtkIdType> Select(vtkRenderer* renderer, vtkProp* prop, int association)
{
  std::set<vtkIdType> ids;
  for (const IdInBlock& found : SelectInBlocks(renderer, prop, association))
  {
    ids.insert(found.second);
  }
  return ids;
}

}

#endif
