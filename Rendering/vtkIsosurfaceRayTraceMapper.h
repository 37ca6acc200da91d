// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceMapper
 * @brief   ray trace isosurfaces straight from image data, on the CPU
 *
 * A volume mapper that draws the isosurfaces of a vtkImageData or a vtkRectilinearGrid without
 * extracting polygons. (A mesh may be the input, too; it is drawn as by
 * vtkIsosurfaceRayTraceMeshMapper.) Every ray is intersected with the trilinear interpolant of the
 * data: inside a cell that is a cubic along the ray, and its first root is the hit. (Samples may
 * also be boxes, whose faces are hit, or the interpolant tricubic: see InterpolationMode.) A new
 * isovalue, colour or camera costs a frame and nothing else.
 *
 * @par Surfaces:
 * The isovalues are those of vtkVolumeProperty::GetIsoSurfaceValues(); there may be several. The
 * colour and opacity of a surface are the transfer functions of the property at its isovalue
 * (the opacity is that of a surface: ScalarOpacityUnitDistance has no part in it). The nearest
 * opaque surface hides what is behind it; translucent surfaces are composited in the order in
 * which each ray meets them, as far as those before them transmit 1/1024 of the light. A property
 * without isovalues draws nothing; a new one has one, which is 0. Points whose value is
 * greater than or equal to the isovalue are inside, as in vtkFlyingEdges3D.
 *
 * @par Intensity projections:
 * The blend mode is ISOSURFACE_BLEND, which SetBlendModeToIsoSurface() sets, unlike that of a new
 * vtkVolumeMapper, COMPOSITE_BLEND, which is an error here, as are all others but two. With
 * SetBlendModeToMaximumIntensity() (or MinimumIntensity), no surfaces are drawn: every ray
 * shows the largest (smallest) value of the same interpolant along its visible part, exact to
 * rounding, through the colour and the opacity function of the property, as VTK's ray cast mappers
 * do: not lit, not scaled by any length, and without a depth in the window. Where several points
 * have that value, the first one counts. Everything below that does not concern lights or the
 * colours of surfaces applies as well.
 *
 * @par Light and depth:
 * Ambient, Diffuse, Specular, SpecularPower and Shade of the property are used, with every light of
 * the renderer, and so is vtkRenderer::TwoSidedLighting. (Where a headlight is the only light, VTK
 * gives polygons wider highlights.) The surface is drawn into the render window with its true
 * depth: opaque geometry hides it and is hidden by it, pixel by pixel. In a vtkIsosurfaceVolume,
 * translucent geometry is composited correctly with it as well, where the surface is opaque or the
 * renderer peels depths.
 *
 * @par Macrocells and bricks:
 * The mapper keeps a hierarchy of macrocells (the smallest and largest value of a block of
 * cells), built in parallel on the first render; and bricks (a copy of the samples reordered for
 * locality), each built when the first ray enters an active macrocell there. Both depend on the
 * scalars alone.
 *
 * Macrocells are built in one pass over the samples, slab by slab: about 16 MiB in the order that
 * they have in memory, or in their file. After each slab the mapper sends ProgressEvent, with the
 * fraction that is read (GetProgress() of the mapper), and the window may abort the frame
 * (vtkRenderWindow::CheckAbortStatus): then nothing is drawn, and the next frame, or whatever else
 * needs the samples, goes on where this one stopped. A frame of interaction (one of a window whose
 * DesiredUpdateRate is at least 1 frame per second, as interactor styles set it) reads as long as
 * it may take by vtkProp::GetAllocatedRenderTime(), but at least a slab, and shows what has been
 * read so far; elsewhere there is no surface yet. All other pictures (those of a window at rest,
 * RenderToImage), rays, picks and hardware selections are of all samples. Small blocks of composite
 * data, meshes and AMR data are built at once.
 *
 * @par Scalars:
 * All scalar types are read without loss, with one exception: 64-bit integers are compared as
 * double, so values beyond 2^53 are rounded to the nearest double. A cell with a NaN or infinite
 * corner is empty. Of several components one is used, or their magnitude: see VectorMode.
 * ScalarMode and SelectScalarArray set the array. Cell scalars are samples at the centres of the
 * cells, so that their surfaces end half a cell inside the border. Nothing is drawn in cells that
 * are blanked (HIDDENCELL, REFINEDCELL), that have a hidden point, or that are duplicates of those
 * of another piece; of what is between the centres of eight cells, the cell with the lowest indices
 * decides to which piece it belongs. An array vtkGhostType that is no vtkUnsignedCharArray is
 * ignored, as by VTK.
 *
 * @par Errors and warnings:
 * What cannot be traced is an error, reported once and not in every frame, and the rest of the
 * scene is drawn as without the volume: arrays (scalars, vtkGhostType, colours) whose number of
 * tuples or components is not that of the data, and numbers that are not finite in the matrix of
 * the volume, the geometry of the data, the camera, the lights that are on, clipping planes or the
 * material; NaN in cropping planes; matrices without an inverse; and a matrix of the volume with
 * perspective (a last row other than 0 0 0 1). Isovalues that are not finite, and those whose
 * opacity is NaN, have no surface; a colour that is NaN is black. A clipping plane whose normal is
 * 0 clips nothing. A setting that is a number has a range, to which it is clamped; NaN is an error,
 * and leaves it as it is.
 *
 * A warning tells, once, why a picture has no surface where no isovalue is within the scalars, that
 * shadows or occlusion have no effect without shading, nor occlusion without ambient light, that
 * surfaces that reflect light have none, and, of RenderToImage, that the camera sees nothing of the
 * data. For a piece of distributed data, and for data with ghost cells, there is no warning about
 * isovalues: the surface may be in another piece.
 *
 * @par Rectilinear grids:
 * The coordinates of a vtkRectilinearGrid may be of any type, ascending or descending, and may
 * repeat: where they repeat and the values differ, the surface is a wall, as in
 * vtkRectilinearSynchronizedTemplates. Everything else is as for images. Where their planes are
 * evenly spaced to within the rounding of double precision, they are traced as images are;
 * otherwise cell by cell, in 1.2 times the time. Smooth normals are interpolated from the slopes of
 * parabolas through neighbouring samples, which is exact for quadrics, however uneven the spacing.
 *
 * @par Composite data:
 * The input may be composite (vtkMultiBlockDataSet, vtkPartitionedDataSet, their collections; any
 * vtkCompositeDataSet; call SetInputDataObject or SetInputConnection), with blocks of vtkImageData,
 * vtkRectilinearGrid, vtkUnstructuredGrid and vtkStructuredGrid, mixed and however nested. They are
 * one scene: hits are in the order of each ray, whatever blocks they are of, so translucent
 * surfaces may pass through each other; blocks hide each other, cast shadows on each other and
 * occlude each other. (Meshes are traced as by vtkIsosurfaceRayTraceMeshMapper; neither cropping
 * nor projections show them.)
 *
 * Images that lie on one lattice, with or without layers of ghosts, are drawn as the image that
 * they are pieces of: the surface and its normals have no seams. That takes a copy of their samples
 * over the box around all of them, and 2 bytes for every cell where blocks are missing; nothing is
 * drawn there. Where the box has more than eight times the samples of its blocks, and for images on
 * other lattices, each block is traced by itself where it is; small ones are prepared when the
 * first ray comes to them. Where caps of several blocks coincide, the first block is seen.
 *
 * Blocks that are empty, without volume or without the scalars are ignored. If anything else is
 * wrong with a block, one warning says so, and the others are drawn. Cells and points are numbered
 * through all blocks: see FindBlock. All this holds for AMR data, too.
 *
 * @par AMR data:
 * AMR data (vtkOverlappingAMR, vtkNonOverlappingAMR) with scalars of points or of cells are drawn
 * by their finest cells. Levels meet without cracks: their interpolants are one continuous
 * function, in which nodes on the border of a finer block have the values of the coarser
 * interpolant. Scalars of cells are interpolated as those of images are, between the centres of
 * cells; beside a coarser level by octants (F. Wang et al.: CPU Isosurface Ray Tracing of Adaptive
 * Mesh Refinement Data, IEEE TVCG 25(1), 2019). But they reach to the border of the data: in the
 * last half of a cell the interpolant has the means of the cells there at points of the border.
 * Refinement ratios are whole numbers, any for each level and axis, but not 1 for all three: blocks
 * with the same spacing are of one level. Of blocks of one level that overlap, the first counts,
 * but not its ghosts. A block that may have a surface is prepared when the first ray comes to it,
 * in 8 bytes for each of its points, or 64 for each of its cells.
 *
 * @par Clipping and cropping:
 * ClippingPlanes and Cropping cut the surface exactly, along every ray. A cropping plane is
 * perpendicular to an axis of the image, at origin + spacing * index (for a rectilinear grid, at
 * that coordinate); it belongs to the region in the middle. There may be any number of clipping
 * planes. Pictures, IntersectWithLine and CastRays are cut alike. The cuts may be closed: see
 * CapClippingPlanes.
 *
 * @par Threads:
 * The threads are OpenMP's, because tiles differ so much in cost that they must be scheduled one at
 * a time (`schedule(dynamic)`), which vtkSMPTools does not guarantee. The picture is the same, bit
 * for bit, for any number of threads, any layout and any hierarchy.
 *
 * @par Colours and shadows:
 * The colour of a surface may come from another array or another image (ColorArrayName), and
 * surfaces may cast shadows (Shadows) and occlude ambient light (AmbientOcclusion).
 *
 * @par Selection:
 * vtkHardwareSelector selects the cells that are hit, or the points nearest to the hits. (Points
 * are selected by the rays of the picture, whose number depends on ImageSampleDistance.) Those of a
 * composite input have the flat index of their block, and are numbered there; those of several
 * connections are numbered through all.
 *
 * @par References:
 * S. Parker, P. Shirley, Y. Livnat, C. Hansen, P.-P. Sloan: Interactive Ray Tracing for Isosurface
 * Rendering. IEEE Visualization 1998. K.-L. Ma, S. Parker: Massively Parallel Software Rendering
 * for Visualizing Large-Scale Data Sets. IEEE Computer Graphics and Applications 21(4), 2001.
 *
 * @par Events:
 * While it draws, the mapper sends (after the ProgressEvents of a pass over the samples, if there
 * is one) VolumeMapperRenderStartEvent, VolumeMapperRenderProgressEvent
 * (up to fifty times a second, with the fraction done) and VolumeMapperRenderEndEvent, on the
 * thread that called it and while no other thread is at work. Observers may do what they like:
 * - Changes of inputs, settings, properties and isovalues are seen in the next frame. What is drawn
 *   stays as it is, and its data are kept until the frame ends. (Changes at a ProgressEvent are
 *   made before the frame is drawn: it has the settings and transfer functions that are not about
 *   what is traced.)
 * - Casting, picking and RenderToImage work, on the state as it is then. They send no events of
 *   their own, and build macrocells of their own.
 * - The mapper may be taken out of its volume, the volume out of its renderer, the renderer out of
 *   its window, and the window may be finalized. VTK goes on to use them, so all this takes effect
 *   when the window sends EndEvent.
 * - To render the mapper again, in another window, is an error. (To call Render() of the window has
 *   no effect. To call that of the renderer is not allowed by VTK.)
 * - To release the memory of the very arrays that are traced, or to make them shorter, is an error,
 *   and the frame is not drawn.
 *
 * A mapper is used by one thread at a time: to call a method that traces while another thread is in
 * one is an error. Several threads may each use a mapper of their own, with a shallow copy of the
 * data.
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
    /// the next sample, or at the border of the volume. An isosurface is the faces between boxes
    /// below the isovalue and boxes at or above it.
    NEAREST = 1,
    /// In a cell, the tricubic interpolant of the 4^3 samples around it: along each axis the cubic
    /// of E. Catmull and R. Rom (1974) through the samples, the one of vtkImageInterpolator.
    CUBIC = 2
  };

  ///@{
  /**
   * Set/Get how values are interpolated between the samples. With NEAREST the samples are shown as
   * they are, for example labels; a hit lies exactly in the plane of a face, whose normal is used
   * in both NormalModes, and is found without a RootSolver. A face between samples that several
   * isovalues separate is hit once for each of them. Nothing is drawn beside a sample that is NaN
   * or infinite, nor at the border of the volume. The boxes of cell scalars are the cells (of a
   * rectilinear grid with uneven spacing, they end half way between the centres); those at the
   * border are drawn from their centres on. Of the two points beside a face, the one inside is
   * selected, and so is the cell of cell scalars. A face between points lies in the middle of four
   * cells, and is hidden in those that are blanked. Intensity projections and the colours of
   * ColorArrayName remain trilinear.
   *
   * With CUBIC the surface is smooth, and so is its normal: in both NormalModes it is the exact
   * gradient of the interpolant. Between samples the values may overshoot them, by up to 61/128 of
   * the range of the 4^3 around: thin structures keep more of their shape, and beside sharp edges
   * there are ripples. The result equals that of vtkImageReslice with cubic interpolation, except
   * at the border of the volume: there samples are extrapolated linearly (VTK repeats the last one,
   * which bends the surface). With uneven spacing the slope at a sample is that of the parabola
   * through it and its neighbours. A cell is empty if one of the 4^3 samples is NaN or infinite;
   * blanked samples count for the cells beside them. All crossings along a ray are found without a
   * RootSolver, but pairs nearer to each other than 2^-40 of the segment in a cell may be missed.
   * Frames take several times as long as trilinear ones. Intensity projections are an error; the
   * colours of ColorArrayName remain trilinear.
   *
   * vtkVolumeProperty::GetInterpolationType() is ignored: its default is nearest, with which other
   * mappers of VTK draw smooth isosurfaces. Default: TRILINEAR.
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
    /// Bernstein form, cut into monotone pieces, guarded Newton, in double. No hit is missed or
    /// invented, but where a ray grazes the surface to within rounding: an extremum within
    /// (32 + 16 n) 2^-53 of the isovalue (times the largest difference between a corner of the cell
    /// and the isovalue; n is the longest edge of the volume in cells).
    ROBUST = 0,
    /// The closed form as published by Parker et al. 1998 (J. Schwarze, Graphics Gems 1990). It
    /// loses many hits where a cell is nearly linear along the ray: for comparison only.
    ANALYTIC = 1,
    /// Cut at the extrema, then NumberOfInterpolations linear interpolations (G. Marmitt et al.,
    /// VMV 2004).
    MARMITT = 2,
    /// Signs at the ends of the segment and one linear interpolation (A. Neubauer et al., VisSym
    /// 2002): a preview, which misses thin sheets.
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
   * Default: DISABLED.
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
   * Set/Get the name of an array that colours the surfaces instead of their isovalues: its value at
   * a hit is mapped through the colour transfer function of the property; an array of unsigned char
   * with three or four components holds the colours themselves. Of other vectors the function shows
   * what its vector mode says (vtkScalarsToColors::SetVectorModeToMagnitude): a component, the
   * first by default, or the magnitude, of nine components at most. Values of points are
   * interpolated trilinearly. If no array of points has the name, it is one of cells, and a surface
   * has one colour in a cell. All blocks of a composite input must have it, of the same kind. It is
   * an array of the second input (SetInputData(1, image), SetInputConnection(1, port)) if there is
   * one: an image of any resolution in the same coordinates, whose border values extend beyond it.
   * An empty name takes the point scalars of the second input; without a second input, surfaces are
   * coloured by isovalue. It gives no opacities. Default: empty.
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

  /**
   * Set the second input, an image to colour the surfaces by: see ColorArrayName.
   * (SetInputConnection(1, port) connects one.) Null removes it. Default: none.
   */
  void SetColorInputData(vtkImageData* image);

  ///@{
  /**
   * Set/Get whether clipping planes are capped where they cut through the inside of a surface,
   * where values are at or above its isovalue. A cap is a surface like any other: it hides, casts
   * shadows, is picked, and is visible from behind. It shows the data: its colour is that of the
   * value in the plane, by the colour transfer function of the property (or by ColorArrayName), and
   * its normal is that of the plane, towards the clipped side. Everything else is that of the
   * isosurface whose inside it shows, the one of the largest isovalue of several: the opacity, and
   * the isovalue that is reported. So a plane through bone in translucent skin shows the section of
   * the skin translucent and that of the bone opaque.
   *
   * A cap ends exactly where the isosurface meets the plane, without a gap, with the solver ROBUST
   * (and NEAREST, which shows the boxes of samples in the plane). Of several planes each is capped
   * within what the others leave. A plane in a face of the volume, to within a millionth of a cell,
   * closes the surface at this face, where it is open otherwise; six planes make a closed box. A
   * plane that lies, to the same tolerance, between cells or between the boxes of samples shows
   * those on the side that it leaves. There is no cap in cells that are blanked or have values that
   * are not finite, nor at cropping planes, nor in intensity projections. Default: off, which costs
   * nothing.
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
   * Set/Get whether surfaces occlude ambient light from each other and from themselves: the ambient
   * term of the shading, and no other, is multiplied by the part of the hemisphere above a hit that
   * is not occluded, on the visible side. A translucent surface transmits one minus its opacity.
   * Clipped or cropped parts occlude nothing. Shading must be on (vtkVolumeProperty::ShadeOn), and
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

  /**
   * How the samples are laid out in memory while rays read them.
   */
  enum BrickLayouts
  {
    /// The array of the input, without a copy: no memory, poor locality.
    NO_BRICKS = 0,
    /// Every brick holds BrickSize^3 cells with all their corners: one sample is repeated on three
    /// sides, and the eight corners of a cell always lie in one brick.
    APRON_BRICKS = 1,
    /// The layout of Parker et al.: bricks of BrickSize^3 samples, in groups of BrickGroupSize^3
    /// bricks; the address of a sample is Fx[x] + Fy[y] + Fz[z].
    TWO_LEVEL_BRICKS = 2
  };

  ///@{
  /**
   * Set/Get the layout of the samples. It affects speed and memory, never the picture. Blocks that
   * are traced by themselves, of up to 2^18 samples each, and AMR data are read without bricks:
   * their samples lie close together as they are. Default: APRON_BRICKS.
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
   * Set/Get the limit of the memory of bricks and of the masks kept with them, in MiB; 0 sets no
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
   * error. Range: 2 to 64. Default: 8 on every level, so with two levels macrocells of 8^3 and 64^3
   * cells.
   */
  void SetMacrocellBranching(int level, int branching);
  int GetMacrocellBranching(int level);
  ///@}

  ///@{
  /**
   * Set/Get a directory in which macrocells of samples in files (see vtkMappedImageReader) are
   * kept, for the mappers of this program and of others: who opens such a file again needs no pass
   * over its samples before the first picture. It is made if there is none. For each file, and
   * component of it that was drawn, it has a file of about 0.4 % of the size, which may be deleted
   * at any time. Default: an empty name, for none.
   *
   * Pictures are the same, bit for bit. What is kept is used if the file of samples is as it was
   * (by path, size, number of its inode, and times, which must be older than two seconds when the
   * samples are read: else nothing is kept), nobody has written to the samples in memory, and the
   * file in the directory is complete and undamaged, by a checksum. Otherwise macrocells are built,
   * and replace it. A directory that cannot be written to is a warning, once, and macrocells are
   * built in each program. On systems other than Linux, which do not tell whether samples have been
   * written to, and of volumes of up to 2^18 samples, nothing is kept.
   *
   * Whoever may write to the directory may change pictures: let that be you alone.
   */
  void SetCacheDirectory(VTK_FILEPATH const char* name);
  VTK_FILEPATH const char* GetCacheDirectory() const { return this->CacheDirectory.c_str(); }
  ///@}

  ///@{
  /**
   * Set/Get whether a coarse level may stand in for images and rectilinear grids of more than 2^21
   * samples in frames of interaction (see DesiredUpdateRate above): until their samples are read
   * and the window has drawn an exact frame, and as long as the last of these would have taken
   * longer than the time allocated to one of interaction, even at the largest distance between rays
   * that is allowed (MaximumImageSampleDistance). All other pictures, rays, picks and selections
   * are of all samples, as without it. Default: off.
   *
   * The coarse level has at most about 2^21 samples (16 MiB): every n-th one along each axis, not
   * filtered. Slices between them are not read: of a file of 2 GiB with 16 bits a sample, one slice
   * in 8 is. Each frame reads some 16 MiB of it, first slices far apart and then those between, so
   * that the first frame shows the whole volume and the next ones refine it; all samples are read
   * meanwhile, as without it. Thin features may be missing, and surfaces are slightly displaced.
   * Arrays to colour by (ColorArrayName) are looked at where surfaces are.
   *
   * K.-L. Ma, S. Parker (2001), see above: interactivity over accuracy.
   */
  vtkSetMacro(LevelOfDetail, bool);
  vtkGetMacro(LevelOfDetail, bool);
  vtkBooleanMacro(LevelOfDetail, bool);
  ///@}

  ///@{
  /**
   * Set/Get the size in pixels of the tiles of the image that are scheduled to threads. Range: 1 to
   * 4096 each. Default: 16 x 8: rays are traced in packets of up to 128, which traverse the volume
   * the faster the closer their rays are together; smaller tiles keep many threads busy to the end.
   * (Parker et al. used 32 x 4.) For blocks that are traced by themselves tiles are 32 x 32 at
   * least.
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
   * Get the times of the last frame, in seconds of wall-clock time: building the macrocells (those
   * that the frame has built, without observers), building bricks, tracing, shading, and displaying
   * (reading the depth of the scene, uploading and drawing the image). The time of a step that the
   * frame did not need is 0. Bricks, tracing and shading are interleaved on all threads: the
   * wall-clock time of the three together is divided in proportion to the time the threads spent in
   * each. Small blocks of composite data that are traced by themselves are prepared, macrocells
   * included, when the first ray comes to them: that is among the time of bricks.
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
   * Get the number of bricks in memory, and the number of all bricks that there may be.
   */
  vtkIdType GetNumberOfBricks();
  vtkIdType GetMaximumNumberOfBricks();
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
   *
   * For a projection (maximum or minimum intensity) the one hit is the point of the extreme value,
   * whatever its opacity; isovalue is that value, and normal that of its isosurface. Of several
   * connections each has one; the nearest of them counts.
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

  ///@{
  /**
   * Get the bounds of the input; of composite input, those of all blocks that are visible.
   */
  using vtkVolumeMapper::GetBounds;
  double* GetBounds() VTK_SIZEHINT(6) override;
  ///@}

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
   * need not have been rendered. Returns 1 if there is a surface (or, for a projection, a value
   * with any opacity); otherwise returns 0 and changes nothing. The results are those of
   * IntersectWithLine.
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
   * vtkVolumeProperty::GetIsoSurfaceValues()). Where there is no surface these are NaN and -1. For
   * a projection, Depth and all others are those of the point of the extreme value, whatever its
   * opacity, and instead of IsovalueId there is Value (double; NaN where there is none). Returns
   * whether there is a picture; if not, an error reports why.
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
   * end as in CastRays where those before them transmit too little. For a projection there is a row
   * for each extreme value, whatever its opacity; if there is one connection, Depth is that of the
   * value, and there is the column Value (double), too. A connection without points has no rows.
   * The depths are those of RenderToImage. Returns whether there is an output; if not, an error
   * reports why.
   *
   * @sa vtkIsosurfaceRayTraceCompositor
   */
  bool RenderToFragments(vtkVolume* volume, vtkCamera* camera, vtkLightCollection* lights,
    int width, int height, vtkTable* output, vtkFloatArray* depths = nullptr);

  /**
   * Copies the inputs and all settings of another mapper; inputs and clipping planes are shared.
   * From a volume mapper of another class it copies those that all volume mappers have.
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
