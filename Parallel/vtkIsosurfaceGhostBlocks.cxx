// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceGhostBlocks.h"

#if __has_include("vtkCartesianGrid.h")
#include "vtkCartesianGrid.h"
#endif
#include "vtkCellData.h"
#include "vtkCommunicator.h"
#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkNonOverlappingAMR.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkUniformGrid.h"
#include "vtkUniformGridAMR.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersionMacros.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace
{

constexpr int BlockTag = 14142;

/// Whether a block has anything but flags. Those of other processes may be there without arrays.
bool HasArrays(vtkDataSet* block)
{
  const int flags = (block->GetPointGhostArray() ? 1 : 0) + (block->GetCellGhostArray() ? 1 : 0);
  return block->GetPointData()->GetNumberOfArrays() + block->GetCellData()->GetNumberOfArrays() >
    flags;
}

/// Where a block is, as all processes know it.
struct Place
{
  double Extent[6];
  double Origin[3];
  double Spacing[3];
  /// The largest spacing of the blocks that are near, its own included.
  double Coarsest[3];
  /// 1 if a coarser block has the cells in its middle, too, and 0 if not.
  double IsInCoarser;
};
static_assert(sizeof(Place) == 16 * sizeof(double), "Places are sent as numbers.");

Place FindPlace(vtkImageData* block)
{
  Place place;
  std::copy_n(block->GetExtent(), 6, place.Extent);
  std::copy_n(block->GetOrigin(), 3, place.Origin);
  std::copy_n(block->GetSpacing(), 3, place.Spacing);
  std::copy_n(block->GetSpacing(), 3, place.Coarsest);
  place.IsInCoarser = 0.0;
  return place;
}

double GetEnd(const Place& place, int side)
{
  return place.Origin[side / 2] + place.Extent[side] * place.Spacing[side / 2];
}

/// The nodes of a block depend on so many cells around it, of its own level and of those coarser.
constexpr double Reach = 4.0;

/// Whether the gap between blocks is less than that many cells of a size.
bool AreNear(const Place& a, const Place& b, const double* cell)
{
  bool areNear = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double distance = std::max(
      GetEnd(a, 2 * axis) - GetEnd(b, 2 * axis + 1), GetEnd(b, 2 * axis) - GetEnd(a, 2 * axis + 1));
    areNear = areNear && distance < Reach * cell[axis];
  }
  return areNear;
}

/// Whether the nodes of a block depend on another one's cells. If no coarser block has these, their
/// means take part where coarser nodes do, and those are as far away as the coarser cells.
bool DependsOn(const Place& block, const Place& other)
{
  double cell[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double own = other.IsInCoarser != 0.0 ? block.Spacing[axis] : block.Coarsest[axis];
    cell[axis] = std::max(own, other.Spacing[axis]);
  }
  return AreNear(block, other, cell);
}

bool IsCoarser(const Place& a, const Place& b)
{
  return a.Spacing[0] > 1.5 * b.Spacing[0] || a.Spacing[1] > 1.5 * b.Spacing[1] ||
    a.Spacing[2] > 1.5 * b.Spacing[2];
}

bool HasMiddleOf(const Place& block, const Place& other)
{
  bool hasMiddle = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double middle = 0.5 * (GetEnd(other, 2 * axis) + GetEnd(other, 2 * axis + 1));
    hasMiddle =
      hasMiddle && GetEnd(block, 2 * axis) < middle && middle < GetEnd(block, 2 * axis + 1);
  }
  return hasMiddle;
}

/// Finds what a block has to do with coarser ones.
void FindCoarser(const Place& other, Place& block)
{
  if (!IsCoarser(other, block))
  {
    return;
  }
  block.IsInCoarser = HasMiddleOf(other, block) ? 1.0 : block.IsInCoarser;
  if (AreNear(block, other, other.Spacing))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      block.Coarsest[axis] = std::max(block.Coarsest[axis], other.Spacing[axis]);
    }
  }
}

/// Whether both are the same cells, but for rounding.
bool AreSame(const Place& a, const Place& b)
{
  bool areSame = true;
  for (int side = 0; side < 6; ++side)
  {
    const double cell = std::min(a.Spacing[side / 2], b.Spacing[side / 2]);
    areSame = areSame && std::abs(GetEnd(a, side) - GetEnd(b, side)) < 0.5 * cell;
  }
  return areSame &&
    std::equal(a.Spacing, a.Spacing + 3, b.Spacing,
      [](double one, double other) { return std::abs(one - other) < 0.5 * std::min(one, other); });
}

/// Whether a process with some blocks needs another one.
bool Needs(const std::vector<Place>& blocks, const Place& other)
{
  return std::any_of(blocks.begin(), blocks.end(),
           [&other](const Place& block) { return DependsOn(block, other); }) &&
    std::none_of(
      blocks.begin(), blocks.end(), [&other](const Place& block) { return AreSame(block, other); });
}

/// The blocks of all processes.
std::vector<std::vector<Place>> Gather(
  const std::vector<Place>& own, vtkMultiProcessController* controller)
{
  constexpr vtkIdType size = sizeof(Place) / sizeof(double);
  const int processes = controller->GetNumberOfProcesses();
  const auto ownLength = size * static_cast<vtkIdType>(own.size());
  std::vector<vtkIdType> lengths(static_cast<std::size_t>(processes));
  controller->AllGather(&ownLength, lengths.data(), 1);
  std::vector<vtkIdType> offsets;
  vtkIdType length = 0;
  for (const vtkIdType ofProcess : lengths)
  {
    offsets.push_back(length);
    length += ofProcess;
  }
  std::vector<Place> all(static_cast<std::size_t>(length / size));
  controller->AllGatherV(reinterpret_cast<const double*>(own.data()),
    reinterpret_cast<double*>(all.data()), ownLength, lengths.data(), offsets.data());
  std::vector<std::vector<Place>> places;
  for (std::size_t i = 0; i < lengths.size(); ++i)
  {
    const Place* first = all.data() + offsets[i] / size;
    places.emplace_back(first, first + lengths[i] / size);
  }
  return places;
}

/// The blocks of all processes, and what each has to do with coarser ones.
std::vector<std::vector<Place>> GatherPlaces(
  const std::vector<vtkImageData*>& blocks, vtkMultiProcessController* controller)
{
  std::vector<Place> own;
  for (vtkImageData* block : blocks)
  {
    own.push_back(FindPlace(block));
  }
  for (const std::vector<Place>& ofProcess : Gather(own, controller))
  {
    for (const Place& other : ofProcess)
    {
      std::for_each(own.begin(), own.end(), [&other](Place& block) { FindCoarser(other, block); });
    }
  }
  return Gather(own, controller);
}

void Send(vtkImageData* block, int process, vtkMultiProcessController* controller)
{
  vtkNew<vtkImageData> image;
  image->ShallowCopy(block);
  controller->Send(image, process, BlockTag);
}

/// Receives a block, and hides its cells.
vtkSmartPointer<vtkUniformGrid> Receive(
  const Place& place, int process, vtkMultiProcessController* controller)
{
  vtkNew<vtkImageData> image;
  controller->Receive(image, process, BlockTag);
  auto block = vtkSmartPointer<vtkUniformGrid>::New();
  block->ShallowCopy(image);
  int extent[6];
  std::copy_n(place.Extent, 6, extent);
  block->SetExtent(extent);
  block->SetOrigin(place.Origin);
  block->SetSpacing(place.Spacing);
  vtkUnsignedCharArray* before = block->GetCellGhostArray();
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(vtkDataSetAttributes::GhostArrayName());
  flags->SetNumberOfValues(block->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < flags->GetNumberOfValues(); ++cell)
  {
    const int flag = before ? before->GetValue(cell) : 0;
    flags->SetValue(cell, static_cast<unsigned char>(flag | vtkDataSetAttributes::HIDDENCELL));
  }
  block->GetCellData()->AddArray(flags);
  return block;
}

/// Sends the own blocks that others need, and receives those that the own need.
std::vector<vtkSmartPointer<vtkUniformGrid>> Exchange(
  const std::vector<vtkImageData*>& blocks, vtkMultiProcessController* controller)
{
  const std::vector<std::vector<Place>> places = GatherPlaces(blocks, controller);
  const auto own = static_cast<std::size_t>(controller->GetLocalProcessId());
  std::vector<vtkSmartPointer<vtkUniformGrid>> ghosts;
  const auto send = [&](std::size_t process)
  {
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
      if (Needs(places[process], places[own][i]))
      {
        Send(blocks[i], static_cast<int>(process), controller);
      }
    }
  };
  const auto receive = [&](std::size_t process)
  {
    for (const Place& place : places[process])
    {
      if (Needs(places[own], place))
      {
        ghosts.push_back(Receive(place, static_cast<int>(process), controller));
      }
    }
  };
  // Of each pair the lower one sends first, so that no two wait for each other.
  for (std::size_t process = 0; process < places.size(); ++process)
  {
    if (process < own)
    {
      receive(process);
      send(process);
    }
    else if (process > own)
    {
      send(process);
      receive(process);
    }
  }
  return ghosts;
}

#if VTK_MAJOR_VERSION > 9 || (VTK_MAJOR_VERSION == 9 && VTK_MINOR_VERSION >= 6)
// Blocks may be rectilinear, too: those have no levels, and stay as they are.
vtkDataSet* GetBlock(vtkUniformGridAMR* amr, unsigned int level, unsigned int number)
{
  return amr->GetDataSetAsCartesianGrid(level, number);
}

unsigned int GetNumberOfBlocks(vtkUniformGridAMR* amr, unsigned int level)
{
  return amr->GetNumberOfBlocks(level);
}

void Initialize(const std::vector<unsigned int>& blocksOfLevels, vtkNonOverlappingAMR* amr)
{
  amr->Initialize(blocksOfLevels);
}
#else
vtkUniformGrid* GetBlock(vtkUniformGridAMR* amr, unsigned int level, unsigned int number)
{
  return amr->GetDataSet(level, number);
}

unsigned int GetNumberOfBlocks(vtkUniformGridAMR* amr, unsigned int level)
{
  return amr->GetNumberOfDataSets(level);
}

void Initialize(const std::vector<unsigned int>& blocksOfLevels, vtkNonOverlappingAMR* amr)
{
  const std::vector<int> counts(blocksOfLevels.begin(), blocksOfLevels.end());
  amr->Initialize(static_cast<int>(counts.size()), counts.data());
}
#endif

}

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfaceGhostBlocks);

//------------------------------------------------------------------------------
vtkIsosurfaceGhostBlocks::vtkIsosurfaceGhostBlocks() = default;
vtkIsosurfaceGhostBlocks::~vtkIsosurfaceGhostBlocks() = default;

//------------------------------------------------------------------------------
void vtkIsosurfaceGhostBlocks::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkMultiProcessController* vtkIsosurfaceGhostBlocks::GetController()
{
  return this->Controller;
}

//------------------------------------------------------------------------------
/// Null if there is a single process.
vtkSmartPointer<vtkMultiProcessController> vtkIsosurfaceGhostBlocks::FindController() const
{
  vtkSmartPointer<vtkMultiProcessController> controller = this->Controller;
  if (!controller)
  {
    controller = vtkMultiProcessController::GetGlobalController();
  }
  return controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr;
}

//------------------------------------------------------------------------------
/// Mappers call another one, each for itself.
void vtkIsosurfaceGhostBlocks::Update()
{
  if (const vtkSmartPointer<vtkMultiProcessController> controller = this->FindController())
  {
    this->UpdateInformation();
    auto* executive = vtkDemandDrivenPipeline::SafeDownCast(this->GetExecutive());
    vtkDataObject* output = this->GetOutputDataObject(0);
    const int isNew = !output || output->GetUpdateTime() < executive->GetPipelineMTime() ? 1 : 0;
    int isAnyNew = 0;
    controller->AllReduce(&isNew, &isAnyNew, 1, vtkCommunicator::MAX_OP);
    if (isAnyNew && !isNew)
    {
      this->Modified();
    }
  }
  this->Superclass::Update();
}

//------------------------------------------------------------------------------
int vtkIsosurfaceGhostBlocks::FillInputPortInformation(int, vtkInformation* info)
{
  // Others are an error, but the process takes part all the same: the others would wait for it.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceGhostBlocks::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkNonOverlappingAMR");
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceGhostBlocks::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* data = vtkDataObject::GetData(inputVector[0]);
  vtkSmartPointer<vtkUniformGridAMR> input = vtkUniformGridAMR::SafeDownCast(data);
  if (data && !input)
  {
    vtkErrorMacro("The input is a " << data->GetClassName()
                                    << ". Give a vtkOverlappingAMR or a vtkNonOverlappingAMR.");
  }
  if (!input)
  {
    input = vtkSmartPointer<vtkNonOverlappingAMR>::New();
  }
  auto* output = vtkNonOverlappingAMR::GetData(outputVector);
  std::vector<unsigned int> counts;
  std::vector<vtkImageData*> blocks;
  for (unsigned int level = 0; level < input->GetNumberOfLevels(); ++level)
  {
    counts.push_back(GetNumberOfBlocks(input, level));
    for (unsigned int i = 0; i < counts.back(); ++i)
    {
      auto* block = vtkImageData::SafeDownCast(GetBlock(input, level, i));
      if (block && HasArrays(block))
      {
        blocks.push_back(block);
      }
    }
  }
  std::vector<vtkSmartPointer<vtkUniformGrid>> ghosts;
  if (const vtkSmartPointer<vtkMultiProcessController> controller = this->FindController())
  {
    ghosts = Exchange(blocks, controller);
  }
  this->NumberOfGhostBlocks = static_cast<int>(ghosts.size());
  counts.push_back(static_cast<unsigned int>(ghosts.size()));
  Initialize(counts, output);
  for (unsigned int level = 0; level < input->GetNumberOfLevels(); ++level)
  {
    for (unsigned int i = 0; i < counts[level]; ++i)
    {
      auto* block = GetBlock(input, level, i);
      output->SetDataSet(level, i, block && HasArrays(block) ? block : nullptr);
    }
  }
  for (std::size_t i = 0; i < ghosts.size(); ++i)
  {
    output->SetDataSet(input->GetNumberOfLevels(), static_cast<unsigned int>(i), ghosts[i]);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceGhostBlocks::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller.Get() << "\n";
  os << indent << "NumberOfGhostBlocks: " << this->NumberOfGhostBlocks << "\n";
}

VTK_ABI_NAMESPACE_END
