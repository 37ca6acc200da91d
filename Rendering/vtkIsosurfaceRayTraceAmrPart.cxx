// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceAmrPart.h"

#include "vtkIsosurfaceRayTraceAmrLevels.h"
#include "vtkIsosurfaceRayTraceCropping.h"
#include "vtkIsosurfaceRayTraceLatticeSampling.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Leaf = vtkIsosurfaceRayTraceLeaf;

/// Blocks are small, and each field costs every ray that comes to it; but a ray that comes to a
/// region makes the samples of all of it.
constexpr int CellsOfRegion = 32;

}

//------------------------------------------------------------------------------
std::vector<std::unique_ptr<vtkIsosurfaceRayTracePart>> vtkIsosurfaceRayTraceAmrPart::MakeParts(
  const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves, const vtkIsosurfaceRayTraceScalars& scalars,
  const vtkirt::ImageSettings& settings, vtkVolumeMapper* cropping, int threads,
  std::vector<std::unique_ptr<vtkIsosurfaceRayTraceAmrPart>>&& former,
  vtkIsosurfaceRayTraceLeftOut& leftOut)
{
  std::vector<std::unique_ptr<vtkIsosurfaceRayTracePart>> parts;
  if (leaves.empty())
  {
    return parts;
  }
  std::shared_ptr<vtkIsosurfaceRayTraceAmrBlocks> whole;
  // By the first of their patches, of which each is in one region.
  std::unordered_map<std::size_t, std::unique_ptr<vtkIsosurfaceRayTraceAmrPart>> known;
  for (std::unique_ptr<vtkIsosurfaceRayTraceAmrPart>& part : former)
  {
    whole = part->Whole;
    known[part->Region.Patches.front()] = std::move(part);
  }
  if (whole && whole->IsOf(leaves, scalars, settings, cropping))
  {
    whole->SetLeaves(leaves);
  }
  else
  {
    known.clear();
    whole = std::make_shared<vtkIsosurfaceRayTraceAmrBlocks>(
      leaves, scalars, settings, cropping, threads);
  }
  whole->AddLeftOut(leftOut);
  for (vtkirt::AmrRegion& region : whole->GetHierarchy().MakeRegions(CellsOfRegion))
  {
    const auto found = known.find(region.Patches.front());
    if (found != known.end() && found->second->Region.Patches == region.Patches)
    {
      parts.push_back(std::move(found->second));
    }
    else
    {
      parts.emplace_back(new vtkIsosurfaceRayTraceAmrPart(std::move(region), whole));
    }
  }
  return parts;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceAmrPart::vtkIsosurfaceRayTraceAmrPart(
  vtkirt::AmrRegion&& region, std::shared_ptr<vtkIsosurfaceRayTraceAmrBlocks> whole)
  : Region(std::move(region))
  , Whole(std::move(whole))
{
  const Leaf& first =
    this->Whole->GetLeaf(this->Whole->GetHierarchy().FindPatch(this->Region, this->Region.First));
  const int nodesOfCell = this->Whole->GetHierarchy().GetNodesOfCell();
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
  if (this->Whole->IsAllHidden(this->Region.Patches.front()))
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
    this->Range = this->Whole->GetHierarchy().FindRange(this->Region);
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
  this->Nodes = this->Whole->GetHierarchy().MakeNodes(this->Region);
  this->Nodes.Shorten();
  this->Field =
    vtkirt::ImageField::New(this->Nodes.GetSamples(), this->Whole->GetSettings(), threads);
  return true;
}

//------------------------------------------------------------------------------
vtkirt::Visibility vtkIsosurfaceRayTraceAmrPart::FindVisible() const
{
  vtkirt::Visibility visible;
  visible.HiddenCells = this->Nodes.HiddenCells.empty() ? nullptr : this->Nodes.HiddenCells.data();
  if (this->Whole->GetCropping())
  {
    vtkIsosurfaceRayTraceCropping::Apply(this->Whole->GetCropping(), this->Geometry, visible);
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
    box.Upper[axis] = this->Whole->GetHierarchy().GetNodesOfCell() * this->Region.Cells[axis];
  }
  return box;
}

//------------------------------------------------------------------------------
std::optional<double> vtkIsosurfaceRayTraceAmrPart::FindOpacity() const
{
  return this->Whole->GetLeaf(this->Region.Patches.front()).Display.Opacity;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceAmrPart::BlockCell vtkIsosurfaceRayTraceAmrPart::FindBlockCell(
  const vtkirt::Hit& hit) const
{
  const int nodesOfCell = this->Whole->GetHierarchy().GetNodesOfCell();
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
  const std::size_t number = this->Whole->GetHierarchy().FindPatch(this->Region, cell);
  const vtkirt::AmrPatch& patch = this->Whole->GetHierarchy().GetPatch(number);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    cell[axis] -= patch.First[axis];
  }
  return { this->Whole->GetLeaf(number), patch.Cells, cell, parametric };
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
    [this](std::size_t block) { return this->Whole->IsIntact(block); });
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceAmrPart::AddObjects(std::vector<vtkObject*>& objects) const
{
  for (const std::size_t block : this->Region.Patches)
  {
    const Leaf& leaf = this->Whole->GetLeaf(block);
    objects.insert(objects.end(), { leaf.Data, leaf.Scalars, leaf.Colors });
  }
}

VTK_ABI_NAMESPACE_END
