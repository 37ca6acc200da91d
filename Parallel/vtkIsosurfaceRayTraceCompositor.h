// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceCompositor
 * @brief   makes one picture of isosurfaces whose data lie in many processes
 *
 * Each process has a piece of the data, a vtkIsosurfaceRayTraceMapper,
 * vtkIsosurfaceRayTraceMeshMapper or vtkCellProjectionMapper of the piece, and a volume with the
 * same property and matrix as the others. All call RenderToImage together, with the same view:
 *
 * @code
 * vtkNew<vtkIsosurfaceRayTraceCompositor> compositor; // of the global controller
 * compositor->BroadcastCamera(camera);
 * compositor->RenderToImage(volume, camera, nullptr, 800, 600, picture);
 * @endcode
 *
 * Each process traces its piece (with its own threads: divide the cores of a machine among the
 * processes on it, by OMP_NUM_THREADS or SetNumberOfThreads). What the rays met is composited pixel
 * by pixel, in the order of each ray: pieces need no order, and may be of any shape. The picture is
 * that of one process with all data:
 * - Bit for bit, if surfaces are opaque or translucent and pieces have enough layers of ghosts:
 *   none with NormalMode INTERPOLANT_GRADIENT and scalars of points, one with central differences
 *   or cubic interpolation; one more with scalars of cells.
 *   (Where meshes are of another centre than the whole, the depth may differ in its last bits.)
 *   AMR data need the blocks beside their own: vtkIsosurfaceGhostBlocks adds them.
 * - The same for projections (blend modes MAXIMUM_INTENSITY_BLEND and MINIMUM_INTENSITY_BLEND of
 *   vtkIsosurfaceRayTraceMapper) of mappers with one connection: each pixel shows the most extreme
 *   value of all pieces, whose last bits may differ, but not its colour. (Where a ray has several
 *   equal ones, the depth may be that of another.) They need a layer of ghosts for scalars of cells
 *   alone.
 * - Shadows and ambient occlusion end at the pieces: a piece casts none on another.
 * - A pixel has one ray: ProgressiveAccumulation has no effect.
 *
 * The data of a piece are given with SetInputData: the mappers ask their inputs for the whole. A
 * cell is of the piece in which it is no ghost (vtkDataSetAttributes::DUPLICATECELL); pieces whose
 * own cells overlap show the surface there twice, which is seen where it is translucent. A process
 * may have no data: give its mapper no input, or an empty one; so may a connection of several have
 * none in some processes: give it an empty input there, so that connections are the same in all.
 *
 * Clouds (vtkCellProjectionMapper) are drawn together, too, isosurfaces in them included, by the
 * processes of a vtkMPIController. Cells may be dealt out in any way; round robin, in short runs of
 * some 64 that are neighbours in the file, keeps all processes equally busy. The picture is divided
 * into tiles, whose rows are dealt out to processes, their owners. All work on the same tiles at
 * about the same time: they find the segments of rays in their cells, front to back, and send them
 * to the owners, which draw them by depth as they come, and tell where the cloud is opaque. The
 * picture is that of one process, bit for bit, for any number of processes, pieces and threads.
 * (Inputs that are composite data or several connections may differ in the last bits, as above.)
 * Clouds that are lit (vtkVolumeProperty::ShadeOn) need the ghosts that isosurfaces need: none with
 * NormalMode INTERPOLANT_GRADIENT, one layer with central differences.
 *
 * The pixels are composited by binary swap: in each of log2(n) steps, of n processes, a process
 * gives half of its rows to another, and takes the other half of the other's pixels. What is empty
 * is not sent. If n is no power of two, the first processes begin with a step in which every second
 * one gives all it has to its neighbour.
 *
 * K.-L. Ma, S. Parker: Massively Parallel Software Rendering for Visualizing Large-Scale Data Sets.
 * IEEE Computer Graphics and Applications 21(4), 2001.
 * K.-L. Ma, J. S. Painter, C. D. Hansen, M. F. Krogh: Parallel Volume Rendering Using Binary-Swap
 * Compositing. IEEE Computer Graphics and Applications 14(4), 1994.
 *
 * vtkIsosurfacePicture draws the picture into a window of process 0, among other props.
 *
 * @sa vtkIsosurfaceRayTraceMapper vtkIsosurfaceGhostBlocks vtkIsosurfacePicture
 * vtkMultiProcessController
 */

#ifndef vtkIsosurfaceRayTraceCompositor_h
#define vtkIsosurfaceRayTraceCompositor_h

#include "vtkIsosurfaceRayTracingCompat.h"         // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingParallelModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for ivars

#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCamera;
class vtkFloatArray;
class vtkImageData;
class vtkLightCollection;
class vtkMultiProcessController;
class vtkVolume;
class vtkVolumeCollection;

class VTKISOSURFACERAYTRACINGPARALLEL_EXPORT vtkIsosurfaceRayTraceCompositor : public vtkObject
{
public:
  static vtkIsosurfaceRayTraceCompositor* New();
  vtkTypeMacro(vtkIsosurfaceRayTraceCompositor, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/Get the controller of the processes. Default: null, which stands for the global controller,
   * or for a single process where there is none.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  ///@{
  /**
   * Set/Get whether process 0 gets the whole picture, and the others an empty one. If not, each
   * gets the rows that it composited, as an image with their extent. Default: on.
   */
  vtkSetMacro(Gather, bool);
  vtkGetMacro(Gather, bool);
  vtkBooleanMacro(Gather, bool);
  ///@}

  /**
   * Gives the camera of process 0 to all processes: its place, its projection and its clipping
   * range. To be called by all. What a view depends on besides is up to the application.
   */
  void BroadcastCamera(vtkCamera* camera);

  /**
   * Makes the picture of all pieces. To be called by all processes, with the same camera, lights
   * (null: a headlight) and size, and with volumes and mappers of the same settings. The output has
   * the arrays Colors and Depth of vtkIsosurfaceRayTraceMapper::RenderToImage, which has the other
   * arguments, too, and of a projection Value.
   *
   * The depths are those of the opaque geometry that this process has drawn; null, the default,
   * where it has none. Rays end at the nearest of all processes: translucent surfaces and clouds
   * are seen before it, and nothing behind it. A scene that process 0 draws alone needs them there
   * alone (vtkIsosurfacePicture says how to get them).
   *
   * Returns whether there is a picture: the same in all processes. If not, an error of process 0
   * names the processes whose errors report why.
   */
  bool RenderToImage(vtkVolume* volume, vtkCamera* camera, vtkLightCollection* lights, int width,
    int height, vtkImageData* output, vtkFloatArray* depths = nullptr);

  /**
   * The same for the isosurfaces of several volumes, translucent ones in each other, too: as many
   * in all processes, in the same order. Where surfaces are in the same place, that of the first
   * volume is in front. Each volume has a mapper of its own: a surface casts no shadow on those of
   * others.
   */
  bool RenderToImage(vtkVolumeCollection* volumes, vtkCamera* camera, vtkLightCollection* lights,
    int width, int height, vtkImageData* output, vtkFloatArray* depths = nullptr);

  ///@{
  /**
   * Set/Get how clouds are sent: a message has at least BufferDepth segments of rays (from 1 to
   * 2^24), unless its process has nothing else to do; and a process looks for messages after
   * PollingInterval groups of up to 16 tiles in which it found segments, or drew what it has to
   * draw of them (from 1 on). Both change the time alone. Default: 4096 and 1.
   */
  vtkSetClampMacro(BufferDepth, int, 1, 1 << 24);
  vtkGetMacro(BufferDepth, int);
  vtkSetClampMacro(PollingInterval, int, 1, VTK_INT_MAX);
  vtkGetMacro(PollingInterval, int);
  ///@}

  ///@{
  /**
   * Get what the last cloud took in this process: the number of segments of rays in its own cells,
   * of those that it drew, whosever cells they are in, and how many of these were stored at once,
   * at most. Zero for isosurfaces, and where one process has all data.
   */
  vtkGetMacro(SegmentsFound, vtkTypeInt64);
  vtkGetMacro(SegmentsDrawn, vtkTypeInt64);
  vtkGetMacro(MostSegmentsStored, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Get what the last picture took in this process: the time to render its piece and to composite
   * the pixels, including waiting for others, in seconds of wall-clock time, and the number of
   * bytes sent for it, without those that find the nearest depths. (Of a cloud, drawing is
   * rendering, too.)
   */
  vtkGetMacro(RenderTime, double);
  vtkGetMacro(CompositeTime, double);
  vtkGetMacro(BytesSent, vtkTypeInt64);
  ///@}

protected:
  vtkIsosurfaceRayTraceCompositor();
  ~vtkIsosurfaceRayTraceCompositor() override;

private:
  vtkIsosurfaceRayTraceCompositor(const vtkIsosurfaceRayTraceCompositor&) = delete;
  void operator=(const vtkIsosurfaceRayTraceCompositor&) = delete;

  struct View;
  struct Pixels;
  struct Fragments;

  bool Render(View view, vtkImageData* output);
  vtkSmartPointer<vtkMultiProcessController> FindController();
  static std::string FindProblem(
    const View& view, vtkMultiProcessController* controller, vtkImageData* output);
  static std::string FindDisagreement(const View* view, vtkMultiProcessController* controller);
  bool IsFineEverywhere(bool isFine, vtkMultiProcessController* controller);
  static vtkSmartPointer<vtkFloatArray> FindNearestDepths(
    const View& view, vtkMultiProcessController* controller);
  static bool RenderPiece(const View& view, Fragments& fragments);
  bool MakeIsosurfaces(const View& view, vtkMultiProcessController* controller, Pixels& pixels);
  bool MakeCloud(const View& view, vtkMultiProcessController* controller, Pixels& pixels);
  bool RenderTiles(const View& view, vtkMultiProcessController* controller, vtkImageData* own);
  void CompositeFragments(
    const Fragments& fragments, vtkMultiProcessController* controller, Pixels& pixels);
  template <typename Record>
  void Composite(std::vector<Record>&& own, vtkMultiProcessController* controller, Pixels& pixels);
  void GatherPixels(int height, vtkMultiProcessController* controller, Pixels& pixels);

  vtkSmartPointer<vtkMultiProcessController> Controller;
  bool Gather = true;
  double RenderTime = 0.0;
  double CompositeTime = 0.0;
  vtkTypeInt64 BytesSent = 0;
  int BufferDepth = 4096;
  int PollingInterval = 1;
  vtkTypeInt64 SegmentsFound = 0;
  vtkTypeInt64 SegmentsDrawn = 0;
  vtkTypeInt64 MostSegmentsStored = 0;
};

VTK_ABI_NAMESPACE_END

#endif
