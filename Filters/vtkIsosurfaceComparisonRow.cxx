// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceComparisonRow.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkVariant.h"

namespace vtkIsosurfaceComparison
{
namespace
{

/// Calls one of the functions for each column, with its name and the member of a row it shows.
template <typename OnText, typename OnCount, typename OnNumber>
void ForEachColumn(const OnText& onText, const OnCount& onCount, const OnNumber& onNumber)
{
  onText("Method", &Row::Method);
  onNumber("Isovalue", &Row::Isovalue);
  onNumber("BuildTime", &Row::BuildTime);
  onNumber("ExtractionTime", &Row::ExtractionTime);
  onNumber("FirstPictureTime", &Row::FirstPictureTime);
  onNumber("NextPictureTime", &Row::NextPictureTime);
  onNumber("NewIsovaluePictureTime", &Row::NewIsovaluePictureTime);
  onCount("Triangles", &Row::Triangles);
  onCount("Points", &Row::Points);
  onCount("Bytes", &Row::Bytes);
  onNumber("PeakBytes", &Row::PeakBytes);
  onNumber("MedianDistanceInCells", &Row::MedianDistanceInCells);
  onNumber("P99DistanceInCells", &Row::P99DistanceInCells);
  onNumber("MaximumDistanceInCells", &Row::MaximumDistanceInCells);
  onNumber("MedianDistance", &Row::MedianDistance);
  onNumber("P99Distance", &Row::P99Distance);
  onNumber("MaximumDistance", &Row::MaximumDistance);
  onNumber("MedianNormalError", &Row::MedianNormalError);
  onNumber("P99NormalError", &Row::P99NormalError);
  onNumber("MaximumNormalError", &Row::MaximumNormalError);
  onNumber("LostPoints", &Row::LostPoints);
  onNumber("CoveredPixels", &Row::CoveredPixels);
  onNumber("DifferentPixels", &Row::DifferentPixels);
  onNumber("IsosurfaceAlonePixels", &Row::IsosurfaceAlonePixels);
  onNumber("MeshAlonePixels", &Row::MeshAlonePixels);
  onNumber("AmbiguousCells", &Row::AmbiguousCells);
  onNumber("TopologyDifferences", &Row::TopologyDifferences);
  onText("Note", &Row::Note);
}

template <typename ArrayT>
void AddColumn(vtkTable* table, const char* name)
{
  vtkNew<ArrayT> column;
  column->SetName(name);
  table->AddColumn(column);
}

}

//------------------------------------------------------------------------------
void Row::AddNote(const std::string& sentence)
{
  const bool isNext = !this->Note.empty() && !sentence.empty();
  this->Note += (isNext ? " " : "") + sentence;
}

//------------------------------------------------------------------------------
void AddColumns(vtkTable* table)
{
  ForEachColumn([table](const char* name, std::string Row::*)
    { AddColumn<vtkStringArray>(table, name); },
    [table](const char* name, vtkIdType Row::*) { AddColumn<vtkIdTypeArray>(table, name); },
    [table](const char* name, double Row::*) { AddColumn<vtkDoubleArray>(table, name); });
}

//------------------------------------------------------------------------------
void AddRow(vtkTable* table, const Row& row)
{
  const vtkIdType last = table->InsertNextBlankRow();
  const auto setValue = [table, last, &row](const char* name, auto member)
  { table->SetValueByName(last, name, vtkVariant(row.*member)); };
  ForEachColumn(setValue, setValue, setValue);
}

}
