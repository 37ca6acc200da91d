// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceComparisonFilter.h"

#include "vtkIsosurfaceComparisonExecution.h"
#include "vtkIsosurfaceComparisonMethods.h"
#include "vtkIsosurfaceComparisonPictures.h"
#include "vtkIsosurfaceComparisonRays.h"
#include "vtkIsosurfaceComparisonRow.h"

#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkVersionMacros.h"

#include <algorithm>
#include <cmath>
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
// The geometry of an image or a mesh, which degrees and weights of cells are a part of, with only
// the scalars to contour.
vtkSmartPointer<vtkDataSet> OnlyScalars(vtkDataSet* data, vtkDataArray* scalars)
{
  auto result = vtk::TakeSmartPointer(data->NewInstance());
  result->CopyStructure(data);
  result->GetPointData()->SetScalars(scalars);
  result->GetPointData()->SetRationalWeights(data->GetPointData()->GetRationalWeights());
  result->GetCellData()->SetHigherOrderDegrees(data->GetCellData()->GetHigherOrderDegrees());
  return result;
}

//------------------------------------------------------------------------------
// What is wrong with the cells of an image and how to mend it; empty if they can be contoured.
std::string FindProblemOfCells(vtkImageData* image)
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
std::string FindProblemOfScalars(vtkDataSet* data, vtkDataArray* scalars)
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
std::string FindProblem(vtkDataSet* data, vtkDataArray* scalars)
{
  auto* image = vtkImageData::SafeDownCast(data);
  const std::string ofCells = image ? FindProblemOfCells(image) : "";
  const std::string problem = ofCells.empty() ? FindProblemOfScalars(data, scalars) : ofCells;
  // The filters of VTK read whatever the cells of a mesh say.
  return image || !problem.empty()
    ? problem
    : TracedIsosurface::New(OnlyScalars(data, scalars))->FindProblem();
}

} // anonymous namespace

VTK_ABI_NAMESPACE_BEGIN

vtkStandardNewMacro(vtkIsosurfaceComparisonFilter);

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
  const std::string problem = FindProblem(input, scalars);
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem);
    for (int i = 0; i < this->GetNumberOfContours(); ++i)
    {
      Row row;
      row.Isovalue = this->GetValue(i);
      row.Note = problem;
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
