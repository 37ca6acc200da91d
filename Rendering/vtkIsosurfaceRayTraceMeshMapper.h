// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceMeshMapper
 * @brief   ray trace isosurfaces straight from meshes, on the CPU
 *
 * Draws the isosurfaces of a vtkUnstructuredGrid, a vtkStructuredGrid or composite data of them
 * (or of an image or a rectilinear grid, but cropping, interpolation modes and projections are
 * those of vtkIsosurfaceRayTraceMapper alone) without extracting polygons, as
 * vtkIsosurfaceRayTraceMapper does those of images: isovalues, colours, opacities, lights, shadows,
 * occlusion, picking, casting and pictures without a window are the same. A new isovalue costs a
 * frame, and the second one the gradients at all points, too, for smooth normals (see NormalMode).
 *
 * Cells are what VTK's own functions of them say. In a tetrahedron the values are linear.
 * Hexahedra, voxels, wedges and pyramids are isoparametric: positions and values are the
 * (collapsed) trilinear interpolants of the corners, their faces are bilinear, and the surface in
 * them is neither flat nor cut at their edges. Every ray is intersected with that very surface.
 * Cells may be of several shapes, overlap, and touch without sharing points. Quadratic cells and
 * other cells of three dimensions are subdivided into tetrahedra by vtkCell::Triangulate, or, where
 * those do not fill the cell or cut its faces otherwise than those of its neighbours, as VTK
 * contours it: VTK_TRIQUADRATIC_HEXAHEDRON into eight hexahedra, Lagrange hexahedra and wedges into
 * such between their points. (Those of Bezier cells, too, are taken for points on the cell.) Cells
 * of fewer dimensions are passed over, and so are cells with a NaN or infinite corner. A mesh may
 * have 2^32 - 1 cells at most.
 *
 * Polyhedra need not be convex, nor their faces flat: they are subdivided into tetrahedra between
 * the triangles of their faces and the mean of their points, which has the mean of their values.
 * Neighbours cut a face alike, also those of different blocks: from its first point (by x, then y,
 * then z), or, where that does not see all of it, as vtkPolygon::EarCutTriangulation does. Where
 * the mean does not see all faces from inside, as in a U, so that tetrahedra overlap by more than a
 * hundredth of their volume, the convex hull is drawn, with a warning that names the first such
 * cell.
 *
 * Points may be float or double, ids of 32 or 64 bits; they are read where they are. The values are
 * those of the points; scalars of cells are averaged to them as vtkCellDataToPointData does.
 * Nothing is drawn in cells that are hidden, refined or duplicates of those of another piece
 * (vtkGhostType), or that have a hidden point.
 *
 * The mapper keeps a tree over the cells with their boxes and ranges of values, built on the first
 * render, and again when the input changes; it serves every isovalue.
 *
 * The input may be composite (vtkMultiBlockDataSet, vtkPartitionedDataSet, their collections; any
 * vtkCompositeDataSet; call SetInputDataObject or SetInputConnection). Blocks of
 * vtkUnstructuredGrid and vtkStructuredGrid, mixed and however nested, are one scene: translucent
 * surfaces of several blocks are composited in the order of each ray, and blocks cast shadows on
 * each other and occlude each other. Blocks need no lattice in common; they may touch, overlap and
 * pass through each other. A surface goes on from block to block, but smooth normals know the cells
 * of one block: give blocks a layer of ghost cells for normals without seams. Images and
 * rectilinear grids may be among the blocks: see vtkIsosurfaceRayTraceMapper, which also says which
 * blocks are left out. Each block has a tree, which is built again when that block changes. Cells
 * and points are numbered through all blocks: see FindBlock.
 *
 * The colour of a surface may come from another array (ColorArrayName).
 *
 * The blend modes of vtkUnstructuredGridVolumeMapper are ignored: surfaces are drawn.
 * ClippingPlanes cut them exactly, along every ray, and are closed by CapClippingPlanes.
 *
 * What vtkIsosurfaceRayTraceMapper says of errors, of events and what their observers may do, and
 * of threads, holds here too.
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
    /// cell: a smooth look. For the first isovalues they are found next to the surfaces; the first
    /// frame with another isovalue finds those of all points, which takes longer, once.
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
   * Which of several components is used.
   */
  enum VectorModes
  {
    /// The component with the largest vtkVolumeProperty::GetComponentWeight() (the first of
    /// equals), of at most four.
    DISABLED = -1,
    /// The magnitude of the vector, of which a copy is made, in double precision.
    MAGNITUDE = 0,
    /// The component set by VectorComponent.
    COMPONENT = 1
  };

  ///@{
  /**
   * Set/Get which of several components is used, by the names of vtkSmartVolumeMapper. With
   * MAGNITUDE and COMPONENT the transfer functions are those of component 0 of the property.
   * vtkCellProjectionMapper says what DISABLED means for clouds. Default: DISABLED.
   */
  vtkSetClampMacro(VectorMode, int, DISABLED, COMPONENT);
  vtkGetMacro(VectorMode, int);
  void SetVectorModeToDisabled() { this->SetVectorMode(DISABLED); }
  void SetVectorModeToMagnitude() { this->SetVectorMode(MAGNITUDE); }
  void SetVectorModeToComponent() { this->SetVectorMode(COMPONENT); }
  ///@}

  ///@{
  /**
   * Set/Get the component for COMPONENT; one that the scalars do not have is an error. Range: from
   * 0. Default: 0.
   */
  vtkSetClampMacro(VectorComponent, int, 0, VTK_INT_MAX);
  vtkGetMacro(VectorComponent, int);
  ///@}

  ///@{
  /**
   * Set/Get the name of an array of the input that colours the surfaces instead of their isovalues:
   * its value at a hit is mapped through the colour transfer function of the property; an array of
   * unsigned char with three or four components holds the colours themselves. Of other vectors the
   * function shows what its vector mode says (vtkScalarsToColors::SetVectorModeToMagnitude): a
   * component, the first by default, or the magnitude, of nine components at most. Values of points
   * are interpolated in the cell. If no array of points has the name, it is one of cells, and a
   * surface has one colour in a cell. All blocks of a composite input must have it, of the same
   * kind. It gives no opacities. Default: empty, and surfaces are coloured by isovalue.
   */
  void SetColorArrayName(const char* name);
  const char* GetColorArrayName() const { return this->ColorArrayName.c_str(); }
  ///@}

  ///@{
  /**
   * How the blocks of a composite input are displayed: whether they are visible, and their colours
   * and opacities, which surfaces and caps have in place of those of the property and of
   * ColorArrayName. What is said of a node holds for all blocks below it that have nothing of their
   * own. An opacity, from 0 (not visible) to 1, is that of all surfaces of a block that are visible
   * by the property. Pickability and materials are not used. Null, the default: all are displayed
   * alike.
   */
  void SetCompositeDataDisplayAttributes(vtkCompositeDataDisplayAttributes* attributes);
  vtkCompositeDataDisplayAttributes* GetCompositeDataDisplayAttributes() const
  {
    return this->CompositeDataDisplayAttributes;
  }
  ///@}

  ///@{
  /**
   * Several connections of the first port (AddInputConnection) are drawn together: hits are in the
   * order of each ray, whatever data they are of; of surfaces at one place, and of caps in one
   * plane, that of the first connection is in front. The volume of a connection, counted from 0,
   * gives its data their own property (isovalues, colours, opacities, material) and their place:
   * its matrix leads from the coordinates of the data to those of the volume that the mapper draws.
   * If it is not visible (VisibilityOff), nothing of the connection is: no ray hits it, and the
   * bounds are those of the others. Data without points are passed over, unless no connection has
   * any. The volume must not be in a renderer by itself. Null, the default: the property is that of
   * the drawn volume, and the data are where they are. Cells are numbered through all connections.
   * A connection less than 0 is an error.
   */
  void SetConnectionVolume(int connection, vtkVolume* volume);
  vtkVolume* GetConnectionVolume(int connection) const;
  ///@}

  ///@{
  /**
   * Set/Get whether cells are split into tetrahedra, in which values are linear: the surface is
   * that of a contour of these, and not that of the cells as VTK interpolates them. The tetrahedra
   * are those of a cloud (vtkCellProjectionMapper): each face with four corners is cut along the
   * diagonal from the first of them (by x, then y, then z), so cells agree on faces, also those of
   * different blocks and processes. Rays take less time; the tetrahedra take memory, 36 bytes each:
   * a hexahedron becomes six, a wedge three, a pyramid two. Default: off.
   */
  vtkSetMacro(Tetrahedralize, bool);
  vtkGetMacro(Tetrahedralize, bool);
  vtkBooleanMacro(Tetrahedralize, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether clipping planes are capped where they cut through the inside of a surface,
   * where values are at or above its isovalue. A cap is a surface like any other: it hides, casts
   * shadows, is picked, and is visible from behind. It shows the data: its colour is that of the
   * value in the plane, by the colour transfer function of the property (or by ColorArrayName), and
   * its normal is that of the plane, towards the clipped side. Everything else is that of the
   * isosurface whose inside it shows, the one of the largest isovalue of several: the opacity, and
   * the isovalue that is reported.
   *
   * A cap ends exactly where the isosurface meets the plane, without a gap. Of several planes each
   * is capped within what the others leave. Capped planes are moved to the side that they leave, by
   * what rounding may have moved the points of the mesh by: 1e-12 of their coordinates, or 6e-8 if
   * they are float. So a plane in faces of cells shows the cells that it leaves, also those of
   * another block, and in a face of the mesh it closes the surface, which is open there otherwise.
   * There is no cap where there is no cell that is traced, nor in cells that are hidden; of cells
   * that overlap one has it. Default: off, which costs nothing.
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
   * Set/Get whether surfaces occlude ambient light from each other and from themselves: the ambient
   * term of the shading, and no other, is multiplied by the part of the hemisphere above a hit that
   * is not occluded, on the visible side. A translucent surface transmits one minus its opacity.
   * Clipped parts occlude nothing. Shading must be on (vtkVolumeProperty::ShadeOn), and
   * the ambient light strong enough for it to be visible: vtkVolumeProperty::SetAmbient(0.5); the
   * default of 0.1 is not. Default: off, which costs nothing.
   */
  vtkSetMacro(AmbientOcclusion, bool);
  vtkGetMacro(AmbientOcclusion, bool);
  vtkBooleanMacro(AmbientOcclusion, bool);
  ///@}

  ///@{
  /**
   * Set/Get the number of ambient occlusion rays from each hit, in directions distributed by the
   * cosine to the normal. The directions differ from hit to hit, and are the same in every picture:
   * few rays give noise. (The further frames of ProgressiveAccumulation have other directions.)
   * With AutoAdjustSampleDistances there may be fewer while interacting. Range: 1 to 4096.
   * Default: 32.
   */
  vtkSetClampMacro(NumberOfAmbientOcclusionRays, int, 1, 4096);
  vtkGetMacro(NumberOfAmbientOcclusionRays, int);
  ///@}

  ///@{
  /**
   * Set/Get the length of the ambient occlusion rays, in world coordinates; what is farther away
   * occludes nothing. 0 sets no limit. Range: from 0. Default: 0.
   */
  vtkIsosurfaceSetClampMacro(AmbientOcclusionRadius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmbientOcclusionRadius, double);
  ///@}

  ///@{
  /**
   * Set/Get the size in pixels of the tiles of the image that are scheduled to threads. Range: 1 to
   * 4096 each. Default: 64 x 64: the cells that a tile may show are found and projected once for
   * all its rays; smaller tiles keep many threads busy to the end.
   */
  void SetTileSize(int width, int height);
  void SetTileSize(const int size[2]) { this->SetTileSize(size[0], size[1]); }
  vtkGetVector2Macro(TileSize, int);
  ///@}

  ///@{
  /**
   * Set/Get whether ImageSampleDistance is chosen for every frame, between its minimum and maximum,
   * so that the frame is drawn in the time allocated to it: coarser pictures while interacting
   * (vtkRenderWindow::SetDesiredUpdateRate, as interactor styles call it), a ray for every pixel
   * when the scene is still. Before that, frames of interaction have fewer ambient occlusion rays,
   * down to 4 from each hit. In stereo both are chosen once for both eyes. Default: on.
   */
  vtkSetClampMacro(AutoAdjustSampleDistances, vtkTypeBool, 0, 1);
  vtkGetMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkBooleanMacro(AutoAdjustSampleDistances, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Set/Get the distance between neighbouring rays, in pixels; after a frame with
   * AutoAdjustSampleDistances, the distance that was chosen. Values from 1 are rounded to a whole
   * number of pixels, and colours are interpolated between the rays; opaque surfaces are hidden by
   * other props pixel by pixel all the same. Values below 1 are rounded to 1/n, and each pixel is
   * the mean of n^2 rays: 0.5 is anti-aliasing with four rays for every pixel. Range: 0.1 to 100.
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
   * Set/Get whether the picture is refined while nothing changes: each Render() of an unchanged
   * scene traces one more frame, by rays through other points of the pixels and, with
   * AmbientOcclusion, in other directions from the hits, and shows the mean of all frames so far.
   * Edges are anti-aliased, noise vanishes. The first frame is the same picture as without
   * accumulation; its depth is kept. Whatever changes the picture (camera, lights, property,
   * settings, inputs, size, the depth of what is in front) restarts it; a frame that is aborted
   * (vtkRenderWindow::CheckAbortStatus) leaves it as it is. Each renderer has its own mean,
   * and in stereo each eye.
   *
   * The application must call Render(), for example from a timer of the interactor, as long as
   * GetNumberOfAccumulatedFrames() is more than 0 and less than MaximumNumberOfAccumulatedFrames.
   *
   * Coarse pictures (ImageSampleDistance of 2 and more, as while interacting), those of
   * vtkSSAOPass, hardware selections and PickPixel do not use the mean, and leave it as it is.
   * RenderToImage makes all frames of a mean of its own at once. It takes 12 bytes for every pixel
   * that the volume covers, and 4 more where depth is read, for each renderer. Default: off, which
   * costs nothing.
   */
  vtkSetMacro(ProgressiveAccumulation, bool);
  vtkGetMacro(ProgressiveAccumulation, bool);
  vtkBooleanMacro(ProgressiveAccumulation, bool);
  ///@}

  ///@{
  /**
   * Set/Get the number of frames after which tracing stops: the mean is only displayed, and
   * TraceTime is 0. Range: 1 to 256. Default: 16.
   */
  vtkSetClampMacro(MaximumNumberOfAccumulatedFrames, int, 1, 256);
  vtkGetMacro(MaximumNumberOfAccumulatedFrames, int);
  ///@}

  /**
   * Get the number of frames whose mean the last Render() showed; 0 if its picture is not
   * accumulated. After a frame that was aborted: the number before it. Where several renderers show
   * the volume, it is that of the last one: ask after each, for example at its EndEvent.
   */
  int GetNumberOfAccumulatedFrames();

  ///@{
  /**
   * Set/Get the number of threads; 0 uses the default of OpenMP (OMP_NUM_THREADS, or all cores).
   * In a process that was forked from one in which a mapper has drawn, it is one thread always.
   * Range: 0 to 1024. Default: 0.
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
   * Get the memory of the trees, with the gradients at the points, and that of what was found of
   * the isosurfaces while rays were traced, in bytes: some 20 for each cell that a surface passes,
   * as far as the camera saw them. It is released when its isovalue is no longer drawn.
   */
  vtkIdType GetTreeMemory();
  vtkIdType GetSurfaceMemory();
  ///@}

  /**
   * Returns whether a volume has isosurfaces to draw, and each of them is opaque: the property has
   * an opacity of at least one at every isovalue that it does not hide. False if the volume cannot
   * be drawn; Render reports why.
   *
   * @sa vtkIsosurfaceVolume
   */
  bool HasOnlyOpaqueSurfaces(vtkVolume* volume);

  /**
   * Finds the first isosurface that the line from p1 to p2 (world coordinates) meets, as the
   * picture of the volume shows it, with the isovalues, opacities and matrix of the volume. Needs
   * neither a window nor OpenGL. Returns 1 if there is a hit; otherwise returns 0 and changes
   * nothing.
   *
   * t is the parametric position on the line, from 0 at p1 to 1 at p2; x the point in world
   * coordinates; pcoords its parametric coordinates in the cell; cellId the cell of the input;
   * isovalue that of the surface; normal its unit normal in world coordinates, by NormalMode,
   * towards smaller values.
   */
  int IntersectWithLine(vtkVolume* volume, const double p1[3], const double p2[3], double& t,
    double x[3], double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3]);

  /**
   * Finds the block of a composite input that has a cell, given the number of the cell through all
   * blocks (the cell id that this class reports), and the number of the cell in the block. The flat
   * index is that of vtkCompositeDataIterator. For other input the block is the input itself, and
   * the flat index 0.
   */
  vtkDataSet* FindBlock(vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex);

  /**
   * Casts rays, given by origins and directions in world coordinates, on all threads, as
   * IntersectWithLine does: a ray has all the hits that contribute to a pixel, up to the first
   * opaque one, or to where the surfaces before it transmit less than 1/1024 of the light: after 11
   * hits of opacity 0.5. To find them all, give the surfaces a small opacity, such as 0.001 (some
   * 6900 hits). The directions have three components, one tuple for each origin; their length is
   * the unit of T. Rays begin at their origins, where T is 0, and do not end. Those whose direction
   * is 0 or not finite have no hits.
   *
   * The output has a point (double) for every hit, by ray and from front to back, and as point data
   * RayId and CellId (vtkIdType), T (in units of the direction), Isovalue, ParametricCoordinates
   * and Normals (double; the last two have 3 components). Returns whether rays were cast; if not,
   * an error reports why.
   */
  bool CastRays(
    vtkVolume* volume, vtkPoints* origins, vtkDataArray* directions, vtkPolyData* output);

  /**
   * Finds the bounds of what the picture of a volume shows, in world coordinates: smaller than
   * those of the volume where its surfaces, or what clipping leaves of them, are. By 64 x 64 rays
   * through each face of the bounds of the volume, or 512 x 512 if those meet nothing; so parts
   * that are thinner than a 64th of it may stick out. Needs neither a window nor OpenGL. Returns
   * whether there is a surface; otherwise changes nothing.
   *
   * vtkRenderer::ResetCamera(bounds) places a camera by it.
   */
  bool FindSurfaceBounds(vtkVolume* volume, double bounds[6]);

  /**
   * Finds what the picture of a renderer shows of the volume at a pixel of the window, counted from
   * the lower left: the nearest isosurface, bit for bit as it is drawn (in stereo, as a window
   * without stereo would show it, as for all pickers of VTK). Other props are ignored. The window
   * need not have been rendered. Returns 1 if there is a surface; otherwise returns 0 and
   * changes nothing. The results are those of IntersectWithLine.
   *
   * @sa vtkIsosurfacePicker
   */
  int PickPixel(vtkRenderer* renderer, vtkVolume* volume, int column, int row, double x[3],
    double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3]);

  /**
   * Makes a picture without a window and without OpenGL: the same, pixel for pixel, as in a window
   * of that size with a single renderer of that camera, with a ray for each pixel whatever the
   * ImageSampleDistance is. The clipping range of the camera is used as it is
   * (vtkCamera::SetClippingRange). Headlights and lights of the camera follow it; without lights
   * (null) there is one headlight, as in a new renderer.
   *
   * The output has a point for every pixel, in rows from the bottom, and as point data Colors (red,
   * green, blue and opacity as unsigned char, the colours multiplied by the opacity; the active
   * scalars) and Depth (float: that of the nearest opaque surface in the depth buffer, from 0 to 1;
   * 1 where there is none). Further arrays describe the nearest surface, translucent or not:
   * Normals (3, double, as of IntersectWithLine), Position (3, double, world coordinates), CellId
   * (vtkIdType) and IsovalueId (int: the number of the isovalue in
   * vtkVolumeProperty::GetIsoSurfaceValues()). Where there is no surface these are NaN
   * and -1. Returns whether there is a picture; if not, an error reports why.
   *
   * With ProgressiveAccumulation, Colors are the mean of MaximumNumberOfAccumulatedFrames frames,
   * as of a window that rests: edges are anti-aliased. Everything else is that of the first of
   * them.
   *
   * The depths are those of opaque geometry that the picture is drawn over, a value from 0 to 1 for
   * each pixel, in rows from the bottom, as vtkRenderWindow::GetZbufferData and the array Depth
   * have them: rays end there. With null, the default, there is none.
   *
   * vtkIsosurfacePicture::UnpremultiplyColors or FlattenColors makes an image for a file of it.
   */
  bool RenderToImage(vtkVolume* volume, vtkCamera* camera, vtkLightCollection* lights, int width,
    int height, vtkImageData* output, vtkFloatArray* depths = nullptr);

  /**
   * Finds what the pixels of the picture of RenderToImage are made of, so that it can be composited
   * with others of the same view. The output has a row for each surface that the ray of a pixel
   * meets and shows, by pixel and front to back, and the columns Pixel (the number of the point in
   * the output of RenderToImage; vtkIdType), T (how far away the surface is, in units that all
   * pictures of a camera share; double), Color (3, from 0 to 1, multiplied by the opacity; double),
   * Opacity (double) and Depth (of an opaque surface, in the depth buffer; else 1; float). Surfaces
   * end as in CastRays where those before them transmit too little. A connection without points has
   * no rows. The depths are those of RenderToImage. Returns whether there is an output; if not, an
   * error reports why.
   *
   * @sa vtkIsosurfaceRayTraceCompositor
   */
  bool RenderToFragments(vtkVolume* volume, vtkCamera* camera, vtkLightCollection* lights,
    int width, int height, vtkTable* output, vtkFloatArray* depths = nullptr);

  /**
   * Copies the inputs and all settings of another vtkIsosurfaceRayTraceMeshMapper; inputs and
   * clipping planes are shared. Of other mappers it copies what their common base class does.
   */
  void ShallowCopy(vtkAbstractMapper* mapper) override;

  ///@{
  /**
   * Updates the whole of the input, in one piece, whatever other consumers have requested before.
   */
  using vtkUnstructuredGridVolumeMapper::Update;
  void Update(int port) override;
  void Update() override;
  ///@}

  ///@{
  /**
   * Get the bounds of the input; of composite input, those of all blocks that are visible.
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
