// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceMapper
 * @brief   ray trace isosurfaces straight from image data, on the CPU
 *
 * A volume mapper that draws the isosurfaces of a vtkImageData or a vtkRectilinearGrid without
 * extracting polygons. (The input may also be a mesh, which is drawn as by
 * vtkIsosurfaceRayTraceMeshMapper.) Every ray is intersected with the trilinear interpolant of the
 * data: inside a cell, this is a cubic polynomial along the ray, and its first root is the hit.
 * (Alternatively, samples are boxes whose faces are hit, or the interpolant is tricubic: see
 * InterpolationMode.) A new isovalue, colour or camera costs a frame and nothing else.
 *
 * @par Surfaces:
 * The isovalues are those of vtkVolumeProperty::GetIsoSurfaceValues(); there may be several. The
 * colour and opacity of a surface are the values of the transfer functions of the property at its
 * isovalue (the opacity is that of a surface: ScalarOpacityUnitDistance is not used). The nearest
 * opaque surface hides what is behind it; translucent surfaces are composited in the order in which
 * each ray meets them, as long as those in front transmit at least 1/1024 of the light. A property
 * without isovalues draws nothing; a new property has the single isovalue 0. Points whose value is
 * greater than or equal to the isovalue are inside, as in vtkFlyingEdges3D.
 *
 * @par Intensity projections:
 * The default blend mode is ISOSURFACE_BLEND (SetBlendModeToIsoSurface()), not COMPOSITE_BLEND as
 * in a new vtkVolumeMapper. Maximum and minimum intensity projections are the only others; any
 * other blend mode, including COMPOSITE_BLEND, is an error.
 *
 * With SetBlendModeToMaximumIntensity() (or SetBlendModeToMinimumIntensity()), no surfaces are
 * drawn. Every ray finds the largest (smallest) value of the same interpolant along its visible
 * part, exact to rounding, and shows it through the colour and opacity functions of the property,
 * as VTK's ray cast mappers do. It is not lit, its opacity is not scaled by any length, and it has
 * no depth in the window. Where several points have that value, the first one counts. Everything
 * below that does not concern lights or the colours of surfaces applies to projections as well.
 *
 * @par Light and depth:
 * Ambient, Diffuse, Specular, SpecularPower and Shade of the property are used, and so are all
 * lights of the renderer and vtkRenderer::TwoSidedLighting. (Where a headlight is the only light,
 * VTK gives polygons wider highlights.) The surface is drawn into the render window with its true
 * depth: opaque geometry hides it and is hidden by it, pixel by pixel. In a vtkIsosurfaceVolume,
 * translucent geometry is also composited correctly with the surface, if the surface is opaque or
 * the renderer uses depth peeling.
 *
 * @par Macrocells and bricks:
 * The mapper keeps two structures, which depend on the scalars alone:
 * - a hierarchy of macrocells (the smallest and largest value of a block of cells), built in
 *   parallel on the first render
 * - bricks (a copy of the samples reordered for locality), each built when the first ray enters an
 *   active macrocell there
 *
 * Macrocells are built in one pass over the samples, in slabs of about 16 MiB, in the order of the
 * samples in memory or in their file. After each slab the mapper sends ProgressEvent with the
 * fraction read so far (GetProgress() of the mapper), and the window may abort the frame
 * (vtkRenderWindow::CheckAbortStatus). An aborted frame draws nothing; the next frame, or whatever
 * else needs the samples, continues where it stopped.
 *
 * An interactive frame (one in a window whose DesiredUpdateRate is at least 1 frame per second, as
 * interactor styles set it) reads samples for its allocated time
 * (vtkProp::GetAllocatedRenderTime()), but at least one slab. It shows what has been read so far;
 * elsewhere there is no surface yet. All other pictures (those of a window at rest and of
 * RenderToImage), rays, picks and hardware selections use all samples. The structures of small
 * blocks of composite data, of meshes and of AMR data are built in one step.
 *
 * @par Scalars:
 * All scalar types are read without loss, with one exception: 64-bit integers are compared as
 * double, so values beyond 2^53 are rounded to the nearest double. A cell with a NaN or infinite
 * corner is empty. If the scalars have several components, one of them or their magnitude is used:
 * see VectorMode. ScalarMode and SelectScalarArray select the array.
 *
 * Cell scalars are treated as samples at the centres of the cells, so their surfaces end half a
 * cell inside the border. Nothing is drawn in cells that are blanked (HIDDENCELL, REFINEDCELL),
 * that have a hidden point, or that are duplicates of those of another piece. The region between
 * the centres of eight cells belongs to the piece of the cell with the lowest indices. An array
 * vtkGhostType that is not a vtkUnsignedCharArray is ignored, as in VTK.
 *
 * @par Errors and warnings:
 * Anything that cannot be traced is an error. It is reported once, not in every frame, and the rest
 * of the scene is drawn as if the volume were absent. Errors are:
 * - arrays (scalars, vtkGhostType, colours) whose number of tuples or components does not match the
 *   data
 * - numbers that are not finite in the matrix of the volume, the geometry of the data, the camera,
 *   the lights that are on, clipping planes or the material
 * - NaN in cropping planes
 * - matrices without an inverse
 * - a matrix of the volume with perspective (a last row other than 0 0 0 1)
 *
 * Isovalues that are not finite, and isovalues at which the opacity is NaN, have no surface; a
 * colour that is NaN is black. A clipping plane whose normal is 0 clips nothing. Numeric settings
 * are clamped to their range; NaN is an error, and does not change the setting.
 *
 * Each of the following causes one warning:
 * - The picture has no surface, because no isovalue is within the range of the scalars.
 * - Shadows or ambient occlusion have no effect, because shading is off.
 * - Ambient occlusion has no effect, because there is no ambient light.
 * - Surfaces reflect light, but there is no light.
 * - The camera of RenderToImage sees nothing of the data.
 *
 * There is no warning about isovalues for a piece of distributed data or for data with ghost cells:
 * the surface may be in another piece.
 *
 * @par Rectilinear grids:
 * The coordinates of a vtkRectilinearGrid may be of any type, ascending or descending, and may
 * repeat. Where they repeat and the values differ, the surface is a wall, as in
 * vtkRectilinearSynchronizedTemplates. Everything else is as for images. A grid whose planes are
 * evenly spaced, to within the rounding of double precision, is traced like an image; any other is
 * traced cell by cell, in 1.2 times the time. Smooth normals are interpolated from the slopes of
 * parabolas through neighbouring samples, which is exact for quadrics, however uneven the spacing.
 *
 * @par Composite data:
 * The input may be composite: any vtkCompositeDataSet, such as vtkMultiBlockDataSet,
 * vtkPartitionedDataSet and their collections. Set it with SetInputDataObject or
 * SetInputConnection. The blocks may be vtkImageData, vtkRectilinearGrid, vtkUnstructuredGrid and
 * vtkStructuredGrid, mixed and nested in any way. They are one scene: hits are sorted along each
 * ray, whichever blocks they belong to, so translucent surfaces may pass through each other. Blocks
 * hide each other, cast shadows on each other and occlude each other. (Meshes are traced as by
 * vtkIsosurfaceRayTraceMeshMapper; cropping does not cut them, and projections leave them out.)
 *
 * Images on a common lattice, with or without layers of ghost cells, are drawn as the single image
 * of which they are pieces: the surface and its normals have no seams. This takes a copy of their
 * samples over the box around all of them, and 2 bytes for every cell where blocks are missing;
 * nothing is drawn there. If the box has more than eight times the samples of its blocks, or if the
 * images are on different lattices, each block is traced by itself, in place; small blocks are
 * prepared when the first ray reaches them. Where caps of several blocks coincide, the cap of the
 * first block is seen.
 *
 * Blocks that are empty, without volume or without the scalars are ignored. If anything else is
 * wrong with a block, one warning says so, and the others are drawn. Cells and points are numbered
 * through all blocks: see FindBlock. All this holds for AMR data, too.
 *
 * @par AMR data:
 * AMR data (vtkOverlappingAMR, vtkNonOverlappingAMR) may have point scalars or cell scalars; the
 * finest cells are drawn everywhere. Levels meet without cracks: their interpolants form one
 * continuous function, in which nodes on the border of a finer block have the values of the coarser
 * interpolant.
 *
 * Cell scalars are interpolated between the centres of cells, as in images, and by octants beside a
 * coarser level (F. Wang et al.: CPU Isosurface Ray Tracing of Adaptive Mesh Refinement Data, IEEE
 * TVCG 25(1), 2019). Unlike in images, their surfaces reach the border of the data: in the last
 * half cell, the value of the interpolant at a point of the border is the mean of the cells there.
 *
 * Refinement ratios are whole numbers. They may differ for each level and axis, but must not be 1
 * for all three axes: blocks with the same spacing belong to one level. Where blocks of one level
 * overlap, the first one counts, but not its ghost cells. A block that may have a surface is
 * prepared when the first ray reaches it; this takes 8 bytes for each of its points, or 64 for each
 * of its cells.
 *
 * @par Clipping and cropping:
 * ClippingPlanes and Cropping cut the surface exactly, along every ray. A cropping plane is
 * perpendicular to an axis of the image, at origin + spacing * index (for a rectilinear grid, at
 * that coordinate); points in the plane belong to the region in the middle. There may be any number
 * of clipping planes. Pictures, IntersectWithLine and CastRays are cut in the same way. The cuts
 * may be closed: see CapClippingPlanes.
 *
 * @par Threads:
 * The mapper uses OpenMP threads, because tiles differ so much in cost that they must be scheduled
 * one at a time (`schedule(dynamic)`), which vtkSMPTools does not guarantee. The picture is the
 * same, bit for bit, for any number of threads, any brick layout and any macrocell hierarchy.
 *
 * @par Colours and shadows:
 * The colour of a surface may come from another array or another image (ColorArrayName), and
 * surfaces may cast shadows (Shadows) and occlude ambient light (AmbientOcclusion).
 *
 * @par Selection:
 * vtkHardwareSelector selects the cells that are hit, or the points nearest to the hits. (Points
 * are selected by the rays of the picture, whose number depends on ImageSampleDistance.) In a
 * composite input, cells and points are numbered within their block, whose flat index is given;
 * with several connections, they are numbered through all connections.
 *
 * @par References:
 * S. Parker, P. Shirley, Y. Livnat, C. Hansen, P.-P. Sloan: Interactive Ray Tracing for Isosurface
 * Rendering. IEEE Visualization 1998. K.-L. Ma, S. Parker: Massively Parallel Software Rendering
 * for Visualizing Large-Scale Data Sets. IEEE Computer Graphics and Applications 21(4), 2001.
 *
 * @par Events:
 * While it draws, the mapper sends (after the ProgressEvents of a pass over the samples, if there
 * is one) VolumeMapperRenderStartEvent, VolumeMapperRenderProgressEvent (up to fifty times a
 * second, with the fraction done) and VolumeMapperRenderEndEvent, on the calling thread, while no
 * other thread is working. Observers may do anything, with these effects:
 * - Changes of inputs, settings, properties and isovalues take effect in the next frame. The
 *   current frame does not change, and its data are kept until it ends. (Changes at a ProgressEvent
 *   are made before the frame is drawn: those of settings and transfer functions that do not affect
 *   what is traced take effect in this frame.)
 * - Casting, picking and RenderToImage work, with the state at that time. They send no events, and
 *   build their own macrocells.
 * - The mapper may be removed from its volume, the volume from its renderer, the renderer from its
 *   window, and the window may be finalized. VTK continues to use them, so all this takes effect
 *   when the window sends EndEvent.
 * - Rendering the mapper again, in another window, is an error. (Calling Render() of the same
 *   window has no effect. VTK does not allow calling Render() of the renderer.)
 * - Releasing the memory of the arrays that are being traced, or shortening them, is an error, and
 *   the frame is not drawn.
 *
 * A mapper may be used by only one thread at a time: calling a method that traces while another
 * thread is in such a method is an error. Several threads may each use their own mapper, each with
 * its own shallow copy of the data.
 *
 * @sa vtkIsosurfaceVolume vtkIsosurfaceRayTraceMeshMapper vtkIsosurfaceComparisonFilter
 * vtkVolumeProperty vtkContourValues vtkFlyingEdges3D
 */

#ifndef vtkIsosurfaceRayTraceMapper_h
#define vtkIsosurfaceRayTraceMapper_h

#include "vtkCompositeDataDisplayAttributes.h" // for ivars
#include "vtkIsosurfaceRayTraceSetMacros.h"    // for vtkIsosurfaceSetClampMacro
#include "vtkIsosurfaceRayTracingCompat.h"     // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingModule.h"     // for export macro
#include "vtkSmartPointer.h"                   // for ivars
#include "vtkVolumeMapper.h"

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

class VTKISOSURFACERAYTRACING_EXPORT vtkIsosurfaceRayTraceMapper : public vtkVolumeMapper
{
public:
  static vtkIsosurfaceRayTraceMapper* New();
  vtkTypeMacro(vtkIsosurfaceRayTraceMapper, vtkVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * How values are interpolated between the samples.
   */
  enum InterpolationModes
  {
    /// In a cell, the trilinear interpolant of its eight corners.
    TRILINEAR = 0,
    /// The value of the nearest sample: every sample is a box of one value, which ends half way to
    /// the next sample, or at the border of the volume. An isosurface consists of the faces between
    /// boxes below the isovalue and boxes at or above it.
    NEAREST = 1,
    /// In a cell, the tricubic interpolant of the 4^3 samples around it: along each axis the cubic
    /// of E. Catmull and R. Rom (1974) through the samples, as in vtkImageInterpolator.
    CUBIC = 2
  };

  ///@{
  /**
   * Set/Get how values are interpolated between the samples. Default: TRILINEAR.
   *
   * With NEAREST the samples, for example labels, are shown without interpolation:
   * - A hit lies exactly in the plane of a face, whose normal is used in both NormalModes. It is
   *   found without a RootSolver.
   * - If several isovalues separate two samples, the face between them is hit once for each
   *   isovalue.
   * - Nothing is drawn beside a sample that is NaN or infinite, nor at the border of the volume.
   * - With cell scalars the boxes are the cells (in a rectilinear grid with uneven spacing, they
   *   end half way between the centres). Boxes at the border are drawn from their centres on.
   * - Of the two points beside a face, the one inside is selected; with cell scalars, the cell
   *   inside is selected.
   * - With point scalars a face lies in the middle of four cells, and is hidden in those that are
   *   blanked.
   * - Intensity projections and the colours of ColorArrayName remain trilinear.
   *
   * With CUBIC the surface and its normal are smooth:
   * - In both NormalModes the normal is the exact gradient of the interpolant.
   * - Between samples the interpolant may overshoot their values, by up to 61/128 of the range of
   *   the 4^3 samples around: thin structures keep more of their shape, and beside sharp edges
   *   there are ripples.
   * - The result equals that of vtkImageReslice with cubic interpolation, except at the border of
   *   the volume: there samples are extrapolated linearly (VTK repeats the last one, which bends
   *   the surface).
   * - With uneven spacing the slope at a sample is that of the parabola through it and its
   *   neighbours.
   * - A cell is empty if one of its 4^3 samples is NaN or infinite. Blanked samples still
   *   contribute to the cells beside them.
   * - All crossings along a ray are found, without a RootSolver, but pairs nearer to each other
   *   than 2^-40 of the segment in a cell may be missed.
   * - Frames take several times as long as trilinear ones.
   * - Intensity projections are an error; the colours of ColorArrayName remain trilinear.
   *
   * vtkVolumeProperty::GetInterpolationType() is ignored: its default is nearest, with which other
   * mappers of VTK draw smooth isosurfaces.
   */
  vtkSetClampMacro(InterpolationMode, int, TRILINEAR, CUBIC);
  vtkGetMacro(InterpolationMode, int);
  void SetInterpolationModeToTrilinear() { this->SetInterpolationMode(TRILINEAR); }
  void SetInterpolationModeToNearest() { this->SetInterpolationMode(NEAREST); }
  void SetInterpolationModeToCubic() { this->SetInterpolationMode(CUBIC); }
  ///@}

  /**
   * How the intersection of a ray with the surface in a cell is found.
   */
  enum RootSolvers
  {
    /// Splits the cubic, in Bernstein form, into monotone pieces, and solves them by a guarded
    /// Newton iteration, in double precision. No hit is missed or invented, except where a ray
    /// grazes the surface to within rounding: where the cubic has an extremum within (32 + 16 n)
    /// 2^-53 of the isovalue (times the largest difference between a corner of the cell and the
    /// isovalue; n is the longest edge of the volume in cells).
    ROBUST = 0,
    /// The closed form as published by Parker et al. 1998 (J. Schwarze, Graphics Gems 1990). It
    /// loses many hits where a cell is nearly linear along the ray: for comparison only.
    ANALYTIC = 1,
    /// Splits the cubic at its extrema, and makes NumberOfInterpolations linear interpolations (G.
    /// Marmitt et al., VMV 2004).
    MARMITT = 2,
    /// Compares the signs at the ends of the segment, and makes one linear interpolation (A.
    /// Neubauer et al., VisSym 2002): a preview, which misses thin sheets.
    LINEAR = 3
  };

  ///@{
  /**
   * Set/Get the root solver for TRILINEAR. Default: ROBUST.
   */
  vtkSetClampMacro(RootSolver, int, ROBUST, LINEAR);
  vtkGetMacro(RootSolver, int);
  void SetRootSolverToRobust() { this->SetRootSolver(ROBUST); }
  void SetRootSolverToAnalytic() { this->SetRootSolver(ANALYTIC); }
  void SetRootSolverToMarmitt() { this->SetRootSolver(MARMITT); }
  void SetRootSolverToLinear() { this->SetRootSolver(LINEAR); }
  ///@}

  ///@{
  /**
   * Set/Get the number of linear interpolations of the solver MARMITT. Range: 1 to 64. Default: 3.
   */
  vtkSetClampMacro(NumberOfInterpolations, int, 1, 64);
  vtkGetMacro(NumberOfInterpolations, int);
  ///@}

  /**
   * How the normal of the surface is computed.
   */
  enum NormalModes
  {
    /// The exact gradient of the trilinear interpolant. It is discontinuous between cells, which
    /// become visible.
    INTERPOLANT_GRADIENT = 0,
    /// Central differences at the corners of the cell, interpolated trilinearly: a smooth look.
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
   * component 0 of the property. Default: DISABLED.
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
   * Set/Get the name of an array that colours the surfaces instead of their isovalues. Its value at
   * a hit is mapped through the colour transfer function of the property. An array of unsigned char
   * with three or four components holds the colours themselves. For other vectors, the vector mode
   * of the function (vtkScalarsToColors::SetVectorModeToMagnitude) selects a component, by default
   * the first, or the magnitude; only the first nine components are used. Point values are
   * interpolated trilinearly. If no point array has the name, the cell array of that name is used,
   * and a surface has one colour in a cell. All blocks of a composite input must have the array, of
   * the same kind. The array gives no opacities. Default: empty.
   *
   * If there is a second input (SetInputData(1, image), SetInputConnection(1, port)), the array is
   * one of that input: an image of any resolution in the same coordinates, whose border values
   * extend beyond it. With an empty name, the point scalars of the second input are used; without a
   * second input, surfaces are coloured by isovalue.
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

  /**
   * Set the second input, an image to colour the surfaces by: see ColorArrayName.
   * (SetInputConnection(1, port) connects one.) Null removes it. Default: none.
   */
  void SetColorInputData(vtkImageData* image);

  ///@{
  /**
   * Set/Get whether clipping planes are capped where they cut through the inside of a surface, that
   * is, where values are at or above its isovalue. A cap is a surface like any other: it hides what
   * is behind it, casts shadows, can be picked, and is visible from behind. It shows the data: its
   * colour is that of the value in the plane, by the colour transfer function of the property (or
   * by ColorArrayName), and its normal is that of the plane, towards the clipped side. Its opacity,
   * the isovalue that is reported and everything else are those of the isosurface whose inside it
   * shows; inside several isosurfaces, those of the one with the largest isovalue. So a plane
   * through bone in translucent skin shows the section of the skin translucent and that of the bone
   * opaque.
   *
   * With the solver ROBUST (and with NEAREST, which shows the boxes of samples in the plane), a cap
   * ends exactly where the isosurface meets the plane, without a gap. With several planes, each is
   * capped only in the part that the others do not clip. A plane in a face of the volume, to within
   * a millionth of a cell, closes the surface at this face, where it is otherwise open; six such
   * planes make a closed box. A plane that lies, to the same tolerance, between cells or between
   * the boxes of samples shows those on the side that is kept. There is no cap in cells that are
   * blanked or have values that are not finite, nor at cropping planes, nor in intensity
   * projections. Default: off, which costs nothing.
   *
   * @sa vtkClipClosedSurface
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
   * opacity. Clipped or cropped parts occlude nothing. Shading must be on
   * (vtkVolumeProperty::ShadeOn), and the ambient light must be strong enough for the effect to be
   * visible: vtkVolumeProperty::SetAmbient(0.5); the default of 0.1 is too weak. Default: off,
   * which costs nothing.
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

  /**
   * How the samples are laid out in memory while rays read them.
   */
  enum BrickLayouts
  {
    /// The array of the input, without a copy: no additional memory, poor locality.
    NO_BRICKS = 0,
    /// Every brick holds BrickSize^3 cells with all their corners: one layer of samples is repeated
    /// on three sides, and the eight corners of a cell always lie in one brick.
    APRON_BRICKS = 1,
    /// The layout of Parker et al.: bricks of BrickSize^3 samples, in groups of BrickGroupSize^3
    /// bricks; the address of a sample is Fx[x] + Fy[y] + Fz[z].
    TWO_LEVEL_BRICKS = 2
  };

  ///@{
  /**
   * Set/Get the layout of the samples. It affects speed and memory, never the picture. Blocks that
   * are traced by themselves, of up to 2^18 samples each, and AMR data are read without bricks:
   * their samples already lie close together. Default: APRON_BRICKS.
   */
  vtkSetClampMacro(BrickLayout, int, NO_BRICKS, TWO_LEVEL_BRICKS);
  vtkGetMacro(BrickLayout, int);
  void SetBrickLayoutToNoBricks() { this->SetBrickLayout(NO_BRICKS); }
  void SetBrickLayoutToApronBricks() { this->SetBrickLayout(APRON_BRICKS); }
  void SetBrickLayoutToTwoLevelBricks() { this->SetBrickLayout(TWO_LEVEL_BRICKS); }
  ///@}

  ///@{
  /**
   * Set/Get the edge of a brick: in cells for APRON_BRICKS, in samples for TWO_LEVEL_BRICKS (the n
   * of the paper, which used 4 for 16-bit data). Range: 2 to 64. Default: 8.
   */
  vtkSetClampMacro(BrickSize, int, 2, 64);
  vtkGetMacro(BrickSize, int);
  ///@}

  ///@{
  /**
   * Set/Get the edge of a group of bricks, in bricks, for TWO_LEVEL_BRICKS (the m of the paper).
   * Range: 1 to 64. Default: 4.
   */
  vtkSetClampMacro(BrickGroupSize, int, 1, 64);
  vtkGetMacro(BrickGroupSize, int);
  ///@}

  /// The largest number of macrocell levels.
  static constexpr int MaximumNumberOfMacrocellLevels = 8;

  ///@{
  /**
   * Set/Get the number of levels of macrocells between the whole volume and the cells. With 0 every
   * cell along a ray is tested. Range: 0 to 8. Default: 2.
   */
  vtkSetClampMacro(NumberOfMacrocellLevels, int, 0, MaximumNumberOfMacrocellLevels);
  vtkGetMacro(NumberOfMacrocellLevels, int);
  ///@}

  ///@{
  /**
   * Set/Get the limit on the memory of bricks and of the masks kept with them, in MiB; 0 sets no
   * limit. When it is reached, rays read the array of the input instead, and the next frame first
   * frees the bricks that the last one did not use. The picture is always the same. The limit
   * applies to APRON_BRICKS, the default layout. Range: 0 to 2^30. Default: 0.
   */
  vtkSetClampMacro(MaximumBrickMemory, int, 0, 1 << 30);
  vtkGetMacro(MaximumBrickMemory, int);
  ///@}

  ///@{
  /**
   * Set/Get the branching of a level: the edge of its macrocells, in macrocells of the level below.
   * Level 0 is the finest; its macrocells consist of cells. A level that does not exist is an
   * error. Range: 2 to 64. Default: 8 on every level, which gives macrocells of 8^3 and 64^3 cells
   * with two levels.
   */
  void SetMacrocellBranching(int level, int branching);
  int GetMacrocellBranching(int level);
  ///@}

  ///@{
  /**
   * Set/Get a directory in which macrocells of samples in files (see vtkMappedImageReader) are
   * kept, for the mappers of this program and of others: when such a file is opened again, no pass
   * over its samples is needed before the first picture. The directory is created if it does not
   * exist. It contains a cache file for each component of each file that was drawn, of about 0.4 %
   * of the size; cache files may be deleted at any time. Default: an empty name, for no directory.
   *
   * Pictures are the same, bit for bit. A cache file is used if:
   * - the file of samples is unchanged, by its path, size, inode number and times
   * - nobody has written to the samples in memory
   * - the cache file is complete and undamaged, by a checksum
   *
   * Otherwise macrocells are built, and replace the cache file. Nothing is kept:
   * - if the times of the file are not older than two seconds when its samples are read
   * - for volumes of up to 2^18 samples
   * - on systems other than Linux, which do not report whether samples have been written to
   *
   * If the directory cannot be written to, there is one warning, and macrocells are built in each
   * program.
   *
   * Anyone who can write to the directory can change pictures: allow this to yourself alone.
   */
  void SetCacheDirectory(VTK_FILEPATH const char* name);
  VTK_FILEPATH const char* GetCacheDirectory() const { return this->CacheDirectory.c_str(); }
  ///@}

  ///@{
  /**
   * Set/Get whether interactive frames (see DesiredUpdateRate above) may show a coarse level of
   * images and rectilinear grids of more than 2^21 samples. They do so until all samples are read
   * and the window has drawn an exact frame. After that, they do so as long as the last exact frame
   * would have taken longer than the time allocated to an interactive frame, even at the largest
   * distance between rays that is allowed (MaximumImageSampleDistance). All other pictures, rays,
   * picks and selections use all samples, as without this setting. Default: off.
   *
   * The coarse level has at most about 2^21 samples (16 MiB): every n-th sample along each axis,
   * without filtering. Slices between these are not read for it: of a file of 2 GiB with 16 bits
   * per sample, one slice in 8 is read. Each frame reads some 16 MiB of the slices needed, first
   * those that are far apart and then those between them, so that the first frame shows the whole
   * volume and the next ones refine it. Meanwhile all samples are read, as without this setting.
   * Thin features may be missing, and surfaces are slightly displaced. Arrays to colour by
   * (ColorArrayName) are evaluated where surfaces are.
   *
   * This follows K.-L. Ma and S. Parker (2001, see above): interactivity over accuracy.
   */
  vtkSetMacro(LevelOfDetail, bool);
  vtkGetMacro(LevelOfDetail, bool);
  vtkBooleanMacro(LevelOfDetail, bool);
  ///@}

  ///@{
  /**
   * Set/Get the size in pixels of the tiles of the image that are scheduled to threads. Range: 1 to
   * 4096 each. Default: 16 x 8. Rays are traced in packets of up to 128; the closer together the
   * rays of a packet are, the faster it traverses the volume. Smaller tiles keep many threads busy
   * to the end. (Parker et al. used 32 x 4.) For blocks that are traced by themselves, tiles are at
   * least 32 x 32.
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
   * Get the times of the last frame, in seconds of wall-clock time: building the macrocells (those
   * built in this frame, without the time of observers), building bricks, tracing, shading, and
   * displaying (reading the depth of the scene, uploading and drawing the image). The time of a
   * step that the frame did not need is 0. Bricks, tracing and shading are interleaved on all
   * threads: the wall-clock time of the three together is divided in proportion to the time the
   * threads spent in each. Small blocks of composite data that are traced by themselves are
   * prepared, macrocells included, when the first ray reaches them; this counts as building bricks.
   */
  double GetMacrocellBuildTime();
  double GetBrickBuildTime();
  double GetTraceTime();
  double GetShadeTime();
  double GetDisplayTime();
  ///@}

  ///@{
  /**
   * Get the memory in use, in bytes: of the macrocells of all levels, and of the bricks.
   */
  vtkIdType GetMacrocellMemory();
  vtkIdType GetBrickMemory();
  ///@}

  ///@{
  /**
   * Get the number of bricks in memory, and the largest possible number of bricks.
   */
  vtkIdType GetNumberOfBricks();
  vtkIdType GetMaximumNumberOfBricks();
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
   *
   * For a projection (maximum or minimum intensity) the one hit is the point of the extreme value,
   * whatever its opacity; isovalue is that value, and normal is that of its isosurface. With
   * several connections, each has one such hit, and the nearest of them counts.
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

  ///@{
  /**
   * Get the bounds of the input; for composite input, the bounds of all visible blocks.
   */
  using vtkVolumeMapper::GetBounds;
  double* GetBounds() VTK_SIZEHINT(6) override;
  ///@}

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
   * ignored. The window need not have been rendered. Returns 1 if there is a surface (or, for a
   * projection, a value with any opacity); otherwise returns 0 and changes nothing. The results are
   * those of IntersectWithLine.
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
   * For a projection, Depth and the further arrays describe the point of the extreme value,
   * whatever its opacity, and instead of IsovalueId there is Value (double; NaN where there is
   * none). Returns whether there is a picture; if not, an error reports why.
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
   * As in CastRays, a ray ends where the surfaces in front transmit too little light. For a
   * projection there is a row for each extreme value, whatever its opacity; if there is one
   * connection, Depth is that of the value, and there is also the column Value (double). A
   * connection without points has no rows. The argument depths is the one of RenderToImage. Returns
   * whether there is an output; if not, an error reports why.
   *
   * @sa vtkIsosurfaceRayTraceCompositor
   */
  bool RenderToFragments(vtkVolume* volume, vtkCamera* camera, vtkLightCollection* lights,
    int width, int height, vtkTable* output, vtkFloatArray* depths = nullptr);

  /**
   * Copies the inputs and all settings of another mapper; inputs and clipping planes are shared.
   * From a volume mapper of another class it copies the settings that all volume mappers have.
   *
   * (vtkVolume::ShallowCopy makes another volume with the same mapper. Give the copy a mapper of
   * its own to change it independently.)
   */
  void ShallowCopy(vtkAbstractMapper* mapper) override;

  ///@{
  /**
   * Updates the whole extent of the inputs, in one piece, whatever other consumers have requested
   * before.
   */
  using vtkVolumeMapper::Update;
  void Update(int port) override;
  void Update() override;
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
  vtkIsosurfaceRayTraceMapper();
  ~vtkIsosurfaceRayTraceMapper() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkIsosurfaceRayTraceMapper(const vtkIsosurfaceRayTraceMapper&) = delete;
  void operator=(const vtkIsosurfaceRayTraceMapper&) = delete;

  friend class vtkIsosurfaceRayTraceEngine;
  friend struct vtkIsosurfaceRayTraceSharedSettings;

  /// Whether there can be a level; if not, reports an error.
  bool HasMacrocellLevel(int level);
  template <typename Visitor>
  static void VisitSettings(const Visitor& visit);
  vtkIsosurfaceRayTraceSettings GetSettings() const;
  vtkIsosurfaceRayTraceInputSettings GetInputSettings() const;
  void CopyVolumeMapper(vtkVolumeMapper* mapper);

  int InterpolationMode = TRILINEAR;
  int RootSolver = ROBUST;
  int NumberOfInterpolations = 3;
  int NormalMode = CENTRAL_DIFFERENCES;
  int VectorMode = DISABLED;
  int VectorComponent = 0;
  std::string ColorArrayName;
  std::vector<vtkSmartPointer<vtkVolume>> ConnectionVolumes;
  vtkSmartPointer<vtkCompositeDataDisplayAttributes> CompositeDataDisplayAttributes;
  bool CapClippingPlanes = false;
  bool Shadows = false;
  bool AmbientOcclusion = false;
  int NumberOfAmbientOcclusionRays = 32;
  double AmbientOcclusionRadius = 0.0;
  int BrickLayout = APRON_BRICKS;
  int BrickSize = 8;
  int BrickGroupSize = 4;
  int MaximumBrickMemory = 0;
  int NumberOfMacrocellLevels = 2;
  int MacrocellBranching[MaximumNumberOfMacrocellLevels] = { 8, 8, 8, 8, 8, 8, 8, 8 };
  std::string CacheDirectory;
  bool LevelOfDetail = false;
  int TileSize[2] = { 16, 8 };
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
