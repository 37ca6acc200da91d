// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceInput.h"

#include "vtkIsosurfaceRayTraceAmrPart.h"
#include "vtkIsosurfaceRayTraceArrayColors.h"
#include "vtkIsosurfaceRayTraceCropping.h"
#include "vtkIsosurfaceRayTraceGridPart.h"
#include "vtkIsosurfaceRayTraceLattices.h"
#include "vtkIsosurfaceRayTraceMeshPart.h"
#include "vtkIsosurfaceRayTraceProblems.h"
#include "vtkIsosurfaceRayTraceScalars.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkUniformGridAMR.h"

#include "Math/Matrix.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Leaf = vtkIsosurfaceRayTraceLeaf;
using LeavesChange = vtkIsosurfaceRayTraceLeaves::Change;

/// Takes a part from those of some data; null if none is wanted.
template <typename Part, typename Function>
std::unique_ptr<Part> TakePart(std::multimap<vtkDataSet*, std::unique_ptr<Part>>& parts,
  vtkDataSet* data, const Function& isWanted)
{
  const auto [first, last] = parts.equal_range(data);
  const auto found =
    std::find_if(first, last, [&isWanted](const auto& part) { return isWanted(*part.second); });
  if (found == last)
  {
    return nullptr;
  }
  std::unique_ptr<Part> part = std::move(found->second);
  parts.erase(found);
  return part;
}

using AmrParts = std::vector<std::unique_ptr<vtkIsosurfaceRayTraceAmrPart>>;

template <typename Part>
AmrParts TakeAmrParts(std::multimap<vtkDataSet*, std::unique_ptr<Part>>& parts)
{
  AmrParts taken;
  while (std::unique_ptr<Part> part = TakePart(parts, nullptr,
           [](const Part& each)
           { return dynamic_cast<const vtkIsosurfaceRayTraceAmrPart*>(&each) != nullptr; }))
  {
    taken.emplace_back(static_cast<vtkIsosurfaceRayTraceAmrPart*>(part.release()));
  }
  return taken;
}

constexpr vtkirt::Matrix4 Identity = { 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0,
  0.0, 0.0, 0.0, 1.0 };

bool IsGrid(const Leaf& leaf)
{
  return vtkIsosurfaceRayTraceGridPart::IsGrid(leaf.Data);
}

/// The scalars of a leaf, chosen as others were.
vtkIsosurfaceRayTraceScalars ScalarsOf(const Leaf& leaf, const vtkIsosurfaceRayTraceScalars& chosen)
{
  vtkIsosurfaceRayTraceScalars scalars = chosen;
  scalars.Array = leaf.Scalars;
  return scalars;
}

/// Whether data are one of several pieces, as the pipeline has asked for them, or by their ghosts.
bool IsPiece(vtkDataObject* data)
{
  const int pieces = data->GetInformation()->Has(vtkDataObject::DATA_NUMBER_OF_PIECES())
    ? data->GetInformation()->Get(vtkDataObject::DATA_NUMBER_OF_PIECES())
    : 1;
  auto* grid = vtkDataSet::SafeDownCast(data);
  return pieces > 1 || (grid && grid->HasAnyGhostCells());
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceInput::vtkIsosurfaceRayTraceInput(vtkAbstractVolumeMapper* mapper,
  int connection, std::function<vtkIsosurfaceRayTraceInputSettings()> getSettings)
  : Mapper(mapper)
  , Connection(connection)
  , GetSettings(std::move(getSettings))
{
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceInput::~vtkIsosurfaceRayTraceInput() = default;

//------------------------------------------------------------------------------
vtkDataObject* vtkIsosurfaceRayTraceInput::GetData() const
{
  return this->Connection < this->Mapper->GetNumberOfInputConnections(0)
    ? this->Mapper->GetInputDataObject(0, this->Connection)
    : nullptr;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceInput::Select(vtkVolumeProperty* property)
{
  const vtkIsosurfaceRayTraceInputSettings settings = this->GetSettings();
  std::string problem = this->SelectLeaves(settings);
  if (!problem.empty())
  {
    return problem;
  }
  if (this->Leaves.Get().empty())
  {
    this->RemoveParts();
    return "";
  }
  // Leaves have as many components as the first.
  vtkIsosurfaceRayTraceScalars scalars;
  scalars.Array = this->Leaves.Get().front().Scalars;
  scalars.AreOfCells = this->Leaves.AreScalarsOfCells();
  problem = scalars.SelectComponent(settings.Component, property, this->PropertyComponent);
  if (!problem.empty())
  {
    return problem;
  }
  if (settings.TakesComponents && !settings.Component)
  {
    problem = this->SelectCloudComponents(property);
  }
  else
  {
    this->CloudComponents = {};
  }
  scalars.HasOthers = this->CloudComponents.Count > 1;
  if (!problem.empty())
  {
    return problem;
  }
  problem = this->UpdateParts(settings, scalars);
  if (!problem.empty())
  {
    return problem;
  }
  if (settings.Cropping)
  {
    problem = vtkIsosurfaceRayTraceCropping::FindProblem(settings.Cropping);
  }
  return problem.empty() ? this->SelectColors(settings) : problem;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceInput::MayHaveCloud() const
{
  const std::vector<Leaf>& leaves = this->Leaves.Get();
  return leaves.empty() ||
    std::any_of(leaves.begin(), leaves.end(),
      [](const Leaf& leaf) { return vtkIsosurfaceRayTraceMeshPart::IsMesh(leaf.Data); });
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceInput::HasData() const
{
  const auto hasPoints = [](vtkDataObject* data)
  { return data->GetNumberOfElements(vtkDataObject::POINT) > 0; };
  vtkDataObject* data = this->GetData();
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    return data && hasPoints(data);
  }
  // Not all of thousands of blocks are asked in every frame.
  const auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
  iterator->InitTraversal();
  while (!iterator->IsDoneWithTraversal() && !hasPoints(iterator->GetCurrentDataObject()))
  {
    iterator->GoToNextItem();
  }
  return !iterator->IsDoneWithTraversal();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceInput::SelectNothing()
{
  this->Leaves = {};
  this->IsComposite = false;
  this->RemoveParts();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceInput::RemoveParts()
{
  this->LeftOut = {};
  this->Field = nullptr;
  this->Parts.clear();
  this->Set.Clear();
  this->Objects = nullptr;
  this->ArePartsKept = false;
  this->PropertyComponent = 0;
  this->CloudComponents = { 0, false };
  this->ColorImage = nullptr;
  this->ColorArray = nullptr;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceInput::SelectLeaves(
  const vtkIsosurfaceRayTraceInputSettings& settings)
{
  vtkDataObject* input = this->GetData();
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  this->IsComposite = composite != nullptr;
  this->Attributes = settings.Attributes;
  const std::string colors = settings.ColorImage ? "" : settings.ColorArrayName;
  if (composite)
  {
    this->ChangeOfLeaves = std::max(this->ChangeOfLeaves,
      this->Leaves.Collect(composite, this->Mapper, colors, settings.Attributes, settings.Threads));
    const std::string problem = this->Leaves.GetLeftOut().Describe();
    if (!this->Leaves.Get().empty() || (problem.empty() && this->Leaves.AreSomeHidden()))
    {
      return "";
    }
    return problem.empty()
      ? "The composite input has no block with a volume and scalars of the requested kind. Give "
        "blocks of images, grids or meshes with scalars, or name an array with "
        "SetScalarModeToUsePointFieldData() (or SetScalarModeToUseCellFieldData()) and "
        "SelectScalarArray()."
      : problem;
  }
  auto* data = vtkDataSet::SafeDownCast(input);
  if (!data ||
    (!vtkIsosurfaceRayTraceGridPart::IsGrid(data) && !vtkIsosurfaceRayTraceMeshPart::IsMesh(data)))
  {
    return (input ? std::string("The input is a ") + input->GetClassName()
                  : std::string("There is no input")) +
      ". Give a vtkImageData, a vtkRectilinearGrid, a vtkUnstructuredGrid, a vtkStructuredGrid or "
      "composite data of them with SetInputData, SetInputDataObject or SetInputConnection.";
  }
  this->ChangeOfLeaves = LeavesChange::OfAnything;
  this->Leaves.Take(data, this->Mapper, colors);
  return this->Leaves.Get().front().Scalars
    ? ""
    : vtkIsosurfaceRayTraceScalars::DescribeMissing(this->Mapper, data);
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceInput::SelectCloudComponents(vtkVolumeProperty* property)
{
  using vtkIsosurfaceRayTraceClouds::FindComponents;
  const std::vector<Leaf>& leaves = this->Leaves.Get();
  this->CloudComponents = FindComponents(leaves.front().Scalars, property);
  const bool areAlike = std::all_of(leaves.begin(), leaves.end(),
    [this, property](const Leaf& leaf)
    { return FindComponents(leaf.Scalars, property).AreBytes == this->CloudComponents.AreBytes; });
  return areAlike
    ? vtkIsosurfaceRayTraceClouds::FindProblem(this->CloudComponents, property)
    : "Some blocks have colours of unsigned char, from 0 to 255, and others have colours from 0 to "
      "1. Give all blocks scalars of one type.";
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceInput::SelectColors(
  const vtkIsosurfaceRayTraceInputSettings& settings)
{
  const std::string& name = settings.ColorArrayName;
  vtkDataArray* const before = std::exchange(this->ColorArray, nullptr);
  if (this->ColorImage != settings.ColorImage)
  {
    this->ColorImage = settings.ColorImage;
    this->Objects = nullptr;
  }
  if (!this->ColorImage)
  {
    const bool haveColors = name.empty() ||
      std::all_of(this->Leaves.Get().begin(), this->Leaves.Get().end(),
        [](const Leaf& leaf) { return leaf.GetAnyColors(); });
    return haveColors ? "" : vtkIsosurfaceRayTraceColors::DescribeMissing(name);
  }
  this->ColorArray = vtkIsosurfaceRayTraceColors::FindArray(this->ColorImage, name);
  if (!this->ColorArray)
  {
    return vtkIsosurfaceRayTraceColors::DescribeMissingInImage(name);
  }
  if (this->ColorArray != before)
  {
    this->Objects = nullptr;
  }
  this->NumberOfColors = this->ColorArray->GetNumberOfTuples();
  const std::string problem = vtkIsosurfaceRayTraceGeometry::FindProblem(this->ColorImage);
  return problem.empty() ? "" : "The image to colour by (port 1): " + problem;
}

//------------------------------------------------------------------------------
/// Thousands of blocks are not put in order again for every frame.
std::string vtkIsosurfaceRayTraceInput::UpdateParts(
  const vtkIsosurfaceRayTraceInputSettings& settings, const vtkIsosurfaceRayTraceScalars& scalars)
{
  const bool isSameChoice = scalars.Component == this->Component &&
    scalars.HasOthers == this->HasOtherComponents && settings.Image == this->ImageSettings;
  if (this->ChangeOfLeaves == LeavesChange::None && this->ArePartsKept && isSameChoice &&
    this->ArePartsIntact(settings.Threads))
  {
    return "";
  }
  this->Objects = nullptr;
  this->ArePartsKept = false;
  this->ArePlaced = false;
  std::string problem = this->SelectParts(settings, scalars);
  if (!problem.empty())
  {
    return problem;
  }
  // Coordinates of rectilinear grids are modified by themselves.
  this->ArePartsKept = std::all_of(this->Leaves.Get().begin(), this->Leaves.Get().end(),
    [](const Leaf& leaf)
    {
      return vtkImageData::SafeDownCast(leaf.Data) ||
        vtkIsosurfaceRayTraceMeshPart::IsMesh(leaf.Data);
    });
  this->ChangeOfLeaves = LeavesChange::None;
  this->Component = scalars.Component;
  this->HasOtherComponents = scalars.HasOthers;
  this->ImageSettings = settings.Image;
  return "";
}

//------------------------------------------------------------------------------
/// Those of before are kept, if they are still of the same data.
std::string vtkIsosurfaceRayTraceInput::SelectParts(
  const vtkIsosurfaceRayTraceInputSettings& settings, const vtkIsosurfaceRayTraceScalars& scalars)
{
  // Those that have changed go at the end of this function, before new ones are built.
  FormerParts before;
  std::vector<const Part*> partsBefore;
  for (std::unique_ptr<Part>& part : this->Parts)
  {
    partsBefore.push_back(part.get());
    before.emplace(part->GetFirstData(), std::move(part));
  }
  this->Parts.clear();
  vtkirt::TracedField* field = nullptr;
  std::swap(field, this->Field); // It goes with the parts where memory is refused.
  std::vector<Leaf> grids;
  std::string first;
  this->LeftOut = this->Leaves.GetLeftOut();
  const auto leaveOut = [this, &first](const Leaf& leaf, const std::string& problem)
  {
    first = first.empty() ? problem : first;
    this->LeftOut.Add(leaf, problem);
  };
  for (const Leaf& leaf : this->Leaves.Get())
  {
    const std::string problem = IsGrid(leaf)
      ? vtkIsosurfaceRayTraceSource::FindProblem(leaf.Data, ScalarsOf(leaf, scalars))
      : this->AddMesh(leaf, settings, ScalarsOf(leaf, scalars), before);
    if (!problem.empty())
    {
      leaveOut(leaf, problem);
    }
    else if (IsGrid(leaf))
    {
      grids.push_back(leaf);
    }
  }
  if (vtkUniformGridAMR::SafeDownCast(this->GetData()))
  {
    this->AddAmr(settings, scalars, before, grids);
  }
  for (const std::vector<Leaf>& leaves : vtkIsosurfaceRayTraceLattices::Group(grids))
  {
    const std::string problem = this->AddGrid(leaves, settings, scalars, before);
    for (std::size_t i = 0; !problem.empty() && i < leaves.size(); ++i)
    {
      leaveOut(leaves[i], problem);
    }
  }
  if (std::equal(this->Parts.begin(), this->Parts.end(), partsBefore.begin(), partsBefore.end(),
        [](const std::unique_ptr<Part>& part, const Part* other) { return part.get() == other; }))
  {
    this->Field = field;
  }
  if (!this->Parts.empty())
  {
    return "";
  }
  return this->IsComposite ? this->LeftOut.Describe() : first;
}

//------------------------------------------------------------------------------
/// Makes the parts of AMR data, and removes their grids from the others.
void vtkIsosurfaceRayTraceInput::AddAmr(const vtkIsosurfaceRayTraceInputSettings& settings,
  const vtkIsosurfaceRayTraceScalars& scalars, FormerParts& before, std::vector<Leaf>& grids)
{
  // From VTK 9.6 on, blocks may be rectilinear: they have no levels, and are traced as in others.
  const auto rectilinear = std::stable_partition(grids.begin(), grids.end(),
    [](const Leaf& leaf) { return vtkImageData::SafeDownCast(leaf.Data) != nullptr; });
  AmrParts former;
  if (this->ChangeOfLeaves != LeavesChange::OfAnything)
  {
    former = TakeAmrParts(before);
  }
  this->Parts = vtkIsosurfaceRayTraceAmrPart::MakeParts({ grids.begin(), rectilinear }, scalars,
    settings.Image, settings.Cropping, settings.Threads, std::move(former), this->LeftOut);
  grids.erase(grids.begin(), rectilinear);
}

//------------------------------------------------------------------------------
/// Takes the mesh of a leaf from those before, if there is one; makes it, if there is none.
std::string vtkIsosurfaceRayTraceInput::AddMesh(const Leaf& leaf,
  const vtkIsosurfaceRayTraceInputSettings& settings, const vtkIsosurfaceRayTraceScalars& scalars,
  FormerParts& before)
{
  using Mesh = vtkIsosurfaceRayTraceMeshPart;
  auto* grid = vtkPointSet::SafeDownCast(leaf.Data);
  std::string problem = scalars.FindProblem(grid->GetNumberOfPoints(), grid->GetNumberOfCells());
  if (!problem.empty())
  {
    return problem;
  }
  problem = vtkIsosurfaceRayTraceProblems::FindInGhosts(grid);
  if (!problem.empty())
  {
    return problem;
  }
  std::unique_ptr<Part> part = TakePart(before, grid,
    [&](const Part& former)
    {
      const auto* mesh = dynamic_cast<const Mesh*>(&former);
      return mesh && mesh->IsOf(grid, scalars, settings.Tetrahedralize);
    });
  if (!part)
  {
    part = std::make_unique<Mesh>(grid, scalars, settings.Tetrahedralize);
    problem = static_cast<Mesh&>(*part).SelectCells(settings.Threads);
  }
  if (problem.empty())
  {
    static_cast<Mesh&>(*part).SetLeaf(leaf);
    this->Parts.push_back(std::move(part));
  }
  return problem;
}

//------------------------------------------------------------------------------
/// Returns why the leaves cannot be traced; else empty.
std::string vtkIsosurfaceRayTraceInput::AddGrid(const std::vector<Leaf>& leaves,
  const vtkIsosurfaceRayTraceInputSettings& settings, const vtkIsosurfaceRayTraceScalars& scalars,
  FormerParts& before)
{
  using Grid = vtkIsosurfaceRayTraceGridPart;
  std::unique_ptr<Part> part = TakePart(before, leaves.front().Data,
    [&leaves](const Part& former)
    {
      const auto* grid = dynamic_cast<const Grid*>(&former);
      return grid && grid->IsOf(leaves);
    });
  if (!part)
  {
    part = std::make_unique<Grid>();
  }
  const std::string problem = static_cast<Grid&>(*part).Select(
    leaves, scalars, settings.Image, settings.CacheDirectory, settings.Cropping);
  if (problem.empty())
  {
    this->Parts.push_back(std::move(part));
  }
  return problem;
}

//------------------------------------------------------------------------------
vtkirt::Matrix4 vtkIsosurfaceRayTraceInput::FindPhysicalFromObject() const
{
  return this->IsLone() ? this->Parts.front()->FindPhysicalFromObject() : Identity;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceInput::Update(int threads, vtkIsosurfaceRayTraceLevel level)
{
  this->Hide();
  if (this->Parts.empty())
  {
    this->PhysicalFromObject = Identity;
    this->CellSize = 1.0;
    return false;
  }
  this->Field = nullptr; // It goes with what cannot be built.
  bool isBuilt = false;
  const bool isLone = this->IsLone();
  for (const std::unique_ptr<Part>& part : this->Parts)
  {
    if (isLone || !part->IsBuiltOnDemand())
    {
      isBuilt = part->Update(threads) || isBuilt;
      this->ArePlaced = !part->SelectLevel(level, threads) && this->ArePlaced;
      this->AtCoarse = part->IsCoarse() || this->AtCoarse;
      ++this->NumberOfEagerParts;
      if (part->GetFractionRead() < 1.0)
      {
        this->UnreadParts.push_back(part.get());
      }
    }
  }
  if (!isLone)
  {
    if (!this->ArePlaced || !this->Set.Get())
    {
      this->Set.Join(this->Parts);
    }
    this->Field = this->Set.Get();
    this->PhysicalFromObject = this->Set.GetPhysicalFromObject();
    this->CellSize = this->Set.GetCellSize();
    this->ArePlaced = true;
    return isBuilt;
  }
  Part& part = *this->Parts.front();
  this->Set.Clear();
  this->Field = &part.GetField();
  this->PhysicalFromObject = part.FindPhysicalFromObject();
  this->CellSize = part.FindCellSize();
  return isBuilt;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceInput::Hide()
{
  this->Field = &this->Empty;
  this->NumberOfEagerParts = 0;
  this->UnreadParts.clear();
  this->AtCoarse = false;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceInput::ReadSlab(int threads)
{
  if (this->UnreadParts.empty())
  {
    return;
  }
  Part& part = *this->UnreadParts.back();
  part.ReadSlab(threads);
  if (vtkirt::FieldSet* set = this->Set.Get())
  {
    set->Forget();
  }
  if (part.GetFractionRead() == 1.0)
  {
    this->UnreadParts.pop_back();
  }
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceInput::GetFractionRead() const
{
  double unread = 0.0;
  for (const Part* part : this->UnreadParts)
  {
    unread += 1.0 - part->GetFractionRead();
  }
  return this->UnreadParts.empty() ? 1.0 : 1.0 - unread / this->NumberOfEagerParts;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceInput::GetWarning() const
{
  std::string warning;
  for (std::size_t i = 0; i < this->Parts.size() && warning.empty(); ++i)
  {
    warning = this->Parts[i]->GetWarning();
  }
  return warning;
}

//------------------------------------------------------------------------------
/// Members of a set have what is visible of their own.
vtkirt::Visibility vtkIsosurfaceRayTraceInput::FindVisible() const
{
  return this->IsLone() ? this->Parts.front()->FindVisible() : vtkirt::Visibility{};
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceInput::SetOpacities(vtkirt::TraceRequest& request) const
{
  if (!this->Leaves.HaveOpacities())
  {
    return; // Thousands of blocks are not asked for them.
  }
  if (!this->IsLone())
  {
    for (const std::unique_ptr<Part>& part : this->Parts)
    {
      request.MemberOpacities.push_back(part->FindOpacity());
    }
    return;
  }
  for (vtkirt::Isosurface& surface : request.Surfaces)
  {
    surface.Opacity = this->Parts.front()->FindOpacity().value_or(surface.Opacity);
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceInput::FindScalarRange(double range[2]) const
{
  range[0] = std::numeric_limits<double>::infinity();
  range[1] = -range[0];
  if (IsPiece(this->GetData()))
  {
    return false;
  }
  for (const Leaf& leaf : this->Leaves.Get())
  {
    if (IsPiece(leaf.Data))
    {
      return false;
    }
    double own[2];
    leaf.Scalars->GetRange(own, this->Component);
    range[0] = std::min(range[0], own[0]);
    range[1] = std::max(range[1], own[1]);
  }
  return !this->Leaves.Get().empty();
}

//------------------------------------------------------------------------------
std::unique_ptr<vtkirt::HitColors> vtkIsosurfaceRayTraceInput::MakeColors(
  const vtkIsosurfaceRayTraceValueColors& colorsOfValues) const
{
  std::unique_ptr<vtkirt::HitColors> ofArray = this->MakeColorsOfArray(colorsOfValues);
  const bool haveBlocksColors = std::any_of(this->Leaves.Get().begin(), this->Leaves.Get().end(),
    [](const Leaf& leaf) { return leaf.Display.Color; });
  if (!haveBlocksColors)
  {
    return ofArray;
  }
  return std::make_unique<vtkIsosurfaceRayTraceBlockColors>(
    *this, std::move(ofArray), colorsOfValues);
}

//------------------------------------------------------------------------------
std::unique_ptr<vtkirt::HitColors> vtkIsosurfaceRayTraceInput::MakeColorsOfArray(
  const vtkIsosurfaceRayTraceValueColors& colorsOfValues) const
{
  if (this->ColorArray)
  {
    return std::make_unique<vtkIsosurfaceRayTraceImageColors>(
      this->ColorImage, this->ColorArray, *this->Field, this->PhysicalFromObject, colorsOfValues);
  }
  const std::vector<Leaf>& leaves = this->Leaves.Get();
  if (leaves.empty() || !leaves.front().GetAnyColors())
  {
    return nullptr;
  }
  const bool areDirect = std::all_of(leaves.begin(), leaves.end(),
    [](const Leaf& leaf) { return vtkIsosurfaceRayTraceColors::IsDirect(leaf.GetAnyColors()); });
  return std::make_unique<vtkIsosurfaceRayTraceArrayColors>(*this, this->Leaves.AreColorsOfCells(),
    areDirect, leaves.front().GetAnyColors()->GetNumberOfComponents(), colorsOfValues);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceInput::IsIntact(int threads) const
{
  return this->ArePartsIntact(threads) &&
    (!this->ColorArray || this->ColorArray->GetNumberOfTuples() >= this->NumberOfColors);
}

//------------------------------------------------------------------------------
/// There may be thousands, looked at in every frame: they are far apart in memory.
bool vtkIsosurfaceRayTraceInput::ArePartsIntact(int threads) const
{
  const std::vector<Leaf>& leaves = this->Leaves.Get();
  const bool areColorsIntact = !this->Leaves.AreColorsOfCells() ||
    std::all_of(leaves.begin(), leaves.end(),
      [](const Leaf& leaf) { return leaf.CellColors->GetNumberOfTuples() >= leaf.NumberOfCells; });
  if (!areColorsIntact)
  {
    return false;
  }
  constexpr std::int64_t many = 256;
  const auto count = static_cast<std::int64_t>(this->Parts.size());
  bool areIntact = true;
#pragma omp parallel for num_threads(threads) if (count > many) reduction(&& : areIntact)
  for (std::int64_t i = 0; i < count; ++i)
  {
    areIntact = areIntact && this->Parts[static_cast<std::size_t>(i)]->IsIntact();
  }
  return areIntact;
}

//------------------------------------------------------------------------------
std::shared_ptr<const std::vector<vtkSmartPointer<vtkObject>>>
vtkIsosurfaceRayTraceInput::GetObjects()
{
  if (this->Objects)
  {
    return this->Objects;
  }
  std::vector<vtkObject*> objects = { this->ColorImage, this->ColorArray, this->Attributes };
  for (const std::unique_ptr<Part>& part : this->Parts)
  {
    part->AddObjects(objects);
  }
  for (const Leaf& leaf : this->Leaves.Get())
  {
    if (leaf.CellColors)
    {
      objects.push_back(leaf.CellColors);
    }
  }
  auto held =
    std::make_shared<const std::vector<vtkSmartPointer<vtkObject>>>(objects.begin(), objects.end());
  if (this->ArePartsKept)
  {
    this->Objects = held;
  }
  return held;
}

VTK_ABI_NAMESPACE_END
