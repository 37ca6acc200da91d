// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceComparisonExecution.h"

#include "vtkIsosurfaceComparisonErrors.h"
#include "vtkIsosurfaceComparisonMethods.h"
#include "vtkIsosurfaceComparisonPictures.h"
#include "vtkIsosurfaceComparisonRays.h"
#include "vtkIsosurfaceComparisonRow.h"
#include "vtkIsosurfaceComparisonTime.h"
#include "vtkIsosurfaceComparisonTopology.h"

#include "vtkAppendFilter.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <sstream>

using namespace vtkIsosurfaceComparison;

namespace
{

//------------------------------------------------------------------------------
// Data for VTK's filters, which do not take a vtkStructuredGrid.
vtkSmartPointer<vtkDataSet> ForExtraction(vtkDataSet* data)
{
  if (!vtkStructuredGrid::SafeDownCast(data))
  {
    return data;
  }
  vtkNew<vtkAppendFilter> append;
  append->AddInputData(data);
  append->Update();
  return append->GetOutput();
}

//------------------------------------------------------------------------------
// The size of the values. vtkPolyData::GetActualMemorySize includes spare capacity, in kibibytes.
vtkIdType BytesOf(vtkDataArray* array)
{
  return array ? array->GetNumberOfValues() * array->GetDataTypeSize() : 0;
}

//------------------------------------------------------------------------------
void CountMesh(vtkPolyData* mesh, Row& row)
{
  vtkPoints* points = mesh->GetPoints();
  vtkCellArray* triangles = mesh->GetPolys();
  row.Triangles = mesh->GetNumberOfPolys();
  row.Points = mesh->GetNumberOfPoints();
  row.Bytes = points ? BytesOf(points->GetData()) : 0;
  if (row.Triangles > 0)
  {
    row.Bytes += BytesOf(triangles->GetOffsetsArray()) + BytesOf(triangles->GetConnectivityArray());
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDoubleArray> NewArray(const std::vector<double>& values, const char* name)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

//------------------------------------------------------------------------------
void AddErrors(const SurfaceErrors& errors, vtkPolyData* mesh)
{
  mesh->GetPointData()->SetScalars(NewArray(errors.Cells, "DistanceInCells"));
  mesh->GetPointData()->AddArray(NewArray(errors.World, "Distance"));
}

} // anonymous namespace

VTK_ABI_NAMESPACE_BEGIN

//------------------------------------------------------------------------------
vtkIsosurfaceComparisonFilter::Comparison::Comparison(vtkIsosurfaceComparisonFilter* self,
  vtkDataSet* data, vtkPolyData* mesh, vtkImageData* difference)
  : Self(self)
  , Data(data)
  , Extracted(ForExtraction(data))
  , Mesh(mesh)
  , Difference(difference)
  , Reference(TracedIsosurface::New(data))
{
  if (self->Camera)
  {
    this->Camera->DeepCopy(self->Camera);
    IncludeWhole(data, this->Camera);
  }
  else
  {
    vtkIsosurfaceComparisonFilter::LookAt(data, this->Camera);
  }
  const int* size = self->ImageSize;
  this->Rays = std::make_unique<PictureRays>(this->Camera, size[0], size[1]);
  data->GetPointData()->GetScalars()->GetRange(this->Range, 0);
  this->WhyNoPictures = self->Pictures ? vtkIsosurfaceComparisonFilter::WhyNoPictures() : "";
  if (self->Pictures && this->WhyNoPictures.empty())
  {
    this->Window = std::make_unique<PictureWindow>(this->Camera, size[0], size[1]);
  }
}

//------------------------------------------------------------------------------
vtkIsosurfaceComparisonFilter::Comparison::~Comparison() = default;

//------------------------------------------------------------------------------
// Empty if there may be one.
std::string vtkIsosurfaceComparisonFilter::Comparison::WhyNoSurface(double isovalue) const
{
  if (this->Range[0] > this->Range[1])
  {
    return "No surface: none of the scalars is a number.";
  }
  if (!(isovalue >= this->Range[0] && isovalue <= this->Range[1]))
  {
    std::ostringstream note;
    note << "No surface: the scalars are from " << this->Range[0] << " to " << this->Range[1]
         << ".";
    return note.str();
  }
  return "";
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceComparisonFilter::Comparison::FinishStep()
{
  // A measurement during which nobody asked to abort is whole, even if they do so when they hear of
  // it.
  const bool isWhole = !this->Self->IsAborted();
  this->Self->UpdateProgress(static_cast<double>(++this->Step) / this->NumberOfSteps);
  return isWhole;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::Comparison::Run(
  const std::vector<const ExtractionMethod*>& methods, vtkTable* table)
{
  std::vector<std::function<bool(Row&)>> measurements;
  for (const ExtractionMethod* method : methods)
  {
    measurements.emplace_back(
      [this, method](Row& row) { return this->MeasureTriangles(*method, row); });
  }
  if (this->Self->MeasuresCastVolume(this->Data))
  {
    measurements.emplace_back([this](Row& row) { return this->MeasureCastVolume(row); });
  }
  if (this->Self->RayTracing)
  {
    measurements.emplace_back([this](Row& row) { return this->MeasureRayTracing(row); });
  }
  // For each row the repeats, the pictures and the accuracy.
  this->NumberOfSteps = this->Self->GetNumberOfContours() * static_cast<int>(measurements.size()) *
    (this->Self->NumberOfRepeats + 2);
  for (int i = 0; i < this->Self->GetNumberOfContours(); ++i)
  {
    const double isovalue = this->Self->GetValue(i);
    this->Reference->SetIsovalue(isovalue);
    if (this->Self->Accuracy)
    {
      this->ReferenceTs = this->Rays->CastAt(*this->Reference);
    }
    for (const std::function<bool(Row&)>& measure : measurements)
    {
      Row row;
      row.Isovalue = isovalue;
      row.AddNote(this->WhyNoSurface(isovalue));
      row.AddNote(this->WhyNoPictures);
      if (this->Self->IsAborted() || !measure(row))
      {
        return;
      }
      AddRow(table, row);
      ++this->NumberOfRows;
    }
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceComparisonFilter::Comparison::MeasureTriangles(
  const ExtractionMethod& method, Row& row)
{
  row.Method = method.Name;
  if (method.NeedsIsovalueInRange &&
    !(row.Isovalue > this->Range[0] && row.Isovalue < this->Range[1]))
  {
    row.AddNote("Not measured: vtkSpanSpace reads beyond its arrays unless the isovalue is between "
                "the smallest and the largest scalar.");
    this->Step += this->Self->NumberOfRepeats + 1;
    return this->FinishStep();
  }
  auto* image = vtkImageData::SafeDownCast(this->Data);
  if (image && !image->GetDirectionMatrix()->IsIdentity() && !HeedsDirection(method))
  {
    row.AddNote(
      "The filter ignores the direction matrix of the image: its surface lies elsewhere.");
  }
  std::vector<double> buildTimes;
  std::vector<double> extractionTimes;
  vtkSmartPointer<vtkPolyData> mesh;
  for (int repeat = 0; repeat < this->Self->NumberOfRepeats; ++repeat)
  {
    mesh = nullptr;
    const MemoryPeak peak;
    const auto extraction = method.New(this->Extracted, false);
    extraction->SetIsovalue(row.Isovalue);
    buildTimes.push_back(extraction->Build());
    const Stopwatch watch;
    extraction->GetFilter()->Update();
    extractionTimes.push_back(watch.GetSeconds());
    row.PeakBytes = repeat == 0 ? peak.GetBytes() : row.PeakBytes;
    mesh = extraction->GetTriangles();
    if (!this->FinishStep())
    {
      return false;
    }
  }
  row.BuildTime = Median(buildTimes);
  row.ExtractionTime = Median(extractionTimes);
  CountMesh(mesh, row);
  if (row.Triangles == 0 && this->WhyNoSurface(row.Isovalue).empty())
  {
    row.AddNote("No triangles: the filter finds no surface at this isovalue.");
  }
  return this->MeasurePictures(
           [this, &method]() { return NewTriangles(method, this->Extracted); }, row) &&
    this->MeasureAccuracyOfTriangles(mesh, row);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceComparisonFilter::Comparison::MeasureCastVolume(Row& row)
{
  row.Method = CastVolumeName;
  this->Step += this->Self->NumberOfRepeats; // Nothing is extracted.
  if (!this->MeasurePictures([this]() { return NewCastVolume(this->Data, true); }, row))
  {
    return false;
  }
  if (this->Self->Accuracy && this->Window)
  {
    const std::unique_ptr<Drawing> volume = NewCastVolume(this->Data, false);
    const std::vector<double> covered = this->Window->FindCovered(*volume, row.Isovalue);
    this->ComparePixels(covered, row);
    if (this->IsOutputRow())
    {
      WriteDifference(*this->Rays, this->ReferenceTs, covered, this->Difference);
    }
  }
  return this->FinishStep();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceComparisonFilter::Comparison::MeasureRayTracing(Row& row)
{
  row.Method = this->Reference->GetName();
  std::vector<double> buildTimes;
  for (int repeat = 0; repeat < this->Self->NumberOfRepeats; ++repeat)
  {
    const MemoryPeak peak;
    const std::unique_ptr<TracedIsosurface> isosurface = TracedIsosurface::New(this->Data);
    isosurface->SetIsovalue(row.Isovalue);
    buildTimes.push_back(isosurface->Build());
    if (repeat == 0)
    {
      this->Rays->CastInPortions(*isosurface);
      row.PeakBytes = peak.GetBytes();
      row.Bytes = isosurface->GetMemory();
    }
    if (!this->FinishStep())
    {
      return false;
    }
  }
  row.BuildTime = Median(buildTimes);
  return this->MeasurePictures([this]() { return NewTracedIsosurface(this->Data); }, row) &&
    this->MeasureAccuracyOfHits(row);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceComparisonFilter::Comparison::MeasurePictures(
  const std::function<std::unique_ptr<Drawing>()>& newDrawing, Row& row)
{
  if (this->Window)
  {
    const double middle = 0.5 * (this->Range[0] + this->Range[1]);
    const double nudge = 1e-3 * (this->Range[1] - this->Range[0]);
    const double other = row.Isovalue + (row.Isovalue < middle ? nudge : -nudge);
    this->Window->Measure(
      newDrawing, row.Isovalue, other, this->Self->NumberOfRepeats,
      [this]() { return this->Self->IsAborted(); }, row);
  }
  return this->FinishStep();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceComparisonFilter::Comparison::MeasureAccuracyOfTriangles(
  vtkPolyData* extracted, Row& row)
{
  if (this->Self->Accuracy)
  {
    const vtkSmartPointer<vtkPolyData> mesh = FiniteTriangles(extracted, this->Data->GetCenter());
    const vtkIdType left = extracted->GetNumberOfPolys() - mesh->GetNumberOfPolys();
    if (left > 0)
    {
      row.AddNote(std::to_string(left) +
        " triangles have vertices that are not finite, near samples that are not: their accuracy "
        "is not measured.");
    }
    const vtkSmartPointer<vtkPolyData> cut = CutAtCentroids(mesh);
    const SurfaceErrors errors = MeasureErrors(this->Data, *this->Reference, row.Isovalue,
      cut->GetPoints(), NormalsOfCentroids(mesh), [this]() { return this->Self->IsAborted(); });
    Summarize(errors, static_cast<std::size_t>(mesh->GetNumberOfPoints()), row);

    const std::vector<double> ts = this->Rays->CastAt(mesh);
    this->ComparePixels(ts, row);

    if (auto* image = vtkImageData::SafeDownCast(this->Data))
    {
      const TopologyCount topology = CompareTopology(image, row.Isovalue, mesh);
      row.AmbiguousCells = static_cast<double>(topology.AmbiguousCells);
      row.TopologyDifferences = static_cast<double>(topology.Differences);
    }
    if (this->IsOutputRow())
    {
      this->Mesh->ShallowCopy(cut);
      AddErrors(errors, this->Mesh);
      WriteDifference(*this->Rays, this->ReferenceTs, ts, this->Difference);
    }
  }
  return this->FinishStep();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::Comparison::ComparePixels(
  const std::vector<double>& ts, Row& row) const
{
  row.CoveredPixels = CountCoveredPixels(this->ReferenceTs);
  row.IsosurfaceAlonePixels = CountPixelsAlone(this->ReferenceTs, ts);
  row.MeshAlonePixels = CountPixelsAlone(ts, this->ReferenceTs);
  row.DifferentPixels = row.IsosurfaceAlonePixels + row.MeshAlonePixels;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceComparisonFilter::Comparison::MeasureAccuracyOfHits(Row& row)
{
  vtkNew<vtkPolyData> hits;
  if (this->Self->Accuracy && this->Rays->FindHits(*this->Reference, hits))
  {
    const SurfaceErrors errors =
      MeasureErrors(this->Data, *this->Reference, row.Isovalue, hits->GetPoints(),
        hits->GetPointData()->GetNormals(), [this]() { return this->Self->IsAborted(); });
    Summarize(errors, 0, row);
    row.CoveredPixels = CountCoveredPixels(this->ReferenceTs);
    if (row.CoveredPixels == 0.0 && this->WhyNoSurface(row.Isovalue).empty())
    {
      row.AddNote("No ray of the picture hits a surface.");
    }
    if (this->IsOutputRow())
    {
      this->Mesh->SetPoints(hits->GetPoints());
      vtkNew<vtkCellArray> vertices;
      for (vtkIdType i = 0; i < hits->GetNumberOfPoints(); ++i)
      {
        vertices->InsertNextCell({ i });
      }
      this->Mesh->SetVerts(vertices);
      AddErrors(errors, this->Mesh);
      WriteDifference(*this->Rays, this->ReferenceTs, this->ReferenceTs, this->Difference);
    }
  }
  return this->FinishStep();
}

VTK_ABI_NAMESPACE_END
