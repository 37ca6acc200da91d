// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceSelection.h"

#include "vtkIsosurfaceRayTraceInputs.h"
#include "vtkIsosurfaceRayTracePicture.h"

#include "vtkDataObject.h"
#include "vtkHardwareSelector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSelection::vtkIsosurfaceRayTraceSelection(
  vtkHardwareSelector* selector, const vtkIsosurfaceRayTraceInputs& inputs)
  : Selector(selector)
  , Inputs(inputs)
{
  selector->BeginRenderProp();
  selector->RenderCompositeIndex(1);
  selector->UpdateMaximumCellId(inputs.GetNumberOfCells());
  selector->UpdateMaximumPointId(inputs.GetNumberOfPoints());
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSelection::~vtkIsosurfaceRayTraceSelection()
{
  this->Selector->EndRenderProp();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSelection::WriteIds(vtkIsosurfaceRayTracePicture& picture) const
{
  vtkirt::Frame& frame = picture.Frame;
  for (std::size_t pixel = 0; pixel < frame.Hits.size(); ++pixel)
  {
    const vtkirt::Hit& hit = frame.Hits[pixel];
    std::uint8_t* color = &frame.Colors[4 * pixel];
    const bool isVisible = picture.IsVisible(pixel);
    std::fill_n(color, 4, std::uint8_t{ 0 });
    frame.Depths[pixel] = vtkirt::PixelWithoutDepth;
    if (!isVisible)
    {
      continue;
    }
    vtkIdType id = this->GetId(hit);
    for (int channel = 0; channel < 3; ++channel, id >>= 8)
    {
      color[channel] = static_cast<std::uint8_t>(id & 0xff);
    }
    color[3] = 255;
    if (!this->Inputs.Get(hit.Field).GetField()->GetRequest().Projection)
    {
      // Of a projection, a picture has no depth either.
      frame.Depths[pixel] = std::clamp(picture.GetDepth(hit), 0.0F, 1.0F);
    }
  }
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceSelection::GetId(const vtkirt::Hit& hit) const
{
  switch (this->Selector->GetCurrentPass())
  {
    case vtkHardwareSelector::COMPOSITE_INDEX_PASS:
      return this->Selector->GetFieldAssociation() == vtkDataObject::FIELD_ASSOCIATION_POINTS
        ? this->FindPoint(hit).FlatIndex
        : this->FindCell(hit).FlatIndex;
    case vtkHardwareSelector::POINT_ID_LOW24:
      return this->FindPoint(hit).Id;
    case vtkHardwareSelector::POINT_ID_HIGH24:
      return this->FindPoint(hit).Id >> 24;
    case vtkHardwareSelector::CELL_ID_LOW24:
      return this->FindCell(hit).Id;
    case vtkHardwareSelector::CELL_ID_HIGH24:
      return this->FindCell(hit).Id >> 24;
    default:
      break;
  }
  // The other passes request the same id for the whole volume, as a colour.
  const float* color = this->Selector->GetPropColorValue();
  const auto byte = [color](int channel)
  { return static_cast<vtkIdType>(std::lround(255.0F * color[channel])); };
  return byte(0) | byte(1) << 8 | byte(2) << 16;
}

//------------------------------------------------------------------------------
// Flat indices are those of one composite input; through several inputs there are numbers alone.
vtkIsosurfaceRayTraceSelection::Element vtkIsosurfaceRayTraceSelection::FindPoint(
  const vtkirt::Hit& hit) const
{
  Element element;
  element.Id = this->Inputs.FindPoint(hit);
  if (this->Inputs.GetNumber() == 1)
  {
    const auto* block = this->Inputs.Get(0).FindBlockOfPoint(element.Id);
    element.FlatIndex = block ? block->FlatIndex : element.FlatIndex;
  }
  return element;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSelection::Element vtkIsosurfaceRayTraceSelection::FindCell(
  const vtkirt::Hit& hit) const
{
  Element element;
  vtkirt::Vector3 parametric;
  element.Id = this->Inputs.FindCell(hit, parametric);
  if (this->Inputs.GetNumber() == 1)
  {
    const auto* block = this->Inputs.Get(0).FindBlockOfCell(element.Id);
    element.FlatIndex = block ? block->FlatIndex : element.FlatIndex;
  }
  return element;
}

VTK_ABI_NAMESPACE_END
