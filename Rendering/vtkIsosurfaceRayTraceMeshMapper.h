// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceMeshMapper
 * @brief   ray trace isosurfaces straight from meshes, on the CPU
 *
 * Draws the isosurfaces of a vtkUnstructuredGrid, a vtkStructuredGrid or composite data of them
 * without extracting polygons, as vtkIsosurfaceRayTraceMapper does those of images. Isovalues,
 * colours, opacities, lights, shadows, occlusion, picking, casting and pictures without a window
 * are the same. (The input may also be an image or a rectilinear grid, but only
 * vtkIsosurfaceRayTraceMapper has cropping, interpolation modes and projections.) A new isovalue
 * costs a frame; for smooth normals, the second isovalue also requires the gradients at all points
 * (see NormalMode).
 *
 * Values in a cell are interpolated as by VTK's own functions for the cell. In a tetrahedron they
 * are linear. Hexahedra, voxels, wedges and pyramids are isoparametric: positions and values are
 * the (collapsed) trilinear interpolants of the corners, faces are bilinear, and the surface in a
 * cell is neither flat nor cut at the edges of the cell. Every ray is intersected with exactly this
 * surface. A mesh may have cells of several shapes; cells may overlap, and may touch without
 * sharing points. Cells of fewer than three dimensions are skipped, and so are cells with a NaN or
 * infinite corner. A mesh may have at most 2^32 - 1 cells.
 *
 * Quadratic cells and other three-dimensional cells are subdivided into tetrahedra by
 * vtkCell::Triangulate. If these tetrahedra do not fill the cell, or do not cut its faces as those
 * of its neighbours do, the cell is subdivided as VTK contours it: VTK_TRIQUADRATIC_HEXAHEDRON into
 * eight hexahedra, Lagrange hexahedra and wedges into hexahedra and wedges between their points.
 * (The points of Bezier cells are also treated as points on the cell.)
 *
 * Polyhedra need not be convex, and their faces need not be flat. They are subdivided into
 * tetrahedra between the triangles of their faces and the mean of their points, which has the mean
 * of their values. Neighbours cut a shared face in the same way, even if they are in different
 * blocks: from its first point (by x, then y, then z), or, if not all of the face is visible from
 * that point, as vtkPolygon::EarCutTriangulation does. If not all faces are visible from the mean,
 * as in a cell shaped like a U, so that tetrahedra overlap by more than a hundredth of their
 * volume, the convex hull is drawn, with a warning that names the first such cell.
 *
 * Points may be float or double, and ids may have 32 or 64 bits; they are read without a copy.
 * Values are those of the points; cell scalars are averaged to the points as vtkCellDataToPointData
 * does. Nothing is drawn in cells that are hidden, refined or duplicates of those of another piece
 * (vtkGhostType), or that have a hidden point.
 *
 * The mapper keeps a tree over the cells with their boxes and ranges of values, built on the first
 * render, and again when the input changes; it serves every isovalue.
 *
 * The input may be composite: any vtkCompositeDataSet, such as vtkMultiBlockDataSet,
 * vtkPartitionedDataSet and their collections. Set it with SetInputDataObject or
 * SetInputConnection. Blocks of vtkUnstructuredGrid and vtkStructuredGrid, mixed and nested in any
 * way, are one scene: translucent surfaces of several blocks are composited in the order in which
 * each ray meets them, and blocks cast shadows on each other and occlude each other. Blocks need no
 * lattice in common; they may touch, overlap and pass through each other. A surface continues from
 * block to block, but smooth normals are computed from the cells of one block: give blocks a layer
 * of ghost cells for normals without seams. Images and rectilinear grids may be among the blocks:
 * see vtkIsosurfaceRayTraceMapper, which also says which blocks are left out. Each block has a
 * tree, which is built again when that block changes. Cells and points are numbered through all
 * blocks: see FindBlock.
 *
 * The colour of a surface may come from another array (ColorArrayName).
 *
 * The blend modes of vtkUnstructuredGridVolumeMapper are ignored: surfaces are drawn.
 * ClippingPlanes cut them exactly, along every ray; CapClippingPlanes closes the cuts.
 *
 * The documentation of vtkIsosurfaceRayTraceMapper about errors, about events and what their
 * observers may do, and about threads applies here, too.
 *
 * K.-L. Ma, S. Parker: Massively Parallel Software Rendering for Visualizing Large-Scale Data Sets.
 * IEEE Computer Graphics and Applications 21(4), 2001.
 *
 * @sa vtkIsosurfaceRayTraceMapper vtkUnstructuredGridVolumeMapper vtkContour3DLinearGrid
 */

#ifndef vtkIsosurfaceRayTraceMeshMapper_h
#define vtkIsosurfaceRayTraceMeshMapper_h

#include "vtkCompositeDataDisplayAttributes.h" // for ivars
#include "vtkIsosurfaceRayTraceSetMacros.h"    // for vtkIsosurfaceSetClampMacro
#include "vtkIsosurfaceRayTracingCompat.h"     // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingModule.h"     // for export macro
#include "vtkSmartPointer.h"                   // for ivars
#include "vtkUnstructuredGridVolumeMapper.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCamera;
class vtkDataArray;
class vtkDataSet;
class vtkFloatArray;
class vtkImageData;
class vtkIsosurfaceRayTraceEngine;
class vtkLightCollection;
class vtkPoints;
class vtkPolyData;
class vtkTable;
struct vtkIsosurfaceRayTraceInputSettings;
struct vtkIsosurfaceRayTraceSettings;
struct vtkIsosurfaceRayTraceSharedSettings;

class VTKISOSURFACERAYTRACING_EXPORT vtkIsosurfaceRayTraceMeshMapper
  : public vtkUnstructuredGridVolumeMapper
{
public:
  static vtkIsosurfaceRayTraceMeshMapper* New();
  vtkTypeMacro(vtkIsosurfaceRayTraceMeshMapper, vtkUnstructuredGridVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set the input: a vtkUnstructuredGrid or a vtkStructuredGrid. (For composite data call
   * SetInputDataObject or SetInputConnection.)
   */
  void SetInputData(vtkUnstructuredGridBase* grid) override;
  void SetInputData(vtkDataSet* grid) override;
  ///@}

  /**
   * How the normal of the surface is computed.
   */
  enum NormalModes
  {
    /// The exact gradient in the cell. It is discontinuous between cells, which become visible.
    INTERPOLANT_GRADIENT = 0,
    /// Gradients at the points, each the mean of those of the cells around it, interpolated in the
    /// cell: a smooth look. For the first isovalues they are computed only next to the surfaces.
    /// The first frame with another isovalue computes those of all points; this one frame takes
    /// longer.
    CENTRAL_DIFFERENCES = 1
  };

  ///@{
  /**
   * Set/Get where the normal comes from. It changes the shading, never the position of the surface.
   * Default: CENTRAL_DIFFERENCES.
   */
  vtkSetClampMacro(NormalMode, int, INTERPOLANT_GRADIENT, CENTRAL_DIFFERENCES);
  vtkGetMacro(NormalMode, int);
  void SetNormalModeToInterpolantGradient() { this->SetNormalMode(INTERPOLANT_GRADIENT); }
  void SetNormalModeToCentralDifferences() { this->SetNormalMode(CENTRAL_DIFFERENCES); }
  ///@}

  /**
   * Which of several components of the scalars is used.
   */
  enum VectorModes
  {
    /// The component with the largest vtkVolumeProperty::GetComponentWeight(); the first of these
    /// if several are equal. The scalars may have at most four components.
    DISABLED = -1,
    /// The magnitude of the vector. A copy of the magnitudes is made, in double precision.
    MAGNITUDE = 0,
    /// The component set by VectorComponent.
    COMPONENT = 1
  };

  ///@{
  /**
   * Set/Get which of several components of the scalars is used. The names are those of
   * vtkSmartVolumeMapper. With MAGNITUDE and COMPONENT the transfer functions are those of
   * component 0 of the property. For the meaning of DISABLED in clouds, see
   * vtkCellProjectionMapper. Default: DISABLED.
   */
  vtkSetClampMacro(VectorMode, int, DISABLED, COMPONENT);
  vtkGetMacro(VectorMode, int);
  void SetVectorModeToDisabled() { this->SetVectorMode(DISABLED); }
  void SetVectorModeToMagnitude() { this->SetVectorMode(MAGNITUDE); }
  void SetVectorModeToComponent() { this->SetVectorMode(COMPONENT); }
  ///@}

  ///@{
  /**
   * Set/Get the component that COMPONENT uses. A component that the scalars do not have is an
   * error. Range: from 0. Default: 0.
   */
  vtkSetClampMacro(VectorComponent, int, 0, VTK_INT_MAX);
  vtkGetMacro(VectorComponent, int);
  ///@}

  ///@{
  /**
   * Set/Get the name of an array of the input that colours the surfaces instead of their isovalues.
   * Its value at a hit is mapped through the colour transfer function of the property. An array of
   * unsigned char with three or four components holds the colours themselves. For other vectors,
   * the vector mode of the function (vtkScalarsToColors::SetVectorModeToMagnitude) selects a
   * component, by default the first, or the magnitude; only the first nine components are used.
   * Point values are interpolated in the cell. If no point array has the name, the cell array of
   * that name is used, and a surface has one colour in a cell. All blocks of a composite input must
   * have the array, of the same kind. The array gives no opacities. Default: empty, and surfaces
   * are coloured by isovalue.
   */
  void SetColorArrayName(const char* name);
  const char* GetColorArrayName() const { return this->ColorArrayName.c_str(); }
  ///@}

  ///@{
  /**
   * Set/Get how the blocks of a composite input are displayed: their visibility, colours and
   * opacities. Surfaces and caps of a block have these colours and opacities in place of those of
   * the property and of ColorArrayName. An attribute of a node applies to all blocks below it that
   * have no attribute of their own. The opacity of a block, from 0 (not visible) to 1, applies to
   * all of its surfaces that the property makes visible. Pickability and materials are ignored.
   * Default: null, and all blocks are displayed alike.
   */
  void SetCompositeDataDisplayAttributes(vtkCompositeDataDisplayAttributes* attributes);
  vtkCompositeDataDisplayAttributes* GetCompositeDataDisplayAttributes() const
  {
    return this->CompositeDataDisplayAttributes;
  }
  ///@}

  ///@{
  /**
   * Set/Get the volume of a connection of the first port. Connections are counted from 0; less than
   * 0 is an error.
   *
   * Several connections (AddInputConnection) are drawn together: hits are sorted along each ray,
   * whichever data they belong to. Where surfaces coincide, or caps lie in one plane, that of the
   * first connection is in front. Data without points are skipped, unless no connection has any
   * points. Cells are numbered through all connections.
   *
   * The volume gives the data of its connection their own property (isovalues, colours, opacities,
   * material) and their own place: its matrix transforms the coordinates of the data to those of
   * the volume that the mapper draws. If it is not visible (VisibilityOff), neither is the
   * connection: no ray hits it, and the bounds are those of the other connections. The volume
   * itself must not be in a renderer. Default: null; the connection has the property of the drawn
   * volume, and its data are not transformed.
   */
  void SetConnectionVolume(int connection, vtkVolume* volume);
  vtkVolume* GetConnectionVolume(int connection) const;
  ///@}

  ///@{
  /**
   * Set/Get whether cells are split into tetrahedra, in which values are linear. The surface is
   * then a contour of these tetrahedra, not that of the cells as VTK interpolates them. The
   * tetrahedra are those of a cloud (vtkCellProjectionMapper): each face with four corners is cut
   * along the diagonal from its first corner (by x, then y, then z), so that cells agree on shared
   * faces, even in different blocks and processes. Rays take less time. The tetrahedra take memory,
   * 36 bytes each: a hexahedron becomes six, a wedge three, a pyramid two. Default: off.
   */
  vtkSetMacro(Tetrahedralize, bool);
  vtkGetMacro(Tetrahedralize, bool);
  vtkBooleanMacro(Tetrahedralize, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether clipping planes are capped where they cut through the inside of a surface, that
   * is, where values are at or above its isovalue. A cap is a surface like any other: it hides what
   * is behind it, casts shadows, can be picked, and is visible from behind. It shows the data: its
   * colour is that of the value in the plane, by the colour transfer function of the property (or
   * by ColorArrayName), and its normal is that of the plane, towards the clipped side. Its opacity,
   * the isovalue that is reported and everything else are those of the isosurface whose inside it
   * shows; inside several isosurfaces, those of the one with the largest isovalue.
   *
   * A cap ends exactly where the isosurface meets the plane, without a gap. With several planes,
   * each is capped only in the part that the others do not clip. Capped planes are moved towards
   * the side that is kept, by the distance by which rounding may have moved the points of the mesh:
   * 1e-12 of their coordinates, or 6e-8 if they are float. A plane in faces of cells therefore
   * shows the cells that it keeps, even those of another block, and a plane in a face of the mesh
   * closes the surface, which is otherwise open there. There is no cap where no cell is traced, nor
   * in cells that are hidden; where cells overlap, one of them has the cap. Default: off, which
   * costs nothing.
   *
   * @sa vtkCutter
   */
  vtkSetMacro(CapClippingPlanes, bool);
  vtkGetMacro(CapClippingPlanes, bool);
  vtkBooleanMacro(CapClippingPlanes, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether the surfaces cast shadows on each other and on themselves, from every light
   * that is switched on. A translucent surface transmits one minus its opacity. Other props neither
   * cast nor receive these shadows. Shading must be on (vtkVolumeProperty::ShadeOn). Default: off,
   * which costs nothing.
   */
  vtkSetMacro(Shadows, bool);
  vtkGetMacro(Shadows, bool);
  vtkBooleanMacro(Shadows, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether surfaces occlude ambient light from each other and from themselves. The ambient
   * term of the shading, and no other, is multiplied by the fraction of the hemisphere above the
   * hit, on the visible side, that is not occluded. A translucent surface transmits one minus its
   * opacity. Clipped parts occlude nothing. Shading must be on (vtkVolumeProperty::ShadeOn), and
   * the ambient light must be strong enough for the effect to be visible:
   * vtkVolumeProperty::SetAmbient(0.5); the default of 0.1 is too weak. Default: off, which costs
   * nothing.
   */
  vtkSetMacro(AmbientOcclusion, bool);
  vtkGetMacro(AmbientOcclusion, bool);
  vtkBooleanMacro(AmbientOcclusion, bool);
  ///@}

  ///@{
  /**
   * Set/Get the number of ambient occlusion rays from each hit, in directions distributed by the
   * cosine to the normal. The directions differ from hit to hit, so few rays give noise; they are
   * the same in every picture. (The further frames of ProgressiveAccumulation have other
   * directions.) With AutoAdjustSampleDistances there may be fewer rays during interaction. Range:
   * 1 to 4096. Default: 32.
   */
  vtkSetClampMacro(NumberOfAmbientOcclusionRays, int, 1, 4096);
  vtkGetMacro(NumberOfAmbientOcclusionRays, int);
  ///@}

  ///@{
  /**
   * Set/Get the length of the ambient occlusion rays, in world coordinates. Surfaces farther away
   * occlude nothing. 0 sets no limit. Range: from 0. Default: 0.
   */
  vtkIsosurfaceSetClampMacro(AmbientOcclusionRadius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmbientOcclusionRadius, double);
  ///@}

  ///@{
  /**
   * Set/Get the size in pixels of the tiles of the image that are scheduled to threads. Range: 1 to
   * 4096 each. Default: 64 x 64. The cells that a tile may show are found and projected once for
   * all its rays; smaller tiles keep many threads busy to the end.
   */
  void SetTileSize(int width, int height);
  void SetTileSize(const int size[2]) { this->SetTileSize(size[0], size[1]); }
  vtkGetVector2Macro(TileSize, int);
  ///@}

  ///@{
  /**
   * Set/Get whether ImageSampleDistance is chosen for every frame, between its minimum and maximum,
   * so that the frame is drawn in the time allocated to it: pictures are coarser during interaction
   * (vtkRenderWindow::SetDesiredUpdateRate, as interactor styles call it) and have a ray for every
   * pixel when the scene is still. Before the distance is increased, the number of ambient
   * occlusion rays of interactive frames is reduced, down to 4 from each hit. In stereo both
   * numbers are chosen once for both eyes. Default: on.
   */
  vtkSetClampMacro(AutoAdjustSampleDistances, vtkTypeBool, 0, 1);
  vtkGetMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkBooleanMacro(AutoAdjustSampleDistances, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Set/Get the distance between neighbouring rays, in pixels; after a frame with
   * AutoAdjustSampleDistances, the distance that was chosen. Values of 1 and more are rounded to a
   * whole number of pixels, and colours are interpolated between the rays; even so, other props
   * hide opaque surfaces pixel by pixel. Values below 1 are rounded to 1/n, and each pixel is the
   * mean of n^2 rays: 0.5 gives anti-aliasing with four rays for every pixel. Range: 0.1 to 100.
   * Default: 1.
   */
  vtkIsosurfaceSetClampMacro(ImageSampleDistance, float, 0.1F, 100.0F);
  vtkGetMacro(ImageSampleDistance, float);
  ///@}

  ///@{
  /**
   * Set/Get the range from which AutoAdjustSampleDistances chooses. Ranges: 0.1 to 100. Defaults: 1
   * and 10.
   */
  vtkIsosurfaceSetClampMacro(MinimumImageSampleDistance, float, 0.1F, 100.0F);
  vtkGetMacro(MinimumImageSampleDistance, float);
  vtkIsosurfaceSetClampMacro(MaximumImageSampleDistance, float, 0.1F, 100.0F);
  vtkGetMacro(MaximumImageSampleDistance, float);
  ///@}

  ///@{
  /**
   * Set/Get whether the picture is refined while nothing changes. Each Render() of an unchanged
   * scene traces one more frame, with rays through other points of the pixels and, with
   * AmbientOcclusion, in other directions from the hits; it shows the mean of all frames so far.
   * Edges become anti-aliased, and noise vanishes. The first frame is the same picture as without
   * accumulation; its depth is kept. Any change of the picture (camera, lights, property, settings,
   * inputs, size, the depth of what is in front) restarts the accumulation; an aborted frame
   * (vtkRenderWindow::CheckAbortStatus) does not change it. Each renderer, and in stereo each eye,
   * has its own mean.
   *
   * The application must call Render(), for example from a timer of the interactor, as long as
   * GetNumberOfAccumulatedFrames() is more than 0 and less than MaximumNumberOfAccumulatedFrames.
   *
   * Coarse pictures (ImageSampleDistance of 2 and more, as while interacting), those of
   * vtkSSAOPass, hardware selections and PickPixel neither use nor change the mean. RenderToImage
   * makes all frames of its own mean at once. Accumulation takes 12 bytes for every pixel that the
   * volume covers, and 4 more where depth is read, for each renderer. Default: off, which costs
   * nothing.
   */
  vtkSetMacro(ProgressiveAccumulation, bool);
  vtkGetMacro(ProgressiveAccumulation, bool);
  vtkBooleanMacro(ProgressiveAccumulation, bool);
  ///@}

  ///@{
  /**
   * Set/Get the number of frames after which tracing stops: from then on the mean is only
   * displayed, and TraceTime is 0. Range: 1 to 256. Default: 16.
   */
  vtkSetClampMacro(MaximumNumberOfAccumulatedFrames, int, 1, 256);
  vtkGetMacro(MaximumNumberOfAccumulatedFrames, int);
  ///@}

  /**
   * Get the number of frames whose mean the last Render() showed; 0 if its picture is not
   * accumulated. After an aborted frame it is the number before that frame. If several renderers
   * show the volume, it is the number of the last one: call this after each renderer, for example
   * at its EndEvent.
   */
  int GetNumberOfAccumulatedFrames();

  ///@{
  /**
   * Set/Get the number of threads; 0 uses the default of OpenMP (OMP_NUM_THREADS, or all cores). A
   * process that was forked from one in which a mapper has drawn always uses one thread. Range: 0
   * to 1024. Default: 0.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * Get the times of the last frame, in seconds of wall-clock time: building the tree, finding
   * gradients at the points, tracing, shading, and displaying. The time of a step that the frame
   * did not need is 0.
   */
  double GetTreeBuildTime();
  double GetGradientTime();
  double GetTraceTime();
  double GetShadeTime();
  double GetDisplayTime();
  ///@}

  ///@{
  /**
   * Get the memory in use, in bytes: of the trees, with the gradients at the points, and of what
   * was found of the isosurfaces while rays were traced. The latter is some 20 bytes for each cell
   * through which a surface passes and that the camera saw; it is released when its isovalue is no
   * longer drawn.
   */
  vtkIdType GetTreeMemory();
  vtkIdType GetSurfaceMemory();
  ///@}

  /**
   * Returns whether a volume has isosurfaces to draw, and all of them are opaque: the property has
   * an opacity of at least one at every isovalue that it does not hide. Returns false if the volume
   * cannot be drawn; Render reports why.
   *
   * @sa vtkIsosurfaceVolume
   */
  bool HasOnlyOpaqueSurfaces(vtkVolume* volume);

  /**
   * Finds the first isosurface that the line from p1 to p2 (world coordinates) meets, as the
   * picture of the volume shows it, with the isovalues, opacities and matrix of the volume. It
   * needs neither a window nor OpenGL. Returns 1 if there is a hit; otherwise returns 0 and changes
   * nothing.
   *
   * The results are:
   * - t: the parametric position on the line, from 0 at p1 to 1 at p2
   * - x: the point in world coordinates
   * - pcoords: its parametric coordinates in the cell
   * - cellId: the cell of the input
   * - isovalue: the isovalue of the surface
   * - normal: the unit normal of the surface in world coordinates, by NormalMode, towards smaller
   *   values
   */
  int IntersectWithLine(vtkVolume* volume, const double p1[3], const double p2[3], double& t,
    double x[3], double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3]);

  /**
   * Finds the block of a composite input that contains a cell, and the number of the cell in that
   * block. The cell is given by its number through all blocks (the cell id that this class
   * reports). The flat index of the block is that of vtkCompositeDataIterator. If the input is not
   * composite, the block is the input itself, and the flat index is 0.
   */
  vtkDataSet* FindBlock(vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex);

  /**
   * Casts rays on all threads, as IntersectWithLine does for one line. The rays are given by
   * origins and directions in world coordinates. A ray has all the hits that contribute to a pixel:
   * up to the first opaque one, or until the surfaces in front transmit less than 1/1024 of the
   * light (after 11 hits of opacity 0.5). To find all hits, give the surfaces a small opacity, such
   * as 0.001 (some 6900 hits). The directions have three components, with one tuple for each
   * origin; the length of a direction is the unit of T. Rays begin at their origins, where T is 0,
   * and have no end. A ray whose direction is 0 or not finite has no hits.
   *
   * The output has a point (double) for every hit, ordered by ray and from front to back. Its point
   * data are RayId and CellId (vtkIdType), T (in units of the direction), Isovalue,
   * ParametricCoordinates and Normals (double; the last two have 3 components). Returns whether
   * rays were cast; if not, an error reports why.
   */
  bool CastRays(
    vtkVolume* volume, vtkPoints* origins, vtkDataArray* directions, vtkPolyData* output);

  /**
   * Finds the bounds, in world coordinates, of what the picture of a volume shows. They are smaller
   * than the bounds of the volume if its surfaces, or what clipping leaves of them, are smaller.
   * They are found by casting 64 x 64 rays through each face of the bounds of the volume, or 512 x
   * 512 rays if those hit nothing; parts thinner than a 64th of the volume may therefore extend
   * beyond them. This needs neither a window nor OpenGL. Returns whether there is a surface; if
   * not, changes nothing.
   *
   * To place a camera, pass these bounds to vtkRenderer::ResetCamera(bounds).
   */
  bool FindSurfaceBounds(vtkVolume* volume, double bounds[6]);

  /**
   * Finds what the picture of a renderer shows of the volume at a pixel of the window: the nearest
   * isosurface, bit for bit as it is drawn. Pixels are counted from the lower left. (In stereo, it
   * is what a window without stereo would show, as for all pickers of VTK.) Other props are
   * ignored. The window need not have been rendered. Returns 1 if there is a surface; otherwise
   * returns 0 and changes nothing. The results are those of IntersectWithLine.
   *
   * @sa vtkIsosurfacePicker
   */
  int PickPixel(vtkRenderer* renderer, vtkVolume* volume, int column, int row, double x[3],
    double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3]);

  /**
   * Makes a picture without a window and without OpenGL. It is the same, pixel for pixel, as in a
   * window of that size with a single renderer with that camera, with a ray for each pixel whatever
   * ImageSampleDistance is. The clipping range of the camera is used unchanged
   * (vtkCamera::SetClippingRange). Headlights and camera lights follow the camera; without lights
   * (null) there is one headlight, as in a new renderer.
   *
   * The output has a point for every pixel, in rows from the bottom. Its point data are:
   * - Colors (unsigned char; the active scalars): red, green, blue and opacity; the colours are
   *   multiplied by the opacity
   * - Depth (float): the depth of the nearest opaque surface in the depth buffer, from 0 to 1; 1
   *   where there is none
   *
   * Further arrays describe the nearest surface, translucent or not. Where there is no surface,
   * they are NaN and -1.
   * - Normals (double, 3 components): as of IntersectWithLine
   * - Position (double, 3 components): in world coordinates
   * - CellId (vtkIdType)
   * - IsovalueId (int): the number of the isovalue in vtkVolumeProperty::GetIsoSurfaceValues()
   *
   * Returns whether there is a picture; if not, an error reports why.
   *
   * With ProgressiveAccumulation, Colors are the mean of MaximumNumberOfAccumulatedFrames frames,
   * as in a window at rest: edges are anti-aliased. All other arrays are those of the first frame.
   *
   * The depths are those of opaque geometry over which the picture is drawn; rays end there. They
   * are a value from 0 to 1 for each pixel, in rows from the bottom, as in
   * vtkRenderWindow::GetZbufferData and in the array Depth. With null, the default, there is no
   * such geometry.
   *
   * To write the picture to a file, convert it with vtkIsosurfacePicture::UnpremultiplyColors or
   * FlattenColors.
   */
  bool RenderToImage(vtkVolume* volume, vtkCamera* camera, vtkLightCollection* lights, int width,
    int height, vtkImageData* output, vtkFloatArray* depths = nullptr);

  /**
   * Finds the surfaces of which the pixels of the picture of RenderToImage are made, so that it can
   * be composited with other pictures of the same view. The output has a row for each surface that
   * the ray of a pixel meets and shows, ordered by pixel and from front to back, and these columns:
   * - Pixel (vtkIdType): the number of the point in the output of RenderToImage
   * - T (double): the distance of the surface, in units that all pictures of a camera share
   * - Color (double, 3 components): from 0 to 1, multiplied by the opacity
   * - Opacity (double)
   * - Depth (float): the depth of an opaque surface in the depth buffer; otherwise 1
   *
   * As in CastRays, a ray ends where the surfaces in front transmit too little light. A connection
   * without points has no rows. The argument depths is the one of RenderToImage. Returns whether
   * there is an output; if not, an error reports why.
   *
   * @sa vtkIsosurfaceRayTraceCompositor
   */
  bool RenderToFragments(vtkVolume* volume, vtkCamera* camera, vtkLightCollection* lights,
    int width, int height, vtkTable* output, vtkFloatArray* depths = nullptr);

  /**
   * Copies the inputs and all settings of another vtkIsosurfaceRayTraceMeshMapper; inputs and
   * clipping planes are shared. From other mappers it copies what their common base class copies.
   */
  void ShallowCopy(vtkAbstractMapper* mapper) override;

  ///@{
  /**
   * Updates the whole input, in one piece, whatever other consumers have requested before.
   */
  using vtkUnstructuredGridVolumeMapper::Update;
  void Update(int port) override;
  void Update() override;
  ///@}

  ///@{
  /**
   * Get the bounds of the input; for composite input, the bounds of all visible blocks.
   */
  using vtkUnstructuredGridVolumeMapper::GetBounds;
  double* GetBounds() VTK_SIZEHINT(6) override;
  ///@}

  /**
   * WARNING: INTERNAL METHOD - NOT INTENDED FOR GENERAL USE
   * Trace the isosurfaces of the volume into the window of the renderer.
   */
  void Render(vtkRenderer* renderer, vtkVolume* volume) override;

  /**
   * WARNING: INTERNAL METHOD - NOT INTENDED FOR GENERAL USE
   * Release the textures and shaders held in the window.
   */
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkIsosurfaceRayTraceMeshMapper();
  ~vtkIsosurfaceRayTraceMeshMapper() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

  /// What is drawn, and how.
  virtual vtkIsosurfaceRayTraceSettings GetSettings() const;
  virtual vtkIsosurfaceRayTraceInputSettings GetInputSettings() const;

private:
  vtkIsosurfaceRayTraceMeshMapper(const vtkIsosurfaceRayTraceMeshMapper&) = delete;
  void operator=(const vtkIsosurfaceRayTraceMeshMapper&) = delete;

  friend class vtkIsosurfaceRayTraceEngine;
  friend struct vtkIsosurfaceRayTraceSharedSettings;

  int NormalMode = CENTRAL_DIFFERENCES;
  int VectorMode = DISABLED;
  int VectorComponent = 0;
  std::string ColorArrayName;
  std::vector<vtkSmartPointer<vtkVolume>> ConnectionVolumes;
  vtkSmartPointer<vtkCompositeDataDisplayAttributes> CompositeDataDisplayAttributes;
  bool Tetrahedralize = false;
  bool CapClippingPlanes = false;
  bool Shadows = false;
  bool AmbientOcclusion = false;
  int NumberOfAmbientOcclusionRays = 32;
  double AmbientOcclusionRadius = 0.0;
  int TileSize[2] = { 64, 64 };
  vtkTypeBool AutoAdjustSampleDistances = 1;
  float ImageSampleDistance = 1.0F;
  float MinimumImageSampleDistance = 1.0F;
  float MaximumImageSampleDistance = 10.0F;
  bool ProgressiveAccumulation = false;
  int MaximumNumberOfAccumulatedFrames = 16;
  int NumberOfThreads = 0;

  std::unique_ptr<vtkIsosurfaceRayTraceEngine> Engine;
};

VTK_ABI_NAMESPACE_END

#endif
