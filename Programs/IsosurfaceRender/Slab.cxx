// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Slab.h"

#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdint>

namespace Render
{

//------------------------------------------------------------------------------
Slab FindSlab(const Extent& whole, int process, int processes)
{
  const std::int64_t layers = static_cast<std::int64_t>(whole[5]) - whole[4];
  const auto border = [&whole, layers, processes](int number)
  { return whole[4] + static_cast<int>((layers * number + processes - 1) / processes); };
  return { border(process), border(process + 1) };
}

//------------------------------------------------------------------------------
Extent FindExtent(const Extent& whole, const Slab& slab, int ghosts)
{
  Extent extent = whole;
  extent[4] = std::max(whole[4], slab.First - ghosts);
  extent[5] = std::min(whole[5], slab.Last + ghosts);
  return extent;
}

//------------------------------------------------------------------------------
void MarkGhosts(const Slab& slab, vtkImageData* image)
{
  const int* extent = image->GetExtent();
  const vtkIdType layer = static_cast<vtkIdType>(extent[1] - extent[0]) * (extent[3] - extent[2]);
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(vtkDataSetAttributes::GhostArrayName());
  flags->SetNumberOfTuples(layer * (extent[5] - extent[4]));
  for (int z = extent[4]; z < extent[5]; ++z)
  {
    const bool isOwn = z >= slab.First && z < slab.Last;
    std::fill_n(flags->GetPointer(layer * (z - extent[4])), layer,
      static_cast<unsigned char>(isOwn ? 0 : vtkDataSetAttributes::DUPLICATECELL));
  }
  image->GetCellData()->AddArray(flags);
}

}
