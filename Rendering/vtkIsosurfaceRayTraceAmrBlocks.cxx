// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceAmrBlocks.h"

#include "vtkIsosurfaceRayTraceAmrLevels.h"
#include "vtkIsosurfaceRayTraceBlock.h"
#include "vtkIsosurfaceRayTraceGhosts.h"

#include "vtkDataArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Leaf = vtkIsosurfaceRayTraceLeaf;

/// What the blocks of a region have in common: their opacity, and whether all cells are hidden.
using BlockKind = std::pair<std::optional<double>, bool>;

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

/// The nodes are a copy already.
vtkirt::ImageSettings ForNodes(const vtkirt::ImageSettings& settings)
{
  vtkirt::ImageSettings ofNodes = settings;
  ofNodes.Layout = vtkirt::BrickLayout::Unbricked;
  return ofNodes;
}

/// Keeps the flags of a patch, if any is set: a pointer to them, or null.
const unsigned char* Keep(
  std::vector<unsigned char>&& flags, std::vector<std::vector<unsigned char>>& ofPatches)
{
  const bool hasAny = std::find(flags.begin(), flags.end(), 1) != flags.end();
  ofPatches.push_back(hasAny ? std::move(flags) : std::vector<unsigned char>{});
  return hasAny ? ofPatches.back().data() : nullptr;
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceAmrBlocks::vtkIsosurfaceRayTraceAmrBlocks(const std::vector<Leaf>& leaves,
  const vtkIsosurfaceRayTraceScalars& scalars, const vtkirt::ImageSettings& settings,
  vtkVolumeMapper* cropping, int threads)
  : Leaves(leaves)
  , Component(scalars.Component)
  , HasOtherComponents(scalars.HasOthers)
  , Settings(ForNodes(settings))
  , Cropping(cropping)
{
  const vtkIsosurfaceRayTraceAmrLevels levels(leaves);
  std::vector<vtkirt::AmrPatch> patches;
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    vtkirt::AmrPatch patch{};
    this->Problems.push_back(levels.Place(leaves[i], patch));
    if (this->Problems.back().empty())
    {
      this->LeafOfPatch.push_back(i);
      this->SetSamples(leaves[i], scalars, threads, patch);
      patches.push_back(patch);
    }
  }
  this->Hierarchy = std::make_unique<vtkirt::AmrHierarchy>(
    levels.GetRatios(), std::move(patches), scalars.AreOfCells);
  this->SetKinds();
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceAmrBlocks::~vtkIsosurfaceRayTraceAmrBlocks() = default;

//------------------------------------------------------------------------------
/// The samples and flags of a block, as those of the next patch.
void vtkIsosurfaceRayTraceAmrBlocks::SetSamples(const Leaf& leaf,
  const vtkIsosurfaceRayTraceScalars& scalars, int threads, vtkirt::AmrPatch& patch)
{
  vtkIsosurfaceRayTraceScalars own = scalars;
  own.Array = leaf.Scalars;
  this->PlainScalars.emplace_back();
  const auto view = own.MakeView(this->PlainScalars.back(), threads);
  patch.Samples = { view.Values, view.Type, patch.Cells, view.Stride };
  for (int& dimension : patch.Samples.Dimensions)
  {
    dimension += scalars.AreOfCells ? 0 : 1;
  }
  patch.GhostCells =
    Keep(FindFlags(leaf, vtkIsosurfaceRayTraceGhosts::Duplicate), this->GhostCells);
  patch.HiddenCells = Keep(FindHiddenCells(leaf), this->HiddenCells);
  this->Read.emplace_back(leaf.Scalars);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceAmrBlocks::SetKinds()
{
  std::map<BlockKind, int> kinds;
  for (std::size_t i = 0; i < this->LeafOfPatch.size(); ++i)
  {
    const BlockKind kind = { this->GetLeaf(i).Display.Opacity, this->IsAllHidden(i) };
    this->Hierarchy->SetKind(i, kinds.emplace(kind, static_cast<int>(kinds.size())).first->second);
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceAmrBlocks::IsOf(const std::vector<Leaf>& leaves,
  const vtkIsosurfaceRayTraceScalars& scalars, const vtkirt::ImageSettings& settings,
  vtkVolumeMapper* cropping) const
{
  const bool areSameLeaves =
    std::equal(leaves.begin(), leaves.end(), this->Leaves.begin(), this->Leaves.end(),
      [](const Leaf& a, const Leaf& b) { return a.Data == b.Data && a.Scalars == b.Scalars; });
  return areSameLeaves && scalars.Component == this->Component &&
    scalars.HasOthers == this->HasOtherComponents && ForNodes(settings) == this->Settings &&
    cropping == this->Cropping &&
    std::all_of(this->Read.begin(), this->Read.end(),
      [](const vtkIsosurfaceRayTraceReadArray& read) { return read.IsIntact(); });
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceAmrBlocks::SetLeaves(const std::vector<Leaf>& leaves)
{
  this->Leaves = leaves;
  this->SetKinds();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceAmrBlocks::AddLeftOut(vtkIsosurfaceRayTraceLeftOut& leftOut) const
{
  for (std::size_t i = 0; i < this->Leaves.size(); ++i)
  {
    if (!this->Problems[i].empty())
    {
      leftOut.Add(this->Leaves[i], this->Problems[i]);
    }
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceAmrBlocks::IsAllHidden(std::size_t patch) const
{
  const std::vector<unsigned char>& hidden = this->HiddenCells[patch];
  return !hidden.empty() && std::find(hidden.begin(), hidden.end(), 0) == hidden.end();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceAmrBlocks::IsIntact(std::size_t patch) const
{
  const Leaf& leaf = this->GetLeaf(patch);
  const vtkDataArray* colors = leaf.Colors;
  return this->Read[patch].IsIntact() &&
    (!colors || colors->GetNumberOfTuples() >= leaf.Data->GetNumberOfPoints());
}

VTK_ABI_NAMESPACE_END
