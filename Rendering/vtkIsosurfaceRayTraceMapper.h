// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceMapper
 * @brief   ray trace isosurfaces straight from image data, on the CPU
 *
 * A volume mapper that draws the isosurfaces of a vtkImageData without extracting a polygon. Every
 * ray is intersected with the trilinear interpolant of the data: inside a cell that is a cubic
 * along the ray, and its first root is the hit. A new isovalue, colour or camera costs a frame and
 * nothing else.
 *
 * The isovalues are those of vtkVolumeProperty::GetIsoSurfaceValues(); there may be several. The
 * colour and opacity of a surface are the transfer functions of the property at its isovalue
 * (the opacity is that of a surface: ScalarOpacityUnitDistance has no part in it). The nearest
 * opaque surface hides what is behind it; translucent surfaces are composited in the order in
 * which each ray meets them. A property without isovalues draws nothing. Points whose value is
 * greater than or equal to the isovalue are inside, as in vtkFlyingEdges3D.
 *
 * Ambient, Diffuse, Specular, SpecularPower and Shade of the property are honoured, with every
 * light of the renderer; so is vtkRenderer::TwoSidedLighting. The surface is drawn into the render
 * window with its true depth: opaque geometry hides it and is hidden by it, pixel by pixel.
 *
 * What the mapper keeps: a hierarchy of macrocells (the smallest and largest value of a block of
 * cells), built in parallel on the first render; and bricks (a copy of the samples reordered for
 * locality), each made when the first ray enters an active macrocell there. Both depend on the
 * scalars alone.
 *
 * All scalar types are read without loss, with one exception: 64-bit integers are compared as
 * double, so values beyond 2^53 are rounded to the nearest double. A cell with a NaN or infinite
 * corner is empty. Of several components the one with the largest
 * vtkVolumeProperty::GetComponentWeight() is taken (the first of equals), out of at most four.
 * Only point scalars are traced; vtkCellDataToPointData makes them from cell scalars.
 *
 * The threads are OpenMP's, because tiles differ so much in cost that they must be handed out one
 * at a time (`schedule(dynamic)`), which vtkSMPTools does not promise. The picture is the same, bit
 * for bit, for any number of threads, any layout and any hierarchy.
 *
 * Not supported, and said so with a warning: Cropping and ClippingPlanes. Nothing is drawn while a
 * vtkHardwareSelector is at work.
 *
 * S. Parker, P. Shirley, Y. Livnat, C. Hansen, P.-P. Sloan: Interactive Ray Tracing for Isosurface
 * Rendering. IEEE Visualization 1998. K.-L. Ma, S. Parker: Massively Parallel Software Rendering
 * for Visualizing Large-Scale Data Sets. IEEE Computer Graphics and Applications 21(4), 2001.
 *
 * @sa vtkVolumeProperty vtkContourValues vtkFlyingEdges3D vtkIsosurfaceComparisonFilter
 */

#ifndef vtkIsosurfaceRayTraceMapper_h
#define vtkIsosurfaceRayTraceMapper_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingModule.h" // for export macro
#include "vtkVolumeMapper.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkDataArray;
class vtkPoints;
class vtkPolyData;
class vtkRenderWindow;

class VTKISOSURFACERAYTRACING_EXPORT vtkIsosurfaceRayTraceMapper : public vtkVolumeMapper
{
public:
  static vtkIsosurfaceRayTraceMapper* New();
  vtkTypeMacro(vtkIsosurfaceRayTraceMapper, vtkVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

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
    /// The same in single precision, several cells at a time in vector registers. Where a ray
    /// grazes the surface, with an extremum within 4.8e-7 of the isovalue (times the largest
    /// difference between a corner of the cell and the isovalue), it may be judged either way.
    FAST = 1,
    /// The closed form as published by Parker et al. 1998 (J. Schwarze, Graphics Gems 1990). It
    /// loses many hits where a cell is nearly linear along the ray: for comparison only.
    ANALYTIC = 2,
    /// Cut at the extrema, then NumberOfInterpolations linear interpolations (G. Marmitt et al.,
    /// VMV 2004).
    MARMITT = 3,
    /// Signs at the ends of the segment and one linear interpolation (A. Neubauer et al., VisSym
    /// 2002): a preview, which misses thin sheets.
    LINEAR = 4
  };

  ///@{
  /**
   * Set/Get the solver. Default: ROBUST.
   */
  vtkSetClampMacro(RootSolver, int, ROBUST, LINEAR);
  vtkGetMacro(RootSolver, int);
  void SetRootSolverToRobust() { this->SetRootSolver(ROBUST); }
  void SetRootSolverToFast() { this->SetRootSolver(FAST); }
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
   * Range: 1 to 4096 each. Default: 16 x 16: rays are traced in groups of up to 128, and walk the
   * faster the closer they are together. (Parker et al. took 32 x 4.)
   */
  void SetTileSize(int width, int height);
  void SetTileSize(const int size[2]) { this->SetTileSize(size[0], size[1]); }
  vtkGetVector2Macro(TileSize, int);
  ///@}

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
   * Finds the first isosurface that a line from p1 to p2 (world coordinates) meets, as the picture
   * of the volume shows it, with the isovalues, opacities and matrix of the volume. Needs no window
   * and no OpenGL. Returns 1 if there is a hit, else 0 and nothing is changed.
   *
   * t is the fraction of the way from p1 to p2, x the point in the world, pcoords the point in the
   * cell, cellId the cell of the input, isovalue that of the surface, normal its normal of length
   * one in the world, by NormalMode, on the side of smaller values.
   */
  int IntersectWithLine(vtkVolume* volume, const double p1[3], const double p2[3], double& t,
    double x[3], double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3]);

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

  int GetThreads();
  /// Says what the problem is, if there is one and it was not said before. Returns whether there
  /// is.
  bool ReportOnce(const std::string& problem);
  /// Brings everything about the volume up to date but the picture. Returns false if it can't be
  /// traced.
  bool UpdateVolume(vtkVolume* volume);
  bool RenderFrame(vtkRenderer* renderer, vtkVolume* volume);
  bool ReportProgress(vtkRenderWindow* window, double fraction);
  void WarnOfWhatIsIgnored();

  int RootSolver = ROBUST;
  int NumberOfInterpolations = 3;
  int NormalMode = CENTRAL_DIFFERENCES;
  int BrickLayout = APRON_BRICKS;
  int BrickSize = 8;
  int BrickGroupSize = 4;
  int MaximumBrickMemory = 0;
  int NumberOfMacrocellLevels = 2;
  int MacrocellBranching[MaximumNumberOfMacrocellLevels] = { 8, 8, 8, 8, 8, 8, 8, 8 };
  int TileSize[2] = { 16, 16 };
  int NumberOfThreads = 0;

  double MacrocellBuildTime = 0.0;
  double BrickBuildTime = 0.0;
  double TraceTime = 0.0;
  double ShadeTime = 0.0;
  double DisplayTime = 0.0;

  class Internals;
  std::unique_ptr<Internals> Internal;
};

VTK_ABI_NAMESPACE_END

#endif
