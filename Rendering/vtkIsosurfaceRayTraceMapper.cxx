// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceMapper.h"

#include "vtkIsosurfaceRayTraceEnumerators.h"
#include "vtkIsosurfaceRayTraceFrame.h"
#include "vtkIsosurfaceRayTraceHits.h"
#include "vtkIsosurfaceRayTraceHolder.h"
#include "vtkIsosurfaceRayTraceOutput.h"
#include "vtkIsosurfaceRayTracePicture.h"
#include "vtkIsosurfaceRayTraceProblems.h"
#include "vtkIsosurfaceRayTraceRequest.h"
#include "vtkIsosurfaceRayTraceScene.h"
#include "vtkIsosurfaceRayTraceSettings.h"
#include "vtkIsosurfaceRayTraceUse.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVolume.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <new>
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

/// Whether a rectangle in a viewport has a pixel of the window, which may be any number.
bool Contains(const vtkirt::PixelRectangle& pixels, const vtkirt::PixelRectangle& viewport,
  std::int64_t column, std::int64_t row)
{
  const std::int64_t x = column - viewport.X - pixels.X;
  const std::int64_t y = row - viewport.Y - pixels.Y;
  return x >= 0 && x < pixels.Width && y >= 0 && y < pixels.Height;
}

/// All zero before the input is first traced.
vtkirt::FieldStatistics GetStatistics(const vtkIsosurfaceRayTraceInput& input)
{
  const vtkirt::TracedField* field = input.GetField();
  return field ? field->GetStatistics() : vtkirt::FieldStatistics();
}

/// The names of parameters are those of IntersectWithLine.
void Copy(const vtkIsosurfaceRayTraceHits::Description& hit, double x[3], double pcoords[3],
  vtkIdType& cellId, double& isovalue, double normal[3])
{
  std::copy_n(hit.Position.begin(), 3, x);
  std::copy_n(hit.Parametric.begin(), 3, pcoords);
  cellId = hit.CellId;
  isovalue = hit.Value;
  std::copy_n(hit.Normal.begin(), 3, normal);
}

}

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfaceRayTraceMapper);

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMapper::vtkIsosurfaceRayTraceMapper()
  : Uses(std::make_unique<vtkIsosurfaceRayTraceUseState>())
  , Frame(std::make_unique<vtkIsosurfaceRayTraceFrame>())
{
  this->BlendMode = vtkVolumeMapper::ISOSURFACE_BLEND;
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMapper::~vtkIsosurfaceRayTraceMapper() = default;

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
vtkIdType vtkIsosurfaceRayTraceMapper::GetMacrocellMemory()
{
  return static_cast<vtkIdType>(GetStatistics(this->Uses->Input).HierarchyMemory);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetBrickMemory()
{
  return static_cast<vtkIdType>(GetStatistics(this->Uses->Input).CacheMemory);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetNumberOfBricks()
{
  return static_cast<vtkIdType>(GetStatistics(this->Uses->Input).NumberOfBricks);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetMaximumNumberOfBricks()
{
  return static_cast<vtkIdType>(GetStatistics(this->Uses->Input).MaximumNumberOfBricks);
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMapper::SelectInput(
  vtkIsosurfaceRayTraceGridInput& input, vtkVolume* volume)
{
  std::string problem =
    vtkIsosurfaceRayTraceRequest::FindProblem(this->BlendMode, this->GetSettings());
  if (!problem.empty())
  {
    return problem;
  }
  vtkIsosurfaceRayTraceGridInput::Choice choice;
  choice.ColorArrayName = this->ColorArrayName;
  if (this->VectorMode != DISABLED)
  {
    choice.Component = this->VectorMode == MAGNITUDE
      ? vtkIsosurfaceRayTraceSource::Selection::Magnitude
      : this->VectorComponent;
  }
  problem = input.Select(this, choice, volume->GetProperty());
  if (!problem.empty())
  {
    return problem;
  }
  problem = vtkIsosurfaceRayTraceProblems::FindInVolume(
    volume, input.GetPropertyComponent(), input.FindPhysicalFromObject());
  return problem.empty() ? vtkIsosurfaceRayTraceProblems::FindInPlanes(this->ClippingPlanes)
                         : problem;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Update()
{
  this->Update(-1);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Update(int /*port*/)
{
  // An update of this algorithm itself would stop here, as long as nothing is modified, though
  // another consumer may have let the producers replace the whole by a piece.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < this->GetNumberOfInputConnections(port); ++i)
    {
      vtkAlgorithmOutput* connection = this->GetInputConnection(port, i);
      vtkAlgorithm* producer = connection->GetProducer();
      producer->UpdateInformation();
      vtkInformation* output = producer->GetOutputInformation(connection->GetIndex());
      if (output->Has(Pipeline::WHOLE_EXTENT()))
      {
        output->Set(Pipeline::UPDATE_EXTENT(), output->Get(Pipeline::WHOLE_EXTENT()), 6);
      }
      output->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
      output->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
      output->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
      producer->Update(connection->GetIndex());
    }
  }
}

//------------------------------------------------------------------------------
std::unique_ptr<vtkIsosurfaceRayTraceRequest> vtkIsosurfaceRayTraceMapper::MakeRequest(
  const vtkIsosurfaceRayTraceUse& use, vtkVolume* volume)
{
  this->Update();
  vtkIsosurfaceRayTraceGridInput& input = use.GetInput();
  if (this->ReportOnce(this->SelectInput(input, volume)))
  {
    return nullptr;
  }
  vtkirt::ImageSettings layout;
  layout.MacrocellBranching.assign(
    this->MacrocellBranching, this->MacrocellBranching + this->NumberOfMacrocellLevels);
  layout.Layout = vtkIsosurfaceRayTraceEnumerators::ToBrickLayout(this->BrickLayout);
  layout.BrickSize = this->BrickSize;
  layout.BrickGroupSize = this->BrickGroupSize;

  const vtkIsosurfaceRayTraceSettings settings = this->GetSettings();
  const Clock::time_point start = Clock::now();
  if (input.Update(layout, settings.NumberOfThreads))
  {
    this->MacrocellBuildTime = SecondsSince(start);
  }
  return std::make_unique<vtkIsosurfaceRayTraceRequest>(
    settings, input, input.FindVisible(this), volume, this->ClippingPlanes);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::SendEvent(const vtkIsosurfaceRayTraceUse& use,
  const vtkIsosurfaceRayTraceRequest& request, unsigned long event, double* progress)
{
  // The observers of an event whose observer traces something are not asked again, without end.
  if (use.IsNested())
  {
    return true;
  }
  this->InvokeEvent(event, progress);
  return request.Input.IsIntact() ||
    !this->ReportOnce("An observer of this mapper's events has released or made shorter the arrays "
                      "that were being traced, so the picture is not complete. Change them between "
                      "frames.");
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::ReportBadAlloc()
{
  vtkErrorMacro("There is not enough memory. Call SetMaximumBrickMemory() or "
                "SetBrickLayoutToNoBricks(), or make the picture or the input smaller.");
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::ReportOnce(const std::string& problem)
{
  if (!problem.empty() && problem != this->LastProblem)
  {
    vtkErrorMacro(<< problem);
  }
  this->LastProblem = problem;
  return !problem.empty();
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
  if (vtkDataSet* block = this->Uses->GetLastInput().FindBlock(cellId, cellInBlock, flatIndex))
  {
    return block;
  }
  cellInBlock = cellId;
  flatIndex = 0;
  return this->GetDataSetInput();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::HasOnlyOpaqueSurfaces(vtkVolume* volume)
try
{
  const vtkIsosurfaceRayTraceUse use(this, *this->Uses);
  if (!use.IsAllowed() || !volume || this->BlendMode != vtkVolumeMapper::ISOSURFACE_BLEND)
  {
    return false;
  }
  this->Update();
  vtkIsosurfaceRayTraceGridInput& input = use.GetInput();
  if (!this->SelectInput(input, volume).empty())
  {
    return false;
  }
  const std::vector<vtkirt::Isosurface> surfaces =
    vtkIsosurfaceRayTraceScene::GetSurfaces(volume->GetProperty(), input.GetPropertyComponent());
  return !surfaces.empty() && vtkIsosurfaceRayTraceScene::AreOpaque(surfaces);
}
catch (const std::bad_alloc&)
{
  this->ReportBadAlloc();
  return false;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetTimes(const vtkIsosurfaceRayTracing::FrameTimes& times)
{
  this->BrickBuildTime = times.Bricks;
  this->TraceTime = times.Trace;
  this->ShadeTime = times.Shade;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
try
{
  const Clock::time_point start = Clock::now();
  const vtkIsosurfaceRayTraceUse use(this, *this->Uses);
  if (!use.IsAllowed())
  {
    return;
  }
  const std::string problem = use.IsNested()
    ? "An observer of this mapper's events renders it, which is tracing already. Render when the "
      "frame is complete: the render window sends vtkCommand::EndEvent then."
    : vtkIsosurfaceRayTraceFrame::FindProblem(renderer, volume);
  if (!problem.empty())
  {
    this->ReportOnce(problem);
    return;
  }
  this->MacrocellBuildTime = 0.0;
  this->SetTimes({});
  this->DisplayTime = 0.0;
  this->NumberOfAccumulatedFrames = 0;
  const vtkIsosurfaceRayTraceHolder holder(renderer, volume, this);
  const auto request = this->MakeRequest(use, volume);
  if (!request)
  {
    return;
  }

  const bool isComplete =
    this->SendEvent(use, *request, vtkCommand::VolumeMapperRenderStartEvent, nullptr) &&
    holder.CanDraw() && this->DrawFrame(use, *request, holder);
  if (isComplete)
  {
    this->TimeToDraw = SecondsSince(start);
  }
  this->SendEvent(use, *request, vtkCommand::VolumeMapperRenderEndEvent, nullptr);
}
catch (const std::bad_alloc&)
{
  this->ReportBadAlloc();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::DrawFrame(const vtkIsosurfaceRayTraceUse& use,
  const vtkIsosurfaceRayTraceRequest& request, const vtkIsosurfaceRayTraceHolder& holder)
{
  vtkRenderer* renderer = holder.GetRenderer();
  vtkVolume* volume = holder.GetVolume();
  this->ImageSampleDistance =
    this->Frame->ChooseSampleDistance(this->GetSettings(), renderer, volume);
  const bool isComplete =
    this->Frame->Render(this->GetSettings(), request, { renderer, volume, this },
      [this, &use, &request, &holder](double fraction)
      {
        return this->SendEvent(
                 use, request, vtkCommand::VolumeMapperRenderProgressEvent, &fraction) &&
          holder.GetWindow()->CheckAbortStatus() == 0 && holder.CanDraw();
      });
  this->SetTimes(this->Frame->GetTimes());
  this->DisplayTime = this->Frame->GetDisplayTime();
  this->NumberOfAccumulatedFrames = this->Frame->GetNumberOfAccumulatedFrames();
  return isComplete;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Frame->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::IntersectWithLine(vtkVolume* volume, const double p1[3],
  const double p2[3], double& t, double x[3], double pcoords[3], vtkIdType& cellId,
  double& isovalue, double normal[3])
try
{
  const vtkIsosurfaceRayTraceUse use(this, *this->Uses);
  const auto request = use.IsAllowed() && volume ? this->MakeRequest(use, volume) : nullptr;
  if (!request)
  {
    return 0;
  }
  const vtkirt::Vector3 from = { p1[0], p1[1], p1[2] };
  const vtkirt::Vector3 direction = { p2[0] - p1[0], p2[1] - p1[1], p2[2] - p1[2] };
  const vtkIsosurfaceRayTraceHits traced(*request);
  const vtkirt::RayHits hits = traced.Cast({ from }, { direction }, 1.0, 1);
  if (hits.Hits.empty())
  {
    return 0;
  }
  const vtkirt::Hit& hit = hits.Hits.front();
  t = hit.T;
  Copy(traced.Describe(hit), x, pcoords, cellId, isovalue, normal);
  return 1;
}
catch (const std::bad_alloc&)
{
  this->ReportBadAlloc();
  return 0;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::CastRays(
  vtkVolume* volume, vtkPoints* origins, vtkDataArray* directions, vtkPolyData* output)
try
{
  if (!volume || !origins || !directions || !output || directions->GetNumberOfComponents() != 3 ||
    directions->GetNumberOfTuples() != origins->GetNumberOfPoints())
  {
    vtkErrorMacro("CastRays needs a volume, origins, as many directions of 3 components, and an "
                  "output.");
    return false;
  }
  output->Initialize();
  const vtkIsosurfaceRayTraceUse use(this, *this->Uses);
  const auto request = use.IsAllowed() ? this->MakeRequest(use, volume) : nullptr;
  if (!request)
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
  const vtkirt::RayHits hits = vtkIsosurfaceRayTraceHits(*request).Cast(
    from, along, std::numeric_limits<double>::infinity(), this->GetSettings().NumberOfThreads);
  vtkIsosurfaceRayTraceOutput::WriteHits(*request, hits, output);
  return true;
}
catch (const std::bad_alloc&)
{
  this->ReportBadAlloc();
  return false;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::PickPixel(vtkRenderer* renderer, vtkVolume* volume, int column,
  int row, double x[3], double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3])
try
{
  const vtkIsosurfaceRayTraceUse use(this, *this->Uses);
  const bool isPossible = use.IsAllowed() && renderer && volume;
  const auto request = isPossible ? this->MakeRequest(use, volume) : nullptr;
  if (!request)
  {
    return 0;
  }
  const vtkirt::Matrix4 clipFromWorld = vtkIsosurfaceRayTraceScene::GetClipFromWorld(
    renderer->GetActiveCamera(), renderer->GetTiledAspectRatio());
  if (this->ReportOnce(
        vtkIsosurfaceRayTraceProblems::FindInView(clipFromWorld, renderer->GetLights())))
  {
    return 0;
  }
  vtkirt::PixelRectangle viewport;
  renderer->GetTiledSizeAndOrigin(&viewport.Width, &viewport.Height, &viewport.X, &viewport.Y);
  vtkIsosurfaceRayTracePicture picture;
  picture.SetScene(this->GetSettings(), *request,
    { clipFromWorld, static_cast<double>(viewport.Width), static_cast<double>(viewport.Height) });
  picture.AddLights(renderer);
  vtkirt::PixelRectangle& pixels = picture.Scene.Pixels;
  if (!Contains(pixels, viewport, column, row))
  {
    return 0;
  }
  pixels = { column - viewport.X, row - viewport.Y, 1, 1 };
  picture.Scene.KeepHits = true;
  picture.Trace(request->Execution, [](double) { return true; });
  this->SetTimes(picture.Times);
  if (!picture.IsVisible(0))
  {
    return 0;
  }
  const vtkirt::Hit& hit = picture.Frame.Hits.front();
  Copy(vtkIsosurfaceRayTraceHits(*request).Describe(hit), x, pcoords, cellId, isovalue, normal);
  return 1;
}
catch (const std::bad_alloc&)
{
  this->ReportBadAlloc();
  return 0;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::RenderToImage(vtkVolume* volume, vtkCamera* camera,
  vtkLightCollection* lights, int width, int height, vtkImageData* output)
try
{
  if (!volume || !camera || !output || width < 1 || height < 1)
  {
    vtkErrorMacro(
      "RenderToImage needs a volume, a camera, a size of at least 1 x 1 and an output.");
    return false;
  }
  const vtkIsosurfaceRayTraceUse use(this, *this->Uses);
  const auto request = use.IsAllowed() ? this->MakeRequest(use, volume) : nullptr;
  if (!request)
  {
    return false;
  }
  const vtkirt::Matrix4 clipFromWorld =
    vtkIsosurfaceRayTraceScene::GetClipFromWorld(camera, static_cast<double>(width) / height);
  if (this->ReportOnce(vtkIsosurfaceRayTraceProblems::FindInView(clipFromWorld, lights)))
  {
    return false;
  }
  vtkIsosurfaceRayTracePicture picture;
  picture.SetScene(this->GetSettings(), *request,
    { clipFromWorld, static_cast<double>(width), static_cast<double>(height) });
  vtkNew<vtkLightCollection> headlight;
  if (!lights)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToHeadlight();
    headlight->AddItem(light);
  }
  vtkIsosurfaceRayTraceScene::AddLights(lights ? lights : headlight, camera, true, picture.Scene);
  picture.Scene.KeepHits = true;
  const bool isComplete = picture.Trace(request->Execution,
    [this, &use, &request](double fraction) {
      return this->SendEvent(use, *request, vtkCommand::VolumeMapperRenderProgressEvent, &fraction);
    });
  this->SetTimes(picture.Times);
  if (!isComplete)
  {
    return false;
  }
  vtkIsosurfaceRayTraceOutput::WriteImage(*request, picture, width, height, output);
  return true;
}
catch (const std::bad_alloc&)
{
  this->ReportBadAlloc();
  return false;
}

VTK_ABI_NAMESPACE_END
