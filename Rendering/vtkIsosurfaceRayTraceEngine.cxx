// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceEngine.h"

#include "vtkIsosurfaceRayTraceHints.h"
#include "vtkIsosurfaceRayTraceHits.h"
#include "vtkIsosurfaceRayTraceHolder.h"
#include "vtkIsosurfaceRayTraceInputs.h"
#include "vtkIsosurfaceRayTraceMapper.h"
#include "vtkIsosurfaceRayTraceMeshMapper.h"
#include "vtkIsosurfaceRayTraceOutput.h"
#include "vtkIsosurfaceRayTracePicture.h"
#include "vtkIsosurfaceRayTraceProblems.h"
#include "vtkIsosurfaceRayTraceRequest.h"
#include "vtkIsosurfaceRayTraceScene.h"
#include "vtkIsosurfaceRayTraceSettings.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkAlgorithmOutput.h"
#include "vtkBoundingBox.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkVolume.h"

#include "Field/Stopwatch.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <limits>
#include <string>
#include <utility>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// Told of the fraction done; false stops.
using KeepGoing = std::function<bool(double)>;

/// Whether a rectangle in a viewport has a pixel of the window, which may be any number.
bool Contains(const vtkirt::PixelRectangle& pixels, const vtkirt::PixelRectangle& viewport,
  std::int64_t column, std::int64_t row)
{
  const std::int64_t x = column - viewport.X - pixels.X;
  const std::int64_t y = row - viewport.Y - pixels.Y;
  return x >= 0 && x < pixels.Width && y >= 0 && y < pixels.Height;
}

/// A square of rays through a face of a box, from outside. Small squares of them follow each other:
/// packets of rays that are next to each other are traced faster than rows of them.
void MakeRaysThroughFace(
  const double box[6], int face, int count, vtkPoints* origins, vtkDataArray* directions)
{
  origins->SetDataTypeToDouble();
  directions->SetNumberOfComponents(3);
  const bool isLower = face % 2 == 0;
  const int axis = face / 2;
  const int second = (axis + 1) % 3;
  const int third = (axis + 2) % 3;
  const auto at = [box](int side, double part)
  { return box[2 * side] + part * (box[2 * side + 1] - box[2 * side]); };
  constexpr int edge = 8;
  for (int i = 0; i < count * count; ++i)
  {
    const int square = i / (edge * edge);
    const int x = square % (count / edge) * edge + i % edge;
    const int y = square / (count / edge) * edge + i / edge % edge;
    double origin[3];
    origin[axis] = at(axis, isLower ? -1.0 : 2.0);
    origin[second] = at(second, (x + 0.5) / count);
    origin[third] = at(third, (y + 0.5) / count);
    double direction[3] = { 0.0, 0.0, 0.0 };
    direction[axis] = isLower ? 1.0 : -1.0;
    origins->InsertNextPoint(origin);
    directions->InsertNextTuple(direction);
  }
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
vtkIsosurfaceRayTraceEngine::vtkIsosurfaceRayTraceEngine(
  vtkAbstractVolumeMapper* mapper, Client client)
  : Mapper(mapper)
  , TheClient(std::move(client))
  , Uses(this->TheClient.NewInput)
  , Reporter(mapper, this->TheClient.MemoryRemedy)
{
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceEngine::~vtkIsosurfaceRayTraceEngine() = default;

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceEngine* vtkIsosurfaceRayTraceEngine::Of(vtkAbstractMapper* mapper)
{
  if (auto* ofImages = vtkIsosurfaceRayTraceMapper::SafeDownCast(mapper))
  {
    return ofImages->Engine.get();
  }
  auto* ofMeshes = vtkIsosurfaceRayTraceMeshMapper::SafeDownCast(mapper);
  return ofMeshes ? ofMeshes->Engine.get() : nullptr;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceEngine::UpdateInputs(vtkAlgorithm* mapper)
{
  // An update of the mapper itself would stop there, as long as nothing is modified, though
  // another consumer may have let the producers replace the whole by a piece.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 0; port < mapper->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < mapper->GetNumberOfInputConnections(port); ++i)
    {
      vtkAlgorithmOutput* connection = mapper->GetInputConnection(port, i);
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
bool vtkIsosurfaceRayTraceEngine::FindBounds(
  vtkCompositeDataDisplayAttributes* attributes, double bounds[6])
try
{
  if (this->Mapper->GetNumberOfInputConnections(0) < 2 &&
    !vtkCompositeDataSet::SafeDownCast(this->Mapper->GetDataObjectInput()) &&
    !this->TheClient.GetConnectionVolume(0))
  {
    return false;
  }
  vtkMath::UninitializeBounds(bounds);
  UpdateInputs(this->Mapper);
  this->Bounds.Find(this->Mapper, this->TheClient.GetConnectionVolume, attributes,
    this->TheClient.GetSettings().NumberOfThreads, bounds);
  return true;
}
catch (const std::exception& exception)
{
  this->Reporter.ReportException(exception);
  return true;
}

//------------------------------------------------------------------------------
vtkirt::FieldStatistics vtkIsosurfaceRayTraceEngine::GetStatistics() const
{
  return this->Uses.Inputs->GetStatistics();
}

//------------------------------------------------------------------------------
vtkDataSet* vtkIsosurfaceRayTraceEngine::FindBlock(
  vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex)
{
  const vtkIsosurfaceRayTraceInputs& inputs = this->Uses.GetLastInputs();
  const int connection = std::max(0, inputs.FindConnection(cellId));
  cellInBlock = cellId;
  flatIndex = 0;
  if (const auto* block = inputs.Get(connection).FindBlockOfCell(cellInBlock))
  {
    flatIndex = block->FlatIndex;
    return block->Data;
  }
  return connection < this->Mapper->GetNumberOfInputConnections(0)
    ? vtkDataSet::SafeDownCast(this->Mapper->GetInputDataObject(0, connection))
    : nullptr;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceEngine::FindConnection(vtkIdType cellId) const
{
  return std::max(0, this->Uses.GetLastInputs().FindConnection(cellId));
}

//------------------------------------------------------------------------------
vtkVolume* vtkIsosurfaceRayTraceEngine::GetConnectionVolume(int connection) const
{
  return this->TheClient.GetConnectionVolume(connection);
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceEngine::SelectInputs(vtkIsosurfaceRayTraceInputs& inputs,
  const vtkIsosurfaceRayTraceRequest::DrawnVolumes& volumes, bool isOfPiece) const
{
  std::string problem = vtkIsosurfaceRayTraceRequest::FindProblem(this->TheClient.GetSettings());
  inputs.SetNumber(static_cast<int>(volumes.OfConnections.size()));
  const bool mayBeEmpty = isOfPiece || inputs.HasData();
  for (int i = 0; i < inputs.GetNumber() && problem.empty(); ++i)
  {
    vtkIsosurfaceRayTraceInput& input = inputs.Get(i);
    if (mayBeEmpty && !input.HasData())
    {
      input.SelectNothing();
      continue;
    }
    vtkVolume* own = volumes.OfConnections[static_cast<std::size_t>(i)];
    problem = input.Select(volumes.GetProperty(i));
    if (problem.empty())
    {
      problem = vtkIsosurfaceRayTraceProblems::FindInVolume(
        own ? own : volumes.Drawn, input.GetPropertyComponent(), input.FindPhysicalFromObject());
    }
    if (problem.empty() && own &&
      !vtkIsosurfaceRayTraceProblems::IsInvertible(volumes.FindWorldFromData(i)))
    {
      problem = "The matrices of its volume and of the one that is drawn have no finite product "
                "with an inverse. Give both finite numbers, and scales other than 0.";
    }
    if (!problem.empty() && !volumes.IsVisible(i))
    {
      input.SelectNothing();
      problem.clear();
    }
    if (!problem.empty() && inputs.GetNumber() > 1)
    {
      return "Connection " + std::to_string(i) + ": " + problem;
    }
  }
  return problem.empty()
    ? vtkIsosurfaceRayTraceProblems::FindInPlanes(this->Mapper->GetClippingPlanes())
    : problem;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceRequest::DrawnVolumes vtkIsosurfaceRayTraceEngine::FindVolumes(
  vtkVolume* drawn) const
{
  vtkIsosurfaceRayTraceRequest::DrawnVolumes volumes{ drawn, {} };
  const int connections = std::max(1, this->Mapper->GetNumberOfInputConnections(0));
  for (int i = 0; i < connections; ++i)
  {
    volumes.OfConnections.push_back(this->TheClient.GetConnectionVolume(i));
  }
  return volumes;
}

//------------------------------------------------------------------------------
std::unique_ptr<vtkIsosurfaceRayTraceRequest> vtkIsosurfaceRayTraceEngine::MakeRequest(
  const vtkIsosurfaceRayTraceUse& use, vtkVolume* volume, vtkIsosurfaceRayTraceLevel level,
  bool isOfPiece)
{
  this->Mapper->Update();
  vtkIsosurfaceRayTraceInputs& inputs = use.GetInputs();
  const vtkIsosurfaceRayTraceRequest::DrawnVolumes volumes = this->FindVolumes(volume);
  if (this->Reporter.ReportOnce(this->SelectInputs(inputs, volumes, isOfPiece)))
  {
    return nullptr;
  }
  const vtkIsosurfaceRayTraceSettings settings = this->TheClient.GetSettings();
  const vtkirt::Stopwatch watch;
  bool isBuilt = false;
  std::string leftOut;
  for (int i = 0; i < inputs.GetNumber(); ++i)
  {
    leftOut = leftOut.empty() ? inputs.Get(i).DescribeLeftOut() : leftOut;
    if (volumes.IsVisible(i))
    {
      isBuilt = inputs.Get(i).Update(settings.NumberOfThreads, level) || isBuilt;
    }
    else
    {
      inputs.Get(i).Hide();
    }
  }
  if (isBuilt || inputs.GetFractionRead() < 1.0)
  {
    this->HierarchyTime = watch.GetSeconds();
  }
  if (isBuilt) // Thousands of blocks are not asked in every frame.
  {
    this->Reporter.WarnOnce(inputs.GetWarning(), vtkIsosurfaceRayTraceReporter::Kind::Input);
  }
  this->Reporter.WarnOnce(leftOut, vtkIsosurfaceRayTraceReporter::Kind::LeftOut);
  auto request = std::make_unique<vtkIsosurfaceRayTraceRequest>(
    settings, inputs, volumes, this->Mapper->GetClippingPlanes());
  const double gradients = inputs.GetGradientSeconds();
  if (gradients > 0.0)
  {
    this->GradientTime = gradients;
  }
  return request;
}

//------------------------------------------------------------------------------
std::unique_ptr<vtkIsosurfaceRayTraceRequest> vtkIsosurfaceRayTraceEngine::MakeCompleteRequest(
  const vtkIsosurfaceRayTraceUse& use, vtkVolume* volume, bool isOfPiece)
{
  auto request = this->MakeRequest(use, volume, vtkIsosurfaceRayTraceLevel::Exact, isOfPiece);
  const bool isComplete = request &&
    this->ReadSamples(use, *request, std::numeric_limits<double>::infinity(), [] { return true; });
  return isComplete ? std::move(request) : nullptr;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::ReadSamples(const vtkIsosurfaceRayTraceUse& use,
  const vtkIsosurfaceRayTraceRequest& request, double seconds, const std::function<bool()>& mayGoOn)
{
  vtkIsosurfaceRayTraceInputs& inputs = request.Inputs;
  if (inputs.GetFractionRead() == 1.0)
  {
    return true;
  }
  double secondsOfReading = 0.0;
  while (inputs.GetFractionRead() < 1.0 && secondsOfReading < seconds)
  {
    const vtkirt::Stopwatch watch;
    inputs.ReadSlab(request.Execution.Threads);
    secondsOfReading += watch.GetSeconds();
    if (!this->SendProgressOfReading(use, request) || !mayGoOn())
    {
      return false;
    }
  }
  request.SelectAgain();
  this->HierarchyTime += secondsOfReading;
  if (inputs.GetFractionRead() == 1.0)
  {
    this->Reporter.WarnOnce(inputs.GetWarning(), vtkIsosurfaceRayTraceReporter::Kind::Input);
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::SendProgressOfReading(
  const vtkIsosurfaceRayTraceUse& use, const vtkIsosurfaceRayTraceRequest& request)
{
  if (use.IsNested())
  {
    return true;
  }
  this->Mapper->UpdateProgress(request.Inputs.GetFractionRead());
  return this->IsIntact(request);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::SendEvent(const vtkIsosurfaceRayTraceUse& use,
  const vtkIsosurfaceRayTraceRequest& request, unsigned long event, double* progress)
{
  // The observers of an event whose observer traces something are not asked again, without end.
  if (use.IsNested())
  {
    return true;
  }
  if (!this->Mapper->HasObserver(event))
  {
    return true;
  }
  this->Mapper->InvokeEvent(event, progress);
  return this->IsIntact(request);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::CheckAbort(
  const vtkIsosurfaceRayTraceRequest& request, vtkRenderWindow* window)
{
  const bool isAsked = window->HasObserver(vtkCommand::AbortCheckEvent) != 0;
  return window->CheckAbortStatus() != 0 || (isAsked && !this->IsIntact(request));
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::IsIntact(const vtkIsosurfaceRayTraceRequest& request)
{
  return request.Inputs.IsIntact(request.Execution.Threads) ||
    !this->Reporter.ReportOnce(
      "An observer of this mapper's events has released or made shorter the arrays "
      "that were being traced, so the picture is not complete. Change them between "
      "frames.");
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::HasOnlyOpaqueSurfaces(vtkVolume* volume)
{
  return this->FindOpacity(volume) == Opacity::Opaque;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceEngine::Opacity vtkIsosurfaceRayTraceEngine::FindOpacity(vtkVolume* volume)
try
{
  const vtkIsosurfaceRayTraceUse use(this->Mapper, this->Uses);
  const vtkIsosurfaceRayTraceSettings settings = this->TheClient.GetSettings();
  if (!use.IsAllowed() || !volume || settings.Projection || settings.HasCloud)
  {
    return Opacity::None;
  }
  this->Mapper->Update();
  vtkIsosurfaceRayTraceInputs& inputs = use.GetInputs();
  const vtkIsosurfaceRayTraceRequest::DrawnVolumes volumes = this->FindVolumes(volume);
  if (!this->SelectInputs(inputs, volumes).empty())
  {
    return Opacity::None;
  }
  bool areAny = false;
  bool areOpaque = true;
  for (int i = 0; i < inputs.GetNumber(); ++i)
  {
    const vtkIsosurfaceRayTraceInput& input = inputs.Get(i);
    vtkirt::TraceRequest request(vtkIsosurfaceRayTraceScene::GetSurfaces(
      volumes.GetProperty(i), input.GetPropertyComponent()));
    input.SetOpacities(request);
    const bool areVisible = volumes.IsVisible(i) && input.HasData() && !request.Surfaces.empty();
    areAny = areAny || areVisible;
    areOpaque = areOpaque && (!areVisible || request.HasOnlyOpaqueSurfaces());
  }
  return !areAny ? Opacity::None : areOpaque ? Opacity::Opaque : Opacity::Translucent;
}
catch (const std::exception& exception)
{
  this->Reporter.ReportException(exception);
  return Opacity::None;
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceEngine::Render(vtkRenderer* renderer, vtkVolume* volume)
try
{
  const vtkirt::Stopwatch watch;
  const vtkIsosurfaceRayTraceUse use(this->Mapper, this->Uses);
  if (!use.IsAllowed())
  {
    return 0.0;
  }
  const vtkIsosurfaceRayTraceReporter::Scope scope(this->Reporter, use, volume, renderer);
  const std::string problem = use.IsNested()
    ? "An observer of this mapper's events renders it, which is tracing already. Render when the "
      "frame is complete: the render window sends vtkCommand::EndEvent then."
    : vtkIsosurfaceRayTraceFrame::FindProblem(renderer, volume);
  if (!problem.empty())
  {
    this->Reporter.ReportOnce(problem);
    return 0.0;
  }
  this->HierarchyTime = 0.0;
  this->GradientTime = 0.0;
  this->Times = {};
  this->DisplayTime = 0.0;
  this->NumberOfAccumulatedFrames = 0;
  const vtkIsosurfaceRayTraceHolder holder(renderer, volume, this->Mapper);
  const auto request = this->MakeRequest(
    use, volume, this->Frame.ChooseLevel(this->TheClient.GetSettings(), renderer, volume));
  if (!request)
  {
    return 0.0;
  }
  // Hints look at the data, which observers may take.
  const bool isHintSafe = request->Inputs.GetFractionRead() == 1.0 ||
    !(this->Mapper->HasObserver(vtkCommand::ProgressEvent) ||
      holder.GetWindow()->HasObserver(vtkCommand::AbortCheckEvent));
  if (!this->ReadSamples(use, *request,
        vtkIsosurfaceRayTraceFrame::FindReadingTime(renderer, volume),
        [this, &request, &holder]
        { return !this->CheckAbort(*request, holder.GetWindow()) && holder.CanDraw(); }))
  {
    return 0.0;
  }
  if (isHintSafe && request->Inputs.GetFractionRead() == 1.0)
  {
    this->Reporter.WarnOnce(vtkIsosurfaceRayTraceHints::FindInRequest(
                              *request, this->TheClient.GetSettings(), renderer->GetLights()),
      vtkIsosurfaceRayTraceReporter::Kind::Hint);
  }

  const bool isComplete =
    this->SendEvent(use, *request, vtkCommand::VolumeMapperRenderStartEvent, nullptr) &&
    holder.CanDraw() && this->DrawFrame(use, *request, holder);
  const double seconds = isComplete ? watch.GetSeconds() : 0.0;
  this->SendEvent(use, *request, vtkCommand::VolumeMapperRenderEndEvent, nullptr);
  return seconds;
}
catch (const std::exception& exception)
{
  this->Reporter.ReportException(exception);
  return 0.0;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::DrawFrame(const vtkIsosurfaceRayTraceUse& use,
  const vtkIsosurfaceRayTraceRequest& request, const vtkIsosurfaceRayTraceHolder& holder)
try
{
  vtkRenderer* renderer = holder.GetRenderer();
  vtkVolume* volume = holder.GetVolume();
  vtkIsosurfaceRayTraceSettings settings = this->TheClient.GetSettings();
  settings.NumberOfAmbientOcclusionRays =
    this->Frame.ChooseOcclusionRays(settings, request.Inputs.IsCoarse(), renderer, volume);
  settings.ImageSampleDistance =
    this->Frame.ChooseSampleDistance(settings, request.Inputs.IsCoarse(), renderer, volume);
  this->TheClient.SetImageSampleDistance(settings.ImageSampleDistance);
  // Others are no part of a mean.
  settings.ProgressiveAccumulation = settings.ProgressiveAccumulation && request.Inputs.IsExact();
  const bool isComplete = this->Frame.Render(settings, request, { renderer, volume, this->Mapper },
    [this, &use, &request, &holder](double fraction)
    {
      return this->SendEvent(
               use, request, vtkCommand::VolumeMapperRenderProgressEvent, &fraction) &&
        !this->CheckAbort(request, holder.GetWindow()) && holder.CanDraw();
    });
  this->Times = this->Frame.GetTimes();
  this->DisplayTime = this->Frame.GetDisplayTime();
  this->NumberOfAccumulatedFrames = this->Frame.GetNumberOfAccumulatedFrames();
  return isComplete;
}
catch (const std::exception& exception)
{
  this->Reporter.ReportException(exception);
  return false;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceEngine::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Frame.ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceEngine::IntersectWithLine(vtkVolume* volume, const double p1[3],
  const double p2[3], double& t, double x[3], double pcoords[3], vtkIdType& cellId,
  double& isovalue, double normal[3])
try
{
  const vtkIsosurfaceRayTraceUse use(this->Mapper, this->Uses);
  const vtkIsosurfaceRayTraceReporter::Scope scope(this->Reporter, use, volume, nullptr);
  const auto request = use.IsAllowed() && volume ? this->MakeCompleteRequest(use, volume) : nullptr;
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
catch (const std::exception& exception)
{
  this->Reporter.ReportException(exception);
  return 0;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::CastRays(
  vtkVolume* volume, vtkPoints* origins, vtkDataArray* directions, vtkPolyData* output)
try
{
  if (!volume || !origins || !directions || !output || directions->GetNumberOfComponents() != 3 ||
    directions->GetNumberOfTuples() != origins->GetNumberOfPoints())
  {
    vtkErrorWithObjectMacro(this->Mapper,
      "CastRays needs a volume, origins, as many directions of 3 components, and an "
      "output.");
    return false;
  }
  // Those may be of the output.
  const auto count = static_cast<std::size_t>(origins->GetNumberOfPoints());
  std::vector<vtkirt::Vector3> from(count);
  std::vector<vtkirt::Vector3> along(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    origins->GetPoint(static_cast<vtkIdType>(i), from[i].data());
    directions->GetTuple(static_cast<vtkIdType>(i), along[i].data());
  }
  output->Initialize();
  const vtkIsosurfaceRayTraceUse use(this->Mapper, this->Uses);
  const vtkIsosurfaceRayTraceReporter::Scope scope(this->Reporter, use, volume, nullptr);
  const auto request = use.IsAllowed() ? this->MakeCompleteRequest(use, volume) : nullptr;
  if (!request)
  {
    return false;
  }
  const vtkirt::RayHits hits = vtkIsosurfaceRayTraceHits(*request).Cast(from, along,
    std::numeric_limits<double>::infinity(), this->TheClient.GetSettings().NumberOfThreads);
  vtkIsosurfaceRayTraceOutput::WriteHits(*request, hits, output);
  return true;
}
catch (const std::exception& exception)
{
  this->Reporter.ReportException(exception);
  return false;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::FindSurfaceBounds(vtkVolume* volume, double bounds[6])
try
{
  // What is small is between few rays. Both are multiples of 8.
  constexpr int few = 64;
  constexpr int many = 512;
  vtkBoundingBox found;
  if (this->AddHitsThroughFaces(volume, few, found) && !found.IsValid() && this->MayHit(volume))
  {
    this->AddHitsThroughFaces(volume, many, found);
  }
  if (!found.IsValid())
  {
    return false;
  }
  found.GetBounds(bounds);
  return true;
}
catch (const std::exception& exception)
{
  this->Reporter.ReportException(exception);
  return false;
}

//------------------------------------------------------------------------------
/// Whether there may be a surface in a volume that can be drawn.
bool vtkIsosurfaceRayTraceEngine::MayHit(vtkVolume* volume)
{
  const vtkIsosurfaceRayTraceUse use(this->Mapper, this->Uses);
  const auto request = use.IsAllowed() ? this->MakeCompleteRequest(use, volume) : nullptr;
  return request &&
    std::any_of(request->Volumes.begin(), request->Volumes.end(),
      [](const vtkIsosurfaceRayTraceRequest::Volume& each) { return each.GetField().MayHit(); });
}

//------------------------------------------------------------------------------
/// Adds the hits of squares of rays through the faces of a volume. Returns whether they are cast.
bool vtkIsosurfaceRayTraceEngine::AddHitsThroughFaces(
  vtkVolume* volume, int count, vtkBoundingBox& found)
{
  for (int face = 0; face < 6; ++face)
  {
    vtkNew<vtkPoints> origins;
    vtkNew<vtkDoubleArray> directions;
    vtkNew<vtkPolyData> hits;
    if (const double* box = volume ? volume->GetBounds() : nullptr)
    {
      MakeRaysThroughFace(box, face, count, origins, directions);
    }
    if (!this->CastRays(volume, origins, directions, hits))
    {
      return false;
    }
    for (vtkIdType i = 0; i < hits->GetNumberOfPoints(); ++i)
    {
      found.AddPoint(hits->GetPoint(i));
    }
  }
  return true;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceEngine::PickPixel(vtkRenderer* renderer, vtkVolume* volume, int column,
  int row, double x[3], double pcoords[3], vtkIdType& cellId, double& isovalue, double normal[3])
try
{
  const vtkIsosurfaceRayTraceUse use(this->Mapper, this->Uses);
  const vtkIsosurfaceRayTraceReporter::Scope scope(this->Reporter, use, volume, renderer);
  const bool isPossible = use.IsAllowed() && renderer && volume;
  const auto request = isPossible ? this->MakeCompleteRequest(use, volume) : nullptr;
  if (!request)
  {
    return 0;
  }
  const vtkirt::Matrix4 clipFromWorld = vtkIsosurfaceRayTraceScene::GetClipFromWorld(
    renderer->GetActiveCamera(), renderer->GetTiledAspectRatio());
  if (this->Reporter.ReportOnce(
        vtkIsosurfaceRayTraceProblems::FindInView(clipFromWorld, renderer->GetLights())))
  {
    return 0;
  }
  vtkirt::PixelRectangle viewport;
  renderer->GetTiledSizeAndOrigin(&viewport.Width, &viewport.Height, &viewport.X, &viewport.Y);
  vtkIsosurfaceRayTracePicture picture;
  picture.SetScene(this->TheClient.GetSettings(), *request,
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
  this->Times = picture.Times;
  if (!picture.IsVisible(0))
  {
    return 0;
  }
  const vtkirt::Hit& hit = picture.Frame.Hits.front();
  Copy(vtkIsosurfaceRayTraceHits(*request).Describe(hit), x, pcoords, cellId, isovalue, normal);
  return 1;
}
catch (const std::exception& exception)
{
  this->Reporter.ReportException(exception);
  return 0;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::RenderToImage(
  vtkVolume* volume, const PictureView& view, vtkImageData* output)
{
  return this->RenderPicture(
    "RenderToImage", volume, view, output,
    [this](vtkIsosurfaceRayTracePicture& picture, const vtkirt::Execution& execution,
      const KeepGoing& keepGoing)
    {
      picture.Scene.KeepHits = true;
      const vtkIsosurfaceRayTraceSettings settings = this->TheClient.GetSettings();
      return settings.ProgressiveAccumulation
        ? picture.TraceMean(settings.MaximumNumberOfAccumulatedFrames, execution, keepGoing)
        : picture.Trace(execution, keepGoing);
    },
    [this, &view, output](
      const vtkIsosurfaceRayTraceRequest& request, const vtkIsosurfaceRayTracePicture& picture)
    {
      vtkIsosurfaceRayTraceOutput::WriteImage(request, picture, view.Width, view.Height, output);
      std::string hint = vtkIsosurfaceRayTraceHints::FindInRequest(
        request, this->TheClient.GetSettings(), view.Lights);
      if (hint.empty())
      {
        hint = vtkIsosurfaceRayTraceHints::FindInView(request,
          vtkIsosurfaceRayTraceScene::GetClipFromWorld(
            view.Camera, static_cast<double>(view.Width) / view.Height));
      }
      this->Reporter.WarnOnce(hint, vtkIsosurfaceRayTraceReporter::Kind::Hint);
    });
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::RenderToFragments(
  vtkVolume* volume, const PictureView& view, vtkTable* output)
{
  if (this->TheClient.GetSettings().HasCloud)
  {
    vtkErrorWithObjectMacro(this->Mapper,
      "A cloud has no fragments: it fills the space between surfaces. Call RenderToImage.");
    return false;
  }
  return this->RenderPicture(
    "RenderToFragments", volume, view, output,
    [this](vtkIsosurfaceRayTracePicture& picture, const vtkirt::Execution& execution,
      const KeepGoing& keepGoing)
    {
      picture.Scene.KeepFragments = true;
      picture.Scene.KeepHits = this->TheClient.GetSettings().Projection.has_value();
      return picture.Trace(execution, keepGoing);
    },
    [&view, output](
      const vtkIsosurfaceRayTraceRequest& request, const vtkIsosurfaceRayTracePicture& picture)
    { vtkIsosurfaceRayTraceOutput::WriteFragments(request, picture, view.Width, output); });
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::RenderOwnTiles(vtkVolume* volume, const PictureView& view,
  const vtkirt::Sharing& sharing, vtkirt::MessageExchange& exchange, vtkirt::SharingCounts& counts,
  vtkImageData* output)
{
  bool hasAgreed = false;
  const bool isDone = this->RenderPicture(
    "RenderOwnTiles", volume, view, output,
    [&](vtkIsosurfaceRayTracePicture& picture, const vtkirt::Execution& execution,
      const KeepGoing& keepGoing)
    {
      hasAgreed = true;
      const vtkirt::Agreement agreement = this->AgreeOnPicture(picture, exchange);
      if (agreement == vtkirt::Agreement::Refused)
      {
        picture.Scene.Pixels = {};
        return true;
      }
      if (view.Depths)
      {
        picture.SetDepths(view.Depths->GetPointer(0), view.Width); // The rectangle is that of all.
      }
      const vtkirt::Stopwatch stopwatch;
      const bool isComplete = agreement == vtkirt::Agreement::Fine &&
        this->AgreeOnClouds(picture, exchange) &&
        vtkirt::RenderSharedTiles(
          picture.Scene, execution, sharing, exchange, picture.Frame, counts, keepGoing);
      picture.Times.Trace = stopwatch.GetSeconds();
      return isComplete;
    },
    [&view, output](
      const vtkIsosurfaceRayTraceRequest&, const vtkIsosurfaceRayTracePicture& picture)
    { vtkIsosurfaceRayTraceOutput::WriteColors(picture, view.Width, view.Height, output); });
  if (!hasAgreed)
  {
    vtkirt::AgreeOnPicture(nullptr, exchange);
  }
  return isDone;
}

//------------------------------------------------------------------------------
vtkirt::Agreement vtkIsosurfaceRayTraceEngine::AgreeOnPicture(
  vtkIsosurfaceRayTracePicture& picture, vtkirt::MessageExchange& exchange)
{
  const vtkirt::Agreement agreement = vtkirt::AgreeOnPicture(&picture.Scene, exchange);
  if (agreement == vtkirt::Agreement::DifferentFields)
  {
    vtkErrorWithObjectMacro(this->Mapper,
      << "The mappers of the processes draw different numbers of inputs; this one draws "
      << picture.Scene.Fields.size() << ". Give each the same connections.");
  }
  return agreement;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::AgreeOnClouds(
  vtkIsosurfaceRayTracePicture& picture, vtkirt::MessageExchange& exchange)
{
  const bool areSame = picture.AgreeOnClouds(exchange);
  if (!areSame)
  {
    vtkErrorWithObjectMacro(this->Mapper,
      "The scalars of the processes have different numbers of components, or some are colours of "
      "unsigned char and others are not. Give all processes the same.");
  }
  return areSame;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceEngine::HasFittingDepths(const char* name, const PictureView& view) const
{
  const bool isFitting = !view.Depths ||
    (view.Depths->GetNumberOfComponents() == 1 &&
      view.Depths->GetNumberOfTuples() == static_cast<vtkIdType>(view.Width) * view.Height);
  if (!isFitting)
  {
    vtkErrorWithObjectMacro(this->Mapper, << name << " needs a depth for each of the " << view.Width
                                          << " x " << view.Height
                                          << " pixels, or null where nothing is drawn already.");
  }
  return isFitting;
}

//------------------------------------------------------------------------------
/// Has a picture traced, and written to an output.
template <typename Trace, typename Write>
bool vtkIsosurfaceRayTraceEngine::RenderPicture(const char* name, vtkVolume* volume,
  const PictureView& view, vtkDataObject* output, const Trace& trace, const Write& write)
try
{
  if (!volume || !view.Camera || !output || view.Width < 1 || view.Height < 1)
  {
    vtkErrorWithObjectMacro(this->Mapper,
      << name << " needs a volume, a camera, a size of at least 1 x 1 and an output.");
    return false;
  }
  if (!this->HasFittingDepths(name, view))
  {
    return false;
  }
  const vtkIsosurfaceRayTraceUse use(this->Mapper, this->Uses);
  const vtkIsosurfaceRayTraceReporter::Scope scope(this->Reporter, use, volume, nullptr);
  const auto request =
    use.IsAllowed() ? this->MakeCompleteRequest(use, volume, view.IsOfPiece) : nullptr;
  if (!request)
  {
    return false;
  }
  const vtkirt::Matrix4 clipFromWorld = vtkIsosurfaceRayTraceScene::GetClipFromWorld(
    view.Camera, static_cast<double>(view.Width) / view.Height);
  if (this->Reporter.ReportOnce(
        vtkIsosurfaceRayTraceProblems::FindInView(clipFromWorld, view.Lights)))
  {
    return false;
  }
  vtkIsosurfaceRayTracePicture picture;
  picture.SetScene(this->TheClient.GetSettings(), *request,
    { clipFromWorld, static_cast<double>(view.Width), static_cast<double>(view.Height) });
  vtkNew<vtkLightCollection> headlight;
  if (!view.Lights)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToHeadlight();
    headlight->AddItem(light);
  }
  vtkIsosurfaceRayTraceScene::AddLights(
    view.Lights ? view.Lights : headlight, view.Camera, true, picture.Scene);
  if (view.Depths)
  {
    picture.SetDepths(view.Depths->GetPointer(0), view.Width);
  }
  const KeepGoing keepGoing = [this, &use, &request](double fraction) {
    return this->SendEvent(use, *request, vtkCommand::VolumeMapperRenderProgressEvent, &fraction);
  };
  const bool isComplete = trace(picture, request->Execution, keepGoing);
  this->Times = picture.Times;
  if (!isComplete)
  {
    return false;
  }
  write(*request, picture);
  return true;
}
catch (const std::exception& exception)
{
  this->Reporter.ReportException(exception);
  return false;
}

VTK_ABI_NAMESPACE_END
