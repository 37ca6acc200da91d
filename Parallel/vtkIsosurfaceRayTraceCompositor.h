// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceCompositor
 * @brief   makes one picture of isosurfaces whose data lie in many processes
 *
 * Each process has a piece of the data, a vtkIsosurfaceRayTraceMapper,
 * vtkIsosurfaceRayTraceMeshMapper or vtkCellProjectionMapper for this piece, and a volume with the
 * same property and matrix as in all other processes. All processes call RenderToImage together,
 * with the same view:
 *
 * @code
 * vtkNew<vtkIsosurfaceRayTraceCompositor> compositor; // of the global controller
 * compositor->BroadcastCamera(camera);
 * compositor->RenderToImage(volume, camera, nullptr, 800, 600, picture);
 * @endcode
 *
 * Each process traces its piece (with its own threads: divide the cores of a machine among the
 * processes on it, by OMP_NUM_THREADS or SetNumberOfThreads). The hits of the rays are composited
 * pixel by pixel, in the order along each ray: pieces need no order, and may have any shape. The
 * picture is that of one process with all data, with these qualifications:
 * - Opaque and translucent surfaces are the same, bit for bit, if pieces have enough layers of
 *   ghost cells: none with NormalMode INTERPOLANT_GRADIENT and point scalars, one with central
 *   differences or cubic interpolation; one more with cell scalars. (Where the centre of a mesh is
 *   not that of the whole, the depth may differ in its last bits.) AMR data need the blocks beside
 *   their own: vtkIsosurfaceGhostBlocks adds them.
 * - Projections (blend modes MAXIMUM_INTENSITY_BLEND and MINIMUM_INTENSITY_BLEND of
 *   vtkIsosurfaceRayTraceMapper) must be of mappers with one connection. Each pixel shows the most
 *   extreme value of all pieces. The colour is the same; the value may differ in its last bits.
 *   (Where a ray has several equal extreme values, the depth may be that of another one.) A layer
 *   of ghost cells is needed for cell scalars only.
 * - Shadows and ambient occlusion end at the border of a piece: a piece has no effect on another.
 * - A pixel has one ray: ProgressiveAccumulation has no effect.
 *
 * Set the data of a piece with SetInputData: mappers request the whole extent of their inputs. A
 * cell belongs to the piece in which it is not a ghost cell (vtkDataSetAttributes::DUPLICATECELL).
 * Pieces whose own cells overlap show the surface there twice, which is visible where it is
 * translucent. A process may have no data: give its mapper no input, or an empty one. One of
 * several connections may also have no data in some processes: give it an empty input there, so
 * that all processes have the same connections.
 *
 * The processes of a vtkMPIController also draw clouds (vtkCellProjectionMapper) together,
 * including isosurfaces in them. Cells may be distributed in any way; round robin, in short runs of
 * some 64 that are neighbours in the file, keeps all processes equally busy. The picture is divided
 * into tiles, and the rows of tiles are assigned to processes, their owners. All processes work on
 * the same tiles at about the same time: they find the segments of rays in their cells, front to
 * back, and send them to the owners. The owners draw these by depth as they arrive, and report
 * where the cloud is opaque. The picture is that of one process, bit for bit, for any number of
 * processes, pieces and threads. (With composite data or several connections as inputs it may
 * differ in the last bits, as above.) Clouds that are lit (vtkVolumeProperty::ShadeOn) need the
 * ghost cells that isosurfaces need: none with NormalMode INTERPOLANT_GRADIENT, one layer with
 * central differences.
 *
 * The pixels are composited by binary swap: with n processes, there are log2(n) steps, in each of
 * which a process gives half of its rows to another process and receives the pixels of the other
 * half from it. Empty pixels are not sent. If n is not a power of two, there is one step before
 * these, in which every second one of the first processes gives all of its pixels to its neighbour.
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
   * or for a single process if there is no global controller.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  ///@{
  /**
   * Set/Get whether process 0 gets the whole picture, and the others an empty one. If not, each
   * process gets the rows that it composited, as an image with their extent. Default: on.
   */
  vtkSetMacro(Gather, bool);
  vtkGetMacro(Gather, bool);
  vtkBooleanMacro(Gather, bool);
  ///@}

  /**
   * Copies the camera of process 0 (its position, its projection and its clipping range) to all
   * processes. All processes must call this together. The application must keep everything else on
   * which a view depends the same in all processes.
   */
  void BroadcastCamera(vtkCamera* camera);

  /**
   * Makes the picture of all pieces. All processes must call this together, with the same camera,
   * lights (null: a headlight) and size, and with the same settings of volumes and mappers. The
   * arguments are those of vtkIsosurfaceRayTraceMapper::RenderToImage. The output has its arrays
   * Colors and Depth, and Value for a projection.
   *
   * The depths are those of the opaque geometry that this process has drawn; null, the default, if
   * it has drawn none. Rays end at the nearest depth of all processes: translucent surfaces and
   * clouds are seen in front of it, and nothing behind it. If process 0 alone draws the scene, only
   * process 0 needs depths (see vtkIsosurfacePicture for how to get them).
   *
   * Returns whether there is a picture: the same in all processes. If not, an error of process 0
   * names the processes whose errors report why.
   */
  bool RenderToImage(vtkVolume* volume, vtkCamera* camera, vtkLightCollection* lights, int width,
    int height, vtkImageData* output, vtkFloatArray* depths = nullptr);

  /**
   * Makes the picture of the isosurfaces of several volumes, which may be translucent and inside
   * each other. All processes must have the same number of volumes, in the same order. Where
   * surfaces coincide, that of the first volume is in front. Each volume has its own mapper: a
   * surface casts no shadow on those of other volumes.
   */
  bool RenderToImage(vtkVolumeCollection* volumes, vtkCamera* camera, vtkLightCollection* lights,
    int width, int height, vtkImageData* output, vtkFloatArray* depths = nullptr);

  ///@{
  /**
   * Set/Get how clouds are sent. A message has at least BufferDepth segments of rays (from 1 to
   * 2^24), unless its process has nothing else to do. A process looks for messages after
   * PollingInterval (from 1 on) groups of up to 16 tiles in which it has found segments, or has
   * drawn those that it has to draw. Both change only the time. Default: 4096 and 1.
   */
  vtkSetClampMacro(BufferDepth, int, 1, 1 << 24);
  vtkGetMacro(BufferDepth, int);
  vtkSetClampMacro(PollingInterval, int, 1, VTK_INT_MAX);
  vtkGetMacro(PollingInterval, int);
  ///@}

  ///@{
  /**
   * Get counts of the last cloud in this process: the number of segments of rays in its own cells,
   * the number of segments that it drew, whichever process has their cells, and the largest number
   * of the latter that were stored at once. They are zero for isosurfaces, and if one process has
   * all data.
   */
  vtkGetMacro(SegmentsFound, vtkTypeInt64);
  vtkGetMacro(SegmentsDrawn, vtkTypeInt64);
  vtkGetMacro(MostSegmentsStored, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Get the cost of the last picture in this process: the times to render its piece and to
   * composite the pixels, including waiting for others, in seconds of wall-clock time; and the
   * number of bytes sent for it, without those that find the nearest depths. (For a cloud, drawing
   * counts as rendering.)
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
