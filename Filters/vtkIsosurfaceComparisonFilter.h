// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceComparisonFilter
 * @brief   measure what it costs to extract isosurfaces as polygons
 *
 * Takes a vtkImageData, extracts its isosurfaces with VTK's own filters and tells what that cost,
 * so that vtkIsosurfaceRayTraceMapper has something to be compared with. The output is a vtkTable
 * with a row for every isovalue and method, the methods of an isovalue one after the other:
 *
 * | column      | type      | meaning                                                        |
 * |-------------|-----------|----------------------------------------------------------------|
 * | Method      | string    | the class that did it: vtkFlyingEdges3D or vtkMarchingCubes    |
 * | Isovalue    | double    |                                                                |
 * | Time        | double    | seconds of wall-clock time, the median of all repeats          |
 * | MinimumTime | double    | the same, the fastest repeat                                   |
 * | Triangles   | vtkIdType | the triangles of the mesh                                      |
 * | Points      | vtkIdType | the points of the mesh                                         |
 * | Memory      | vtkIdType | bytes of its coordinates and triangles, spare capacity left out |
 *
 * What is measured is extraction and nothing else: the filters compute no normals, no gradients and
 * no scalars, every repeat is a fresh filter, and uploading and drawing the mesh are not in it.
 * The filters keep the threads that VTK gives them (vtkMarchingCubes has one). Their meshes differ
 * slightly: vtkMarchingCubes merges points that coincide and drops triangles without area,
 * vtkFlyingEdges3D does not.
 *
 * An isovalue that the data does not reach has a row with no triangles. Point scalars of one
 * component are needed: the active ones, or those chosen with SetInputArrayToProcess. Without
 * them, or if the data has no cells, there is an error and a table without rows; without isovalues
 * or methods, a warning and a table without rows.
 *
 * Progress is reported after every repeat, never inside one, so that observers are not measured.
 * That is also where AbortExecute is looked at; an aborted table holds the rows that were finished.
 *
 * @sa vtkIsosurfaceRayTraceMapper vtkFlyingEdges3D vtkMarchingCubes vtkContourValues
 */

#ifndef vtkIsosurfaceComparisonFilter_h
#define vtkIsosurfaceComparisonFilter_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingModule.h" // for export macro
#include "vtkNew.h"                        // for vtkNew
#include "vtkTableAlgorithm.h"

VTK_ABI_NAMESPACE_BEGIN

class vtkContourValues;

class VTKISOSURFACERAYTRACING_EXPORT vtkIsosurfaceComparisonFilter : public vtkTableAlgorithm
{
public:
  static vtkIsosurfaceComparisonFilter* New();
  vtkTypeMacro(vtkIsosurfaceComparisonFilter, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/Get the isovalues, as in vtkContourFilter. They are kept in a vtkContourValues.
   * Default: the single isovalue 0.
   */
  void SetValue(int i, double value);
  double GetValue(int i);
  double* GetValues();
  void GetValues(double* contourValues);
  void SetNumberOfContours(int number);
  int GetNumberOfContours();
  void GenerateValues(int numberOfContours, double range[2]);
  void GenerateValues(int numberOfContours, double rangeStart, double rangeEnd);
  ///@}

  ///@{
  /**
   * Set/Get whether vtkFlyingEdges3D is measured. Default: true.
   */
  vtkSetMacro(FlyingEdges, bool);
  vtkGetMacro(FlyingEdges, bool);
  vtkBooleanMacro(FlyingEdges, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether vtkMarchingCubes is measured. Default: true.
   */
  vtkSetMacro(MarchingCubes, bool);
  vtkGetMacro(MarchingCubes, bool);
  vtkBooleanMacro(MarchingCubes, bool);
  ///@}

  ///@{
  /**
   * Set/Get how many times every extraction is repeated. The first one also pays for waking threads
   * and touching memory; an odd number of three or more keeps that out of the median.
   * Range: 1 to 1000. Default: 5.
   */
  vtkSetClampMacro(NumberOfRepeats, int, 1, 1000);
  vtkGetMacro(NumberOfRepeats, int);
  ///@}

  /**
   * The isovalues are part of the state of the filter.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkIsosurfaceComparisonFilter();
  ~vtkIsosurfaceComparisonFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkIsosurfaceComparisonFilter(const vtkIsosurfaceComparisonFilter&) = delete;
  void operator=(const vtkIsosurfaceComparisonFilter&) = delete;

  bool IsAborted();

  vtkNew<vtkContourValues> ContourValues;
  bool FlyingEdges = true;
  bool MarchingCubes = true;
  int NumberOfRepeats = 5;
};

VTK_ABI_NAMESPACE_END

#endif
