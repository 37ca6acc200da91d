// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceComparisonFilter.h"

#include "vtkCellArray.h"
#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMarchingCubes.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace
{

// One way to make a mesh. Setting the filter up is not part of the time, Update() is.
struct Method
{
  const char* Name;
  vtkSmartPointer<vtkPolyDataAlgorithm> (*NewExtraction)(vtkImageData* image, double isovalue);
};

// One row of the table.
struct Measurement
{
  std::vector<double> Times; // seconds, one per repeat
  vtkIdType Triangles = 0;
  vtkIdType Points = 0;
  vtkIdType Memory = 0;
};

// The columns of the table; they are there even when no row is.
struct Columns
{
  explicit Columns(vtkTable* table)
  {
    this->Add(table, this->Method, "Method");
    this->Add(table, this->Isovalue, "Isovalue");
    this->Add(table, this->Time, "Time");
    this->Add(table, this->MinimumTime, "MinimumTime");
    this->Add(table, this->Triangles, "Triangles");
    this->Add(table, this->Points, "Points");
    this->Add(table, this->Memory, "Memory");
  }

  void Add(vtkTable* table, vtkAbstractArray* column, const char* name)
  {
    column->SetName(name);
    table->AddColumn(column);
  }

  void InsertNextRow(const char* method, double isovalue, const Measurement& measurement);

  vtkNew<vtkStringArray> Method;
  vtkNew<vtkDoubleArray> Isovalue;
  vtkNew<vtkDoubleArray> Time;
  vtkNew<vtkDoubleArray> MinimumTime;
  vtkNew<vtkIdTypeArray> Triangles;
  vtkNew<vtkIdTypeArray> Points;
  vtkNew<vtkIdTypeArray> Memory;
};

//------------------------------------------------------------------------------
template <typename FilterT>
vtkSmartPointer<vtkPolyDataAlgorithm> NewExtraction(vtkImageData* image, double isovalue)
{
  auto filter = vtkSmartPointer<FilterT>::New();
  filter->SetInputData(image);
  filter->SetValue(0, isovalue);
  filter->ComputeNormalsOff();
  filter->ComputeGradientsOff();
  filter->ComputeScalarsOff();
  return filter;
}

//------------------------------------------------------------------------------
double TimeOfUpdate(vtkAlgorithm* extraction)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  extraction->Update();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

//------------------------------------------------------------------------------
// What the values take. vtkPolyData::GetActualMemorySize counts in kibibytes and spare capacity.
vtkIdType BytesOf(vtkDataArray* array)
{
  return array ? array->GetNumberOfValues() * array->GetDataTypeSize() : 0;
}

//------------------------------------------------------------------------------
void MeasureMesh(vtkPolyData* mesh, Measurement& measurement)
{
  vtkPoints* points = mesh->GetPoints();
  vtkCellArray* triangles = mesh->GetPolys();
  measurement.Triangles = mesh->GetNumberOfPolys();
  measurement.Points = mesh->GetNumberOfPoints();
  measurement.Memory = points ? BytesOf(points->GetData()) : 0;
  if (measurement.Triangles > 0)
  {
    measurement.Memory +=
      BytesOf(triangles->GetOffsetsArray()) + BytesOf(triangles->GetConnectivityArray());
  }
}

//------------------------------------------------------------------------------
double Median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

//------------------------------------------------------------------------------
void Columns::InsertNextRow(const char* method, double isovalue, const Measurement& measurement)
{
  this->Method->InsertNextValue(method);
  this->Isovalue->InsertNextValue(isovalue);
  this->Time->InsertNextValue(Median(measurement.Times));
  this->MinimumTime->InsertNextValue(
    *std::min_element(measurement.Times.begin(), measurement.Times.end()));
  this->Triangles->InsertNextValue(measurement.Triangles);
  this->Points->InsertNextValue(measurement.Points);
  this->Memory->InsertNextValue(measurement.Memory);
}

//------------------------------------------------------------------------------
// What is wrong with the input and how to mend it, or nullptr if it can be contoured.
const char* Complaint(vtkImageData* image, vtkDataArray* scalars)
{
  const int* dimensions = image->GetDimensions();
  if (std::min({ dimensions[0], dimensions[1], dimensions[2] }) < 2)
  {
    return "The image has no three-dimensional cells: it needs at least two points along every "
           "axis.";
  }
  if (!scalars)
  {
    return "The image has no point scalars to contour: set them with "
           "vtkPointData::SetActiveScalars or choose an array with SetInputArrayToProcess; "
           "vtkCellDataToPointData makes them from cell data.";
  }
  if (scalars->GetNumberOfComponents() != 1)
  {
    return "The scalars have several components and VTK's contour filters take one: extract it "
           "with vtkImageExtractComponents.";
  }
  if (scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    return "The number of scalars is not the number of points: the array must hold one value for "
           "every point of the image; vtkCellDataToPointData makes such an array from cell data.";
  }
  return nullptr;
}

//------------------------------------------------------------------------------
// The geometry of the image with just the scalars that are to be contoured.
vtkSmartPointer<vtkImageData> ImageOfScalars(vtkImageData* image, vtkDataArray* scalars)
{
  auto result = vtkSmartPointer<vtkImageData>::New();
  result->CopyStructure(image);
  result->GetPointData()->SetScalars(scalars);
  return result;
}

} // anonymous namespace

VTK_ABI_NAMESPACE_BEGIN

vtkStandardNewMacro(vtkIsosurfaceComparisonFilter);

//------------------------------------------------------------------------------
vtkIsosurfaceComparisonFilter::vtkIsosurfaceComparisonFilter()
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkIsosurfaceComparisonFilter::~vtkIsosurfaceComparisonFilter() = default;

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::SetValue(int i, double value)
{
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
  this->ContourValues->SetNumberOfContours(number);
}

//------------------------------------------------------------------------------
int vtkIsosurfaceComparisonFilter::GetNumberOfContours()
{
  return this->ContourValues->GetNumberOfContours();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::GenerateValues(int numberOfContours, double range[2])
{
  this->ContourValues->GenerateValues(numberOfContours, range);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::GenerateValues(
  int numberOfContours, double rangeStart, double rangeEnd)
{
  this->ContourValues->GenerateValues(numberOfContours, rangeStart, rangeEnd);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkIsosurfaceComparisonFilter::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ContourValues->GetMTime());
}

//------------------------------------------------------------------------------
int vtkIsosurfaceComparisonFilter::FillInputPortInformation(
  int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
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
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkTable* output = vtkTable::GetData(outputVector);
  Columns columns(output);

  vtkDataArray* scalars = this->GetInputArrayToProcess(0, inputVector);
  if (const char* complaint = Complaint(input, scalars))
  {
    vtkErrorMacro(<< complaint);
    return 1;
  }

  std::vector<Method> methods;
  if (this->FlyingEdges)
  {
    methods.push_back({ "vtkFlyingEdges3D", NewExtraction<vtkFlyingEdges3D> });
  }
  if (this->MarchingCubes)
  {
    methods.push_back({ "vtkMarchingCubes", NewExtraction<vtkMarchingCubes> });
  }
  const int numberOfIsovalues = this->GetNumberOfContours();
  const double numberOfSteps =
    static_cast<double>(numberOfIsovalues) * methods.size() * this->NumberOfRepeats;
  if (numberOfSteps == 0.0)
  {
    vtkWarningMacro("There is nothing to measure: set an isovalue with SetValue and switch a "
                    "method on with FlyingEdgesOn or MarchingCubesOn.");
    return 1;
  }

  const vtkSmartPointer<vtkImageData> image = ImageOfScalars(input, scalars);
  int step = 0;
  for (int i = 0; i < numberOfIsovalues; ++i)
  {
    const double isovalue = this->GetValue(i);
    for (const Method& method : methods)
    {
      Measurement measurement;
      for (int repeat = 0; repeat < this->NumberOfRepeats; ++repeat)
      {
        if (this->IsAborted())
        {
          return 1;
        }
        const auto extraction = method.NewExtraction(image, isovalue);
        measurement.Times.push_back(TimeOfUpdate(extraction));
        MeasureMesh(extraction->GetOutput(), measurement);
        this->UpdateProgress(++step / numberOfSteps);
      }
      columns.InsertNextRow(method.Name, isovalue, measurement);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceComparisonFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FlyingEdges: " << (this->FlyingEdges ? "On" : "Off") << "\n";
  os << indent << "MarchingCubes: " << (this->MarchingCubes ? "On" : "Off") << "\n";
  os << indent << "NumberOfRepeats: " << this->NumberOfRepeats << "\n";
  os << indent << "ContourValues:\n";
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
}

VTK_ABI_NAMESPACE_END
