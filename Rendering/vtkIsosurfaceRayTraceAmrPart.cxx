// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceAmrPart.h"

#include "vtkIsosurfaceRayTraceAmrLevels.h"
#include "vtkIsosurfaceRayTraceBlock.h"
#include "vtkIsosurfaceRayTraceCropping.h"
#include "vtkIsosurfaceRayTraceGhosts.h"
#include "vtkIsosurfaceRayTraceLatticeSampling.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Leaf = vtkIsosurfaceRayTraceLeaf;

/// Blocks are small, and each field costs every ray that comes to it; but a ray that comes to a
/// region makes the samples of all of it.
constexpr int CellsOfRegion = 32;

/// What the blocks of a region have in common: their opacity, and whether all cells are hidden.
using BlockKind = std::pair<std::optional<double>, bool>;

bool AreAllHidden(const std::vector<unsigned char>& hidden)
{
  return !hidden.empty() && std::find(hidden.begin(), hidden.end(), 0) == hidden.end();
}

/// The flags of some kinds, for each cell of a block; none if it has no flags.
std::vector<unsigned char> FindFlags(const Leaf& leaf, int kinds)
{
  vtkUnsignedCharArray* flags = leaf.Data->GetCellGhostArray();
  std::vector<unsigned char> found;
  for (vtkIdType i = 0; flags && i < flags->GetNumberOfValues(); ++i)
  {
    found.push_back((flags->GetValue(i) & kinds) != 0 ? 1 : 0);
  }
  return found;
}

/// Not zero for each cell of a block that is blanked, refined, or has a hidden corner; none if the
/// block has no flags.
std::vector<unsigned char> FindHiddenCells(const Leaf& leaf)
{
  if (!leaf.Data->GetPointGhostArray())
  {
    return FindFlags(leaf, vtkIsosurfaceRayTraceGhosts::Blanked);
  }
  const vtkIsosurfaceRayTraceBlock block{ leaf, { 0, 0, 0 } };
  const vtkirt::Index3 cells = block.GetCells();
  std::vector<unsigned char> hidden;
  hidden.reserve(vtkirt::Count(cells));
  for (int z = 0; z < cells[2]; ++z)
  {
    for (int y = 0; y < cells[1]; ++y)
    {
      for (int x = 0; x < cells[0]; ++x)
      {
        const bool isShown = block.Shows({ x, y, z }, vtkIsosurfaceRayTraceGhosts::Blanked);
        hidden.push_back(isShown ? 0 : 1);
      }
    }
  }
  return hidden;
}

}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceAmrPart::Block::IsIntact() const
{
  vtkDataArray* scalars = this->Leaf.Scalars;
  const vtkDataArray* colors = this->Leaf.Colors;
  return scalars->GetVoidPointer(0) == this->Memory &&
    scalars->GetNumberOfTuples() >= this->NumberOfTuples &&
    (!colors || colors->GetNumberOfTuples() >= this->Leaf.Data->GetNumberOfPoints());
}

//------------------------------------------------------------------------------
struct vtkIsosurfaceRayTraceAmrPart::Hierarchy
{
  /// A patch for each block.
  std::unique_ptr<vtkirt::AmrHierarchy> Patches;
  std::vector<Block> Blocks;
  bool OfCells;
  vtkirt::ImageSettings Settings;
  vtkVolumeMapper* Cropping;
  /// Copies of scalars that are not plain arrays in memory, and flags of cells, of each block.
  std::vector<vtkSmartPointer<vtkDataArray>> PlainScalars;
  std::vector<std::vector<unsigned char>> GhostCells;
  std::vector<std::vector<unsigned char>> HiddenCells;
};

//------------------------------------------------------------------------------
std::vector<std::unique_ptr<vtkIsosurfaceRayTracePart>> vtkIsosurfaceRayTraceAmrPart::MakeParts(
  const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves, const vtkIsosurfaceRayTraceScalars& scalars,
  const vtkirt::ImageSettings& settings, vtkVolumeMapper* cropping, int threads,
  vtkIsosurfaceRayTraceLeftOut& leftOut)
{
  std::vector<std::unique_ptr<vtkIsosurfaceRayTracePart>> parts;
  if (leaves.empty())
  {
    return parts;
  }
  const auto whole = std::make_shared<Hierarchy>();
  whole->OfCells = scalars.AreOfCells;
  whole->Settings = settings;
  whole->Settings.Layout = vtkirt::BrickLayout::Unbricked; // The nodes are a copy already.
  whole->Cropping = cropping;
  const vtkIsosurfaceRayTraceAmrLevels levels(leaves);
  std::vector<vtkirt::AmrPatch> patches;
  std::map<BlockKind, int> kinds;
  for (const vtkIsosurfaceRayTraceLeaf& leaf : leaves)
  {
    vtkirt::AmrPatch patch{};
    const std::string problem = levels.Place(leaf, patch);
    if (!problem.empty())
    {
      leftOut.Add(leaf, problem);
      continue;
    }
    vtkIsosurfaceRayTraceScalars own = scalars;
    own.Array = leaf.Scalars;
    whole->PlainScalars.emplace_back();
    const auto view = own.MakeView(whole->PlainScalars.back(), threads);
    patch.Samples = { view.Values, view.Type, patch.Cells, view.Stride };
    for (int& dimension : patch.Samples.Dimensions)
    {
      dimension += scalars.AreOfCells ? 0 : 1;
    }
    const auto keep = [](std::vector<unsigned char>&& flags,
                        std::vector<std::vector<unsigned char>>& ofPatches) -> const unsigned char*
    {
      const bool hasAny = std::find(flags.begin(), flags.end(), 1) != flags.end();
      ofPatches.push_back(hasAny ? std::move(flags) : std::vector<unsigned char>{});
      return hasAny ? ofPatches.back().data() : nullptr;
    };
    patch.GhostCells =
      keep(FindFlags(leaf, vtkIsosurfaceRayTraceGhosts::Duplicate), whole->GhostCells);
    patch.HiddenCells = keep(FindHiddenCells(leaf), whole->HiddenCells);
    const BlockKind kind = { leaf.Display.Opacity, AreAllHidden(whole->HiddenCells.back()) };
    patch.Kind = kinds.emplace(kind, static_cast<int>(kinds.size())).first->second;
    patches.push_back(patch);
    whole->Blocks.push_back(
      { leaf, leaf.Scalars->GetVoidPointer(0), leaf.Scalars->GetNumberOfTuples() });
  }
  whole->Patches = std::make_unique<vtkirt::AmrHierarchy>(
    levels.GetRatios(), std::move(patches), scalars.AreOfCells);
  for (vtkirt::AmrRegion& region : whole->Patches->MakeRegions(CellsOfRegion))
  {
    parts.emplace_back(new vtkIsosurfaceRayTraceAmrPart(std::move(region), whole));
  }
  return parts;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceAmrPart::vtkIsosurfaceRayTraceAmrPart(
  vtkirt::AmrRegion&& region, std::shared_ptr<Hierarchy> whole)
  : Region(std::move(region))
  , Whole(std::move(whole))
{
  const Leaf& first =
    this->Whole->Blocks[this->Whole->Patches->FindPatch(this->Region, this->Region.First)].Leaf;
  const int nodesOfCell = this->Whole->Patches->GetNodesOfCell();
  const vtkirt::Vector3 spacing = vtkIsosurfaceRayTraceAmrLevels::GetSpacing(first);
  const vtkirt::Vector3 corner = vtkIsosurfaceRayTraceAmrLevels::GetCorner(first);
  vtkNew<vtkImageData> nodes;
  int extent[6];
  double ofNodes[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    extent[2 * axis] = 0;
    extent[2 * axis + 1] = nodesOfCell * this->Region.Cells[axis] + 1;
    ofNodes[axis] = spacing[axis] / nodesOfCell;
  }
  nodes->SetExtent(extent);
  nodes->SetSpacing(ofNodes);
  nodes->SetOrigin(corner.data());
  this->Geometry = vtkIsosurfaceRayTraceGeometry(nodes, false);
}

//------------------------------------------------------------------------------
/// Most blocks of a simulation have nothing of a surface, and blocks whose cells are hidden lend
/// others their samples alone: they need no nodes.
bool vtkIsosurfaceRayTraceAmrPart::MayHit(const vtkirt::TraceRequest& request)
{
  if (AreAllHidden(this->Whole->HiddenCells[this->Region.Patches.front()]))
  {
    return false;
  }
  // Between the samples the tricubic interpolant may have any value.
  if (request.Projection || request.Interpolation == vtkirt::Interpolant::Tricubic)
  {
    return true;
  }
  if (!this->Range)
  {
    this->Range = this->Whole->Patches->FindRange(this->Region);
  }
  return std::any_of(request.Surfaces.begin(), request.Surfaces.end(),
    [this](const vtkirt::Isosurface& surface)
    { return this->Range->Min <= surface.Isovalue && surface.Isovalue <= this->Range->Max; });
}

//------------------------------------------------------------------------------
vtkirt::TracedField& vtkIsosurfaceRayTraceAmrPart::GetField()
{
  this->Update(1);
  return *this->Field;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceAmrPart::Update(int threads)
{
  if (this->Field)
  {
    return false;
  }
  this->Nodes = this->Whole->Patches->MakeNodes(this->Region);
  this->Nodes.Shorten();
  this->Field = vtkirt::ImageField::New(this->Nodes.GetSamples(), this->Whole->Settings, threads);
  return true;
}

//------------------------------------------------------------------------------
vtkirt::Visibility vtkIsosurfaceRayTraceAmrPart::FindVisible() const
{
  vtkirt::Visibility visible;
  visible.HiddenCells = this->Nodes.HiddenCells.empty() ? nullptr : this->Nodes.HiddenCells.data();
  if (this->Whole->Cropping)
  {
    vtkIsosurfaceRayTraceCropping::Apply(this->Whole->Cropping, this->Geometry, visible);
  }
  return visible;
}

//------------------------------------------------------------------------------
std::size_t vtkIsosurfaceRayTraceAmrPart::GetMemory() const
{
  return this->Nodes.GetMemory();
}

//------------------------------------------------------------------------------
/// Without the layer of nodes behind it.
vtkirt::Bounds vtkIsosurfaceRayTraceAmrPart::FindBox() const
{
  vtkirt::Bounds box = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.Upper[axis] = this->Whole->Patches->GetNodesOfCell() * this->Region.Cells[axis];
  }
  return box;
}

//------------------------------------------------------------------------------
std::optional<double> vtkIsosurfaceRayTraceAmrPart::FindOpacity() const
{
  return this->Whole->Blocks[this->Region.Patches.front()].Leaf.Display.Opacity;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceAmrPart::BlockCell vtkIsosurfaceRayTraceAmrPart::FindBlockCell(
  const vtkirt::Hit& hit) const
{
  const int nodesOfCell = this->Whole->Patches->GetNodesOfCell();
  vtkirt::Index3 cell = this->Field->GetLattice().GetCell(hit);
  vtkirt::Vector3 parametric;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double place = (cell[axis] + hit.Parametric[axis]) / nodesOfCell;
    // Hits may lie in the margin behind the region.
    cell[axis] = std::min(cell[axis] / nodesOfCell, this->Region.Cells[axis] - 1);
    parametric[axis] = std::clamp(place - cell[axis], 0.0, 1.0);
    cell[axis] += this->Region.First[axis];
  }
  const std::size_t number = this->Whole->Patches->FindPatch(this->Region, cell);
  const vtkirt::AmrPatch& patch = this->Whole->Patches->GetPatch(number);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    cell[axis] -= patch.First[axis];
  }
  return { this->Whole->Blocks[number].Leaf, patch.Cells, cell, parametric };
}

//------------------------------------------------------------------------------
const vtkIsosurfaceRayTraceLeaf& vtkIsosurfaceRayTraceAmrPart::FindLeaf(
  const vtkirt::Hit& hit) const
{
  return this->FindBlockCell(hit).Leaf;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceAmrPart::FindCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  const BlockCell found = this->FindBlockCell(hit);
  parametric = found.Parametric;
  return found.Leaf.FirstCell + static_cast<vtkIdType>(vtkirt::Offset(found.Cell, found.Cells));
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceAmrPart::FindPoint(const vtkirt::Hit& hit) const
{
  const BlockCell found = this->FindBlockCell(hit);
  vtkirt::Index3 point = found.Cell;
  vtkirt::Index3 points = found.Cells;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    point[axis] += found.Parametric[axis] >= 0.5 ? 1 : 0;
    ++points[axis];
  }
  return found.Leaf.FirstPoint + static_cast<vtkIdType>(vtkirt::Offset(point, points));
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceAmrPart::SampleColors(
  const vtkirt::Hit& hit, int components, double* values) const
{
  const BlockCell found = this->FindBlockCell(hit);
  vtkirt::Vector3 index = found.Parametric;
  vtkirt::Index3 points = found.Cells;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    index[axis] += found.Cell[axis];
    ++points[axis];
  }
  for (int component = 0; component < components; ++component)
  {
    values[component] =
      vtkIsosurfaceRayTraceSampleLattice(found.Leaf.Colors, points, index, component);
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceAmrPart::IsIntact() const
{
  return std::all_of(this->Region.Patches.begin(), this->Region.Patches.end(),
    [this](std::size_t block) { return this->Whole->Blocks[block].IsIntact(); });
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceAmrPart::AddObjects(std::vector<vtkObject*>& objects) const
{
  for (const std::size_t block : this->Region.Patches)
  {
    const Leaf& leaf = this->Whole->Blocks[block].Leaf;
    objects.insert(objects.end(), { leaf.Data, leaf.Scalars, leaf.Colors });
  }
}

VTK_ABI_NAMESPACE_END
