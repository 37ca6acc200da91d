// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceRecords.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using vtkIsosurfaceRayTraceRecords::OpaquePixel;
using vtkIsosurfaceRayTraceRecords::ProjectedPixel;
using vtkIsosurfaceRayTraceRecords::SentFragment;

/// The output of RenderToFragments.
struct FragmentColumns
{
  explicit FragmentColumns(vtkTable* fragments)
    : Pixels(vtkIdTypeArray::SafeDownCast(fragments->GetColumnByName("Pixel")))
    , Ts(vtkDoubleArray::SafeDownCast(fragments->GetColumnByName("T")))
    , Colors(vtkDoubleArray::SafeDownCast(fragments->GetColumnByName("Color")))
    , Opacities(vtkDoubleArray::SafeDownCast(fragments->GetColumnByName("Opacity")))
    , Depths(vtkFloatArray::SafeDownCast(fragments->GetColumnByName("Depth")))
  {
  }

  vtkirt::Fragment Get(vtkIdType row) const
  {
    vtkirt::Fragment fragment{};
    fragment.T = this->Ts->GetValue(row);
    this->Colors->GetTypedTuple(row, fragment.Color.data());
    fragment.Opacity = this->Opacities->GetValue(row);
    fragment.Depth = this->Depths->GetValue(row);
    return fragment;
  }

  vtkIdTypeArray* Pixels;
  vtkDoubleArray* Ts;
  vtkDoubleArray* Colors;
  vtkDoubleArray* Opacities;
  vtkFloatArray* Depths;
};

void ToRecord(const vtkirt::Fragment& fragment, OpaquePixel& record)
{
  record.T = fragment.T;
  record.Shown = vtkirt::ToPixel(fragment);
}

void ToRecord(const vtkirt::Fragment& fragment, SentFragment& record)
{
  record.T = fragment.T;
  std::copy(fragment.Color.begin(), fragment.Color.end(), record.Color);
  record.Opacity = fragment.Opacity;
  record.Depth = fragment.Depth;
}

}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceRecords::AreOpaque(vtkTable* fragments)
{
  if (fragments->GetNumberOfRows() == 0)
  {
    return true;
  }
  const FragmentColumns columns(fragments);
  const double* opacities = columns.Opacities->GetPointer(0);
  return std::all_of(opacities, opacities + fragments->GetNumberOfRows(),
    [](double opacity) { return opacity >= 1.0; });
}

//------------------------------------------------------------------------------
template <typename Record>
std::vector<Record> vtkIsosurfaceRayTraceRecords::Make(vtkTable* fragments)
{
  std::vector<Record> records(static_cast<std::size_t>(fragments->GetNumberOfRows()));
  if (records.empty())
  {
    return records; // The table may have no columns.
  }
  const FragmentColumns columns(fragments);
  for (std::size_t i = 0; i < records.size(); ++i)
  {
    const auto row = static_cast<vtkIdType>(i);
    ToRecord(columns.Get(row), records[i]);
    records[i].Pixel = static_cast<std::uint32_t>(columns.Pixels->GetValue(row));
  }
  return records;
}

template std::vector<OpaquePixel> vtkIsosurfaceRayTraceRecords::Make(vtkTable*);
template std::vector<SentFragment> vtkIsosurfaceRayTraceRecords::Make(vtkTable*);

//------------------------------------------------------------------------------
std::vector<vtkIsosurfaceRayTraceRecords::ProjectedPixel>
vtkIsosurfaceRayTraceRecords::MakeOfValues(vtkTable* fragments, double sign)
{
  std::vector<ProjectedPixel> records;
  if (fragments->GetNumberOfRows() == 0)
  {
    return records;
  }
  const FragmentColumns columns(fragments);
  auto* values = vtkDoubleArray::SafeDownCast(fragments->GetColumnByName("Value"));
  for (vtkIdType row = 0; row < fragments->GetNumberOfRows(); ++row)
  {
    records.push_back(
      { sign * values->GetValue(row), static_cast<std::uint32_t>(columns.Pixels->GetValue(row)),
        vtkirt::ToPixel(columns.Get(row)) });
  }
  return records;
}

//------------------------------------------------------------------------------
std::vector<vtkIsosurfaceRayTraceRecords::OpaquePixel> vtkIsosurfaceRayTraceRecords::MakeOfPicture(
  vtkImageData* picture)
{
  vtkPointData* arrays = picture->GetPointData();
  auto* colors = vtkUnsignedCharArray::SafeDownCast(arrays->GetArray("Colors"));
  auto* depths = vtkFloatArray::SafeDownCast(arrays->GetArray("Depth"));
  std::vector<OpaquePixel> records;
  for (vtkIdType i = 0; colors && i < colors->GetNumberOfTuples(); ++i)
  {
    OpaquePixel record{};
    record.Pixel = static_cast<std::uint32_t>(i);
    colors->GetTypedTuple(i, record.Shown.Rgba);
    record.Shown.Depth = depths->GetValue(i);
    if (record.Shown.Rgba[3] > 0 || record.Shown.Depth < 1.0F)
    {
      records.push_back(record);
    }
  }
  return records;
}

//------------------------------------------------------------------------------
vtkirt::CompositedPixel vtkIsosurfaceRayTraceRecords::Composite(
  const SentFragment* first, const SentFragment* end, std::vector<vtkirt::Fragment>& fragments)
{
  fragments.clear();
  std::transform(first, end, std::back_inserter(fragments),
    [](const SentFragment& sent)
    {
      return vtkirt::Fragment{ sent.T, { sent.Color[0], sent.Color[1], sent.Color[2] },
        sent.Opacity, sent.Depth };
    });
  return vtkirt::Composite(fragments.data(), fragments.size());
}

VTK_ABI_NAMESPACE_END
