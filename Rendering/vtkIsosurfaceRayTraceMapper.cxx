// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceMapper.h"

#include "vtkIsosurfaceRayTraceAccumulation.h"
#include "vtkIsosurfaceRayTraceBlocks.h"
#include "vtkIsosurfaceRayTraceColors.h"
#include "vtkIsosurfaceRayTraceImageDisplay.h"
#include "vtkIsosurfaceRayTraceScene.h"
#include "vtkIsosurfaceRayTraceSource.h"
#include "vtkIsosurfaceRayTraceValueColors.h"

#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkDualDepthPeelingPass.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkIntArray.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSSAOPass.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include "Picture/CastRays.h"
#include "Picture/PixelSampling.h"
#include "Picture/RenderTiles.h"
#include "Picture/Shader.h"

#include <omp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool AreOpaque(const std::vector<vtkirt::Isosurface>& surfaces)
{
  return std::all_of(surfaces.begin(), surfaces.end(),
    [](const vtkirt::Isosurface& surface) { return surface.Opacity >= 1.0; });
}

/// The pixels of its window that a renderer covers.
vtkirt::PixelRectangle GetViewport(vtkRenderer* renderer)
{
  vtkirt::PixelRectangle viewport;
  renderer->GetTiledSizeAndOrigin(&viewport.Width, &viewport.Height, &viewport.X, &viewport.Y);
  return viewport;
}

/// What a blend mode looks for along rays, if not for surfaces.
std::optional<vtkirt::Extremum> GetProjection(int blendMode)
{
  switch (blendMode)
  {
    case vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND:
      return vtkirt::Extremum::Largest;
    case vtkVolumeMapper::MINIMUM_INTENSITY_BLEND:
      return vtkirt::Extremum::Smallest;
    default:
      return std::nullopt;
  }
}

/// The pixels that are drawn to now: in a render pass, of a framebuffer that may begin elsewhere
/// and have another size.
vtkirt::PixelRectangle GetDrawnViewport(vtkOpenGLRenderWindow* window)
{
  const std::array<int, 4> viewport = vtkIsosurfaceRayTraceImageDisplay::GetViewport(window);
  return { viewport[0], viewport[1], viewport[2], viewport[3] };
}

/// The render pass of a kind that draws a volume now, if there is one.
template <typename Pass>
Pass* FindPass(vtkVolume* volume)
{
  vtkInformation* keys = volume->GetPropertyKeys();
  const int count = keys ? vtkOpenGLRenderPass::RenderPasses()->Length(keys) : 0;
  for (int i = 0; i < count; ++i)
  {
    if (auto* pass = Pass::SafeDownCast(vtkOpenGLRenderPass::RenderPasses()->Get(keys, i)))
    {
      return pass;
    }
  }
  return nullptr;
}

/// Whether a frame in stereo has shown another eye already.
bool IsSecondEye(vtkRenderer* renderer)
{
  vtkRenderWindow* window = renderer->GetRenderWindow();
  return window->GetStereoRender() != 0 && window->GetStereoType() != VTK_STEREO_RIGHT &&
    renderer->GetActiveCamera()->GetLeftEye() == 0;
}

bool Contains(const vtkirt::PixelRectangle& pixels, int x, int y)
{
  return x >= pixels.X && x < pixels.X + pixels.Width && y >= pixels.Y &&
    y < pixels.Y + pixels.Height;
}

}

//------------------------------------------------------------------------------
class vtkIsosurfaceRayTraceMapper::Internals
{
public:
  /// The size is in rays.
  struct View
  {
    vtkirt::Matrix4 ClipFromWorld;
    double Width;
    double Height;
  };

  /// Finds the input, of which blocks are put together. Returns what stands in the way.
  std::string SelectGrid(vtkIsosurfaceRayTraceMapper* self);

  /// Chooses what to trace. Returns what stands in the way; empty if nothing does.
  std::string SelectScalars(vtkIsosurfaceRayTraceMapper* self, vtkVolumeProperty* property);

  /// The same for the colours.
  std::string SelectColors(vtkIsosurfaceRayTraceMapper* self);

  /// Whether a message is new. Every cause is named once, not once per frame.
  bool IsNews(const std::string& message, std::string& last) const
  {
    const bool news = !message.empty() && message != last;
    last = message;
    return news;
  }

  /// The hits of rays given in the world, up to tEnd times their direction.
  vtkirt::RayHits Cast(const std::vector<vtkirt::Vector3>& origins,
    const std::vector<vtkirt::Vector3>& directions, double tEnd, int threads);
  /// The isovalue of a surface, or the value of a projection.
  double GetValue(const vtkirt::Hit& hit) const
  {
    return this->Request.Projection
      ? hit.Value
      : this->Request.Surfaces[static_cast<std::size_t>(hit.Surface)].Isovalue;
  }
  /// Whether the picture shows anything at a pixel. A value may have no opacity.
  bool IsSeen(std::size_t pixel) const
  {
    return this->Picture.Hits[pixel].Surface != vtkirt::Hit::NoSurface &&
      (!this->Request.Projection || this->Picture.Colors[4 * pixel + 3] > 0);
  }
  /// In the world, towards smaller values, of length one.
  vtkirt::Vector3 GetNormal(const vtkirt::Hit& hit, int normalMode) const;
  /// The cell that a hit is in and the point nearest to it, as users know them.
  vtkIdType FindCell(const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const;
  vtkIdType FindPoint(const vtkirt::Hit& hit) const;
  /// All that is said of a hit.
  void Describe(const vtkirt::Hit& hit, int normalMode, double x[3], double pcoords[3],
    vtkIdType& cellId, double& isovalue, double normal[3]) const;
  void WriteHits(const vtkirt::RayHits& hits, int normalMode, vtkPolyData* output) const;

  /// What is seen from where, but the lights.
  vtkirt::Scene MakeScene(
    vtkIsosurfaceRayTraceMapper* self, vtkVolumeProperty* property, const View& view);
  /// The same for a renderer, with its lights.
  vtkirt::Scene MakeScene(vtkIsosurfaceRayTraceMapper* self, vtkVolumeProperty* property,
    const View& view, vtkRenderer* renderer, const vtkirt::PixelSampling& sampling);
  /// As AutoAdjustSampleDistances has it.
  vtkirt::PixelSampling ChooseSampling(
    vtkIsosurfaceRayTraceMapper* self, vtkRenderer* renderer, vtkVolume* volume) const;
  /// The depth of what the window shows already, for every ray of a scene.
  void ReadDepths(vtkOpenGLRenderWindow* window, const vtkirt::PixelRectangle& viewport,
    const vtkirt::PixelSampling& sampling, vtkirt::Scene& scene);
  /// Makes the picture. Returns false if it was given up.
  bool Trace(vtkIsosurfaceRayTraceMapper* self, const vtkirt::Scene& scene,
    const std::function<bool(double)>& keepGoing);
  /// The same, with a pixel for every square of rays; if frames are accumulated, with one more of
  /// them, or without tracing any if there are enough.
  bool TraceFrame(vtkIsosurfaceRayTraceMapper* self, vtkRenderer* renderer,
    vtkVolumeProperty* property, const vtkirt::PixelSampling& sampling, vtkirt::Scene& scene);
  /// What pictures are made from, besides what a scene has as numbers.
  std::vector<vtkObject*> GetObjects(
    vtkIsosurfaceRayTraceMapper* self, vtkVolumeProperty* property) const;
  /// Turns the picture into that of the ids that a selector asks for.
  void WriteIds(vtkHardwareSelector* selector, const vtkirt::Scene& scene);
  vtkIdType GetId(vtkHardwareSelector* selector, const vtkirt::Hit& hit) const;
  /// The points and normals of the nearest surfaces, in coordinates of the view, three numbers for
  /// every ray.
  void FindGeometry(vtkIsosurfaceRayTraceMapper* self, vtkCamera* camera,
    std::vector<float>& positions, std::vector<float>& normals) const;
  /// Writes the picture and what is known of its pixels.
  void WriteImage(vtkIsosurfaceRayTraceMapper* self, vtkVolumeProperty* property,
    const vtkirt::Scene& scene, vtkImageData* output) const;

  /// The blocks of the input, if it is composite.
  bool IsComposite = false;
  vtkIsosurfaceRayTraceBlocks Blocks;
  /// The input, or what its blocks make.
  vtkDataSet* Grid = nullptr;
  vtkIsosurfaceRayTraceSource::Selection Scalars;
  /// The component of the property that says what they look like.
  int PropertyComponent = 0;
  vtkIsosurfaceRayTraceSource Source;
  /// What surfaces are coloured by; the array is null if by their isovalues, the image if it is an
  /// array of the input.
  vtkImageData* ColorImage = nullptr;
  vtkDataArray* ColorArray = nullptr;
  std::unique_ptr<vtkIsosurfaceRayTraceColors> Colors;
  /// What a projection is coloured by, and caps.
  std::unique_ptr<vtkIsosurfaceRayTraceValueColors> ValueColors;

  /// What the volume of the last call looks like: see vtkIsosurfaceRayTraceMapper::UpdateVolume.
  vtkirt::Matrix4 WorldFromIndex;
  vtkirt::TraceRequest Request;

  vtkirt::Frame Picture;
  std::vector<float> SceneDepths;
  /// For each eye.
  std::array<vtkIsosurfaceRayTraceAccumulation, 2> Accumulations;
  /// What the last frame would have taken with a ray for every pixel.
  double SecondsOfFullFrame = 0.0;
  vtkIsosurfaceRayTraceImageDisplay Display;
  std::string LastProblem;
};

//------------------------------------------------------------------------------
vtkirt::RayHits vtkIsosurfaceRayTraceMapper::Internals::Cast(
  const std::vector<vtkirt::Vector3>& origins, const std::vector<vtkirt::Vector3>& directions,
  double tEnd, int threads)
{
  vtkirt::Matrix4 indexFromWorld;
  vtkMatrix4x4::Invert(this->WorldFromIndex.data(), indexFromWorld.data());
  // The place of the first sample is taken off first: a volume far from the origin of the world
  // loses nothing.
  const vtkirt::Vector3 first = vtkirt::TransformPoint(this->WorldFromIndex, { 0.0, 0.0, 0.0 });
  std::vector<std::optional<vtkirt::Ray>> rays(origins.size());
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    using vtkirt::operator-;
    rays[i] = vtkirt::ClipToVolume(vtkirt::TransformDirection(indexFromWorld, origins[i] - first),
      vtkirt::TransformDirection(indexFromWorld, directions[i]), 0.0, tEnd,
      this->Source.GetVolume()->GetDimensions(), this->Request.Planes);
  }
  this->Source.GetVolume()->Select(this->Request, threads);
  return vtkirt::CastRays(*this->Source.GetVolume(), rays, threads);
}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceMapper::Internals::GetNormal(
  const vtkirt::Hit& hit, int normalMode) const
{
  using vtkirt::operator*;
  const vtkirt::Vector3 gradient =
    this->Source.GetVolume()->GetGradient(hit, static_cast<vtkirt::NormalMode>(normalMode));
  return vtkirt::Normalized(vtkirt::GradientToWorld(this->WorldFromIndex, gradient)) * -1.0;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::Internals::FindCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  return this->IsComposite
    ? this->Blocks.GetCellId(this->Source.FindStructuredCell(hit, parametric))
    : this->Source.FindCell(hit, parametric);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::Internals::FindPoint(const vtkirt::Hit& hit) const
{
  vtkirt::Vector3 parametric;
  return this->IsComposite
    ? this->Blocks.GetPointId(
        this->Source.FindStructuredCell(hit, parametric), this->Source.FindStructuredPoint(hit))
    : this->Source.FindPoint(hit);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Internals::Describe(const vtkirt::Hit& hit, int normalMode,
  double x[3], double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3]) const
{
  vtkirt::Vector3 inCell;
  cellId = this->FindCell(hit, inCell);
  std::copy_n(inCell.begin(), 3, pcoords);
  isovalue = this->GetValue(hit);
  const vtkirt::Vector3 point =
    vtkirt::TransformPoint(this->WorldFromIndex, hit.GetPoint(this->Request.Planes));
  std::copy_n(point.begin(), 3, x);
  const vtkirt::Vector3 outward = this->GetNormal(hit, normalMode);
  std::copy_n(outward.begin(), 3, normal);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Internals::WriteHits(
  const vtkirt::RayHits& hits, int normalMode, vtkPolyData* output) const
{
  const auto count = static_cast<vtkIdType>(hits.Hits.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkNew<vtkIdTypeArray> rayIds;
  vtkNew<vtkIdTypeArray> cellIds;
  vtkNew<vtkDoubleArray> ts;
  vtkNew<vtkDoubleArray> isovalues;
  vtkNew<vtkDoubleArray> parametric;
  vtkNew<vtkDoubleArray> normals;
  parametric->SetNumberOfComponents(3);
  normals->SetNumberOfComponents(3);
  const auto add = [count, output](vtkDataArray* array, const char* name)
  {
    array->SetName(name);
    array->SetNumberOfTuples(count);
    output->GetPointData()->AddArray(array);
  };
  add(rayIds, "RayId");
  add(ts, "T");
  add(cellIds, "CellId");
  add(parametric, "ParametricCoordinates");
  add(isovalues, "Isovalue");
  add(normals, "Normals");
  output->GetPointData()->SetActiveNormals("Normals");
  output->SetPoints(points);

  for (std::size_t ray = 0; ray + 1 < hits.First.size(); ++ray)
  {
    for (std::size_t i = hits.First[ray]; i < hits.First[ray + 1]; ++i)
    {
      const vtkirt::Hit& hit = hits.Hits[i];
      const auto row = static_cast<vtkIdType>(i);
      vtkirt::Vector3 point;
      vtkirt::Vector3 inCell;
      vtkirt::Vector3 normal;
      vtkIdType cellId = -1;
      double isovalue = 0.0;
      this->Describe(hit, normalMode, point.data(), inCell.data(), cellId, isovalue, normal.data());
      points->SetPoint(row, point.data());
      rayIds->SetValue(row, static_cast<vtkIdType>(ray));
      ts->SetValue(row, hit.T);
      cellIds->SetValue(row, cellId);
      parametric->SetTypedTuple(row, inCell.data());
      isovalues->SetValue(row, isovalue);
      normals->SetTypedTuple(row, normal.data());
    }
  }
}

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfaceRayTraceMapper);

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMapper::vtkIsosurfaceRayTraceMapper()
  : Internal(std::make_unique<Internals>())
{
  this->BlendMode = vtkVolumeMapper::ISOSURFACE_BLEND;
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMapper::~vtkIsosurfaceRayTraceMapper() = default;

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (auto* volumeMapper = vtkVolumeMapper::SafeDownCast(mapper))
  {
    this->CopyVolumeMapper(volumeMapper);
  }
  if (auto* other = vtkIsosurfaceRayTraceMapper::SafeDownCast(mapper))
  {
    this->InterpolationMode = other->InterpolationMode;
    this->RootSolver = other->RootSolver;
    this->NumberOfInterpolations = other->NumberOfInterpolations;
    this->NormalMode = other->NormalMode;
    this->VectorMode = other->VectorMode;
    this->VectorComponent = other->VectorComponent;
    this->ColorArrayName = other->ColorArrayName;
    this->Shadows = other->Shadows;
    this->CapClippingPlanes = other->CapClippingPlanes;
    this->AmbientOcclusion = other->AmbientOcclusion;
    this->NumberOfAmbientOcclusionRays = other->NumberOfAmbientOcclusionRays;
    this->AmbientOcclusionRadius = other->AmbientOcclusionRadius;
    this->ProgressiveAccumulation = other->ProgressiveAccumulation;
    this->MaximumNumberOfAccumulatedFrames = other->MaximumNumberOfAccumulatedFrames;
    this->BrickLayout = other->BrickLayout;
    this->BrickSize = other->BrickSize;
    this->BrickGroupSize = other->BrickGroupSize;
    this->MaximumBrickMemory = other->MaximumBrickMemory;
    this->NumberOfMacrocellLevels = other->NumberOfMacrocellLevels;
    std::copy_n(
      other->MacrocellBranching, MaximumNumberOfMacrocellLevels, this->MacrocellBranching);
    std::copy_n(other->TileSize, 2, this->TileSize);
    this->AutoAdjustSampleDistances = other->AutoAdjustSampleDistances;
    this->ImageSampleDistance = other->ImageSampleDistance;
    this->MinimumImageSampleDistance = other->MinimumImageSampleDistance;
    this->MaximumImageSampleDistance = other->MaximumImageSampleDistance;
    this->NumberOfThreads = other->NumberOfThreads;
  }
  this->Superclass::ShallowCopy(mapper);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::CopyVolumeMapper(vtkVolumeMapper* mapper)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    const bool hasInput =
      port < mapper->GetNumberOfInputPorts() && mapper->GetNumberOfInputConnections(port) > 0;
    this->SetInputConnection(port, hasInput ? mapper->GetInputConnection(port, 0) : nullptr);
  }
  this->SetScalarMode(mapper->GetScalarMode());
  this->SelectScalarArray(mapper->GetArrayId());
  this->SelectScalarArray(mapper->GetArrayName());
  this->SetArrayAccessMode(mapper->GetArrayAccessMode());
  this->SetBlendMode(mapper->GetBlendMode());
  this->SetAverageIPScalarRange(mapper->GetAverageIPScalarRange());
  this->SetCropping(mapper->GetCropping());
  this->SetCroppingRegionPlanes(mapper->GetCroppingRegionPlanes());
  this->SetCroppingRegionFlags(mapper->GetCroppingRegionFlags());
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port == 0)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkRectilinearGrid");
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  }
  else
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetColorInputData(vtkImageData* image)
{
  this->SetInputDataInternal(1, image);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetColorArrayName(const char* name)
{
  const std::string newName = name ? name : "";
  if (this->ColorArrayName != newName)
  {
    this->ColorArrayName = newName;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetMacrocellBranching(int level, int branching)
{
  if (level < 0 || level >= MaximumNumberOfMacrocellLevels)
  {
    vtkErrorMacro("There is no macrocell level " << level << ": levels are 0 to "
                                                 << MaximumNumberOfMacrocellLevels - 1 << ".");
    return;
  }
  const int clamped = std::clamp(branching, 2, 64);
  if (this->MacrocellBranching[level] != clamped)
  {
    this->MacrocellBranching[level] = clamped;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::GetMacrocellBranching(int level)
{
  if (level < 0 || level >= MaximumNumberOfMacrocellLevels)
  {
    vtkErrorMacro("There is no macrocell level " << level << ": levels are 0 to "
                                                 << MaximumNumberOfMacrocellLevels - 1 << ".");
    return 0;
  }
  return this->MacrocellBranching[level];
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetTileSize(int width, int height)
{
  const int clamped[2] = { std::clamp(width, 1, 4096), std::clamp(height, 1, 4096) };
  if (this->TileSize[0] != clamped[0] || this->TileSize[1] != clamped[1])
  {
    this->TileSize[0] = clamped[0];
    this->TileSize[1] = clamped[1];
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetMacrocellMemory()
{
  const vtkirt::ImageField* volume = this->Internal->Source.GetVolume();
  return volume ? static_cast<vtkIdType>(volume->GetMacrocellMemory()) : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetBrickMemory()
{
  const vtkirt::ImageField* volume = this->Internal->Source.GetVolume();
  return volume ? static_cast<vtkIdType>(volume->GetBrickMemory()) : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetNumberOfBricks()
{
  const vtkirt::ImageField* volume = this->Internal->Source.GetVolume();
  return volume ? static_cast<vtkIdType>(volume->GetNumberOfBricks()) : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetMaximumNumberOfBricks()
{
  const vtkirt::ImageField* volume = this->Internal->Source.GetVolume();
  return volume ? static_cast<vtkIdType>(volume->GetMaximumNumberOfBricks()) : 0;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Display.ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  this->MacrocellBuildTime = 0.0;
  this->BrickBuildTime = 0.0;
  this->TraceTime = 0.0;
  this->ShadeTime = 0.0;
  this->DisplayTime = 0.0;
  this->NumberOfAccumulatedFrames = 0;
  if (!this->ProgressiveAccumulation)
  {
    this->Internal->Accumulations = {}; // and their memory
  }
  const Clock::time_point start = Clock::now();
  if (!vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()))
  {
    this->ReportOnce("The renderer is not in an OpenGL render window. Add it to a vtkRenderWindow, "
                     "and initialize the module vtkRenderingOpenGL2 (VTK_MODULE_INIT, "
                     "vtk_module_autoinit, or import vtkmodules.vtkRenderingOpenGL2).");
    return;
  }
  if (FindPass<vtkDualDepthPeelingPass>(volume))
  {
    this->ReportOnce("The renderer peels volumes, which isosurfaces cannot be. Call "
                     "UseDepthPeelingForVolumesOff() of the renderer, or, if every isosurface is "
                     "opaque, put the mapper in a vtkIsosurfaceVolume.");
    return;
  }
  if (!this->UpdateVolume(volume))
  {
    return;
  }

  this->InvokeEvent(vtkCommand::VolumeMapperRenderStartEvent, nullptr);
  if (this->RenderFrame(renderer, volume))
  {
    this->TimeToDraw = SecondsSince(start);
    if (!renderer->GetSelector() && this->TraceTime > 0.0)
    {
      // What was built is built; what remains grows with the number of rays.
      const double distance = static_cast<double>(this->ImageSampleDistance);
      this->Internal->SecondsOfFullFrame =
        (this->TraceTime + this->ShadeTime) * distance * distance + this->DisplayTime;
    }
  }
  this->InvokeEvent(vtkCommand::VolumeMapperRenderEndEvent, nullptr);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::ReportOnce(const std::string& problem)
{
  if (this->Internal->IsNews(problem, this->Internal->LastProblem))
  {
    vtkErrorMacro(<< problem);
  }
  return !problem.empty();
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::GetThreads()
{
  return this->NumberOfThreads > 0 ? this->NumberOfThreads : std::max(1, omp_get_max_threads());
}

//------------------------------------------------------------------------------
double* vtkIsosurfaceRayTraceMapper::GetBounds()
{
  auto* blocks = vtkCompositeDataSet::SafeDownCast(this->GetDataObjectInput());
  if (!blocks)
  {
    return this->Superclass::GetBounds();
  }
  this->Update();
  blocks->GetBounds(this->Bounds);
  return this->Bounds;
}

//------------------------------------------------------------------------------
vtkDataSet* vtkIsosurfaceRayTraceMapper::FindBlock(
  vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex)
{
  const Internals& internal = *this->Internal;
  const auto* block = internal.IsComposite ? internal.Blocks.FindBlock(cellId) : nullptr;
  cellInBlock = block ? cellId - block->FirstCell : cellId;
  flatIndex = block ? block->FlatIndex : 0;
  return block ? block->Data.Get() : this->GetDataSetInput();
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMapper::Internals::SelectGrid(vtkIsosurfaceRayTraceMapper* self)
{
  vtkDataObject* input = self->GetDataObjectInput();
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  this->IsComposite = composite != nullptr;
  this->Grid = vtkDataSet::SafeDownCast(input);
  if (composite)
  {
    const std::string problem = this->Blocks.Update(composite,
      { self->ScalarMode, self->ArrayAccessMode, self->ArrayId, self->ArrayName,
        self->ColorArrayName });
    this->Grid = this->Blocks.GetGrid();
    this->Scalars.Scalars = this->Blocks.GetScalars();
    this->Scalars.AreOfCells = this->Blocks.AreOfCells();
    return problem;
  }
  if (!vtkImageData::SafeDownCast(input) && !vtkRectilinearGrid::SafeDownCast(input))
  {
    return "There is no input. Give a vtkImageData, a vtkRectilinearGrid or composite data of them "
           "with SetInputData, SetInputDataObject or SetInputConnection.";
  }
  int association = 0;
  this->Scalars.Scalars = vtkAbstractMapper::GetScalars(this->Grid, self->ScalarMode,
    self->ArrayAccessMode, self->ArrayId, self->ArrayName, association);
  if (association == vtkDataObject::FIELD_ASSOCIATION_NONE)
  {
    this->Scalars.Scalars = nullptr; // Field data lie nowhere.
  }
  this->Scalars.AreOfCells = association == 1;
  return "";
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMapper::Internals::SelectScalars(
  vtkIsosurfaceRayTraceMapper* self, vtkVolumeProperty* property)
{
  const int mode = self->GetBlendMode();
  if (mode != vtkVolumeMapper::ISOSURFACE_BLEND && !GetProjection(mode))
  {
    return "The blend mode is one that this mapper does not have. Call SetBlendModeToIsoSurface(), "
           "SetBlendModeToMaximumIntensity() or SetBlendModeToMinimumIntensity(), or use another "
           "volume mapper.";
  }
  if (GetProjection(mode) && self->InterpolationMode == CUBIC)
  {
    return "Intensity projections are those of the trilinear interpolant. Call "
           "SetInterpolationModeToTrilinear(), or SetBlendModeToIsoSurface().";
  }
  std::string problem = this->SelectGrid(self);
  if (!problem.empty())
  {
    return problem;
  }
  this->PropertyComponent = 0;
  if (self->VectorMode == DISABLED)
  {
    const int count = this->Scalars.Scalars ? this->Scalars.Scalars->GetNumberOfComponents() : 1;
    if (count > VTK_MAX_VRCOMP)
    {
      return "The scalars have " + std::to_string(count) + " components, of which " +
        std::to_string(VTK_MAX_VRCOMP) +
        " at most can be chosen from by vtkVolumeProperty::SetComponentWeight. Call "
        "SetVectorModeToComponent() and SetVectorComponent(), or SetVectorModeToMagnitude().";
    }
    this->PropertyComponent = vtkIsosurfaceRayTraceScene::ChooseComponent(property, count);
    this->Scalars.Component = this->PropertyComponent;
  }
  else
  {
    this->Scalars.Component = self->VectorMode == MAGNITUDE
      ? vtkIsosurfaceRayTraceSource::Selection::Magnitude
      : self->VectorComponent;
  }
  problem = vtkIsosurfaceRayTraceSource::FindProblem(this->Grid, this->Scalars);
  problem += problem.empty() ? vtkIsosurfaceRayTraceScene::FindCroppingProblem(self) : "";
  problem += problem.empty() ? this->SelectColors(self) : "";
  return problem;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMapper::Internals::SelectColors(vtkIsosurfaceRayTraceMapper* self)
{
  auto* second = vtkImageData::SafeDownCast(self->GetInputDataObject(1, 0));
  this->ColorImage = second;
  this->ColorArray = nullptr;
  if (!second && self->ColorArrayName.empty())
  {
    return "";
  }
  this->ColorArray =
    vtkIsosurfaceRayTraceColors::FindArray(second ? second : this->Grid, self->ColorArrayName);
  if (this->ColorArray)
  {
    return "";
  }
  return "There are no point data " +
    (self->ColorArrayName.empty() ? std::string("scalars")
                                  : "named \"" + self->ColorArrayName + "\"") +
    (second ? " in the second input" : " in the input") +
    " to colour by. Give an array with a tuple for every point to SetColorArrayName.";
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::UpdateInputs()
{
  for (int port = 0; port < 2; ++port)
  {
    if (this->GetNumberOfInputConnections(port) > 0)
    {
      this->GetInputAlgorithm(port, 0)->Update();
    }
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::HasOnlyOpaqueSurfaces(vtkVolume* volume)
{
  this->UpdateInputs();
  Internals& internal = *this->Internal;
  if (!volume || GetProjection(this->BlendMode) ||
    !internal.SelectScalars(this, volume->GetProperty()).empty())
  {
    return false;
  }
  const std::vector<vtkirt::Isosurface> surfaces =
    vtkIsosurfaceRayTraceScene::GetSurfaces(volume->GetProperty(), internal.PropertyComponent);
  return !surfaces.empty() && AreOpaque(surfaces);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::UpdateVolume(vtkVolume* volume)
{
  this->UpdateInputs();
  Internals& internal = *this->Internal;
  vtkVolumeProperty* property = volume->GetProperty();
  if (this->ReportOnce(internal.SelectScalars(this, property)))
  {
    return false;
  }

  vtkirt::ImageSettings settings;
  settings.MacrocellBranching.assign(
    this->MacrocellBranching, this->MacrocellBranching + this->NumberOfMacrocellLevels);
  settings.Layout = static_cast<vtkirt::BrickLayout>(this->BrickLayout);
  settings.BrickSize = this->BrickSize;
  settings.BrickGroupSize = this->BrickGroupSize;

  const Clock::time_point start = Clock::now();
  if (internal.Source.Update(internal.Grid, internal.Scalars, settings, this->GetThreads()))
  {
    this->MacrocellBuildTime = SecondsSince(start);
  }
  const vtkIsosurfaceRayTraceGeometry& geometry = internal.Source.GetGeometry();
  internal.WorldFromIndex =
    vtkIsosurfaceRayTraceScene::GetWorldFromIndex(volume, geometry.GetPhysicalFromIndex());
  internal.Request.Planes = geometry.GetPlanes();
  internal.Request.Projection = GetProjection(this->BlendMode);
  internal.Request.Surfaces = internal.Request.Projection
    ? std::vector<vtkirt::Isosurface>()
    : vtkIsosurfaceRayTraceScene::GetSurfaces(property, internal.PropertyComponent);
  internal.Request.Field = static_cast<vtkirt::Interpolant>(this->InterpolationMode);
  internal.Request.Solver = static_cast<vtkirt::RootSolver>(this->RootSolver);
  internal.Request.Interpolations = this->NumberOfInterpolations;
  internal.Request.Visible = vtkIsosurfaceRayTraceScene::GetVisibility(
    this, this->CapClippingPlanes, internal.Source, internal.WorldFromIndex);
  internal.Request.MaximumMemory = this->MaximumBrickMemory > 0
    ? static_cast<std::size_t>(this->MaximumBrickMemory) << 20
    : std::numeric_limits<std::size_t>::max();
  return true;
}

//------------------------------------------------------------------------------
vtkirt::Scene vtkIsosurfaceRayTraceMapper::Internals::MakeScene(
  vtkIsosurfaceRayTraceMapper* self, vtkVolumeProperty* property, const View& view)
{
  vtkirt::Scene scene;
  scene.Threads = self->GetThreads();
  scene.TileWidth = self->TileSize[0];
  scene.TileHeight = self->TileSize[1];
  scene.Normals = static_cast<vtkirt::NormalMode>(self->NormalMode);
  scene.Request = this->Request;
  for (const vtkirt::Isosurface& surface : scene.Request.Surfaces)
  {
    scene.Colors.push_back(
      vtkIsosurfaceRayTraceScene::GetColor(property, this->PropertyComponent, surface.Isovalue));
  }
  scene.Look = vtkIsosurfaceRayTraceScene::GetMaterial(property, this->PropertyComponent);
  scene.Shadows = self->Shadows;
  scene.OcclusionRays = self->AmbientOcclusion ? self->NumberOfAmbientOcclusionRays : 0;
  if (self->AmbientOcclusionRadius > 0.0)
  {
    scene.OcclusionRadius = self->AmbientOcclusionRadius;
  }
  if (this->ColorArray)
  {
    this->Colors = std::make_unique<vtkIsosurfaceRayTraceColors>(
      this->ColorImage, this->ColorArray, this->Source, property, this->PropertyComponent);
    scene.ColorsOfHits = this->Colors.get();
  }
  if (scene.Request.Projection || scene.Request.Visible.HasCaps())
  {
    this->ValueColors =
      std::make_unique<vtkIsosurfaceRayTraceValueColors>(property, this->PropertyComponent);
    scene.ColorsOfValues = this->ValueColors.get();
  }
  scene.View = vtkIsosurfaceRayTraceScene::MakeCamera(
    view.ClipFromWorld, this->WorldFromIndex, view.Width, view.Height);
  scene.Pixels =
    vtkIsosurfaceRayTraceScene::GetPixels(scene.View, this->Source.GetVolume()->GetDimensions());
  return scene;
}

//------------------------------------------------------------------------------
vtkirt::Scene vtkIsosurfaceRayTraceMapper::Internals::MakeScene(vtkIsosurfaceRayTraceMapper* self,
  vtkVolumeProperty* property, const View& view, vtkRenderer* renderer,
  const vtkirt::PixelSampling& sampling)
{
  vtkirt::Scene scene = this->MakeScene(self, property, view);
  scene.Pixels = sampling.Align(scene.Pixels);
  vtkIsosurfaceRayTraceScene::AddLights(
    renderer->GetLights(), renderer->GetActiveCamera(), false, scene);
  scene.TwoSidedLighting = renderer->GetTwoSidedLighting() != 0;
  return scene;
}

//------------------------------------------------------------------------------
vtkirt::PixelSampling vtkIsosurfaceRayTraceMapper::Internals::ChooseSampling(
  vtkIsosurfaceRayTraceMapper* self, vtkRenderer* renderer, vtkVolume* volume) const
{
  if (vtkHardwareSelector* selector = renderer->GetSelector())
  {
    // A selection of points begins with a usual frame, and shows ids where they have its depth.
    return selector->GetFieldAssociation() == vtkDataObject::FIELD_ASSOCIATION_POINTS
      ? vtkirt::PixelSampling::FromDistance(static_cast<double>(self->ImageSampleDistance))
      : vtkirt::PixelSampling{};
  }
  const double allocated = volume->GetAllocatedRenderTime();
  // Eyes that see the same in other pixels would quarrel.
  if (self->AutoAdjustSampleDistances != 0 && allocated > 0.0 && !IsSecondEye(renderer))
  {
    // Rays become fewer with the square of their distance.
    const double enough = std::sqrt(this->SecondsOfFullFrame / allocated);
    const double wanted = enough > 1.0 ? std::ceil(enough) : 1.0 / std::floor(1.0 / enough);
    self->ImageSampleDistance =
      std::clamp(static_cast<float>(wanted), self->MinimumImageSampleDistance,
        std::max(self->MinimumImageSampleDistance, self->MaximumImageSampleDistance));
  }
  return vtkirt::PixelSampling::FromDistance(static_cast<double>(self->ImageSampleDistance));
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Internals::ReadDepths(vtkOpenGLRenderWindow* window,
  const vtkirt::PixelRectangle& viewport, const vtkirt::PixelSampling& sampling,
  vtkirt::Scene& scene)
{
  vtkirt::PixelRectangle pixels = sampling.ToPixels(scene.Pixels);
  pixels.Width = std::min(pixels.Width, viewport.Width - pixels.X);
  pixels.Height = std::min(pixels.Height, viewport.Height - pixels.Y);
  this->SceneDepths.resize(vtkirt::Count({ pixels.Width, pixels.Height, 1 }));
  vtkIsosurfaceRayTraceImageDisplay::ReadDepths(window, viewport.X + pixels.X,
    viewport.Y + pixels.Y, pixels.Width, pixels.Height, this->SceneDepths.data());
  if (sampling.Pixels != 1 || sampling.Rays != 1)
  {
    this->SceneDepths = vtkirt::TakeAtRays(sampling, scene.Pixels, this->SceneDepths, pixels);
  }
  scene.Depth = this->SceneDepths.data();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::RenderFrame(vtkRenderer* renderer, vtkVolume* volume)
{
  Internals& internal = *this->Internal;
  vtkHardwareSelector* selector = renderer->GetSelector();
  vtkirt::PixelSampling sampling = internal.ChooseSampling(this, renderer, volume);
  vtkSSAOPass* occlusion = selector ? nullptr : FindPass<vtkSSAOPass>(volume);
  if (occlusion)
  {
    sampling.Rays = 1; // A pixel has one point, and the pass softens edges itself.
  }
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  const vtkirt::PixelRectangle viewport = GetDrawnViewport(window);
  const Internals::View view = { vtkIsosurfaceRayTraceScene::GetClipFromWorldOfEye(
                                   renderer->GetActiveCamera(), renderer->GetTiledAspectRatio()),
    sampling.ToRays(viewport.Width), sampling.ToRays(viewport.Height) };
  vtkirt::Scene scene = internal.MakeScene(this, volume->GetProperty(), view, renderer, sampling);
  if (scene.Request.IsNothing() || scene.Pixels.Width == 0 || scene.Pixels.Height == 0)
  {
    return true;
  }

  const Clock::time_point depthStart = Clock::now();
  // With nothing drawn before, there is nothing to be hidden by. Render passes do not count. For a
  // selection of points the depth is also that of our own surfaces, rounded; there, the depth test
  // decides.
  const bool isHidden = renderer->GetNumberOfPropsRendered() > 0 ||
    renderer->GetPreserveDepthBuffer() || renderer->GetPass();
  if (isHidden && (!selector || scene.Request.Projection))
  {
    internal.ReadDepths(window, viewport, sampling, scene);
  }
  this->DisplayTime = SecondsSince(depthStart);

  scene.KeepHits = selector || occlusion;
  if (!internal.TraceFrame(this, renderer, volume->GetProperty(), sampling, scene))
  {
    return false;
  }

  const Clock::time_point displayStart = Clock::now();
  // A mean is not opaque where a surface ends.
  bool opaque = !scene.Request.Projection && AreOpaque(scene.Request.Surfaces) &&
    sampling.Rays == 1 && this->NumberOfAccumulatedFrames <= 1;
  if (selector)
  {
    const bool isComposite = internal.IsComposite;
    selector->BeginRenderProp();
    selector->RenderCompositeIndex(1);
    selector->UpdateMaximumCellId(
      isComposite ? internal.Blocks.GetNumberOfCells() : internal.Grid->GetNumberOfCells());
    selector->UpdateMaximumPointId(
      isComposite ? internal.Blocks.GetNumberOfPoints() : internal.Grid->GetNumberOfPoints());
    internal.WriteIds(selector, scene);
    if (sampling.Rays > 1)
    {
      vtkirt::TakeNearestRays(sampling.Rays, scene.Pixels.Width, internal.Picture);
    }
    opaque = !scene.Request.Projection;
  }
  const vtkirt::PixelRectangle pixels = sampling.ToPixels(scene.Pixels);
  const vtkIsosurfaceRayTraceImageDisplay::Image image = { viewport.X + pixels.X,
    viewport.Y + pixels.Y, pixels.Width, pixels.Height, scene.Pixels.Width / sampling.Rays,
    scene.Pixels.Height / sampling.Rays, internal.Picture.Colors.data(),
    internal.Picture.Depths.data(), opaque };
  if (occlusion && opaque)
  {
    std::vector<float> positions;
    std::vector<float> normals;
    internal.FindGeometry(this, renderer->GetActiveCamera(), positions, normals);
    const vtkIsosurfaceRayTraceImageDisplay::Geometry geometry = { occlusion, volume,
      positions.data(), normals.data() };
    internal.Display.Display(window, image, &geometry);
  }
  else
  {
    if (occlusion)
    {
      occlusion->SetShaderParameters(nullptr, this, volume); // Only colours are drawn.
    }
    internal.Display.Display(window, image, nullptr);
  }
  if (selector)
  {
    selector->EndRenderProp();
  }
  this->DisplayTime += SecondsSince(displayStart);
  return true;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::Internals::Trace(vtkIsosurfaceRayTraceMapper* self,
  const vtkirt::Scene& scene, const std::function<bool(double)>& keepGoing)
{
  vtkirt::FrameTimes times;
  const bool complete =
    vtkirt::RenderTiles(scene, *this->Source.GetVolume(), this->Picture, times, keepGoing);
  self->BrickBuildTime = times.Bricks;
  self->TraceTime = times.Trace;
  self->ShadeTime = times.Shade;
  return complete;
}

//------------------------------------------------------------------------------
std::vector<vtkObject*> vtkIsosurfaceRayTraceMapper::Internals::GetObjects(
  vtkIsosurfaceRayTraceMapper* self, vtkVolumeProperty* property) const
{
  std::vector<vtkObject*> objects = { self, property, this->Grid, this->Scalars.Scalars,
    this->ColorImage, this->ColorArray };
  if (auto* uneven = vtkRectilinearGrid::SafeDownCast(this->Grid))
  {
    objects.insert(objects.end(),
      { uneven->GetXCoordinates(), uneven->GetYCoordinates(), uneven->GetZCoordinates() });
  }
  return objects;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::Internals::TraceFrame(vtkIsosurfaceRayTraceMapper* self,
  vtkRenderer* renderer, vtkVolumeProperty* property, const vtkirt::PixelSampling& sampling,
  vtkirt::Scene& scene)
{
  // Ids and points have no mean, and a coarse picture is not there to stay.
  const bool accumulates = self->ProgressiveAccumulation && !scene.KeepHits && sampling.Pixels == 1;
  vtkIsosurfaceRayTraceAccumulation& accumulation =
    this->Accumulations[renderer->GetActiveCamera()->GetLeftEye() != 0 ? 0 : 1];
  vtkIsosurfaceRayTraceAccumulation::Key key;
  if (accumulates)
  {
    key = { this->GetObjects(self, property), static_cast<double>(self->ImageSampleDistance),
      scene };
    self->NumberOfAccumulatedFrames = accumulation.GetNumberOfFrames(key);
    vtkIsosurfaceRayTraceAccumulation::SetFrame(self->NumberOfAccumulatedFrames, scene);
  }
  if (!accumulates || self->NumberOfAccumulatedFrames < self->MaximumNumberOfAccumulatedFrames)
  {
    if (!this->Trace(self, scene,
          [self, renderer](double fraction)
          { return self->ReportProgress(renderer->GetRenderWindow(), fraction); }))
    {
      return false;
    }
    if (sampling.Rays > 1 && !scene.KeepHits)
    {
      vtkirt::AverageRays(sampling.Rays, scene.Pixels.Width, this->Picture);
    }
    if (accumulates)
    {
      accumulation.Add(key, this->Picture);
      ++self->NumberOfAccumulatedFrames;
    }
  }
  if (accumulates)
  {
    accumulation.GetMean(this->Picture);
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Internals::FindGeometry(vtkIsosurfaceRayTraceMapper* self,
  vtkCamera* camera, std::vector<float>& positions, std::vector<float>& normals) const
{
  vtkirt::Matrix4 viewFromWorld;
  std::copy_n(
    camera->GetModelViewTransformMatrix()->GetData(), viewFromWorld.size(), viewFromWorld.data());
  const auto count = static_cast<int>(this->Picture.Hits.size());
  positions.assign(3 * this->Picture.Hits.size(), 0.0F);
  normals.assign(3 * this->Picture.Hits.size(), 0.0F);
#pragma omp parallel for schedule(dynamic, 1024) num_threads(self->GetThreads())
  for (int i = 0; i < count; ++i)
  {
    const auto pixel = static_cast<std::size_t>(i);
    const vtkirt::Hit& hit = this->Picture.Hits[pixel];
    if (hit.Surface == vtkirt::Hit::NoSurface)
    {
      continue;
    }
    using vtkirt::operator*;
    const vtkirt::Vector3 position = vtkirt::TransformPoint(viewFromWorld,
      vtkirt::TransformPoint(this->WorldFromIndex, hit.GetPoint(this->Request.Planes)));
    vtkirt::Vector3 normal = vtkirt::Normalized(
      vtkirt::GradientToWorld(viewFromWorld, this->GetNormal(hit, self->NormalMode)));
    // As of polygons: towards the viewer, whose side is that of positive z.
    normal = normal[2] < 0.0 ? normal * -1.0 : normal;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      positions[3 * pixel + axis] = static_cast<float>(position[axis]);
      normals[3 * pixel + axis] = static_cast<float>(normal[axis]);
    }
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Internals::WriteIds(
  vtkHardwareSelector* selector, const vtkirt::Scene& scene)
{
  vtkirt::Frame& picture = this->Picture;
  for (std::size_t pixel = 0; pixel < picture.Hits.size(); ++pixel)
  {
    const vtkirt::Hit& hit = picture.Hits[pixel];
    std::uint8_t* color = &picture.Colors[4 * pixel];
    const bool isSeen = this->IsSeen(pixel);
    std::fill_n(color, 4, std::uint8_t{ 0 });
    picture.Depths[pixel] = vtkirt::Frame::NoSurface;
    if (!isSeen)
    {
      continue;
    }
    vtkIdType id = this->GetId(selector, hit);
    for (int channel = 0; channel < 3; ++channel, id >>= 8)
    {
      color[channel] = static_cast<std::uint8_t>(id & 0xff);
    }
    color[3] = 255;
    if (!this->Request.Projection) // of which a picture has no depth either
    {
      picture.Depths[pixel] = static_cast<float>(
        std::clamp(scene.View.GetDepth(hit.GetPoint(this->Request.Planes)), 0.0, 1.0));
    }
  }
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::Internals::GetId(
  vtkHardwareSelector* selector, const vtkirt::Hit& hit) const
{
  vtkirt::Vector3 parametric;
  switch (selector->GetCurrentPass())
  {
    case vtkHardwareSelector::POINT_ID_LOW24:
      return this->FindPoint(hit);
    case vtkHardwareSelector::POINT_ID_HIGH24:
      return this->FindPoint(hit) >> 24;
    case vtkHardwareSelector::CELL_ID_LOW24:
      return this->FindCell(hit, parametric);
    case vtkHardwareSelector::CELL_ID_HIGH24:
      return this->FindCell(hit, parametric) >> 24;
    default:
      break;
  }
  // The other passes ask for the same id of all of the volume, as a colour.
  const float* color = selector->GetPropColorValue();
  const auto byte = [color](int channel)
  { return static_cast<vtkIdType>(std::lround(255.0F * color[channel])); };
  return byte(0) | byte(1) << 8 | byte(2) << 16;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::IntersectWithLine(vtkVolume* volume, const double p1[3],
  const double p2[3], double& t, double x[3], double pcoords[3], vtkIdType& cellId,
  double& isovalue, double normal[3])
{
  if (!volume || !this->UpdateVolume(volume))
  {
    return 0;
  }
  Internals& internal = *this->Internal;
  const vtkirt::Vector3 from = { p1[0], p1[1], p1[2] };
  const vtkirt::Vector3 direction = { p2[0] - p1[0], p2[1] - p1[1], p2[2] - p1[2] };
  const vtkirt::RayHits hits = internal.Cast({ from }, { direction }, 1.0, 1);
  if (hits.Hits.empty())
  {
    return 0;
  }
  const vtkirt::Hit& hit = hits.Hits.front();
  t = hit.T;
  internal.Describe(hit, this->NormalMode, x, pcoords, cellId, isovalue, normal);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::CastRays(
  vtkVolume* volume, vtkPoints* origins, vtkDataArray* directions, vtkPolyData* output)
{
  if (!volume || !origins || !directions || !output || directions->GetNumberOfComponents() != 3 ||
    directions->GetNumberOfTuples() != origins->GetNumberOfPoints())
  {
    vtkErrorMacro("CastRays needs a volume, origins, as many directions of 3 components, and an "
                  "output.");
    return false;
  }
  output->Initialize();
  if (!this->UpdateVolume(volume))
  {
    return false;
  }
  const auto count = static_cast<std::size_t>(origins->GetNumberOfPoints());
  std::vector<vtkirt::Vector3> from(count);
  std::vector<vtkirt::Vector3> along(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    origins->GetPoint(static_cast<vtkIdType>(i), from[i].data());
    directions->GetTuple(static_cast<vtkIdType>(i), along[i].data());
  }
  Internals& internal = *this->Internal;
  const vtkirt::RayHits hits =
    internal.Cast(from, along, std::numeric_limits<double>::infinity(), this->GetThreads());
  internal.WriteHits(hits, this->NormalMode, output);
  return true;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::PickPixel(vtkRenderer* renderer, vtkVolume* volume, int column,
  int row, double x[3], double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3])
{
  if (!renderer || !volume || !this->UpdateVolume(volume))
  {
    return 0;
  }
  Internals& internal = *this->Internal;
  const vtkirt::PixelRectangle viewport = GetViewport(renderer);
  const Internals::View view = { vtkIsosurfaceRayTraceScene::GetClipFromWorld(
                                   renderer->GetActiveCamera(), renderer->GetTiledAspectRatio()),
    static_cast<double>(viewport.Width), static_cast<double>(viewport.Height) };
  vtkirt::Scene scene = internal.MakeScene(this, volume->GetProperty(), view, renderer, {});
  const int pixelX = column - viewport.X;
  const int pixelY = row - viewport.Y;
  if (!Contains(scene.Pixels, pixelX, pixelY))
  {
    return 0;
  }
  scene.Pixels = { pixelX, pixelY, 1, 1 };
  scene.KeepHits = true;
  internal.Trace(this, scene, [](double) { return true; });
  if (!internal.IsSeen(0))
  {
    return 0;
  }
  internal.Describe(
    internal.Picture.Hits.front(), this->NormalMode, x, pcoords, cellId, isovalue, normal);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::RenderToImage(vtkVolume* volume, vtkCamera* camera,
  vtkLightCollection* lights, int width, int height, vtkImageData* output)
{
  if (!volume || !camera || !output || width < 1 || height < 1)
  {
    vtkErrorMacro(
      "RenderToImage needs a volume, a camera, a size of at least 1 x 1 and an output.");
    return false;
  }
  if (!this->UpdateVolume(volume))
  {
    return false;
  }
  Internals& internal = *this->Internal;
  vtkirt::Scene scene = internal.MakeScene(this, volume->GetProperty(),
    { vtkIsosurfaceRayTraceScene::GetClipFromWorld(camera, static_cast<double>(width) / height),
      static_cast<double>(width), static_cast<double>(height) });
  vtkNew<vtkLightCollection> headlight;
  if (!lights)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToHeadlight();
    headlight->AddItem(light);
  }
  vtkIsosurfaceRayTraceScene::AddLights(lights ? lights : headlight, camera, true, scene);
  scene.KeepHits = true;
  internal.Trace(this, scene,
    [this](double fraction)
    {
      this->InvokeEvent(vtkCommand::VolumeMapperRenderProgressEvent, &fraction);
      return true;
    });
  output->Initialize();
  output->SetDimensions(width, height, 1);
  internal.WriteImage(this, volume->GetProperty(), scene, output);
  return true;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Internals::WriteImage(vtkIsosurfaceRayTraceMapper* self,
  vtkVolumeProperty* property, const vtkirt::Scene& scene, vtkImageData* output) const
{
  const vtkIdType count = output->GetNumberOfPoints();
  const int* size = output->GetDimensions();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto add = [count, output](
                     vtkDataArray* array, const char* name, int components, double none)
  {
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(count);
    array->Fill(none);
    output->GetPointData()->AddArray(array);
  };
  vtkNew<vtkUnsignedCharArray> colors;
  vtkNew<vtkFloatArray> depths;
  vtkNew<vtkDoubleArray> normals;
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkIdTypeArray> cellIds;
  vtkNew<vtkIntArray> isovalueIds;
  vtkNew<vtkDoubleArray> values;
  add(colors, "Colors", 4, 0.0);
  add(depths, "Depth", 1, 1.0);
  add(normals, "Normals", 3, nan);
  add(positions, "Position", 3, nan);
  add(cellIds, "CellId", 1, -1.0);
  if (scene.Request.Projection)
  {
    add(values, "Value", 1, nan);
  }
  else
  {
    add(isovalueIds, "IsovalueId", 1, -1.0);
  }
  output->GetPointData()->SetActiveScalars("Colors");

  const vtkirt::PixelRectangle& pixels = scene.Pixels;
  for (int y = 0; y < pixels.Height; ++y)
  {
    for (int x = 0; x < pixels.Width; ++x)
    {
      const std::size_t from = vtkirt::Offset({ x, y, 0 }, { pixels.Width, pixels.Height, 1 });
      const vtkirt::Hit& hit = this->Picture.Hits[from];
      if (hit.Surface == vtkirt::Hit::NoSurface)
      {
        continue;
      }
      const auto to = static_cast<vtkIdType>(
        vtkirt::Offset({ pixels.X + x, pixels.Y + y, 0 }, { size[0], size[1], 1 }));
      vtkirt::Vector3 position;
      vtkirt::Vector3 parametric;
      vtkirt::Vector3 normal;
      vtkIdType cellId = -1;
      double value = 0.0;
      this->Describe(
        hit, self->NormalMode, position.data(), parametric.data(), cellId, value, normal.data());
      colors->SetTypedTuple(to, &this->Picture.Colors[4 * from]);
      normals->SetTypedTuple(to, normal.data());
      positions->SetTypedTuple(to, position.data());
      cellIds->SetValue(to, cellId);
      if (scene.Request.Projection)
      {
        // A picture of values hides nothing in a window, but each has its place.
        depths->SetValue(
          to, static_cast<float>(scene.View.GetDepth(hit.GetPoint(this->Request.Planes))));
        values->SetValue(to, value);
      }
      else
      {
        depths->SetValue(to, std::min(this->Picture.Depths[from], 1.0F));
        isovalueIds->SetValue(to, vtkIsosurfaceRayTraceScene::FindIsovalue(property, value));
      }
    }
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::ReportProgress(vtkRenderWindow* window, double fraction)
{
  this->InvokeEvent(vtkCommand::VolumeMapperRenderProgressEvent, &fraction);
  return window->CheckAbortStatus() == 0;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent
     << "ArrayAccessMode: " << (this->ArrayAccessMode == VTK_GET_ARRAY_BY_ID ? "ById" : "ByName")
     << "\n";
  os << indent << "ArrayId: " << this->ArrayId << "\n";
  os << indent << "ArrayName: " << (this->ArrayName ? this->ArrayName : "(none)") << "\n";
  os << indent << "NormalMode: "
     << (this->NormalMode == INTERPOLANT_GRADIENT ? "InterpolantGradient" : "CentralDifferences")
     << "\n";
  const char* const interpolationModes[] = { "Trilinear", "Nearest", "Cubic" };
  os << indent << "InterpolationMode: " << interpolationModes[this->InterpolationMode] << "\n";
  const char* const solvers[] = { "Robust", "Analytic", "Marmitt", "Linear" };
  os << indent << "RootSolver: " << solvers[this->RootSolver] << "\n";
  os << indent << "NumberOfInterpolations: " << this->NumberOfInterpolations << "\n";
  const char* const layouts[] = { "NoBricks", "ApronBricks", "TwoLevelBricks" };
  os << indent << "BrickLayout: " << layouts[this->BrickLayout] << "\n";
  const char* const vectorModes[] = { "Disabled", "Magnitude", "Component" };
  os << indent << "VectorMode: " << vectorModes[this->VectorMode + 1] << "\n";
  os << indent << "VectorComponent: " << this->VectorComponent << "\n";
  os << indent << "ColorArrayName: " << this->ColorArrayName << "\n";
  os << indent << "CapClippingPlanes: " << (this->CapClippingPlanes ? "on" : "off") << "\n";
  os << indent << "Shadows: " << (this->Shadows ? "on" : "off") << "\n";
  os << indent << "AmbientOcclusion: " << (this->AmbientOcclusion ? "on" : "off") << "\n";
  os << indent << "NumberOfAmbientOcclusionRays: " << this->NumberOfAmbientOcclusionRays << "\n";
  os << indent << "AmbientOcclusionRadius: " << this->AmbientOcclusionRadius << "\n";
  os << indent << "ProgressiveAccumulation: " << (this->ProgressiveAccumulation ? "on" : "off")
     << "\n";
  os << indent << "MaximumNumberOfAccumulatedFrames: " << this->MaximumNumberOfAccumulatedFrames
     << "\n";
  os << indent << "NumberOfAccumulatedFrames: " << this->NumberOfAccumulatedFrames << "\n";
  os << indent << "BrickSize: " << this->BrickSize << "\n";
  os << indent << "BrickGroupSize: " << this->BrickGroupSize << "\n";
  os << indent << "MaximumBrickMemory: " << this->MaximumBrickMemory << "\n";
  os << indent << "NumberOfMacrocellLevels: " << this->NumberOfMacrocellLevels << "\n";
  os << indent << "MacrocellBranching:";
  for (int level = 0; level < this->NumberOfMacrocellLevels; ++level)
  {
    os << " " << this->MacrocellBranching[level];
  }
  os << "\n";
  os << indent << "TileSize: " << this->TileSize[0] << " x " << this->TileSize[1] << "\n";
  os << indent << "AutoAdjustSampleDistances: " << this->AutoAdjustSampleDistances << "\n";
  os << indent << "ImageSampleDistance: " << this->ImageSampleDistance << "\n";
  os << indent << "MinimumImageSampleDistance: " << this->MinimumImageSampleDistance << "\n";
  os << indent << "MaximumImageSampleDistance: " << this->MaximumImageSampleDistance << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "MacrocellBuildTime: " << this->MacrocellBuildTime << "\n";
  os << indent << "BrickBuildTime: " << this->BrickBuildTime << "\n";
  os << indent << "TraceTime: " << this->TraceTime << "\n";
  os << indent << "ShadeTime: " << this->ShadeTime << "\n";
  os << indent << "DisplayTime: " << this->DisplayTime << "\n";
  os << indent << "MacrocellMemory: " << this->GetMacrocellMemory() << "\n";
  os << indent << "BrickMemory: " << this->GetBrickMemory() << "\n";
  os << indent << "NumberOfBricks: " << this->GetNumberOfBricks() << "\n";
  os << indent << "MaximumNumberOfBricks: " << this->GetMaximumNumberOfBricks() << "\n";
}

VTK_ABI_NAMESPACE_END
