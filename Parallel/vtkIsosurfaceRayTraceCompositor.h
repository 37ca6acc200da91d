// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceCompositor
 * @brief   makes one picture of isosurfaces whose data lie in many processes
 *
 * Each process has a piece of the data, a vtkIsosurfaceRayTraceMapper or
 * vtkIsosurfaceRayTraceMeshMapper of the piece, and a volume with the same property and matrix as
 * the others. All call RenderToImage together, with the same view:
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
 * - Shadows and ambient occlusion end at the pieces: a piece casts none on another.
 *
 * The data of a piece are given with SetInputData: the mappers ask their inputs for the whole. A
 * cell is of the piece in which it is no ghost (vtkDataSetAttributes::DUPLICATECELL); pieces whose
 * own cells overlap show the surface there twice, which is seen where it is translucent. A process
 * may have no data: give its mapper no input, or an empty one.
 *
 * The pixels are composited by binary swap: in each of the logarithm of the number of processes
 * steps a process gives half of its rows to another, and takes the other half of the other's
 * pixels. What is empty is not sent. Of n processes that are no power of two, the first begin with
 * a step in which every second one gives all it has to its neighbour.
 *
 * K.-L. Ma, J. S. Painter, C. D. Hansen, M. F. Krogh: Parallel Volume Rendering Using Binary-Swap
 * Compositing. IEEE Computer Graphics and Applications 14(4), 1994.
 *
 * vtkIsosurfacePicture draws the picture into a window of process 0, among other props.
 *
 * @sa vtkIsosurfaceRayTraceMapper vtkIsosurfacePicture vtkMultiProcessController
 */

#ifndef vtkIsosurfaceRayTraceCompositor_h
#define vtkIsosurfaceRayTraceCompositor_h

#include "vtkIsosurfaceRayTracingCompat.h"         // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingParallelModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for ivars

#include <string> // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkCamera;
class vtkImageData;
class vtkLightCollection;
class vtkMultiProcessController;
class vtkTable;
class vtkVolume;

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
   * arguments, too.
   *
   * Returns whether there is a picture: the same in all processes. If not, an error of process 0
   * names the processes whose errors report why.
   */
  bool RenderToImage(vtkVolume* volume, vtkCamera* camera, vtkLightCollection* lights, int width,
    int height, vtkImageData* output);

  ///@{
  /**
   * Get what the last picture took in this process: the time to render its piece and to composite
   * the pixels, including waiting for others, in seconds of wall-clock time, and the number of
   * bytes sent for it.
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

  vtkSmartPointer<vtkMultiProcessController> FindController();
  static std::string FindProblem(const View& view, vtkImageData* output);
  static std::string FindDisagreement(const View* view, vtkMultiProcessController* controller);
  bool IsFineEverywhere(bool isFine, vtkMultiProcessController* controller);
  static bool RenderPiece(const View& view, vtkTable* fragments);
  template <typename Record>
  void Composite(vtkTable* fragments, vtkMultiProcessController* controller, Pixels& pixels);
  void GatherPixels(int height, vtkMultiProcessController* controller, Pixels& pixels);

  vtkSmartPointer<vtkMultiProcessController> Controller;
  bool Gather = true;
  double RenderTime = 0.0;
  double CompositeTime = 0.0;
  vtkTypeInt64 BytesSent = 0;
};

VTK_ABI_NAMESPACE_END

#endif
