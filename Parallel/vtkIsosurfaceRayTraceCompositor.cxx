// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceCompositor.h"

#include "vtkIsosurfaceRayTraceAgreement.h"
#include "vtkIsosurfaceRayTraceBinarySwap.h"
#include "vtkIsosurfaceRayTraceMapper.h"
#include "vtkIsosurfaceRayTraceMeshMapper.h"
#include "vtkIsosurfaceRayTraceRecords.h"
#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkIsosurfaceRayTraceMPIExchange.h"
#endif

#include "vtkCamera.h"
#include "vtkCellProjectionMapper.h"
#include "vtkDoubleArray.h"
#include "vtkDummyController.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVolume.h"
#include "vtkVolumeCollection.h"

#include "Field/Stopwatch.h"
#include "Picture/RenderSharedTiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <type_traits>
#include <utility>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

vtkStandardNewMacro(vtkIsosurfaceRayTraceCompositor);

namespace
{

using vtkIsosurfaceRayTraceRecords::OpaquePixel;
using vtkIsosurfaceRayTraceRecords::ProjectedPixel;
using vtkIsosurfaceRayTraceRecords::SentFragment;

constexpr int PixelsTag = 31415;

//------------------------------------------------------------------------------
/// Calls function(mapper) with a mapper as one of those that trace isosurfaces, if it is one.
template <typename Function>
bool Visit(vtkAbstractMapper* mapper, const Function& function)
{
  if (auto* ofImages = vtkIsosurfaceRayTraceMapper::SafeDownCast(mapper))
  {
    return function(ofImages);
  }
  auto* ofMeshes = vtkIsosurfaceRayTraceMeshMapper::SafeDownCast(mapper);
  return ofMeshes && function(ofMeshes);
}

/// Whether a controller has messages that do not block.
bool SendsByMPI(vtkMultiProcessController* controller)
{
#if VTK_MODULE_ENABLE_VTK_ParallelMPI
  return vtkMPIController::SafeDownCast(controller) != nullptr;
#else
  (void)controller;
  return false;
#endif
}

/// Of a mapper that projects: 1 if it shows the smallest values, -1 if it shows the largest, so
/// that these times the sign are the smallest; 0 if it does not project.
double GetSignOfProjection(vtkAbstractMapper* mapper)
{
  auto* ofImages = vtkIsosurfaceRayTraceMapper::SafeDownCast(mapper);
  const int blendMode = ofImages ? ofImages->GetBlendMode() : vtkVolumeMapper::ISOSURFACE_BLEND;
  return blendMode == vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND ? -1.0
    : blendMode == vtkVolumeMapper::MINIMUM_INTENSITY_BLEND    ? 1.0
                                                               : 0.0;
}

bool DrawsClouds(vtkAbstractMapper* mapper)
{
  return vtkCellProjectionMapper::SafeDownCast(mapper) != nullptr;
}

/// Whether a mapper draws isosurfaces, and nothing else.
bool DrawsIsosurfaces(vtkAbstractMapper* mapper)
{
  if (auto* ofImages = vtkIsosurfaceRayTraceMapper::SafeDownCast(mapper))
  {
    return ofImages->GetBlendMode() == vtkVolumeMapper::ISOSURFACE_BLEND;
  }
  return vtkIsosurfaceRayTraceMeshMapper::SafeDownCast(mapper) && !DrawsClouds(mapper);
}

/// Gives an array of all rows to process 0, and an empty one to the others. Each process has those
/// from rows[2 * process] to rows[2 * process + 1] in the array. Returns the number of bytes sent.
template <typename Number>
vtkTypeInt64 GatherRows(const std::vector<int>& rows, vtkIdType numbersInRow, int height,
  vtkMultiProcessController* controller, std::vector<Number>& array)
{
  if (controller->GetLocalProcessId() > 0)
  {
    const auto size = static_cast<vtkIdType>(array.size());
    if (size > 0)
    {
      controller->Send(array.data(), size, 0, PixelsTag);
    }
    array.clear();
    return size * static_cast<vtkTypeInt64>(sizeof(Number));
  }
  std::vector<Number> whole(static_cast<std::size_t>(height * numbersInRow));
  std::copy(array.begin(), array.end(), whole.begin() + rows[0] * numbersInRow);
  for (std::size_t i = 2; i < rows.size(); i += 2)
  {
    const vtkIdType size = (rows[i + 1] - rows[i]) * numbersInRow;
    if (size > 0)
    {
      controller->Receive(
        whole.data() + rows[i] * numbersInRow, size, static_cast<int>(i / 2), PixelsTag);
    }
  }
  array = std::move(whole);
  return 0;
}

/// What is wrong with the mapper of a cloud or of a projection; empty if nothing is.
std::string FindProblemOfOne(vtkAbstractVolumeMapper* mapper, vtkMultiProcessController* controller)
{
  if (DrawsClouds(mapper))
  {
    return controller->GetNumberOfProcesses() == 1 || SendsByMPI(controller)
      ? ""
      : "Clouds of many processes are drawn by MPI alone: give the compositor a "
        "vtkMPIController, of a VTK with the module ParallelMPI.";
  }
  if (GetSignOfProjection(mapper) == 0.0)
  {
    return "The volume needs a vtkIsosurfaceRayTraceMapper with the blend mode ISOSURFACE_BLEND, "
           "MAXIMUM_INTENSITY_BLEND or MINIMUM_INTENSITY_BLEND, or a "
           "vtkIsosurfaceRayTraceMeshMapper.";
  }
  return mapper->GetNumberOfInputConnections(0) > 1
    ? "Projections of several connections are not composited. Give the mapper one input, such as a "
      "vtkPartitionedDataSet of all data."
    : "";
}

/// Updates the inputs of a mapper, if it has any. Filters before it may exchange data: so all
/// processes do that, be there data in them or not.
void UpdateInputs(vtkVolume* volume)
{
  vtkAbstractVolumeMapper* mapper = volume->GetMapper();
  if (mapper->GetNumberOfInputConnections(0) > 0)
  {
    mapper->Update();
  }
}

/// Whether a process has any data at all; points without cells are none.
bool HasData(vtkAbstractVolumeMapper* mapper)
{
  for (int i = 0; i < mapper->GetNumberOfInputConnections(0); ++i)
  {
    vtkDataObject* data = mapper->GetInputDataObject(0, i);
    if (data && data->GetNumberOfElements(vtkDataObject::POINT) > 0 &&
      data->GetNumberOfElements(vtkDataObject::CELL) > 0)
    {
      return true;
    }
  }
  return false;
}

}

//------------------------------------------------------------------------------
/// The arguments of RenderToImage but for its output.
struct vtkIsosurfaceRayTraceCompositor::View
{
  std::vector<vtkVolume*> Volumes;
  vtkCamera* Camera;
  vtkLightCollection* Lights;
  int Width;
  int Height;
  vtkFloatArray* Depths;

  vtkIdType GetNumberOfPixels() const { return static_cast<vtkIdType>(this->Width) * this->Height; }

  /// The mapper of the first volume, which is the only one unless all draw isosurfaces.
  vtkAbstractVolumeMapper* GetMapper() const { return this->Volumes.front()->GetMapper(); }

  std::vector<vtkIsosurfaceRayTraceAgreement::Item> Describe() const
  {
    return vtkIsosurfaceRayTraceAgreement::Describe(
      this->Volumes, this->Camera, this->Lights, this->Width, this->Height);
  }
};

//------------------------------------------------------------------------------
/// What the rays of this process met: the outputs of RenderToFragments of the volumes.
struct vtkIsosurfaceRayTraceCompositor::Fragments
{
  std::vector<vtkSmartPointer<vtkTable>> OfVolumes;

  bool AreOpaque() const
  {
    return std::all_of(
      this->OfVolumes.begin(), this->OfVolumes.end(), vtkIsosurfaceRayTraceRecords::AreOpaque);
  }

  template <typename Record>
  std::vector<Record> MakeRecords() const
  {
    std::vector<Record> all;
    for (vtkTable* fragments : this->OfVolumes)
    {
      std::vector<Record> records = vtkIsosurfaceRayTraceRecords::Make<Record>(fragments);
      all = all.empty() ? std::move(records)
                        : vtkIsosurfaceRayTraceBinarySwap<Record>::Merge(all, records);
    }
    return all;
  }
};

//------------------------------------------------------------------------------
/// Some rows of the picture.
struct vtkIsosurfaceRayTraceCompositor::Pixels
{
  int Width;
  int FirstRow;
  int EndRow;
  std::vector<unsigned char> Colors;
  std::vector<float> Depths;
  /// Of a projection.
  bool HaveValues;
  std::vector<double> Values;

  void SetRows(int first, int end)
  {
    const std::size_t count =
      static_cast<std::size_t>(end - first) * static_cast<std::size_t>(this->Width);
    this->FirstRow = first;
    this->EndRow = end;
    this->Colors.assign(4 * count, 0);
    this->Depths.assign(count, 1.0F);
    this->Values.assign(this->HaveValues ? count : 0, std::numeric_limits<double>::quiet_NaN());
  }

  void Write(vtkImageData* output) const
  {
    output->Initialize();
    if (this->EndRow == this->FirstRow)
    {
      return;
    }
    output->SetExtent(0, this->Width - 1, this->FirstRow, this->EndRow - 1, 0, 0);
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName("Colors");
    colors->SetNumberOfComponents(4);
    colors->SetNumberOfTuples(output->GetNumberOfPoints());
    std::copy(this->Colors.begin(), this->Colors.end(), colors->GetPointer(0));
    vtkNew<vtkFloatArray> depths;
    depths->SetName("Depth");
    depths->SetNumberOfTuples(output->GetNumberOfPoints());
    std::copy(this->Depths.begin(), this->Depths.end(), depths->GetPointer(0));
    output->GetPointData()->SetScalars(colors);
    output->GetPointData()->AddArray(depths);
    if (this->HaveValues)
    {
      vtkNew<vtkDoubleArray> values;
      values->SetName("Value");
      values->SetNumberOfTuples(output->GetNumberOfPoints());
      std::copy(this->Values.begin(), this->Values.end(), values->GetPointer(0));
      output->GetPointData()->AddArray(values);
    }
  }
};

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceCompositor::vtkIsosurfaceRayTraceCompositor() = default;
vtkIsosurfaceRayTraceCompositor::~vtkIsosurfaceRayTraceCompositor() = default;

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceCompositor::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkMultiProcessController* vtkIsosurfaceRayTraceCompositor::GetController()
{
  return this->Controller;
}

//------------------------------------------------------------------------------
/// That of the processes, which is there.
vtkSmartPointer<vtkMultiProcessController> vtkIsosurfaceRayTraceCompositor::FindController()
{
  vtkSmartPointer<vtkMultiProcessController> controller = this->Controller;
  if (!controller)
  {
    controller = vtkMultiProcessController::GetGlobalController();
  }
  if (!controller)
  {
    controller = vtkSmartPointer<vtkDummyController>::New();
  }
  return controller;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceCompositor::BroadcastCamera(vtkCamera* camera)
{
  std::array<double, 17> numbers{};
  camera->GetPosition(&numbers[0]);
  camera->GetFocalPoint(&numbers[3]);
  camera->GetViewUp(&numbers[6]);
  camera->GetClippingRange(&numbers[9]);
  camera->GetWindowCenter(&numbers[11]);
  numbers[13] = camera->GetViewAngle();
  numbers[14] = camera->GetUseHorizontalViewAngle();
  numbers[15] = camera->GetParallelProjection();
  numbers[16] = camera->GetParallelScale();
  this->FindController()->Broadcast(numbers.data(), numbers.size(), 0);
  camera->SetPosition(&numbers[0]);
  camera->SetFocalPoint(&numbers[3]);
  // The view of a camera that was turned (Azimuth) has other rounding than one from the same
  // numbers: all are computed anew, which a change alone does.
  camera->SetViewUp(-numbers[6], -numbers[7], -numbers[8]);
  camera->SetViewUp(&numbers[6]);
  camera->SetClippingRange(&numbers[9]);
  camera->SetWindowCenter(numbers[11], numbers[12]);
  camera->SetViewAngle(numbers[13]);
  camera->SetUseHorizontalViewAngle(static_cast<vtkTypeBool>(numbers[14]));
  camera->SetParallelProjection(static_cast<vtkTypeBool>(numbers[15]));
  camera->SetParallelScale(numbers[16]);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceCompositor::RenderToImage(vtkVolume* volume, vtkCamera* camera,
  vtkLightCollection* lights, int width, int height, vtkImageData* output, vtkFloatArray* depths)
{
  return this->Render({ { volume }, camera, lights, width, height, depths }, output);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceCompositor::RenderToImage(vtkVolumeCollection* volumes, vtkCamera* camera,
  vtkLightCollection* lights, int width, int height, vtkImageData* output, vtkFloatArray* depths)
{
  View view = { {}, camera, lights, width, height, depths };
  for (int i = 0; volumes && i < volumes->GetNumberOfItems(); ++i)
  {
    view.Volumes.push_back(vtkVolume::SafeDownCast(volumes->GetItemAsObject(i)));
  }
  return this->Render(std::move(view), output);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceCompositor::Render(View view, vtkImageData* output)
{
  const vtkSmartPointer<vtkMultiProcessController> controller = this->FindController();
  this->RenderTime = 0.0;
  this->CompositeTime = 0.0;
  this->BytesSent = 0;
  this->SegmentsFound = 0;
  this->SegmentsDrawn = 0;
  this->MostSegmentsStored = 0;
  // Whatever is wrong in a process, it takes part: the others would wait for it for ever.
  std::string problem = FindProblem(view, controller, output);
  const std::string disagreement = FindDisagreement(problem.empty() ? &view : nullptr, controller);
  problem = problem.empty() ? disagreement : problem;
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem);
  }
  if (!this->IsFineEverywhere(problem.empty(), controller))
  {
    return false;
  }
  std::for_each(view.Volumes.begin(), view.Volumes.end(), UpdateInputs);
  const vtkSmartPointer<vtkFloatArray> nearest = FindNearestDepths(view, controller);
  view.Depths = nearest;
  const bool isProjection = GetSignOfProjection(view.GetMapper()) != 0.0;
  Pixels pixels{ view.Width, 0, view.Height, {}, {}, isProjection, {} };
  const bool isMade = DrawsClouds(view.GetMapper())
    ? this->MakeCloud(view, controller, pixels)
    : this->MakeIsosurfaces(view, controller, pixels);
  if (!isMade)
  {
    return false;
  }
  const vtkirt::Stopwatch ofPicture;
  if (this->Gather)
  {
    this->GatherPixels(view.Height, controller, pixels);
  }
  pixels.Write(output);
  this->CompositeTime += ofPicture.GetSeconds();
  return true;
}

//------------------------------------------------------------------------------
/// The nearest depths of all processes; null if none has any.
vtkSmartPointer<vtkFloatArray> vtkIsosurfaceRayTraceCompositor::FindNearestDepths(
  const View& view, vtkMultiProcessController* controller)
{
  const int hasOwn = view.Depths ? 1 : 0;
  int hasAny = 0;
  controller->AllReduce(&hasOwn, &hasAny, 1, vtkCommunicator::MAX_OP);
  if (!hasAny)
  {
    return nullptr;
  }
  auto nearest = vtkSmartPointer<vtkFloatArray>::New();
  nearest->SetNumberOfValues(view.GetNumberOfPixels());
  std::vector<float> none;
  if (!hasOwn)
  {
    none.assign(static_cast<std::size_t>(view.GetNumberOfPixels()), 1.0F);
  }
  controller->AllReduce(hasOwn ? view.Depths->GetPointer(0) : none.data(), nearest->GetPointer(0),
    view.GetNumberOfPixels(), vtkCommunicator::MIN_OP);
  return nearest;
}

//------------------------------------------------------------------------------
/// Renders the isosurfaces or the projection of the own piece and composites those of all.
bool vtkIsosurfaceRayTraceCompositor::MakeIsosurfaces(
  const View& view, vtkMultiProcessController* controller, Pixels& pixels)
{
  const vtkirt::Stopwatch ofPiece;
  Fragments fragments;
  const bool isRendered = RenderPiece(view, fragments);
  this->RenderTime = ofPiece.GetSeconds();
  const vtkirt::Stopwatch ofPicture;
  if (!this->IsFineEverywhere(isRendered, controller))
  {
    return false;
  }
  if (pixels.HaveValues)
  {
    const double sign = GetSignOfProjection(view.GetMapper());
    this->Composite(vtkIsosurfaceRayTraceRecords::MakeOfValues(fragments.OfVolumes.front(), sign),
      controller, pixels);
    for (double& value : pixels.Values)
    {
      value *= sign;
    }
  }
  else
  {
    this->CompositeFragments(fragments, controller, pixels);
  }
  this->CompositeTime = ofPicture.GetSeconds();
  return true;
}

//------------------------------------------------------------------------------
/// Those that are opaque in all processes take fewer bytes.
void vtkIsosurfaceRayTraceCompositor::CompositeFragments(
  const Fragments& fragments, vtkMultiProcessController* controller, Pixels& pixels)
{
  const int isTranslucent = fragments.AreOpaque() ? 0 : 1;
  int isAnyTranslucent = 0;
  controller->AllReduce(&isTranslucent, &isAnyTranslucent, 1, vtkCommunicator::MAX_OP);
  if (isAnyTranslucent)
  {
    this->Composite(fragments.MakeRecords<SentFragment>(), controller, pixels);
  }
  else
  {
    this->Composite(fragments.MakeRecords<OpaquePixel>(), controller, pixels);
  }
}

//------------------------------------------------------------------------------
/// Renders the cloud of all processes: each has the pixels of some tiles, which are put together as
/// those of opaque surfaces are.
bool vtkIsosurfaceRayTraceCompositor::MakeCloud(
  const View& view, vtkMultiProcessController* controller, Pixels& pixels)
{
  const vtkirt::Stopwatch ofPiece;
  vtkNew<vtkImageData> own;
  const bool isRendered = this->RenderTiles(view, controller, own);
  this->RenderTime = ofPiece.GetSeconds();
  const vtkirt::Stopwatch ofPicture;
  if (!this->IsFineEverywhere(isRendered, controller))
  {
    return false;
  }
  this->Composite(vtkIsosurfaceRayTraceRecords::MakeOfPicture(own), controller, pixels);
  this->CompositeTime = ofPicture.GetSeconds();
  return true;
}

//------------------------------------------------------------------------------
/// Renders the tiles that this process owns; none if it has no data.
bool vtkIsosurfaceRayTraceCompositor::RenderTiles(
  const View& view, vtkMultiProcessController* controller, vtkImageData* own)
{
  auto* mapper = vtkCellProjectionMapper::SafeDownCast(view.GetMapper());
  const int hasData = HasData(mapper) ? 1 : 0;
  int withData = 0;
  controller->AllReduce(&hasData, &withData, 1, vtkCommunicator::SUM_OP);
#if VTK_MODULE_ENABLE_VTK_ParallelMPI
  if (withData > 1)
  {
    // Those without data do not take part.
    vtkSmartPointer<vtkMPIController> all = vtkMPIController::SafeDownCast(controller);
    if (withData < controller->GetNumberOfProcesses())
    {
      all.TakeReference(all->PartitionController(hasData, controller->GetLocalProcessId()));
    }
    if (!hasData)
    {
      return true;
    }
    vtkIsosurfaceRayTraceMPIExchange exchange(all);
    vtkirt::SharingCounts counts;
    const bool isRendered =
      mapper->RenderOwnTiles(view.Volumes.front(), view.Camera, view.Lights, view.Width,
        view.Height, { static_cast<std::size_t>(this->BufferDepth), this->PollingInterval },
        exchange, counts, own, view.Depths);
    this->SegmentsFound = counts.SegmentsFound;
    this->SegmentsDrawn = counts.SegmentsDrawn;
    this->MostSegmentsStored = counts.MostStored;
    this->BytesSent += counts.Bytes;
    return isRendered;
  }
#endif
  return !hasData ||
    mapper->RenderToImage(
      view.Volumes.front(), view.Camera, view.Lights, view.Width, view.Height, own, view.Depths);
}

//------------------------------------------------------------------------------
/// What is wrong with the arguments in this process; empty if nothing is.
std::string vtkIsosurfaceRayTraceCompositor::FindProblem(
  const View& view, vtkMultiProcessController* controller, vtkImageData* output)
{
  constexpr vtkTypeInt64 most = VTK_UNSIGNED_INT_MAX;
  const std::vector<vtkVolume*>& volumes = view.Volumes;
  const bool haveVolumes =
    !volumes.empty() && std::find(volumes.begin(), volumes.end(), nullptr) == volumes.end();
  if (!haveVolumes || !view.Camera || !output || view.Width < 1 || view.Height < 1 ||
    view.GetNumberOfPixels() > most)
  {
    return "RenderToImage needs a volume, a camera, a size of at least 1 x 1 and no more than 2^32 "
           "pixels, and an output.";
  }
  if (view.Depths &&
    (view.Depths->GetNumberOfComponents() != 1 ||
      view.Depths->GetNumberOfTuples() != view.GetNumberOfPixels()))
  {
    return "RenderToImage needs a depth for each pixel, or null where this process has drawn "
           "nothing.";
  }
  const bool areIsosurfaces = std::all_of(volumes.begin(), volumes.end(),
    [](vtkVolume* volume) { return DrawsIsosurfaces(volume->GetMapper()); });
  if (areIsosurfaces)
  {
    return "";
  }
  if (volumes.size() > 1)
  {
    return "Several volumes are composited as isosurfaces alone: each needs a "
           "vtkIsosurfaceRayTraceMapper with the blend mode ISOSURFACE_BLEND, or a "
           "vtkIsosurfaceRayTraceMeshMapper. Make a picture of each cloud and each projection.";
  }
  return FindProblemOfOne(view.GetMapper(), controller);
}

//------------------------------------------------------------------------------
/// In what this process differs from process 0; empty if in nothing. Without a view it differs in
/// nothing, nor do others from it.
std::string vtkIsosurfaceRayTraceCompositor::FindDisagreement(
  const View* view, vtkMultiProcessController* controller)
{
  std::vector<vtkIsosurfaceRayTraceAgreement::Item> items;
  std::vector<double> own;
  if (view)
  {
    items = view->Describe();
  }
  for (const vtkIsosurfaceRayTraceAgreement::Item& item : items)
  {
    own.push_back(static_cast<double>(item.Numbers.size()));
    own.insert(own.end(), item.Numbers.begin(), item.Numbers.end());
  }
  auto size = static_cast<vtkIdType>(own.size());
  controller->Broadcast(&size, 1, 0);
  std::vector<double> ofFirst = own;
  ofFirst.resize(static_cast<std::size_t>(size));
  controller->Broadcast(ofFirst.data(), size, 0);
  const auto areSame = [](double one, double other)
  { return one == other || (std::isnan(one) && std::isnan(other)); };
  std::size_t begin = 0;
  for (const vtkIsosurfaceRayTraceAgreement::Item& item : items)
  {
    const std::size_t end = begin + 1 + item.Numbers.size();
    const bool isSame = end <= ofFirst.size() &&
      std::equal(own.begin() + static_cast<std::ptrdiff_t>(begin),
        own.begin() + static_cast<std::ptrdiff_t>(end),
        ofFirst.begin() + static_cast<std::ptrdiff_t>(begin), areSame);
    if (!isSame && !ofFirst.empty())
    {
      return std::string("The ") + item.Name + " of process " +
        std::to_string(controller->GetLocalProcessId()) +
        " differ from those of process 0. Give all processes the same.";
    }
    begin = end;
  }
  return "";
}

//------------------------------------------------------------------------------
/// Whether all processes are. If not, process 0 reports which are not.
bool vtkIsosurfaceRayTraceCompositor::IsFineEverywhere(
  bool isFine, vtkMultiProcessController* controller)
{
  const int own = isFine ? 1 : 0;
  std::vector<int> all(static_cast<std::size_t>(controller->GetNumberOfProcesses()));
  controller->AllGather(&own, all.data(), 1);
  std::ostringstream failed;
  bool areOthers = false;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    failed << (all[i] ? "" : " " + std::to_string(i));
    areOthers = areOthers || (i > 0 && !all[i]);
  }
  // Of its own failure process 0 has said enough.
  if (controller->GetLocalProcessId() == 0 && areOthers)
  {
    vtkErrorMacro("There is no picture: see the errors of these processes:" << failed.str() << ".");
  }
  return failed.str().empty();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceCompositor::RenderPiece(const View& view, Fragments& fragments)
{
  bool areRendered = true;
  for (vtkVolume* volume : view.Volumes)
  {
    fragments.OfVolumes.push_back(vtkSmartPointer<vtkTable>::New());
    vtkTable* own = fragments.OfVolumes.back();
    const auto render = [&](auto* tracing)
    {
      return tracing->RenderToFragments(
        volume, view.Camera, view.Lights, view.Width, view.Height, own, view.Depths);
    };
    areRendered =
      (!HasData(volume->GetMapper()) || Visit(volume->GetMapper(), render)) && areRendered;
  }
  return areRendered;
}

//------------------------------------------------------------------------------
/// Composites the records of all processes, each of which gets some rows.
template <typename Record>
void vtkIsosurfaceRayTraceCompositor::Composite(
  std::vector<Record>&& own, vtkMultiProcessController* controller, Pixels& pixels)
{
  vtkIsosurfaceRayTraceBinarySwap<Record> swap(std::move(own), pixels.Width, pixels.EndRow);
  swap.Run(controller);
  this->BytesSent += swap.GetBytesSent();
  pixels.SetRows(swap.GetFirstRow(), swap.GetEndRow());
  const std::vector<Record>& records = swap.GetRecords();
  const Record* const end = records.data() + records.size();
  std::vector<vtkirt::Fragment> fragmentsOfPixel;
  for (const Record* first = records.data(); first != end;)
  {
    const Record* const next = std::find_if(
      first, end, [first](const Record& record) { return record.Pixel != first->Pixel; });
    const vtkirt::CompositedPixel made =
      vtkIsosurfaceRayTraceRecords::Composite(first, next, fragmentsOfPixel);
    const std::size_t place = first->Pixel -
      static_cast<std::size_t>(pixels.FirstRow) * static_cast<std::size_t>(pixels.Width);
    std::copy_n(made.Rgba, 4, &pixels.Colors[4 * place]);
    pixels.Depths[place] = std::min(made.Depth, 1.0F);
    if constexpr (std::is_same_v<Record, ProjectedPixel>)
    {
      pixels.Values[place] = first->Rank;
    }
    first = next;
  }
}

//------------------------------------------------------------------------------
/// Gives all rows to process 0.
void vtkIsosurfaceRayTraceCompositor::GatherPixels(
  int height, vtkMultiProcessController* controller, Pixels& pixels)
{
  const int processes = controller->GetNumberOfProcesses();
  const int own[2] = { pixels.FirstRow, pixels.EndRow };
  std::vector<int> rows(2 * static_cast<std::size_t>(processes));
  controller->AllGather(own, rows.data(), 2);
  this->BytesSent += GatherRows(rows, 4 * pixels.Width, height, controller, pixels.Colors);
  this->BytesSent += GatherRows(rows, pixels.Width, height, controller, pixels.Depths);
  if (pixels.HaveValues)
  {
    this->BytesSent += GatherRows(rows, pixels.Width, height, controller, pixels.Values);
  }
  pixels.FirstRow = 0;
  pixels.EndRow = controller->GetLocalProcessId() == 0 ? height : 0;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceCompositor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller.Get() << "\n";
  os << indent << "Gather: " << (this->Gather ? "On" : "Off") << "\n";
  os << indent << "RenderTime: " << this->RenderTime << "\n";
  os << indent << "CompositeTime: " << this->CompositeTime << "\n";
  os << indent << "BufferDepth: " << this->BufferDepth << "\n";
  os << indent << "PollingInterval: " << this->PollingInterval << "\n";
  os << indent << "SegmentsFound: " << this->SegmentsFound << "\n";
  os << indent << "SegmentsDrawn: " << this->SegmentsDrawn << "\n";
  os << indent << "MostSegmentsStored: " << this->MostSegmentsStored << "\n";
  os << indent << "BytesSent: " << this->BytesSent << "\n";
}

VTK_ABI_NAMESPACE_END
