// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceBlockDisplay.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDataObject.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Display = vtkIsosurfaceRayTraceBlockDisplay;

/// What the attributes say of a node, in place of what they say of those above it.
void Override(vtkCompositeDataDisplayAttributes* attributes, vtkDataObject* node, Display& display)
{
  if (attributes->HasBlockVisibility(node))
  {
    display.IsVisible = attributes->GetBlockVisibility(node);
  }
  if (attributes->HasBlockColor(node))
  {
    vtkirt::Vector3 color;
    attributes->GetBlockColor(node, color.data());
    display.Color = color;
  }
  if (attributes->HasBlockOpacity(node))
  {
    display.Opacity = attributes->GetBlockOpacity(node);
  }
}

/// What is not opaque at all is not visible.
void Normalize(Display& display)
{
  if (display.Opacity)
  {
    display.IsVisible = display.IsVisible && *display.Opacity > 0.0;
    display.Opacity = std::min(*display.Opacity, 1.0);
  }
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceBlockDisplays::vtkIsosurfaceRayTraceBlockDisplays(
  vtkDataObject* root, vtkCompositeDataDisplayAttributes* attributes)
  : Attributes(attributes &&
          (attributes->HasBlockVisibilities() || attributes->HasBlockColors() ||
            attributes->HasBlockOpacities())
        ? attributes
        : nullptr)
{
  if (this->Attributes)
  {
    Override(this->Attributes, root, this->OfRoot);
    this->VisitChildren(root, this->OfRoot);
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceBlockDisplays::Visit(vtkDataObject* node, Display display)
{
  if (!node)
  {
    return;
  }
  Override(this->Attributes, node, display);
  this->Displays[node] = display;
  this->VisitChildren(node, display);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceBlockDisplays::VisitChildren(vtkDataObject* node, const Display& display)
{
  if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(node))
  {
    for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      this->Visit(blocks->GetBlock(i), display);
    }
  }
  else if (auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(node))
  {
    for (unsigned int i = 0; i < collection->GetNumberOfPartitionedDataSets(); ++i)
    {
      this->Visit(collection->GetPartitionedDataSet(i), display);
    }
  }
  else if (auto* partitioned = vtkPartitionedDataSet::SafeDownCast(node))
  {
    for (unsigned int i = 0; i < partitioned->GetNumberOfPartitions(); ++i)
    {
      this->Visit(partitioned->GetPartitionAsDataObject(i), display);
    }
  }
}

//------------------------------------------------------------------------------
Display vtkIsosurfaceRayTraceBlockDisplays::Get(vtkDataObject* block) const
{
  if (!this->Attributes)
  {
    return {};
  }
  const auto found = this->Displays.find(block);
  Display display = found != this->Displays.end() ? found->second : this->OfRoot;
  Override(this->Attributes, block, display);
  Normalize(display);
  return display;
}

VTK_ABI_NAMESPACE_END
