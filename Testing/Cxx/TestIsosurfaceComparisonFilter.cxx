// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The table of vtkIsosurfaceComparisonFilter must say what VTK's own filters say when they are run
// by hand, and must say what is wrong with an input that cannot be contoured.

#include "vtkIsosurfaceComparisonFilter.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkMarchingCubes.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRTAnalyticSource.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkTestErrorObserver.h"
#include "vtkVariant.h"

#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>

namespace
{

bool Passed = true;

//------------------------------------------------------------------------------
void Check(bool condition, const std::string& what)
{
  if (!condition)
  {
    std::cerr << "FAILED: " << what << "\n";
    Passed = false;
  }
}

//------------------------------------------------------------------------------
template <typename T, typename U>
void CheckEqual(const T& is, const U& shouldBe, const std::string& what)
{
  std::ostringstream message;
  message << what << " is " << is << ", should be " << shouldBe;
  Check(is == shouldBe, message.str());
}

//------------------------------------------------------------------------------
// An image whose value at a point is a function of its indices.
vtkSmartPointer<vtkImageData> NewImage(
  int scalarType, int size, const std::function<double(int, int, int)>& value)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(size, size, size);
  image->AllocateScalars(scalarType, 1);
  for (int z = 0; z < size; ++z)
  {
    for (int y = 0; y < size; ++y)
    {
      for (int x = 0; x < size; ++x)
      {
        image->SetScalarComponentFromDouble(x, y, z, 0, value(x, y, z));
      }
    }
  }
  return image;
}

//------------------------------------------------------------------------------
// The distance to the middle of the image: isosurfaces are spheres.
vtkSmartPointer<vtkImageData> NewSphere(int scalarType, int size)
{
  const double middle = 0.5 * (size - 1);
  return NewImage(scalarType, size,
    [middle](int x, int y, int z) { return std::hypot(x - middle, y - middle, z - middle); });
}

//------------------------------------------------------------------------------
// One cell with one corner above 0.5: the isosurface is a single triangle.
vtkSmartPointer<vtkImageData> NewCell()
{
  return NewImage(
    VTK_FLOAT, 2, [](int x, int y, int z) { return x == 0 && y == 0 && z == 0 ? 1.0 : 0.0; });
}

//------------------------------------------------------------------------------
template <typename FilterT>
vtkSmartPointer<vtkPolyData> Extract(vtkImageData* image, double isovalue)
{
  vtkNew<FilterT> filter;
  filter->SetInputData(image);
  filter->SetValue(0, isovalue);
  filter->ComputeNormalsOff();
  filter->ComputeScalarsOff();
  filter->Update();
  return filter->GetOutput();
}

//------------------------------------------------------------------------------
vtkIdType NumberOfBytes(vtkPolyData* mesh)
{
  vtkDataArray* points = mesh->GetPoints()->GetData();
  vtkIdType bytes = points->GetNumberOfValues() * points->GetDataTypeSize();
  for (vtkDataArray* ids :
    { mesh->GetPolys()->GetOffsetsArray(), mesh->GetPolys()->GetConnectivityArray() })
  {
    bytes += ids->GetNumberOfValues() * ids->GetDataTypeSize();
  }
  return bytes;
}

//------------------------------------------------------------------------------
void CheckRow(vtkTable* table, vtkIdType row, const std::string& method, double isovalue)
{
  const std::string name = "row " + std::to_string(row) + ": ";
  CheckEqual(table->GetValueByName(row, "Method").ToString(), method, name + "Method");
  CheckEqual(table->GetValueByName(row, "Isovalue").ToDouble(), isovalue, name + "Isovalue");
  const double median = table->GetValueByName(row, "Time").ToDouble();
  const double fastest = table->GetValueByName(row, "MinimumTime").ToDouble();
  Check(fastest > 0.0, name + "MinimumTime is not positive");
  Check(fastest <= median && median < 60.0, name + "Time is not a median of seconds");
}

//------------------------------------------------------------------------------
void CheckCounts(vtkTable* table, vtkIdType row, vtkPolyData* mesh)
{
  const std::string name = "row " + std::to_string(row) + ": ";
  CheckEqual(table->GetValueByName(row, "Triangles").ToTypeInt64(), mesh->GetNumberOfPolys(),
    name + "Triangles");
  CheckEqual(
    table->GetValueByName(row, "Points").ToTypeInt64(), mesh->GetNumberOfPoints(), name + "Points");
  if (mesh->GetNumberOfPolys() > 0)
  {
    CheckEqual(
      table->GetValueByName(row, "Memory").ToTypeInt64(), NumberOfBytes(mesh), name + "Memory");
  }
}

//------------------------------------------------------------------------------
void CheckColumns(vtkTable* table)
{
  const char* names[] = { "Method", "Isovalue", "Time", "MinimumTime", "Triangles", "Points",
    "Memory" };
  CheckEqual(table->GetNumberOfColumns(), 7, "number of columns");
  for (const char* name : names)
  {
    Check(table->GetColumnByName(name) != nullptr, std::string("there is no column ") + name);
  }
}

//------------------------------------------------------------------------------
// Two isovalues, two methods: four rows, as VTK's filters count them.
void TestCounts(vtkImageData* image, double firstIsovalue, double secondIsovalue)
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(image);
  comparison->SetValue(0, firstIsovalue);
  comparison->SetValue(1, secondIsovalue);
  comparison->SetNumberOfRepeats(2);
  comparison->Update();

  vtkTable* table = comparison->GetOutput();
  CheckColumns(table);
  CheckEqual(table->GetNumberOfRows(), 4, "number of rows");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); row += 2)
  {
    const double isovalue = row == 0 ? firstIsovalue : secondIsovalue;
    const auto flyingEdges = Extract<vtkFlyingEdges3D>(image, isovalue);
    const auto marchingCubes = Extract<vtkMarchingCubes>(image, isovalue);
    Check(flyingEdges->GetNumberOfPolys() > 0, "the test volume has no isosurface");
    CheckRow(table, row, "vtkFlyingEdges3D", isovalue);
    CheckCounts(table, row, flyingEdges);
    CheckRow(table, row + 1, "vtkMarchingCubes", isovalue);
    CheckCounts(table, row + 1, marchingCubes);
  }
}

//------------------------------------------------------------------------------
// The same through a pipeline whose extent does not start at 0.
void TestPipeline()
{
  vtkNew<vtkRTAnalyticSource> wavelet;
  wavelet->SetWholeExtent(-10, 10, -8, 12, -6, 9);
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputConnection(wavelet->GetOutputPort());
  comparison->SetValue(0, 157.0);
  comparison->MarchingCubesOff();
  comparison->Update();
  CheckEqual(comparison->GetOutput()->GetNumberOfRows(), 1, "number of rows with one method");
  CheckCounts(comparison->GetOutput(), 0, Extract<vtkFlyingEdges3D>(wavelet->GetOutput(), 157.0));

  comparison->SetValue(0, 200.0); // a new isovalue alone must run the filter again
  comparison->Update();
  CheckRow(comparison->GetOutput(), 0, "vtkFlyingEdges3D", 200.0);
}

//------------------------------------------------------------------------------
void TestOneCell()
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(NewCell());
  comparison->SetValue(0, 0.5);
  comparison->Update();
  for (vtkIdType row = 0; row < 2; ++row)
  {
    CheckEqual(comparison->GetOutput()->GetValueByName(row, "Triangles").ToInt(), 1, "Triangles");
    CheckEqual(comparison->GetOutput()->GetValueByName(row, "Points").ToInt(), 3, "Points");
  }
}

//------------------------------------------------------------------------------
// What the data does not reach has a row, with nothing in it.
void TestIsovalueOutOfRange(double isovalue)
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(NewSphere(VTK_SHORT, 9));
  comparison->SetValue(0, isovalue);
  comparison->Update();
  CheckEqual(comparison->GetOutput()->GetNumberOfRows(), 2, "number of rows out of range");
  for (vtkIdType row = 0; row < comparison->GetOutput()->GetNumberOfRows(); ++row)
  {
    for (const char* column : { "Triangles", "Points", "Memory" })
    {
      CheckEqual(comparison->GetOutput()->GetValueByName(row, column).ToInt(), 0,
        std::string("out of range: ") + column);
    }
  }
}

//------------------------------------------------------------------------------
// An array that is not the active one, chosen by name.
void TestChosenArray()
{
  const auto image = NewSphere(VTK_FLOAT, 9);
  const auto other = NewSphere(VTK_DOUBLE, 9);
  vtkDataArray* chosen = other->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < chosen->GetNumberOfTuples(); ++i)
  {
    chosen->SetTuple1(i, 2.0 * chosen->GetTuple1(i));
  }
  chosen->SetName("Doubled");
  image->GetPointData()->AddArray(chosen);

  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(image);
  comparison->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Doubled");
  comparison->SetValue(0, 6.1);
  comparison->Update();
  CheckCounts(comparison->GetOutput(), 0, Extract<vtkFlyingEdges3D>(other, 6.1));
  CheckCounts(comparison->GetOutput(), 1, Extract<vtkMarchingCubes>(other, 6.1));
  Check(image->GetPointData()->GetScalars() != chosen, "the input was changed");
}

//------------------------------------------------------------------------------
// There must be one error, it must hold the words, and the table must have columns and no rows.
void TestError(vtkImageData* image, const std::string& words)
{
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->AddObserver(vtkCommand::ErrorEvent, errors);
  comparison->SetInputData(image);
  comparison->Update();
  const std::string said = errors->GetErrorMessage();
  Check(said.find(words) != std::string::npos, "no error about \"" + words + "\" but: " + said);
  Check(said.find("ERROR:") == said.rfind("ERROR:"), "there are several errors: " + said);
  CheckColumns(comparison->GetOutput());
  CheckEqual(comparison->GetOutput()->GetNumberOfRows(), 0, "number of rows after an error");
}

//------------------------------------------------------------------------------
void TestErrors()
{
  const auto noScalars = NewSphere(VTK_FLOAT, 4);
  noScalars->GetPointData()->Initialize();
  TestError(noScalars, "no point scalars");

  vtkNew<vtkFloatArray> cellScalars;
  cellScalars->SetNumberOfTuples(noScalars->GetNumberOfCells());
  noScalars->GetCellData()->SetScalars(cellScalars);
  TestError(noScalars, "vtkCellDataToPointData");

  const auto vectors = NewSphere(VTK_FLOAT, 4);
  vectors->AllocateScalars(VTK_FLOAT, 3);
  TestError(vectors, "several components");

  const auto tooFew = NewSphere(VTK_FLOAT, 4);
  tooFew->GetPointData()->GetScalars()->SetNumberOfTuples(63);
  TestError(tooFew, "number of points");

  vtkNew<vtkImageData> slice;
  slice->SetDimensions(4, 4, 1);
  slice->AllocateScalars(VTK_FLOAT, 1);
  TestError(slice, "three-dimensional");

  vtkNew<vtkImageData> empty;
  TestError(empty, "three-dimensional");
}

//------------------------------------------------------------------------------
void TestNothingToMeasure()
{
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->AddObserver(vtkCommand::ErrorEvent, observer);
  comparison->AddObserver(vtkCommand::WarningEvent, observer);
  comparison->SetInputData(NewCell());
  comparison->SetNumberOfContours(0);
  comparison->Update();
  Check(observer->GetWarning() && !observer->GetError(), "no isovalues: there is no warning");
  CheckColumns(comparison->GetOutput());
  CheckEqual(comparison->GetOutput()->GetNumberOfRows(), 0, "number of rows without isovalues");

  observer->Clear();
  comparison->SetValue(0, 0.5);
  comparison->FlyingEdgesOff();
  comparison->MarchingCubesOff();
  comparison->Update();
  Check(observer->GetWarning() && !observer->GetError(), "no methods: there is no warning");
  CheckEqual(comparison->GetOutput()->GetNumberOfRows(), 0, "number of rows without methods");

  observer->Clear();
  comparison->FlyingEdgesOn();
  comparison->Update();
  Check(!observer->GetWarning() && !observer->GetError(), "there is a warning without a reason");
  CheckEqual(
    comparison->GetOutput()->GetNumberOfRows(), 1, "number of rows once there is a method");
}

//------------------------------------------------------------------------------
// Progress comes after every repeat, grows, ends at 1; an abort keeps the rows that were finished.
struct Progress
{
  int Events = 0;
  double Last = 0.0;
  bool Grows = true;
  double AbortAt = 2.0;
};

//------------------------------------------------------------------------------
void OnProgress(vtkObject* caller, unsigned long, void* clientData, void* callData)
{
  auto* progress = static_cast<Progress*>(clientData);
  const double amount = *static_cast<double*>(callData);
  progress->Events++;
  progress->Grows = progress->Grows && amount >= progress->Last;
  progress->Last = amount;
  if (amount >= progress->AbortAt)
  {
    vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
  }
}

//------------------------------------------------------------------------------
vtkIdType NumberOfRowsWith(Progress& progress)
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(NewSphere(VTK_UNSIGNED_CHAR, 9));
  comparison->GenerateValues(2, 1.5, 3.5);
  comparison->SetNumberOfRepeats(3);
  vtkNew<vtkCallbackCommand> callback;
  callback->SetCallback(OnProgress);
  callback->SetClientData(&progress);
  comparison->AddObserver(vtkCommand::ProgressEvent, callback);
  comparison->Update();
  return comparison->GetOutput()->GetNumberOfRows();
}

//------------------------------------------------------------------------------
void TestProgressAndAbort()
{
  Progress progress;
  CheckEqual(NumberOfRowsWith(progress), 4, "number of rows with progress");
  Check(progress.Events >= 12, "there is not a progress event for every repeat");
  Check(progress.Grows, "progress goes backwards");
  CheckEqual(progress.Last, 1.0, "the last progress");

  Progress aborted;
  aborted.AbortAt = 0.5; // after six repeats of twelve: two rows of four
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  Check(NumberOfRowsWith(aborted) < 4, "the abort was not honoured"); // the pipeline may clear it
#else
  CheckEqual(NumberOfRowsWith(aborted), 2, "number of rows after an abort");
#endif
  Check(aborted.Last < 1.0, "progress went on after the abort");
}

//------------------------------------------------------------------------------
void TestSettings()
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  CheckEqual(comparison->GetNumberOfContours(), 1, "default number of isovalues");
  CheckEqual(comparison->GetValue(0), 0.0, "default isovalue");
  Check(comparison->GetFlyingEdges() && comparison->GetMarchingCubes(), "a method is off");
  CheckEqual(comparison->GetNumberOfRepeats(), 5, "default number of repeats");
  comparison->SetNumberOfRepeats(0);
  CheckEqual(comparison->GetNumberOfRepeats(), 1, "smallest number of repeats");

  double range[2] = { 1.0, 3.0 };
  double values[3] = { 0.0, 0.0, 0.0 };
  comparison->GenerateValues(3, range);
  comparison->GetValues(values);
  CheckEqual(values[1], 2.0, "generated isovalue");
  CheckEqual(comparison->GetValues()[2], 3.0, "generated isovalue");
  std::ostringstream printed;
  comparison->Print(printed);
  Check(printed.str().find("NumberOfRepeats: 1") != std::string::npos, "PrintSelf lacks a setting");
}

} // anonymous namespace

//------------------------------------------------------------------------------
int TestIsosurfaceComparisonFilter(int, char*[])
{
  vtkNew<vtkRTAnalyticSource> wavelet;
  wavelet->Update();
  TestCounts(wavelet->GetOutput(), 100.0, 220.0);
  TestCounts(NewSphere(VTK_FLOAT, 24), 7.3, 4.0);
  TestCounts(NewSphere(VTK_SHORT, 24), 7.0, 4.0); // through samples: degenerate triangles
  TestPipeline();
  TestOneCell();
  TestIsovalueOutOfRange(1000.0);
  TestIsovalueOutOfRange(-1000.0);
  TestIsovalueOutOfRange(std::numeric_limits<double>::quiet_NaN());
  TestIsovalueOutOfRange(std::numeric_limits<double>::infinity());
  TestChosenArray();
  TestErrors();
  TestNothingToMeasure();
  TestProgressAndAbort();
  TestSettings();
  return Passed ? EXIT_SUCCESS : EXIT_FAILURE;
}
