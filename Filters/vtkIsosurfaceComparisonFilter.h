// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceComparisonFilter
 * @brief   compare ray traced isosurfaces with extracted ones: time, memory, accuracy
 *
 * Takes a vtkImageData, comes by its isosurfaces in several ways, and tells what each costs and how
 * far it is from the isosurface of the trilinear interpolant, which is what
 * vtkIsosurfaceRayTraceMapper traces.
 *
 * Output 0 is a vtkTable with a row for every isovalue and method, the methods of an isovalue one
 * after the other. Times are seconds of wall-clock time, each the median of all repeats. What was
 * not measured is NaN.
 *
 * | column                 | meaning                                                             |
 * |------------------------|---------------------------------------------------------------------|
 * | Method                 | the class that did it                                               |
 * | Isovalue               |                                                                     |
 * | BuildTime              | preparing what serves all isovalues: span space, macrocells         |
 * | ExtractionTime         | from there to the triangles, without normals                        |
 * | FirstPictureTime       | from the image in memory to a picture in an open window             |
 * | NextPictureTime        | the next picture, from another side                                 |
 * | NewIsovaluePictureTime | the first picture of another isovalue, 1/1000 of the range away     |
 * | Triangles, Points      | of the mesh                                                         |
 * | Bytes                  | what is kept: coordinates and triangles; macrocells and bricks      |
 * | PeakBytes              | how far the memory of the process rises, see below                  |
 * | MedianDistanceInCells, P99DistanceInCells, MaximumDistanceInCells | of the surface from the  |
 * |                        | isosurface of the interpolant, see below                            |
 * | MedianDistance, P99Distance, MaximumDistance | the same in units of the world                |
 * | MedianNormalError, P99NormalError, MaximumNormalError | angles between the normals of         |
 * |                        | triangles and those of the isosurface, in degrees, 0 to 90          |
 * | LostPoints             | points measured from which no isosurface was found                  |
 * | CoveredPixels          | pixels that show the isosurface                                     |
 * | DifferentPixels        | pixels that show the isosurface and not the mesh, or the mesh alone |
 * | AmbiguousCells         | cells whose signs do not tell how the surface runs, see below       |
 * | TopologyDifferences    | those of them which the mesh parts otherwise than the isosurface    |
 * | Note                   | what stands in the way of a measurement                             |
 *
 * *Pictures.* Those of triangles are shaded with the normals the filters compute, ours with the
 * defaults of the mapper. They need an OpenGL window; where none can be had the times are NaN and
 * the note says why. Who draws the triangles, a GPU or a CPU, decides their times.
 *
 * *Distances* are measured at the centroids of the triangles: the vertices are on edges of cells,
 * where linear interpolation is exact, and would only flatter the mesh. A distance is that along
 * the gradient of the interpolant, found by casting a ray, or that to the nearest crossing of an
 * edge of the cell, if that is nearer: never smaller than the true one. For
 * vtkIsosurfaceRayTraceMapper the points are the hits of the picture, with the gradient as normal.
 *
 * *Pixels* are told by casting the rays of the picture at the isosurface and at the triangles, in
 * double and without OpenGL.
 *
 * *Ambiguous cells* have corners inside, or outside, that no edges join. The mesh differs there if
 * two corners can be joined by a path that does not cross it and not by one that does not cross the
 * isosurface, or the other way round. Cells with a corner at the isovalue are left out. For
 * vtkIsosurfaceRayTraceMapper the isosurface would be compared with itself: DifferentPixels,
 * AmbiguousCells and TopologyDifferences are NaN.
 *
 * *PeakBytes* is the growth of the memory in RAM during build and extraction, or a picture; Linux
 * only (VmHWM of /proc). It holds whatever the process did meanwhile: measure in a quiet process.
 * Memory of the graphics driver is in no column.
 *
 * Output 1 is the mesh of the row chosen with SetOutputRow, each triangle cut in three at its
 * centroid, with the point data DistanceInCells (the active scalars) and Distance. For
 * vtkIsosurfaceRayTraceMapper, it is the hits as vertices.
 *
 * Output 2 is a picture of the same row, rows of pixels from the bottom, with the point data
 * DepthDifference (the active scalars: how far the mesh is behind the isosurface along the ray, in
 * the world; NaN where one is missing) and Coverage (0: neither is there, 1: both, 2: the
 * isosurface alone, 3: the mesh alone).
 *
 * Triangles with vertices that are not finite, as VTK makes them beside samples that are not, are
 * counted, have no accuracy, and are not in output 1; the note says how many.
 *
 * An isovalue that the data does not reach has rows with no triangles, and a note. Point scalars of
 * one component are needed: the active ones, or those chosen with SetInputArrayToProcess. Without
 * them, or if the data has no cells, there is an error, and rows that say so; without isovalues
 * or methods, a warning and a table without rows.
 *
 * Progress is reported after every measurement, never inside one, so that observers are not
 * measured. That is also where AbortExecute is looked at; an aborted table holds the rows that were
 * finished.
 *
 * The near-optimal extraction in span space is that of Y. Livnat, H.-W. Shen, C. R. Johnson: A Near
 * Optimal Isosurface Extraction Algorithm Using the Span Space. IEEE TVCG 2(1), 1996, as VTK has
 * it.
 *
 * @sa vtkIsosurfaceRayTraceMapper vtkFlyingEdges3D vtkMarchingCubes vtkSynchronizedTemplates3D
 * vtkContourFilter vtkSpanSpace vtkContourValues
 */

#ifndef vtkIsosurfaceComparisonFilter_h
#define vtkIsosurfaceComparisonFilter_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingModule.h" // for export macro
#include "vtkNew.h"                        // for vtkNew
#include "vtkSmartPointer.h"               // for vtkSmartPointer
#include "vtkTableAlgorithm.h"

#include <string> // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkCamera;
class vtkContourValues;
class vtkImageData;
class vtkPolyData;

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
   * Set/Get whether vtkSynchronizedTemplates3D is measured. Default: true.
   */
  vtkSetMacro(SynchronizedTemplates, bool);
  vtkGetMacro(SynchronizedTemplates, bool);
  vtkBooleanMacro(SynchronizedTemplates, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether vtkContourFilter is measured, as it is out of the box. Default: true.
   */
  vtkSetMacro(ContourFilter, bool);
  vtkGetMacro(ContourFilter, bool);
  vtkBooleanMacro(ContourFilter, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether vtkContourFilter with a vtkSpanSpace is measured. It takes isovalues only that
   * are truly between the smallest and the largest scalar; for others the note says so.
   * Default: true.
   */
  vtkSetMacro(SpanSpace, bool);
  vtkGetMacro(SpanSpace, bool);
  vtkBooleanMacro(SpanSpace, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether vtkIsosurfaceRayTraceMapper is measured. Default: true.
   */
  vtkSetMacro(RayTracing, bool);
  vtkGetMacro(RayTracing, bool);
  vtkBooleanMacro(RayTracing, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether the times of pictures are measured. Default: true.
   */
  vtkSetMacro(Pictures, bool);
  vtkGetMacro(Pictures, bool);
  vtkBooleanMacro(Pictures, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether accuracy is measured: the columns from MedianDistanceInCells to
   * TopologyDifferences. Without it outputs 1 and 2 are empty. Default: true.
   */
  vtkSetMacro(Accuracy, bool);
  vtkGetMacro(Accuracy, bool);
  vtkBooleanMacro(Accuracy, bool);
  ///@}

  ///@{
  /**
   * Set/Get how many times every time is taken. The first one also pays for waking threads and
   * touching memory; an odd number of three or more keeps that out of the median.
   * Range: 1 to 1000. Default: 3.
   */
  vtkSetClampMacro(NumberOfRepeats, int, 1, 1000);
  vtkGetMacro(NumberOfRepeats, int);
  ///@}

  ///@{
  /**
   * Set/Get the camera of the pictures. Its clipping planes are moved to include the whole volume.
   * Default: none, which stands for that of LookAt.
   */
  void SetCamera(vtkCamera* camera);
  vtkCamera* GetCamera();
  ///@}

  ///@{
  /**
   * Set/Get the width and height of the pictures in pixels. Range: 1 to 16384. Default: 512 x 512.
   */
  void SetImageSize(int width, int height);
  void SetImageSize(const int size[2]) { this->SetImageSize(size[0], size[1]); }
  vtkGetVector2Macro(ImageSize, int);
  ///@}

  ///@{
  /**
   * Set/Get the row of the table to which outputs 1 and 2 belong. There is nothing in them if there
   * is no such row. Range: 0 to VTK_INT_MAX. Default: 0.
   */
  vtkSetClampMacro(OutputRow, int, 0, VTK_INT_MAX);
  vtkGetMacro(OutputRow, int);
  ///@}

  /**
   * Makes a camera look at the middle of an image, from the front, the left and above if y points
   * to the viewer and z up, so that the picture is well filled.
   */
  static void LookAt(vtkImageData* image, vtkCamera* camera);

  /**
   * Why pictures cannot be drawn here, and what to do about it; empty if they can.
   */
  static std::string WhyNoPictures();

  /**
   * The isovalues and the camera are part of the state of the filter.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkIsosurfaceComparisonFilter();
  ~vtkIsosurfaceComparisonFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkIsosurfaceComparisonFilter(const vtkIsosurfaceComparisonFilter&) = delete;
  void operator=(const vtkIsosurfaceComparisonFilter&) = delete;

  bool IsAborted();

  vtkNew<vtkContourValues> ContourValues;
  bool FlyingEdges = true;
  bool MarchingCubes = true;
  bool SynchronizedTemplates = true;
  bool ContourFilter = true;
  bool SpanSpace = true;
  bool RayTracing = true;
  bool Pictures = true;
  bool Accuracy = true;
  int NumberOfRepeats = 3;
  vtkSmartPointer<vtkCamera> Camera;
  int ImageSize[2] = { 512, 512 };
  int OutputRow = 0;

  class Comparison;
};

VTK_ABI_NAMESPACE_END

#endif
