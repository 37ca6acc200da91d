// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The table of vtkIsosurfaceComparisonFilter must say what VTK's own filters say when they are run
// by hand, and must say what is wrong with an input that cannot be contoured. (How accurate the
// surfaces are is the subject of TestIsosurfaceComparisonFilterAccuracy.)

#include "vtkIsosurfaceComparisonFilter.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkContourFilter.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkGenericOpenGLRenderWindow.h"
#include "vtkImageCast.h"
#include "vtkImageData.h"
#include "vtkMarchingCubes.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRTAnalyticSource.h"
#include "vtkRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkSynchronizedTemplates3D.h"
#include "vtkTable.h"
#include "vtkTestErrorObserver.h"
#include "vtkUniformGrid.h"
#include "vtkVariant.h"
#include "vtkVersionMacros.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
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
vtkSmartPointer<vtkPolyData> Extract(vtkDataObject* image, double isovalue)
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
// A comparison of two extraction methods alone, without pictures and accuracy.
vtkSmartPointer<vtkIsosurfaceComparisonFilter> NewSmallComparison(vtkImageData* image)
{
  auto comparison = vtkSmartPointer<vtkIsosurfaceComparisonFilter>::New();
  comparison->SetInputData(image);
  comparison->SynchronizedTemplatesOff();
  comparison->ContourFilterOff();
  comparison->SpanSpaceOff();
  comparison->RayTracingOff();
  comparison->PicturesOff();
  comparison->AccuracyOff();
  return comparison;
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
  const double time = table->GetValueByName(row, "ExtractionTime").ToDouble();
  Check(time > 0.0 && time < 60.0, name + "ExtractionTime is not a time in seconds");
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
      table->GetValueByName(row, "Bytes").ToTypeInt64(), NumberOfBytes(mesh), name + "Bytes");
  }
}

//------------------------------------------------------------------------------
void CheckColumns(vtkTable* table)
{
  const char* names[] = { "Method", "Isovalue", "BuildTime", "ExtractionTime", "FirstPictureTime",
    "NextPictureTime", "NewIsovaluePictureTime", "Triangles", "Points", "Bytes", "PeakBytes",
    "MedianDistanceInCells", "P99DistanceInCells", "MaximumDistanceInCells", "MedianDistance",
    "P99Distance", "MaximumDistance", "MedianNormalError", "P99NormalError", "MaximumNormalError",
    "LostPoints", "CoveredPixels", "DifferentPixels", "IsosurfaceAlonePixels", "MeshAlonePixels",
    "AmbiguousCells", "TopologyDifferences", "Note" };
  CheckEqual(table->GetNumberOfColumns(), 28, "number of columns");
  for (const char* name : names)
  {
    Check(table->GetColumnByName(name) != nullptr, std::string("there is no column ") + name);
  }
}

//------------------------------------------------------------------------------
// Two isovalues, all methods: rows as VTK's filters count them.
void TestCounts(vtkImageData* image, double firstIsovalue, double secondIsovalue)
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(image);
  comparison->SetValue(0, firstIsovalue);
  comparison->SetValue(1, secondIsovalue);
  comparison->SetNumberOfRepeats(2);
  comparison->PicturesOff();
  comparison->AccuracyOff();
  comparison->Update();

  vtkTable* table = comparison->GetOutput();
  CheckColumns(table);
  CheckEqual(table->GetNumberOfRows(), 12, "number of rows");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); row += 6)
  {
    const double isovalue = row == 0 ? firstIsovalue : secondIsovalue;
    const auto check = [table, isovalue](vtkIdType line, const char* name, vtkPolyData* mesh)
    {
      Check(mesh->GetNumberOfPolys() > 0, "the test volume has no isosurface");
      CheckRow(table, line, name, isovalue);
      CheckCounts(table, line, mesh);
    };
    check(row, "vtkFlyingEdges3D", Extract<vtkFlyingEdges3D>(image, isovalue));
    check(row + 1, "vtkMarchingCubes", Extract<vtkMarchingCubes>(image, isovalue));
    check(
      row + 2, "vtkSynchronizedTemplates3D", Extract<vtkSynchronizedTemplates3D>(image, isovalue));
    check(row + 3, "vtkContourFilter", Extract<vtkContourFilter>(image, isovalue));
    vtkNew<vtkUniformGrid> grid; // The path of VTK that knows scalar trees, without one.
    grid->ShallowCopy(image);
    check(row + 4, "vtkSpanSpace", Extract<vtkContourFilter>(grid, isovalue));
    Check(
      table->GetValueByName(row + 4, "BuildTime").ToDouble() > 0.0, "a span space costs nothing");
    CheckEqual(table->GetValueByName(row + 5, "Method").ToString(),
      std::string("vtkIsosurfaceRayTraceMapper"), "the last method");
    CheckEqual(table->GetValueByName(row + 5, "Triangles").ToInt(), 0, "triangles of the mapper");
    Check(table->GetValueByName(row + 5, "Bytes").ToInt() > 0, "the mapper keeps nothing");
    Check(table->GetValueByName(row + 5, "BuildTime").ToDouble() > 0.0, "macrocells cost nothing");
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
  comparison->SynchronizedTemplatesOff();
  comparison->ContourFilterOff();
  comparison->SpanSpaceOff();
  comparison->RayTracingOff();
  comparison->SetImageSize(24, 16);
  comparison->Update();
  CheckEqual(comparison->GetOutput()->GetNumberOfRows(), 1, "number of rows with one method");
  CheckCounts(comparison->GetOutput(), 0, Extract<vtkFlyingEdges3D>(wavelet->GetOutput(), 157.0));

  comparison->SetValue(0, 200.0); // a new isovalue alone must run the filter again
  comparison->Update();
  CheckRow(comparison->GetOutput(), 0, "vtkFlyingEdges3D", 200.0);

  // Whatever part of the picture is requested downstream, the whole volume is compared.
  vtkNew<vtkImageCast> cast;
  cast->SetInputConnection(comparison->GetOutputPort(2));
  cast->UpdateWholeExtent();
  CheckEqual(cast->GetOutput()->GetDimensions()[0], 24, "width of the difference downstream");
  CheckEqual(cast->GetOutput()->GetDimensions()[1], 16, "height of the difference downstream");
  CheckCounts(comparison->GetOutput(), 0, Extract<vtkFlyingEdges3D>(wavelet->GetOutput(), 200.0));

  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.0, 0.0, 100.0);
  comparison->SetCamera(camera);
  comparison->Update();
  const double before = comparison->GetOutput()->GetValueByName(0, "CoveredPixels").ToDouble();
  camera->SetPosition(0.0, 0.0, 300.0); // the camera alone must run the filter again
  comparison->Update();
  const double after = comparison->GetOutput()->GetValueByName(0, "CoveredPixels").ToDouble();
  Check(after > 0.0 && after < 0.5 * before, "the camera is not heeded");
}

//------------------------------------------------------------------------------
void TestOneCell()
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(NewCell());
  comparison->SetValue(0, 0.5);
  comparison->SetImageSize(32, 32);
  comparison->Update();
  CheckEqual(comparison->GetOutput()->GetNumberOfRows(), 6, "rows of one cell");
  for (vtkIdType row = 0; row < 5; ++row)
  {
    CheckEqual(comparison->GetOutput()->GetValueByName(row, "Triangles").ToInt(), 1, "Triangles");
    CheckEqual(comparison->GetOutput()->GetValueByName(row, "Points").ToInt(), 3, "Points");
  }
}

//------------------------------------------------------------------------------
// A filter that ignores the direction matrix has a surface beside the image: the note says why, and
// its points are not nearer to the isosurface than to the image.
void TestDirectionMatrix()
{
  vtkNew<vtkRTAnalyticSource> wavelet;
  wavelet->SetWholeExtent(1, 8, 1, 8, 1, 8);
  wavelet->Update();
  vtkImageData* image = wavelet->GetOutput();
  image->SetDirectionMatrix(-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0);
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(image);
  comparison->SetValue(0, 200.0);
  comparison->SetNumberOfRepeats(1);
  comparison->PicturesOff();
  for (int row = 0; row < 6; ++row)
  {
    comparison->SetOutputRow(row);
    comparison->Update();
    auto* surface = vtkPolyData::SafeDownCast(comparison->GetOutputDataObject(1));
    const std::string note = comparison->GetOutput()->GetValueByName(row, "Note").ToString();
    CheckEqual(note.find("direction matrix") == std::string::npos, surface->GetBounds()[1] < 0.0,
      "what is said of the direction matrix");
    vtkDataArray* distances = surface->GetPointData()->GetArray("Distance");
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
    {
      const double* point = surface->GetPoint(i);
      const double toImage = std::hypot(std::max(point[0] + 1.0, 0.0), point[1] + 1.0);
      const bool isBeside = point[0] > -1.0;
      Check(!isBeside || distances->GetComponent(i, 0) > toImage - 1e-4, "a distance is too small");
    }
  }
}

//------------------------------------------------------------------------------
// All rows must hold the words.
void CheckNotes(vtkTable* table, const std::string& words)
{
  CheckEqual(table->GetNumberOfRows(), 6, "number of rows with notes");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const std::string note = table->GetValueByName(row, "Note").ToString();
    Check(note.find(words) != std::string::npos, "no note about \"" + words + "\" but: " + note);
  }
}

//------------------------------------------------------------------------------
// What the data does not reach has a row, with nothing in it.
void TestIsovalueOutOfRange(vtkImageData* image, double isovalue)
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(image);
  comparison->SetValue(0, isovalue);
  comparison->SetNumberOfRepeats(1);
  comparison->SetImageSize(16, 16);
  comparison->Update();
  vtkTable* table = comparison->GetOutput();
  CheckEqual(table->GetNumberOfRows(), 6, "number of rows out of range");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    CheckEqual(table->GetValueByName(row, "Triangles").ToInt(), 0, "triangles out of range");
    CheckEqual(table->GetValueByName(row, "Points").ToInt(), 0, "points out of range");
    Check(std::isnan(table->GetValueByName(row, "MaximumDistance").ToDouble()),
      "there is a distance without a surface");
  }
  CheckNotes(table, "No surface");
  CheckEqual(comparison->GetOutputDataObject(1)->GetNumberOfElements(vtkDataObject::POINT), 0,
    "points of the mesh out of range");
}

//------------------------------------------------------------------------------
// Samples that are no numbers, as simulations have where nothing is: all finite triangles, and only
// they, are measured.
void TestNotFinite()
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto half = NewImage(VTK_DOUBLE, 9,
    [](int x, int y, int z) { return x < 5 ? std::hypot(x - 4, y - 4, z - 4) : nan; });
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(half);
  comparison->SetValue(0, 3.1);
  comparison->SetNumberOfRepeats(1);
  comparison->SetImageSize(16, 16);
  comparison->Update();
  vtkTable* table = comparison->GetOutput();
  const auto mesh = Extract<vtkFlyingEdges3D>(half, 3.1);
  CheckCounts(table, 0, mesh);
  Check(table->GetValueByName(0, "MaximumDistanceInCells").ToDouble() < 1.0, "a finite distance");
  CheckEqual(table->GetValueByName(0, "LostPoints").ToInt(), 0, "lost points beside no numbers");
  const std::string note = table->GetValueByName(0, "Note").ToString();
  auto* measured = vtkPolyData::SafeDownCast(comparison->GetOutputDataObject(1));
  const vtkIdType left = mesh->GetNumberOfPolys() - measured->GetNumberOfPolys() / 3;
  Check(left > 0 && measured->GetNumberOfPolys() > 0, "triangles of both kinds were tried");
  CheckEqual(note.find(std::to_string(left) + " triangles"), 0u, "the note of them");

  const auto nothing = NewImage(VTK_FLOAT, 5, [](int, int, int) { return nan; });
  comparison->SetInputData(nothing);
  comparison->Update();
  CheckNotes(comparison->GetOutput(), "none of the scalars is a number");
}

//------------------------------------------------------------------------------
// An isovalue within the range has no surface where all samples have that value.
void TestEmptySurface()
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(NewImage(VTK_SHORT, 5, [](int, int, int) { return 2.0; }));
  comparison->SetValue(0, 2.0);
  comparison->SetNumberOfRepeats(1);
  comparison->SetImageSize(16, 16);
  comparison->Update();
  vtkTable* table = comparison->GetOutput();
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const std::string words = row < 4 ? "finds no surface"
      : row == 4                      ? "vtkSpanSpace"
                                      : "No ray of the picture";
    const std::string note = table->GetValueByName(row, "Note").ToString();
    Check(note.find(words) != std::string::npos, "no note about \"" + words + "\" but: " + note);
  }
}

//------------------------------------------------------------------------------
// At the ends of the range there may be a surface, and nothing may crash.
void TestIsovalueAtEndOfRange()
{
  const auto image = NewSphere(VTK_SHORT, 9);
  for (const double isovalue : { image->GetScalarRange()[0], image->GetScalarRange()[1] })
  {
    vtkNew<vtkIsosurfaceComparisonFilter> comparison;
    comparison->SetInputData(image);
    comparison->SetValue(0, isovalue);
    comparison->SetNumberOfRepeats(1);
    comparison->SetImageSize(16, 16);
    comparison->Update();
    CheckCounts(comparison->GetOutput(), 0, Extract<vtkFlyingEdges3D>(image, isovalue));
    const std::string note = comparison->GetOutput()->GetValueByName(4, "Note").ToString();
    Check(note.find("vtkSpanSpace") != std::string::npos, "nothing is said of span space: " + note);
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

  const auto comparison = NewSmallComparison(image);
  comparison->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Doubled");
  comparison->SetValue(0, 6.1);
  comparison->Update();
  CheckCounts(comparison->GetOutput(), 0, Extract<vtkFlyingEdges3D>(other, 6.1));
  CheckCounts(comparison->GetOutput(), 1, Extract<vtkMarchingCubes>(other, 6.1));
  Check(image->GetPointData()->GetScalars() != chosen, "the input was changed");
}

//------------------------------------------------------------------------------
// There must be one error, and it and all rows of the table must hold the words.
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
  CheckNotes(comparison->GetOutput(), words);
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

  const auto flat = NewSphere(VTK_FLOAT, 4);
  flat->SetSpacing(1.0, 0.0, 1.0);
  TestError(flat, "spacing not 0");

  const auto bits = NewSphere(VTK_FLOAT, 4);
  bits->AllocateScalars(VTK_BIT, 1);
  TestError(bits, "bits");
}

//------------------------------------------------------------------------------
void TestNothingToMeasure()
{
  vtkNew<vtkTest::ErrorObserver> observer;
  const auto comparison = NewSmallComparison(NewCell());
  comparison->AddObserver(vtkCommand::ErrorEvent, observer);
  comparison->AddObserver(vtkCommand::WarningEvent, observer);
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
// Progress comes after every measurement, grows, ends at 1; an abort keeps the rows that were
// finished.
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
  const auto comparison = NewSmallComparison(NewSphere(VTK_UNSIGNED_CHAR, 9));
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
  Check(progress.Events >= 20, "there is not a progress event for every measurement");
  Check(progress.Grows, "progress goes backwards");
  CheckEqual(progress.Last, 1.0, "the last progress");

  Progress aborted;
  aborted.AbortAt = 0.5; // after ten steps of twenty: two rows of four
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  // The pipeline may clear it, and says at the end that all is done.
  Check(NumberOfRowsWith(aborted) < 4, "the abort was not honoured");
  Check(aborted.Events < progress.Events, "progress went on after the abort");
#else
  CheckEqual(NumberOfRowsWith(aborted), 2, "number of rows after an abort");
  Check(aborted.Last < 1.0, "progress went on after the abort");
#endif
}

//------------------------------------------------------------------------------
void TestSettings()
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  CheckEqual(comparison->GetNumberOfContours(), 1, "default number of isovalues");
  CheckEqual(comparison->GetValue(0), 0.0, "default isovalue");
  Check(comparison->GetFlyingEdges() && comparison->GetMarchingCubes() &&
      comparison->GetSynchronizedTemplates() && comparison->GetContourFilter() &&
      comparison->GetSpanSpace() && comparison->GetRayTracing(),
    "a method is off");
  Check(!comparison->GetGPUVolumeRayCast(), "the volume mapper of the GPU is on");
  Check(comparison->GetPictures() && comparison->GetAccuracy(), "a measurement is off");
  CheckEqual(comparison->GetImageSize()[1], 512, "default height of the picture");
  comparison->SetImageSize(0, 100000);
  CheckEqual(comparison->GetImageSize()[0], 1, "smallest width of the picture");
  CheckEqual(comparison->GetImageSize()[1], 16384, "largest height of the picture");
  CheckEqual(comparison->GetNumberOfRepeats(), 3, "default number of repeats");
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

//------------------------------------------------------------------------------
// Pictures cost time where there is a window; where there is none, they cost the note.
void TestPictures(bool isPossible)
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(NewSphere(VTK_FLOAT, 16));
  comparison->SetValue(0, 5.0);
  comparison->SetImageSize(64, 64);
  comparison->Update();
  vtkTable* table = comparison->GetOutput();
  CheckEqual(table->GetNumberOfRows(), 6, "number of rows with pictures");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    for (const char* column : { "FirstPictureTime", "NextPictureTime", "NewIsovaluePictureTime" })
    {
      const double time = table->GetValueByName(row, column).ToDouble();
      Check(isPossible ? time > 0.0 && time < 60.0 : std::isnan(time),
        std::string(column) + " is " + std::to_string(time));
    }
    const std::string note = table->GetValueByName(row, "Note").ToString();
    CheckEqual(note.find("display") == std::string::npos, isPossible, "what is said of a display");
    Check(table->GetValueByName(row, "CoveredPixels").ToDouble() > 400.0,
      "the camera does not look at the volume");
#ifdef __linux__
    // Elsewhere, and where /proc is read-only, the peak is not measured.
    static const bool isPeakKnown = static_cast<bool>(std::ofstream("/proc/self/clear_refs"));
    Check(!isPeakKnown || table->GetValueByName(row, "PeakBytes").ToDouble() >= 0.0,
      "PeakBytes is not measured");
#endif
  }
}

//------------------------------------------------------------------------------
// Of a sphere to one side, the GPU shows the same pixels, and some more along its edge.
void TestGPUVolumeRayCast(bool isPossible)
{
  vtkNew<vtkIsosurfaceComparisonFilter> comparison;
  comparison->SetInputData(NewImage(
    VTK_FLOAT, 16, [](int x, int y, int z) { return std::hypot(x - 5.0, y - 6.0, z - 10.0); }));
  comparison->SetNumberOfContours(2);
  comparison->SetValue(0, 5.0);
  comparison->SetValue(1, 4.0);
  comparison->SetImageSize(64, 64);
  comparison->FlyingEdgesOff();
  comparison->MarchingCubesOff();
  comparison->SynchronizedTemplatesOff();
  comparison->ContourFilterOff();
  comparison->SpanSpaceOff();
  comparison->RayTracingOff();
  comparison->GPUVolumeRayCastOn();
  comparison->SetOutputRow(1);
  comparison->Update();
  vtkTable* table = comparison->GetOutput();
  CheckEqual(table->GetNumberOfRows(), 2, "rows of the volume mapper of the GPU");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const auto get = [table, row](const char* column)
    { return table->GetValueByName(row, column).ToDouble(); };
    CheckEqual(table->GetValueByName(row, "Method").ToString(),
      std::string("vtkGPUVolumeRayCastMapper"), "method");
    Check(isPossible ? get("FirstPictureTime") > 0.0 : std::isnan(get("FirstPictureTime")),
      "time of the first picture");
    Check(std::isnan(get("ExtractionTime")) && std::isnan(get("MedianDistance")) &&
        get("Triangles") == 0.0,
      "a triangle of the volume mapper of the GPU");
    const double different = get("DifferentPixels");
    Check(isPossible ? get("CoveredPixels") > 300.0 && different < 0.2 * get("CoveredPixels")
                     : std::isnan(different),
      "pixels of the volume mapper of the GPU: " + std::to_string(different));
  }
  const vtkIdType pixels =
    vtkImageData::SafeDownCast(comparison->GetOutputDataObject(2))->GetNumberOfPoints();
  CheckEqual<vtkIdType>(pixels, isPossible ? 64 * 64 : 0, "pixels of the difference");
}

//------------------------------------------------------------------------------
// Windows that are not drawn with OpenGL, as of WebGPU or ANARI.
class OtherWindow : public vtkRenderWindow
{
public:
  static OtherWindow* New() { VTK_STANDARD_NEW_BODY(OtherWindow); }

protected:
  const char* GetClassNameInternal() const override { return "OtherWindow"; }
};

//------------------------------------------------------------------------------
// What VTK 9.4 and newer makes without a display, EGL and OSMesa: a window that has no context.
class WindowWithoutOSMesa : public vtkGenericOpenGLRenderWindow
{
public:
  static WindowWithoutOSMesa* New() { VTK_STANDARD_NEW_BODY(WindowWithoutOSMesa); }
  vtkTypeBool IsA(const char* type) override
  {
    return type == std::string("vtkOSOpenGLRenderWindow") || this->Superclass::IsA(type);
  }
};

//------------------------------------------------------------------------------
template <typename WindowT>
class WindowFactory : public vtkObjectFactory
{
public:
  static WindowFactory* New() { VTK_STANDARD_NEW_BODY(WindowFactory); }
  const char* GetVTKSourceVersion() override { return VTK_SOURCE_VERSION; }
  const char* GetDescription() override { return "other windows"; }

protected:
  WindowFactory()
  {
    this->RegisterOverride("vtkRenderWindow", "OtherWindow", "without OpenGL", 1,
      []() -> vtkObject* { return WindowT::New(); });
  }
};

//------------------------------------------------------------------------------
void CheckWhyNoPictures(const std::string& words)
{
  const std::string why = vtkIsosurfaceComparisonFilter::WhyNoPictures();
  Check(why.find(words) != std::string::npos, "it should say \"" + words + "\": " + why);
}

//------------------------------------------------------------------------------
template <typename WindowT>
void TestWindow(const std::string& words)
{
  vtkNew<WindowFactory<WindowT>> factory;
  vtkObjectFactory::RegisterFactory(factory);
  CheckWhyNoPictures(words);
  vtkObjectFactory::UnRegisterFactory(factory);
}

//------------------------------------------------------------------------------
void TestOtherWindows()
{
  vtkObjectFactory::SetAllEnableFlags(false, "vtkRenderWindow");
  CheckWhyNoPictures("vtkRenderingOpenGL2 is not initialized");
  TestWindow<OtherWindow>("windows of the class OtherWindow");
  TestWindow<WindowWithoutOSMesa>("no OSMesa");
  vtkObjectFactory::SetAllEnableFlags(true, "vtkRenderWindow");
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
  TestDirectionMatrix();
  const auto sphere = NewSphere(VTK_SHORT, 9);
  for (const double isovalue : { 1000.0, -1000.0, std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity() })
  {
    TestIsovalueOutOfRange(sphere, isovalue);
  }
  TestIsovalueOutOfRange(NewImage(VTK_FLOAT, 5, [](int, int, int) { return 1.0; }), 2.0);
  TestIsovalueAtEndOfRange();
  TestEmptySurface();
  TestNotFinite();
  TestChosenArray();
  TestErrors();
  TestNothingToMeasure();
  TestProgressAndAbort();
  TestSettings();
  CheckEqual(vtkIsosurfaceComparisonFilter::WhyNoPictures(), std::string(), "why no pictures");
  TestPictures(true);
  TestGPUVolumeRayCast(true);
  TestOtherWindows();
#ifdef __linux__
  // Newer VTK may have a window all the same, by EGL or OSMesa.
  setenv("DISPLAY", ":9999", 1); // there is no such server
  TestPictures(vtkIsosurfaceComparisonFilter::WhyNoPictures().empty());
  unsetenv("DISPLAY");
  TestPictures(vtkIsosurfaceComparisonFilter::WhyNoPictures().empty());
  TestGPUVolumeRayCast(vtkIsosurfaceComparisonFilter::WhyNoPictures().empty());
#endif
  return Passed ? EXIT_SUCCESS : EXIT_FAILURE;
}
