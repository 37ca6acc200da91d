// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceComparisonFilter.h"

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
#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <vector>

using namespace vtkIsosurfaceComparison;

namespace
{

//------------------------------------------------------------------------------
bool IsFinite(vtkMatrix4x4* matrix)
{
  const double* elements = matrix->GetData();
  return std::all_of(
    elements, elements + 16, [](double element) { return std::isfinite(element); });
}

//------------------------------------------------------------------------------
// The geometry of an image or a mesh with only the scalars to contour.
vtkSmartPointer<vtkDataSet> OnlyScalars(vtkDataSet* data, vtkDataArray* scalars)
{
  auto result = vtk::TakeSmartPointer(data->NewInstance());
  result->CopyStructure(data);
  result->GetPointData()->SetScalars(scalars);
  return result;
}

//------------------------------------------------------------------------------
// The same for VTK's filters, which do not take a vtkStructuredGrid.
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
// What is wrong with the cells of an image and how to mend it; empty if they can be contoured.
std::string ComplaintOfCells(vtkImageData* image)
{
  const int* dimensions = image->GetDimensions();
  if (std::min({ dimensions[0], dimensions[1], dimensions[2] }) < 2)
  {
    return "The image has no three-dimensional cells: it needs at least two points along every "
           "axis.";
  }
  if (image->GetIndexToPhysicalMatrix()->Determinant() == 0.0 ||
    !IsFinite(image->GetIndexToPhysicalMatrix()) || !IsFinite(image->GetPhysicalToIndexMatrix()))
  {
    return "The image has no finite volume: its origin, spacing and direction matrix must be "
           "finite, the spacing not 0 and the matrix of full rank.";
  }
  const double* bounds = image->GetBounds();
  if (std::any_of(bounds, bounds + 6,
        [](double coordinate) { return !(std::abs(coordinate) <= VTK_FLOAT_MAX); }))
  {
    return "The image has coordinates beyond the range of single precision, in which VTK's contour "
           "filters store points: give it another origin or spacing.";
  }
  return "";
}

//------------------------------------------------------------------------------
std::string ComplaintOfScalars(vtkDataSet* data, vtkDataArray* scalars)
{
  if (!scalars)
  {
    return "The input has no point scalars to contour: set them with "
           "vtkPointData::SetActiveScalars or choose an array with SetInputArrayToProcess; "
           "vtkCellDataToPointData makes them from cell data.";
  }
  if (scalars->GetNumberOfComponents() != 1)
  {
    return "The scalars have several components, but VTK's contour filters need one: extract it "
           "with "
           "vtkImageExtractComponents or vtkArrayCalculator.";
  }
  if (scalars->GetNumberOfTuples() != data->GetNumberOfPoints())
  {
    return "The number of scalars is not the number of points: the array must have one value for "
           "every point of the input. vtkCellDataToPointData converts cell data.";
  }
  if (scalars->GetDataType() == VTK_BIT)
  {
    return "The scalars are bits, which VTK's contour filters do not support: convert them with "
           "vtkImageCast.";
  }
  return "";
}

//------------------------------------------------------------------------------
// What is wrong with the input and how to mend it; empty if it can be contoured.
std::string Complaint(vtkDataSet* data, vtkDataArray* scalars)
{
  auto* image = vtkImageData::SafeDownCast(data);
  const std::string ofCells = image ? ComplaintOfCells(image) : "";
  const std::string complaint = ofCells.empty() ? ComplaintOfScalars(data, scalars) : ofCells;
  // The filters of VTK read whatever the cells of a mesh say.
  return image || !complaint.empty()
    ? complaint
    : TracedIsosurface::New(OnlyScalars(data, scalars))->FindProblem();
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

vtkStandardNewMacro(vtkIsosurfaceComparisonFilter);

//------------------------------------------------------------------------------
// One execution of the filter: what its measurements share.
class vtkIsosurfaceComparisonFilter::Comparison
{
public:
  Comparison(vtkIsosurfaceComparisonFilter* self, vtkDataSet* data, vtkPolyData* mesh,
    vtkImageData* difference)
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

  // Fills the table; returns early when aborted.
  void Run(const std::vector<const ExtractionMethod*>& methods, vtkTable* table);

private:
  // These return false when aborted: the row is not finished.
  bool MeasureTriangles(const ExtractionMethod& method, Row& row);
  bool MeasureCastVolume(Row& row);
  bool MeasureRayTracing(Row& row);
  bool MeasurePictures(const std::function<std::unique_ptr<Drawing>()>& newDrawing, Row& row);
  bool MeasureAccuracyOfTriangles(vtkPolyData* extracted, Row& row);
  bool MeasureAccuracyOfHits(Row& row);
  void ComparePixels(const std::vector<double>& ts, Row& row) const;

  std::string WhyNoSurface(double isovalue) const;
  bool FinishStep();
  bool IsOutputRow() const { return this->NumberOfRows == this->Self->OutputRow; }

  vtkIsosurfaceComparisonFilter* Self;
  vtkDataSet* Data;
  vtkSmartPointer<vtkDataSet> Extracted;
  vtkPolyData* Mesh;
  vtkImageData* Difference;
  std::unique_ptr<TracedIsosurface> Reference;
  vtkNew<vtkCamera> Camera;
  std::unique_ptr<PictureRays> Rays;
  std::unique_ptr<PictureWindow> Window;
  std::string WhyNoPictures;
  double Range[2];

  // Where the rays of the picture hit the isosurface of the present isovalue.
  std::vector<double> ReferenceTs;
  int NumberOfRows = 0;
  int Step = 0;
  int NumberOfSteps = 0;
};

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

//------------------------------------------------------------------------------
vtkIsosurfaceComparisonFilter::vtkIsosurfaceComparisonFilter()
{
  this->SetNumberOfOutputPorts(3);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkIsosurfaceComparisonFilter::~vtkIsosurfaceComparisonFilter() = default;

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::LookAt(vtkDataSet* data, vtkCamera* camera)
{
  vtkIsosurfaceComparison::LookAt(data, camera);
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceComparisonFilter::WhyNoPictures()
{
  return vtkIsosurfaceComparison::WhyNoPictures();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::SetCamera(vtkCamera* camera)
{
  if (this->Camera != camera)
  {
    this->Camera = camera;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkCamera* vtkIsosurfaceComparisonFilter::GetCamera()
{
  return this->Camera;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::SetImageSize(int width, int height)
{
  const int clamped[2] = { std::clamp(width, 1, 16384), std::clamp(height, 1, 16384) };
  if (this->ImageSize[0] != clamped[0] || this->ImageSize[1] != clamped[1])
  {
    this->ImageSize[0] = clamped[0];
    this->ImageSize[1] = clamped[1];
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::SetValue(int i, double value)
{
  if (i >= MaximumNumberOfContours)
  {
    vtkErrorMacro("There is no isovalue " << i << ": they are numbered from 0 to "
                                          << MaximumNumberOfContours - 1 << ".");
    return;
  }
  this->ContourValues->SetValue(i, value);
}

//------------------------------------------------------------------------------
double vtkIsosurfaceComparisonFilter::GetValue(int i)
{
  return this->ContourValues->GetValue(i);
}

//------------------------------------------------------------------------------
double* vtkIsosurfaceComparisonFilter::GetValues()
{
  return this->ContourValues->GetValues();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::GetValues(double* contourValues)
{
  this->ContourValues->GetValues(contourValues);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::SetNumberOfContours(int number)
{
  this->ContourValues->SetNumberOfContours(std::min(number, MaximumNumberOfContours));
}

//------------------------------------------------------------------------------
int vtkIsosurfaceComparisonFilter::GetNumberOfContours()
{
  return this->ContourValues->GetNumberOfContours();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::GenerateValues(int numberOfContours, double range[2])
{
  this->GenerateValues(numberOfContours, range[0], range[1]);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::GenerateValues(
  int numberOfContours, double rangeStart, double rangeEnd)
{
  this->ContourValues->GenerateValues(
    std::min(numberOfContours, MaximumNumberOfContours), rangeStart, rangeEnd);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkIsosurfaceComparisonFilter::GetMTime()
{
  return std::max({ this->Superclass::GetMTime(), this->ContourValues->GetMTime(),
    this->Camera ? this->Camera->GetMTime() : 0 });
}

//------------------------------------------------------------------------------
int vtkIsosurfaceComparisonFilter::FillInputPortInformation(
  int vtkNotUsed(port), vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  for (const char* type : { "vtkImageData", "vtkUnstructuredGrid", "vtkStructuredGrid" })
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceComparisonFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[] = { "vtkTable", "vtkPolyData", "vtkImageData" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceComparisonFilter::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(2);
  const int extent[6] = { 0, this->ImageSize[0] - 1, 0, this->ImageSize[1] - 1, 0, 0 };
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkDataObject::SPACING(), 1.0, 1.0, 1.0);
  info->Set(vtkDataObject::ORIGIN(), 0.0, 0.0, 0.0);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_DOUBLE, 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceComparisonFilter::RequestUpdateExtent(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* vtkNotUsed(outputVector))
{
  // The whole volume, whatever part of an output is requested.
  vtkInformation* info = inputVector[0]->GetInformationObject(0);
  if (info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
  {
    info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
      info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6);
  }
  info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
  info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceComparisonFilter::MeasuresCastVolume(vtkDataSet* data) const
{
  return this->GPUVolumeRayCast && vtkImageData::SafeDownCast(data);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceComparisonFilter::IsAborted()
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  return this->CheckAbort();
#else
  return this->GetAbortExecute() != 0;
#endif
}

//------------------------------------------------------------------------------
int vtkIsosurfaceComparisonFilter::RequestData(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataSet* input = vtkDataSet::GetData(inputVector[0]);
  vtkTable* table = vtkTable::GetData(outputVector, 0);
  AddColumns(table);

  std::vector<const ExtractionMethod*> methods;
  const auto choose = [&methods](bool isChosen, const ExtractionMethod& method)
  {
    if (isChosen)
    {
      methods.push_back(&method);
    }
  };
  const bool isImage = vtkImageData::SafeDownCast(input) != nullptr;
  choose(isImage && this->FlyingEdges, vtkIsosurfaceComparison::FlyingEdges);
  choose(isImage && this->MarchingCubes, vtkIsosurfaceComparison::MarchingCubes);
  choose(isImage && this->SynchronizedTemplates, vtkIsosurfaceComparison::SynchronizedTemplates);
  choose(isImage && this->ContourFilter, vtkIsosurfaceComparison::ContourFilter);
  choose(isImage && this->SpanSpace, vtkIsosurfaceComparison::SpanSpace);
  choose(!isImage && this->ContourGrid, vtkIsosurfaceComparison::ContourGrid);
  choose(!isImage && this->Contour3DLinearGrid, vtkIsosurfaceComparison::Contour3DLinearGrid);
  const bool castsVolume = this->MeasuresCastVolume(input);
  if (this->GetNumberOfContours() == 0 || (methods.empty() && !castsVolume && !this->RayTracing))
  {
    vtkWarningMacro("There is nothing to measure: set an isovalue with SetValue, and switch on "
                    "a method for this input, for example with RayTracingOn.");
    return 1;
  }

  vtkDataArray* scalars = this->GetInputArrayToProcess(0, inputVector);
  const std::string complaint = Complaint(input, scalars);
  if (!complaint.empty())
  {
    vtkErrorMacro(<< complaint);
    for (int i = 0; i < this->GetNumberOfContours(); ++i)
    {
      Row row;
      row.Isovalue = this->GetValue(i);
      row.Note = complaint;
      for (const ExtractionMethod* method : methods)
      {
        row.Method = method->Name;
        AddRow(table, row);
      }
      if (castsVolume)
      {
        row.Method = CastVolumeName;
        AddRow(table, row);
      }
      if (this->RayTracing)
      {
        row.Method = TracedIsosurface::New(input)->GetName();
        AddRow(table, row);
      }
    }
    return 1;
  }

  const vtkSmartPointer<vtkDataSet> data = OnlyScalars(input, scalars);
  Comparison comparison(
    this, data, vtkPolyData::GetData(outputVector, 1), vtkImageData::GetData(outputVector, 2));
  comparison.Run(methods, table);
  return 1;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&os, indent](const char* name, bool value)
  { os << indent << name << ": " << (value ? "On" : "Off") << "\n"; };
  print("FlyingEdges", this->FlyingEdges);
  print("MarchingCubes", this->MarchingCubes);
  print("SynchronizedTemplates", this->SynchronizedTemplates);
  print("ContourFilter", this->ContourFilter);
  print("SpanSpace", this->SpanSpace);
  print("ContourGrid", this->ContourGrid);
  print("Contour3DLinearGrid", this->Contour3DLinearGrid);
  print("GPUVolumeRayCast", this->GPUVolumeRayCast);
  print("RayTracing", this->RayTracing);
  print("Pictures", this->Pictures);
  print("Accuracy", this->Accuracy);
  os << indent << "NumberOfRepeats: " << this->NumberOfRepeats << "\n";
  os << indent << "ImageSize: " << this->ImageSize[0] << " x " << this->ImageSize[1] << "\n";
  os << indent << "OutputRow: " << this->OutputRow << "\n";
  os << indent << "Camera: " << (this->Camera ? "" : "(none)") << "\n";
  if (this->Camera)
  {
    this->Camera->PrintSelf(os, indent.GetNextIndent());
  }
  os << indent << "ContourValues:\n";
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
}

VTK_ABI_NAMESPACE_END
