// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceComparisonFilter
 * @brief   compare ray traced isosurfaces with extracted ones: time, memory, accuracy
 *
 * Computes the isosurfaces of a vtkImageData by several methods, and reports the cost of each
 * method and its distance from the isosurface of the trilinear interpolant, which
 * vtkIsosurfaceRayTraceMapper traces. For a vtkUnstructuredGrid or a vtkStructuredGrid, the
 * reference is the isosurface of the interpolants of the cells, which
 * vtkIsosurfaceRayTraceMeshMapper traces. There are methods for images and methods for meshes;
 * those that do not apply to the input are skipped. Hidden cells and points and ghost cells and
 * points (vtkGhostType) are treated like all others.
 *
 * Output 0 is a vtkTable with a row for every isovalue and method; the rows of an isovalue are
 * consecutive. Times are wall-clock times in seconds, each the median of all repeats. Values that
 * were not measured are NaN.
 *
 * | column                 | meaning                                                             |
 * |------------------------|---------------------------------------------------------------------|
 * | Method                 | the name of the class                                               |
 * | Isovalue               |                                                                     |
 * | BuildTime              | building what serves all isovalues: span space, macrocells, a tree  |
 * | ExtractionTime         | extracting the triangles after that, without normals                |
 * | FirstPictureTime       | from the input in memory to a picture in an open window             |
 * | NextPictureTime        | the next picture, from another side                                 |
 * | NewIsovaluePictureTime | the first picture of an isovalue 1/1000 of the range away           |
 * | Triangles, Points      | of the mesh                                                         |
 * | Bytes                  | memory kept: coordinates and triangles; macrocells, bricks, a tree  |
 * | PeakBytes              | peak growth of the memory of the process, see below                 |
 * | MedianDistanceInCells, P99DistanceInCells, MaximumDistanceInCells | of the surface from the  |
 * |                        | isosurface of the interpolant, see below                            |
 * | MedianDistance, P99Distance, MaximumDistance | the same in units of the world                |
 * | MedianNormalError, P99NormalError, MaximumNormalError | angles between the normals of         |
 * |                        | triangles and those of the isosurface, in degrees, 0 to 90          |
 * | LostPoints             | measured points from which no isosurface was found                  |
 * | CoveredPixels          | pixels that show the isosurface                                     |
 * | DifferentPixels        | pixels that show either the isosurface or the mesh, but not both:   |
 * |                        | for vtkGPUVolumeRayCastMapper, what its picture shows               |
 * | IsosurfaceAlonePixels, MeshAlonePixels | of them, those that show the isosurface, and those  |
 * |                        | that show the mesh                                                  |
 * | AmbiguousCells         | cells whose signs do not determine the topology, see below          |
 * | TopologyDifferences    | ambiguous cells in which the topology of the mesh is different      |
 * | Note                   | why something could not be measured, or lies elsewhere              |
 *
 * *Pictures* of triangles are shaded with the normals that the filters compute; ray traced pictures
 * are shaded with the defaults of the mapper. Pictures need an OpenGL window; without one the times
 * are NaN and the note says why. The times of triangles depend on whether a GPU or a CPU draws
 * them.
 *
 * *Distances* are measured at the centroids of the triangles: the vertices are on edges of cells,
 * where linear interpolation is exact, and would make the mesh look more accurate than it is. A
 * distance is measured along the gradient of the interpolant, by casting a ray, or to the nearest
 * crossing of an edge of the cell, if that is nearer; it is never smaller than the true distance.
 * For a point outside of the image, the line continues from the border, and the distance to the
 * border is added. For the mappers of this module the points are the hits of the picture, with the
 * gradient as normal. In a mesh, the cell at a point and the value and gradient there are found
 * with VTK's own cells (vtkCell::EvaluatePosition, vtkCell::Derivatives). The unit of distances in
 * cells is the mean length of the edges of that cell. Points that are in no cell count as lost.
 *
 * *Pixels* are compared by casting the rays of the picture at the isosurface and at the triangles,
 * in double precision and without OpenGL. vtkGPUVolumeRayCastMapper has no surface at which rays
 * could be cast, or whose distance could be measured. Its pixels are those of its picture; it has
 * no triangles, no memory except that of the driver, and no distances.
 *
 * *Ambiguous cells* have inside corners, or outside corners, that are not all connected by edges
 * between them. The topology is different if two corners can be connected by a path that does not
 * cross the mesh, but by none that does not cross the isosurface, or the reverse. Cells with a
 * corner at the isovalue are left out. In meshes, ambiguous cells are not counted: AmbiguousCells
 * and TopologyDifferences are NaN. For the mappers of this module the isosurface would be compared
 * with itself: these columns and the numbers of pixels that differ are NaN.
 *
 * *PeakBytes* is the growth of resident memory during build and extraction, or during a picture, on
 * Linux only (VmHWM of /proc). It includes everything that the process does during this time:
 * measure in a process that does nothing else. No column includes the memory of the graphics
 * driver.
 *
 * Output 1 is the mesh of the row selected with SetOutputRow, each triangle split into three at its
 * centroid, with the point data DistanceInCells (the active scalars) and Distance. For the mappers
 * of this module it contains the hits as vertices.
 *
 * Output 2 is an image of the same row, the bottom row of pixels first, with the point data
 * DepthDifference (the active scalars: the distance of the mesh behind the isosurface along the
 * ray, in world units; NaN where either is missing) and Coverage (0: neither, 1: both, 2: the
 * isosurface alone, 3: the mesh alone).
 *
 * Triangles with vertices that are not finite, which VTK generates near samples that are not
 * finite, are counted, but have no accuracy and are not in output 1; the note says how many there
 * are.
 *
 * An isovalue outside the range of the scalars has rows without triangles, and a note. The filter
 * needs point scalars with one component: the active ones, or those selected with
 * SetInputArrayToProcess. Without them, or if the input has no cells, the filter reports an error,
 * and the rows have a note; without isovalues or methods, it reports a warning and the table has no
 * rows.
 *
 * Progress is reported after every measurement, never during one, so that the time of observers is
 * not measured. AbortExecute is checked at the same points; after an abort the table has the rows
 * that were finished.
 *
 * The near-optimal extraction in span space is that of Y. Livnat, H.-W. Shen, C. R. Johnson: A Near
 * Optimal Isosurface Extraction Algorithm Using the Span Space. IEEE TVCG 2(1), 1996, as
 * implemented in VTK.
 *
 * @sa vtkIsosurfaceRayTraceMapper vtkIsosurfaceRayTraceMeshMapper vtkFlyingEdges3D vtkMarchingCubes
 * vtkSynchronizedTemplates3D vtkContourFilter vtkSpanSpace vtkContourGrid vtkContour3DLinearGrid
 * vtkContourValues
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
class vtkDataSet;

class VTKISOSURFACERAYTRACING_EXPORT vtkIsosurfaceComparisonFilter : public vtkTableAlgorithm
{
public:
  static vtkIsosurfaceComparisonFilter* New();
  vtkTypeMacro(vtkIsosurfaceComparisonFilter, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The largest number of isovalues: each has a row in the table for every method.
  static constexpr int MaximumNumberOfContours = 4096;

  ///@{
  /**
   * Set/Get the isovalues, as in vtkContourFilter. They are kept in a vtkContourValues. There are
   * at most MaximumNumberOfContours; an index beyond them is an error, and a larger number of
   * contours is reduced to this maximum. Default: the single isovalue 0.
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
   * Set/Get whether vtkFlyingEdges3D is measured, for images. Default: true.
   */
  vtkSetMacro(FlyingEdges, bool);
  vtkGetMacro(FlyingEdges, bool);
  vtkBooleanMacro(FlyingEdges, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether vtkMarchingCubes is measured, for images. Default: true.
   */
  vtkSetMacro(MarchingCubes, bool);
  vtkGetMacro(MarchingCubes, bool);
  vtkBooleanMacro(MarchingCubes, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether vtkSynchronizedTemplates3D is measured, for images. Default: true.
   */
  vtkSetMacro(SynchronizedTemplates, bool);
  vtkGetMacro(SynchronizedTemplates, bool);
  vtkBooleanMacro(SynchronizedTemplates, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether vtkContourFilter is measured, with its default settings, for images. Default:
   * true.
   */
  vtkSetMacro(ContourFilter, bool);
  vtkGetMacro(ContourFilter, bool);
  vtkBooleanMacro(ContourFilter, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether vtkContourFilter with a vtkSpanSpace is measured, for images. It supports only
   * isovalues strictly between the smallest and the largest scalar; for others the note says so.
   * Default: true.
   */
  vtkSetMacro(SpanSpace, bool);
  vtkGetMacro(SpanSpace, bool);
  vtkBooleanMacro(SpanSpace, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether vtkContourGrid is measured, for meshes. Default: true.
   */
  vtkSetMacro(ContourGrid, bool);
  vtkGetMacro(ContourGrid, bool);
  vtkBooleanMacro(ContourGrid, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether vtkContour3DLinearGrid is measured, for meshes. It merges points only for
   * pictures, which have normals. Default: true.
   */
  vtkSetMacro(Contour3DLinearGrid, bool);
  vtkGetMacro(Contour3DLinearGrid, bool);
  vtkBooleanMacro(Contour3DLinearGrid, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether vtkGPUVolumeRayCastMapper is measured, for images, in its isosurface mode, with
   * its default settings: the times of pictures and the pixels that show the surface.
   * vtkSmartVolumeMapper uses this mapper to draw isosurfaces. Without a GPU, OpenGL takes about a
   * second for a picture. Default: false.
   */
  vtkSetMacro(GPUVolumeRayCast, bool);
  vtkGetMacro(GPUVolumeRayCast, bool);
  vtkBooleanMacro(GPUVolumeRayCast, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether vtkIsosurfaceRayTraceMapper is measured, or vtkIsosurfaceRayTraceMeshMapper for
   * meshes. Default: true.
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
   * Set/Get the number of measurements of each time. The first one includes starting threads and
   * touching memory; with an odd number of three or more, the median does not.
   * Range: 1 to 1000. Default: 3.
   */
  vtkSetClampMacro(NumberOfRepeats, int, 1, 1000);
  vtkGetMacro(NumberOfRepeats, int);
  ///@}

  ///@{
  /**
   * Set/Get the camera of the pictures. Its clipping range is reset to include the whole volume.
   * Default: none; the camera of LookAt is used.
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
   * Set/Get the row of the table to which outputs 1 and 2 belong. They are empty if there is no
   * such row. Range: 0 to VTK_INT_MAX. Default: 0.
   */
  vtkSetClampMacro(OutputRow, int, 0, VTK_INT_MAX);
  vtkGetMacro(OutputRow, int);
  ///@}

  /**
   * Makes a camera look at the centre of an image or a mesh, so that the data fill most of the
   * picture. If y points to the viewer and z up, it looks from the front, the left and above.
   */
  static void LookAt(vtkDataSet* data, vtkCamera* camera);

  /**
   * Returns why pictures cannot be rendered on this machine, and the remedy; an empty string if
   * they can.
   */
  static std::string WhyNoPictures();

  /**
   * Returns the modification time, including that of the isovalues and the camera.
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

  bool MeasuresCastVolume(vtkDataSet* data) const;
  bool IsAborted();

  vtkNew<vtkContourValues> ContourValues;
  bool FlyingEdges = true;
  bool MarchingCubes = true;
  bool SynchronizedTemplates = true;
  bool ContourFilter = true;
  bool SpanSpace = true;
  bool ContourGrid = true;
  bool Contour3DLinearGrid = true;
  bool GPUVolumeRayCast = false;
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
