// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceMapper
 * @brief   ray trace isosurfaces straight from image data, on the CPU
 *
 * A volume mapper that draws the isosurfaces of a vtkImageData or a vtkRectilinearGrid without
 * extracting a polygon. Every ray is intersected with the trilinear interpolant of the data: inside
 * a cell that is a cubic along the ray, and its first root is the hit. (Or samples are boxes, and
 * faces between them are hit; or the interpolant is tricubic: see InterpolationMode.) A new
 * isovalue, colour or camera costs a frame and nothing else.
 *
 * The isovalues are those of vtkVolumeProperty::GetIsoSurfaceValues(); there may be several. The
 * colour and opacity of a surface are the transfer functions of the property at its isovalue
 * (the opacity is that of a surface: ScalarOpacityUnitDistance has no part in it). The nearest
 * opaque surface hides what is behind it; translucent surfaces are composited in the order in
 * which each ray meets them. A property without isovalues draws nothing. Points whose value is
 * greater than or equal to the isovalue are inside, as in vtkFlyingEdges3D.
 *
 * With SetBlendModeToMaximumIntensity() (or MinimumIntensity), no surfaces are drawn: every ray
 * shows the largest (smallest) value of the same interpolant along all of it that is seen, exact to
 * rounding, through the colour and the opacity function of the property, as VTK's ray cast mappers
 * do: not lit, not multiplied by any length, and without a depth in the window. Where several
 * places have that value, the first one counts. Everything below that is not about light or about
 * surfaces' colours holds alike.
 *
 * Ambient, Diffuse, Specular, SpecularPower and Shade of the property are honoured, with every
 * light of the renderer; so is vtkRenderer::TwoSidedLighting. The surface is drawn into the render
 * window with its true depth: opaque geometry hides it and is hidden by it, pixel by pixel. Put the
 * mapper in a vtkIsosurfaceVolume, and so does translucent geometry.
 *
 * What the mapper keeps: a hierarchy of macrocells (the smallest and largest value of a block of
 * cells), built in parallel on the first render; and bricks (a copy of the samples reordered for
 * locality), each made when the first ray enters an active macrocell there. Both depend on the
 * scalars alone.
 *
 * All scalar types are read without loss, with one exception: 64-bit integers are compared as
 * double, so values beyond 2^53 are rounded to the nearest double. A cell with a NaN or infinite
 * corner is empty. Of several components one is taken, or their magnitude: see VectorMode. Which
 * array is traced is set by ScalarMode and SelectScalarArray. The scalars of cells are samples at
 * the centres of the cells, so that their surfaces end half a cell inside the border. Nothing is
 * drawn in cells that are blanked (HIDDENCELL, REFINEDCELL), that have a hidden point, or that are
 * duplicates of those of another piece.
 *
 * The coordinates of a vtkRectilinearGrid may be of any type, rise or fall, and repeat: where they
 * repeat and the values differ, the surface is a wall, as in vtkRectilinearSynchronizedTemplates.
 * What is said of images holds for these grids; where their planes are evenly spaced to within the
 * rounding of double precision, they are traced as images are, else cell by cell, at ten times
 * the time. Smooth normals are interpolated from the slopes of parabolas through neighbouring
 * samples, which is exact for quadrics, however uneven the spacing.
 *
 * The input may be composite (vtkMultiBlockDataSet, vtkPartitionedDataSet, their collections; any
 * vtkCompositeDataSet; call SetInputDataObject or SetInputConnection). Blocks of vtkImageData that
 * lie on one lattice, however nested, with or without layers of ghosts, are drawn as the one image
 * that they are pieces of: the surface and its normals have no seams, and translucent surfaces come
 * in the order of each ray. That takes a copy of their samples over the box around all of them, and
 * 2 bytes for every cell where blocks are missing; nothing is drawn there. Blocks that are empty
 * or do not have the scalars are passed over. A vtkRectilinearGrid must be the only block. Blocks
 * of another lattice are an error: give each lattice a mapper and a vtkVolume; opaque surfaces are
 * then exact by depth, translucent ones are drawn in the order of the volumes. Cells and points are
 * numbered through all blocks: see FindBlock.
 *
 * ClippingPlanes and Cropping cut the surface exactly, along every ray. A cropping plane stands
 * across an axis of the image, at origin + spacing * index (for a rectilinear grid, at that
 * coordinate); it belongs to the region in the middle.
 * There may be any number of clipping planes. Pictures, IntersectWithLine and CastRays are cut
 * alike. Where planes cut solids open, they may be closed again: see CapClippingPlanes.
 *
 * The threads are OpenMP's, because tiles differ so much in cost that they must be handed out one
 * at a time (`schedule(dynamic)`), which vtkSMPTools does not promise. The picture is the same, bit
 * for bit, for any number of threads, any layout and any hierarchy.
 *
 * The colour of a surface may come from another array or another image (ColorArrayName), and
 * surfaces may cast shadows (Shadows) and keep ambient light from each other (AmbientOcclusion).
 *
 * vtkHardwareSelector selects the cells that are hit, or the points nearest to the hits. (Of
 * points, it selects those of the rays that the picture is made of, by ImageSampleDistance.)
 *
 * S. Parker, P. Shirley, Y. Livnat, C. Hansen, P.-P. Sloan: Interactive Ray Tracing for Isosurface
 * Rendering. IEEE Visualization 1998. K.-L. Ma, S. Parker: Massively Parallel Software Rendering
 * for Visualizing Large-Scale Data Sets. IEEE Computer Graphics and Applications 21(4), 2001.
 *
 * @sa vtkIsosurfaceVolume vtkVolumeProperty vtkContourValues vtkFlyingEdges3D
 * @sa vtkIsosurfaceComparisonFilter
 */

#ifndef vtkIsosurfaceRayTraceMapper_h
#define vtkIsosurfaceRayTraceMapper_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingModule.h" // for export macro
#include "vtkVolumeMapper.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string

namespace vtkIsosurfaceRayTracing
{
struct FrameTimes;
}

VTK_ABI_NAMESPACE_BEGIN

class vtkCamera;
class vtkDataArray;
class vtkDataSet;
class vtkImageData;
class vtkIsosurfaceRayTraceFrame;
class vtkIsosurfaceRayTraceGridInput;
class vtkLightCollection;
class vtkPoints;
class vtkPolyData;
class vtkVolumeProperty;
struct vtkIsosurfaceRayTraceRequest;
struct vtkIsosurfaceRayTraceSettings;

class VTKISOSURFACERAYTRACING_EXPORT vtkIsosurfaceRayTraceMapper : public vtkVolumeMapper
{
public:
  static vtkIsosurfaceRayTraceMapper* New();
  vtkTypeMacro(vtkIsosurfaceRayTraceMapper, vtkVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What is between the samples.
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
   * Set/Get what is between the samples. With NEAREST one sees the samples as they are, labels
   * among them; a hit lies exactly in the plane of a face, whose normal is that of both
   * NormalModes, and is found without a RootSolver. A face that parts several isovalues is met once
   * for each of them. Nothing is drawn beside a sample that is NaN or infinite, nor at the border
   * of the volume. The boxes of cell scalars are the cells (of a rectilinear grid with uneven
   * spacing, they end half way between the centres); those at the border are drawn from their
   * centres on. Of the two points beside a face, the one selected is inside, and so is the cell of
   * cell scalars. A face between points lies in the middle of four cells, and is hidden in those
   * that are blanked. Intensity projections and the colours of ColorArrayName stay trilinear.
   *
   * With CUBIC the surface is smooth, and so is its normal: that of both NormalModes is the exact
   * gradient of the interpolant. Between samples the values may go beyond them, by up to 61/128 of
   * the range of the 4^3 around: thin things keep more of their shape, and beside sharp edges there
   * are ripples. It equals what vtkImageReslice makes with cubic interpolation, but at the border
   * of the volume: there samples go on in a straight line (VTK repeats the last one, which bends
   * the surface). With uneven spacing the slope at a sample is that of the parabola through it and
   * its neighbours. A cell is empty if one of the 4^3 samples is NaN or infinite; blanked samples
   * count for the cells beside them. All crossings along a ray are found without a RootSolver, but
   * pairs nearer to each other than 2^-40 of the way through a cell may be missed. Frames take
   * several times as long as trilinear ones. Intensity projections are an error; the colours of
   * ColorArrayName stay trilinear.
   *
   * vtkVolumeProperty::GetInterpolationType() is not asked: it is nearest unless it is set, and
   * those who draw isosurfaces with VTK without setting it get smooth ones. Default: TRILINEAR.
   */
  vtkSetClampMacro(InterpolationMode, int, TRILINEAR, CUBIC);
  vtkGetMacro(InterpolationMode, int);
  void SetInterpolationModeToTrilinear() { this->SetInterpolationMode(TRILINEAR); }
  void SetInterpolationModeToNearest() { this->SetInterpolationMode(NEAREST); }
  void SetInterpolationModeToCubic() { this->SetInterpolationMode(CUBIC); }
  ///@}

  /**
   * How the place where a ray meets the surface in a cell is found.
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
   * Set/Get the solver. Default: ROBUST.
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
   * Where the normal of the surface comes from.
   */
  enum NormalModes
  {
    /// The exact gradient of the trilinear interpolant. It jumps from cell to cell: one sees the
    /// cells.
    INTERPOLANT_GRADIENT = 0,
    /// Central differences at the corners of the cell, interpolated trilinearly: a smooth look.
    CENTRAL_DIFFERENCES = 1
  };

  ///@{
  /**
   * Set/Get where the normal comes from. It changes the shading, never the place of the surface.
   * Default: CENTRAL_DIFFERENCES.
   */
  vtkSetClampMacro(NormalMode, int, INTERPOLANT_GRADIENT, CENTRAL_DIFFERENCES);
  vtkGetMacro(NormalMode, int);
  void SetNormalModeToInterpolantGradient() { this->SetNormalMode(INTERPOLANT_GRADIENT); }
  void SetNormalModeToCentralDifferences() { this->SetNormalMode(CENTRAL_DIFFERENCES); }
  ///@}

  /**
   * Which of several components is traced.
   */
  enum VectorModes
  {
    /// The one with the largest vtkVolumeProperty::GetComponentWeight() (the first of equals), out
    /// of at most four.
    DISABLED = -1,
    /// The length of the vector, of which a copy is made.
    MAGNITUDE = 0,
    /// VectorComponent.
    COMPONENT = 1
  };

  ///@{
  /**
   * Set/Get which of several components is traced, by the names of vtkSmartVolumeMapper. With
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
   * Set/Get the component for COMPONENT, from 0; one that the scalars do not have is an error.
   * Default: 0.
   */
  vtkSetClampMacro(VectorComponent, int, 0, VTK_INT_MAX);
  vtkGetMacro(VectorComponent, int);
  ///@}

  ///@{
  /**
   * Set/Get the name of a point array that colours the surfaces, in place of their isovalues: its
   * value at a hit, interpolated trilinearly, is looked up in the colour transfer function of the
   * property; an array of unsigned char with three or four components is a colour itself. It is an
   * array of the second input (SetInputData(1, image), SetInputConnection(1, port)) if there is
   * one: an image of any resolution in the same coordinates, whose border goes on outside of it. An
   * empty name takes the point scalars of the second input; without a second input, it colours by
   * isovalue. Opacity is always that of the isovalue. Default: empty.
   */
  void SetColorArrayName(const char* name);
  const char* GetColorArrayName() const { return this->ColorArrayName.c_str(); }
  ///@}

  /**
   * Set the second input (SetInputConnection(1, port) connects one): an image to colour the
   * surfaces by, of any resolution, in the same coordinates. Outside of it its border goes on. Null
   * takes it away. Default: none.
   */
  void SetColorInputData(vtkImageData* image);

  ///@{
  /**
   * Set/Get whether clipping planes are closed where they cut through the inside of a surface,
   * where values are at or above its isovalue. Such a cap is a surface like any other: it hides,
   * casts shadows, is picked, and is seen from behind. It shows the data: its colour is that of the
   * value in the plane, by the colour transfer function of the property (or by ColorArrayName), and
   * its normal is that of the plane, towards what is cut off. Everything else is that of the
   * isosurface whose inside it shows, that of the largest isovalue of several: the opacity, and the
   * isovalue that is told of it. So a plane through bone in translucent skin shows the skin's
   * section translucent and that of the bone opaque.
   *
   * A cap ends exactly where the isosurface meets the plane, without a gap, with the solver ROBUST
   * (and NEAREST, which shows the boxes of samples in the plane). Of several planes each is closed
   * as far as the others leave it. A plane in a face of the volume, to within a millionth of a
   * cell, closes the surface at this face, where it is open otherwise; six planes make a closed
   * box. A plane that lies, as exactly, between cells or between the boxes of samples shows those
   * that it leaves. There is no cap in cells that are blanked or have values that are not finite,
   * nor at cropping planes. Intensity projections have none. Default: off, which costs nothing.
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
   * that is on. A translucent surface lets through one minus its opacity. Other props neither cast
   * nor receive these shadows. Shading must be on (vtkVolumeProperty::ShadeOn). Default: off, which
   * costs nothing.
   */
  vtkSetMacro(Shadows, bool);
  vtkGetMacro(Shadows, bool);
  vtkBooleanMacro(Shadows, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether surfaces keep ambient light from each other and from themselves: the ambient
   * term of the shading, and no other, is multiplied by how much of the sky above a hit is open, on
   * the side that is seen. A translucent surface lets through one minus its opacity. Cut off parts
   * let through all. Shading must be on (vtkVolumeProperty::ShadeOn), and the ambient light strong
   * enough to see what is missing of it: vtkVolumeProperty::SetAmbient(0.5); the default of 0.1 is
   * not. Default: off, which costs nothing.
   */
  vtkSetMacro(AmbientOcclusion, bool);
  vtkGetMacro(AmbientOcclusion, bool);
  vtkBooleanMacro(AmbientOcclusion, bool);
  ///@}

  ///@{
  /**
   * Set/Get the number of rays that look for it from each hit, more of them upwards than to the
   * sides, as a matt surface sees the sky. Where they go differs from hit to hit, and is the same
   * in every picture: few rays give grain. (In the further frames of ProgressiveAccumulation they
   * go elsewhere.) Range: 1 to 4096. Default: 32.
   */
  vtkSetClampMacro(NumberOfAmbientOcclusionRays, int, 1, 4096);
  vtkGetMacro(NumberOfAmbientOcclusionRays, int);
  ///@}

  ///@{
  /**
   * Set/Get how far they look, in units of the world; what is farther away darkens nothing. 0 sets
   * no limit. Range: from 0. Default: 0.
   */
  vtkSetClampMacro(AmbientOcclusionRadius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmbientOcclusionRadius, double);
  ///@}

  /**
   * How the samples lie in memory while rays read them.
   */
  enum BrickLayouts
  {
    /// The array of the user, as it is: no memory, poor locality.
    NO_BRICKS = 0,
    /// Every brick holds BrickSize^3 cells with all their corners: one sample is repeated on three
    /// sides, and the eight corners of a cell always lie in one brick.
    APRON_BRICKS = 1,
    /// The layout of Parker et al.: bricks of BrickSize^3 samples, gathered in groups of
    /// BrickGroupSize^3 bricks; the address of a sample is Fx[x] + Fy[y] + Fz[z].
    TWO_LEVEL_BRICKS = 2
  };

  ///@{
  /**
   * Set/Get the layout of the samples. It changes speed and memory, never the picture.
   * Default: APRON_BRICKS.
   */
  vtkSetClampMacro(BrickLayout, int, NO_BRICKS, TWO_LEVEL_BRICKS);
  vtkGetMacro(BrickLayout, int);
  void SetBrickLayoutToNoBricks() { this->SetBrickLayout(NO_BRICKS); }
  void SetBrickLayoutToApronBricks() { this->SetBrickLayout(APRON_BRICKS); }
  void SetBrickLayoutToTwoLevelBricks() { this->SetBrickLayout(TWO_LEVEL_BRICKS); }
  ///@}

  ///@{
  /**
   * Set/Get the edge of a brick: cells for APRON_BRICKS, samples for TWO_LEVEL_BRICKS (the n of
   * the paper, which had 4 for 16-bit data). Range: 2 to 64. Default: 8.
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
   * cell along a ray is looked at. Range: 0 to 8. Default: 2.
   */
  vtkSetClampMacro(NumberOfMacrocellLevels, int, 0, MaximumNumberOfMacrocellLevels);
  vtkGetMacro(NumberOfMacrocellLevels, int);
  ///@}

  ///@{
  /**
   * Set/Get the ceiling for the memory of bricks and of what is kept with them, in MiB; 0 sets
   * none. When it is reached, rays read the array of the input instead, and the next frame begins
   * by giving up the bricks that the last one did not use. The picture is always the same. It holds
   * for APRON_BRICKS, the default layout. Range: 0 to 2^30. Default: 0.
   */
  vtkSetClampMacro(MaximumBrickMemory, int, 0, 1 << 30);
  vtkGetMacro(MaximumBrickMemory, int);
  ///@}

  ///@{
  /**
   * Set/Get the branching of a level: the edge of its macrocells, counted in macrocells of the
   * level below. Level 0 is the finest; its macrocells are made of cells. A level that does not
   * exist is an error. Range: 2 to 64. Default: 8 on every level, so with two levels macrocells of
   * 8^3 and 64^3 cells.
   */
  void SetMacrocellBranching(int level, int branching);
  int GetMacrocellBranching(int level);
  ///@}

  ///@{
  /**
   * Set/Get the size in pixels of the tiles of the image that threads take one after the other.
   * Range: 1 to 4096 each. Default: 16 x 8: rays are traced in groups of up to 128, and walk the
   * faster the closer they are together; smaller tiles keep many threads busy to the end. (Parker
   * et al. took 32 x 4.)
   */
  void SetTileSize(int width, int height);
  void SetTileSize(const int size[2]) { this->SetTileSize(size[0], size[1]); }
  vtkGetVector2Macro(TileSize, int);
  ///@}

  ///@{
  /**
   * Set/Get whether ImageSampleDistance is chosen for every frame, between its minimum and maximum,
   * so that the frame is drawn in the time allocated to it: coarser pictures while one turns the
   * scene (vtkRenderWindow::SetDesiredUpdateRate, as interactor styles call it), a ray for every
   * pixel when it is still. In stereo it is chosen once for both eyes. Default: on.
   */
  vtkSetClampMacro(AutoAdjustSampleDistances, vtkTypeBool, 0, 1);
  vtkGetMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkBooleanMacro(AutoAdjustSampleDistances, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Set/Get the distance between neighbouring rays, in pixels; in a frame with
   * AutoAdjustSampleDistances, what was chosen. From 1 it is rounded to a whole number, of pixels
   * that share a ray; below 1 it is rounded to one over a whole number, and each pixel is the mean
   * of so many rays squared: 0.5 smooths edges with four rays for every pixel. Range: 0.1 to 100.
   * Default: 1.
   */
  vtkSetClampMacro(ImageSampleDistance, float, 0.1F, 100.0F);
  vtkGetMacro(ImageSampleDistance, float);
  ///@}

  ///@{
  /**
   * Set/Get the bounds of what AutoAdjustSampleDistances chooses. Ranges: 0.1 to 100. Defaults: 1
   * and 10.
   */
  vtkSetClampMacro(MinimumImageSampleDistance, float, 0.1F, 100.0F);
  vtkGetMacro(MinimumImageSampleDistance, float);
  vtkSetClampMacro(MaximumImageSampleDistance, float, 0.1F, 100.0F);
  vtkGetMacro(MaximumImageSampleDistance, float);
  ///@}

  ///@{
  /**
   * Set/Get whether the picture becomes better while nothing moves: each Render() of an unchanged
   * scene traces one more frame, by rays through other places of the pixels and, with
   * AmbientOcclusion, by other rays from the hits, and shows the mean of all so far. Edges become
   * smooth, grain goes away. The first frame is the very picture that there is without; its depth
   * stays. Whatever changes the picture (camera, lights, property, settings, inputs, size, the
   * depth of what is in front) begins anew; a frame that is given up
   * (vtkRenderWindow::CheckAbortStatus) leaves what there is. In stereo each eye has its own mean.
   *
   * Somebody has to call Render(), for example a timer of the interactor, for as long as
   * GetNumberOfAccumulatedFrames() is more than 0 and less than MaximumNumberOfAccumulatedFrames.
   *
   * Coarse pictures (ImageSampleDistance of 2 and more, as in a hurry), those of vtkSSAOPass,
   * hardware selections, PickPixel and RenderToImage are as without, and leave the mean as it is.
   * It takes 12 bytes for every pixel that the volume covers, and 4 more where depth is read.
   * Default: off, which costs nothing.
   */
  vtkSetMacro(ProgressiveAccumulation, bool);
  vtkGetMacro(ProgressiveAccumulation, bool);
  vtkBooleanMacro(ProgressiveAccumulation, bool);
  ///@}

  ///@{
  /**
   * Set/Get how many frames it takes. After them nothing more is traced: the mean is only
   * displayed, and TraceTime is 0. Range: 1 to 256. Default: 16.
   */
  vtkSetClampMacro(MaximumNumberOfAccumulatedFrames, int, 1, 256);
  vtkGetMacro(MaximumNumberOfAccumulatedFrames, int);
  ///@}

  /**
   * The number of frames whose mean the last Render() showed; 0 if its picture is not one to
   * accumulate. Of a frame that was given up: how many there are still.
   */
  vtkGetMacro(NumberOfAccumulatedFrames, int);

  ///@{
  /**
   * Set/Get the number of threads; 0 takes what OpenMP gives (OMP_NUM_THREADS, or all cores).
   * Range: 0 to 1024. Default: 0.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * The times of the last frame, in seconds of wall-clock time: building the macrocells, making
   * bricks, tracing, shading, and displaying (reading the depth of the scene, uploading and drawing
   * the image). What did not happen in the frame is 0. Bricks, tracing and shading are interleaved
   * on all threads: the wall-clock time of the three together is divided in proportion to the time
   * the threads spent in each.
   */
  vtkGetMacro(MacrocellBuildTime, double);
  vtkGetMacro(BrickBuildTime, double);
  vtkGetMacro(TraceTime, double);
  vtkGetMacro(ShadeTime, double);
  vtkGetMacro(DisplayTime, double);
  ///@}

  ///@{
  /**
   * The memory held now, in bytes: the macrocells of all levels, and the bricks.
   */
  vtkIdType GetMacrocellMemory();
  vtkIdType GetBrickMemory();
  ///@}

  ///@{
  /**
   * The number of bricks that exist now, and the number there would be if all existed.
   */
  vtkIdType GetNumberOfBricks();
  vtkIdType GetMaximumNumberOfBricks();
  ///@}

  /**
   * Returns whether there are isosurfaces to draw of a volume, and each of them is opaque: its
   * property has an opacity of at least one at every isovalue that it does not hide. What cannot be
   * drawn is not opaque; Render says why.
   *
   * @sa vtkIsosurfaceVolume
   */
  bool HasOnlyOpaqueSurfaces(vtkVolume* volume);

  /**
   * Finds the first isosurface that a line from p1 to p2 (world coordinates) meets, as the picture
   * of the volume shows it, with the isovalues, opacities and matrix of the volume. Needs no window
   * and no OpenGL. Returns 1 if there is a hit, else 0 and nothing is changed.
   *
   * t is the fraction of the way from p1 to p2, x the point in the world, pcoords the point in the
   * cell, cellId the cell of the input, isovalue that of the surface, normal its normal of length
   * one in the world, by NormalMode, on the side of smaller values.
   *
   * Of a projection (maximum or minimum intensity) the one hit is the place of the extreme value,
   * whatever its opacity; isovalue is that value, and normal that of its isosurface.
   */
  int IntersectWithLine(vtkVolume* volume, const double p1[3], const double p2[3], double& t,
    double x[3], double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3]);

  /**
   * Finds the block of composite input that has a cell by its number through all blocks, as all
   * that tells a cell of composite input gives it, and its number in the block. The flat index is
   * that of vtkCompositeDataIterator. For other input the block is the input itself, and the flat
   * index 0.
   */
  vtkDataSet* FindBlock(vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex);

  ///@{
  /**
   * The bounds of the input, of composite input those of all blocks.
   */
  using vtkVolumeMapper::GetBounds;
  double* GetBounds() VTK_SIZEHINT(6) override;
  ///@}

  /**
   * Casts rays, given by origins and directions in the world, on all threads, as IntersectWithLine
   * does: a ray has the hits of which its pixel would be composed, the last one opaque. The
   * directions have three components, one tuple for each origin; their length is the unit of T.
   *
   * The output has a point for every hit, by ray and from front to back, and as point data RayId, T
   * (in units of the direction), CellId, ParametricCoordinates (3), Isovalue and Normals (3).
   * Returns whether rays were cast; if not, the error says why.
   */
  bool CastRays(
    vtkVolume* volume, vtkPoints* origins, vtkDataArray* directions, vtkPolyData* output);

  /**
   * Finds what the picture of a renderer shows of the volume at a pixel of the window, counted from
   * the lower left: the nearest isosurface, to the very bits that are drawn (in stereo, that a
   * window without it would show, as for all pickers of VTK). Other props are not asked. Needs no
   * window to have been drawn. Returns 1 if there is a surface (or, of a projection, a value with
   * any opacity), else 0 and nothing is changed. What is found is described as by
   * IntersectWithLine.
   *
   * @sa vtkIsosurfacePicker
   */
  int PickPixel(vtkRenderer* renderer, vtkVolume* volume, int column, int row, double x[3],
    double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3]);

  /**
   * Makes a picture without a window and without OpenGL: the same, pixel for pixel, as in a window
   * of that size, of which the camera is that of the only renderer. The clipping range of the
   * camera is taken as it is (vtkCamera::SetClippingRange). Headlights and lights of the camera
   * follow it; without lights (null) there is one headlight, as in a new renderer.
   *
   * The output has a point for every pixel, in rows from the bottom, and as point data Colors (red,
   * green, blue and opacity, the colours multiplied by the opacity; the active scalars) and Depth
   * (that of the nearest opaque surface in the depth buffer, from 0 to 1; 1 where there is none).
   * Then, of the nearest surface, translucent or not: Normals (3, as IntersectWithLine has them),
   * Position (3, in the world), CellId and IsovalueId (the number of the isovalue in
   * vtkVolumeProperty::GetIsoSurfaceValues()). Where there is no surface these are NaN and -1.
   * Of a projection, Depth and all others are those of the place of the extreme value, whatever its
   * opacity, and instead of IsovalueId there is Value (double; NaN where there is none).
   * Returns whether there is a picture; if not, the error says why.
   */
  bool RenderToImage(vtkVolume* volume, vtkCamera* camera, vtkLightCollection* lights, int width,
    int height, vtkImageData* output);

  /**
   * Takes the inputs and all settings of another mapper, of which inputs and clipping planes are
   * shared. Of a volume mapper of another class it takes those that all volume mappers have.
   *
   * (vtkVolume::ShallowCopy makes another volume of the same mapper. Give the copy one of its own
   * to change it by itself.)
   */
  void ShallowCopy(vtkAbstractMapper* mapper) override;

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

  /// Whether there can be a level; if not, reports it.
  bool HasMacrocellLevel(int level);
  template <typename Visitor>
  static void VisitSettings(const Visitor& visit);
  vtkIsosurfaceRayTraceSettings GetSettings() const;
  void SetTimes(const vtkIsosurfaceRayTracing::FrameTimes& times);
  void UpdateInputs();
  void CopyVolumeMapper(vtkVolumeMapper* mapper);
  /// Chooses what to trace. Returns why it cannot be traced; empty if it can.
  std::string SelectInput(vtkVolumeProperty* property);
  /// Reports a problem, if there is one and it was not reported before: once, not in every frame.
  /// Returns whether there is.
  bool ReportOnce(const std::string& problem);
  /// Updates the input, and says what to trace of it for a volume. Returns null, and reports why,
  /// if it cannot be traced.
  std::unique_ptr<vtkIsosurfaceRayTraceRequest> MakeRequest(vtkVolume* volume);

  int InterpolationMode = TRILINEAR;
  int RootSolver = ROBUST;
  int NumberOfInterpolations = 3;
  int NormalMode = CENTRAL_DIFFERENCES;
  int VectorMode = DISABLED;
  int VectorComponent = 0;
  std::string ColorArrayName;
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
  int TileSize[2] = { 16, 8 };
  vtkTypeBool AutoAdjustSampleDistances = 1;
  float ImageSampleDistance = 1.0F;
  float MinimumImageSampleDistance = 1.0F;
  float MaximumImageSampleDistance = 10.0F;
  bool ProgressiveAccumulation = false;
  int MaximumNumberOfAccumulatedFrames = 16;
  int NumberOfThreads = 0;

  int NumberOfAccumulatedFrames = 0;
  double MacrocellBuildTime = 0.0;
  double BrickBuildTime = 0.0;
  double TraceTime = 0.0;
  double ShadeTime = 0.0;
  double DisplayTime = 0.0;

  std::unique_ptr<vtkIsosurfaceRayTraceGridInput> Input;
  std::unique_ptr<vtkIsosurfaceRayTraceFrame> Frame;
  std::string LastProblem;
};

VTK_ABI_NAMESPACE_END

#endif
