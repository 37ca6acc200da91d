// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceMeshInput.h"

#include "vtkIsosurfaceRayTraceEnumerators.h"
#include "vtkIsosurfaceRayTraceMesh.h"
#include "vtkIsosurfaceRayTraceMeshColors.h"
#include "vtkIsosurfaceRayTraceMeshMapper.h"
#include "vtkIsosurfaceRayTraceProblems.h"
#include "vtkIsosurfaceRayTraceScalars.h"
#include "vtkIsosurfaceRayTraceSharedSettings.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkPointSet.h"

#include "Math/Matrix.h"

#include <algorithm>
#include <cstddef>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Mesh = vtkIsosurfaceRayTraceMesh;

constexpr vtkirt::Matrix4 Identity = { 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0,
  0.0, 0.0, 0.0, 1.0 };

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMeshInput::vtkIsosurfaceRayTraceMeshInput(
  vtkIsosurfaceRayTraceMeshMapper* mapper)
  : Mapper(mapper)
{
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMeshInput::~vtkIsosurfaceRayTraceMeshInput() = default;

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMeshInput::Select(vtkVolumeProperty* property)
{
  std::string problem = this->SelectLeaves();
  if (!problem.empty())
  {
    return problem;
  }
  const std::string colors = this->Mapper->GetColorArrayName();
  const bool haveColors = colors.empty() ||
    std::all_of(this->Leaves.Get().begin(), this->Leaves.Get().end(),
      [](const vtkIsosurfaceRayTraceLeaf& leaf) { return leaf.Colors; });
  if (!haveColors)
  {
    return vtkIsosurfaceRayTraceColors::DescribeMissing(colors, "the input");
  }
  // Leaves have as many components as the first.
  vtkIsosurfaceRayTraceScalars scalars;
  scalars.Array = this->Leaves.Get().front().Scalars;
  problem =
    scalars.SelectComponent(vtkIsosurfaceRayTraceEnumerators::FindComponent(
                              this->Mapper->GetVectorMode(), this->Mapper->GetVectorComponent()),
      property, this->PropertyComponent);
  if (!problem.empty())
  {
    return problem;
  }
  // Those that have changed go at the end of this function, before new ones are built.
  std::vector<std::unique_ptr<Mesh>> before;
  before.swap(this->Meshes);
  for (const vtkIsosurfaceRayTraceLeaf& leaf : this->Leaves.Get())
  {
    problem = this->SelectMesh(leaf, scalars.Component, before);
    if (!problem.empty())
    {
      return this->IsComposite ? leaf.GetName() + ": " + problem : problem;
    }
  }
  return "";
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMeshInput::SelectLeaves()
{
  vtkDataObject* input = this->Mapper->GetDataObjectInput();
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  this->IsComposite = composite != nullptr;
  if (composite)
  {
    return this->Leaves.Collect(composite, this->Mapper, this->Mapper->GetColorArrayName(),
      { Mesh::IsMesh, Mesh::HasVolume, "vtkUnstructuredGrid and vtkStructuredGrid" });
  }
  auto* data = vtkDataSet::SafeDownCast(input);
  if (!Mesh::IsMesh(data))
  {
    return "There is no input. Give a vtkUnstructuredGrid, a vtkStructuredGrid or composite data "
           "of them with SetInputData, SetInputDataObject or SetInputConnection.";
  }
  this->Leaves.Take(data, this->Mapper, this->Mapper->GetColorArrayName());
  return "";
}

//------------------------------------------------------------------------------
/// Takes the mesh of a leaf from those before, if there is one; makes it, if there is none.
std::string vtkIsosurfaceRayTraceMeshInput::SelectMesh(
  const vtkIsosurfaceRayTraceLeaf& leaf, int component, std::vector<std::unique_ptr<Mesh>>& before)
{
  auto* grid = vtkPointSet::SafeDownCast(leaf.Data);
  vtkIsosurfaceRayTraceScalars scalars;
  scalars.Array = leaf.Scalars;
  scalars.AreOfCells = this->Leaves.AreScalarsOfCells();
  scalars.Component = component;
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
  const bool isTetrahedralized = this->Mapper->GetTetrahedralize();
  const auto found = std::find_if(before.begin(), before.end(),
    [&](const std::unique_ptr<Mesh>& mesh)
    { return mesh && mesh->IsOf(grid, scalars, isTetrahedralized); });
  if (found != before.end())
  {
    this->Meshes.push_back(std::move(*found));
    return "";
  }
  auto mesh = std::make_unique<Mesh>(grid, scalars, isTetrahedralized);
  problem =
    mesh->SelectCells(vtkIsosurfaceRayTraceSharedSettings::FindNumberOfThreads(*this->Mapper));
  if (problem.empty())
  {
    this->Meshes.push_back(std::move(mesh));
  }
  return problem;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshInput::Update(int threads)
{
  bool isBuilt = false;
  for (const std::unique_ptr<Mesh>& mesh : this->Meshes)
  {
    isBuilt = mesh->Update(threads) || isBuilt;
  }
  return isBuilt;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMeshInput::GetNumberOfFields() const
{
  const bool isBuilt = std::all_of(this->Meshes.begin(), this->Meshes.end(),
    [](const std::unique_ptr<Mesh>& mesh) { return mesh->GetField(); });
  return isBuilt ? static_cast<int>(this->Meshes.size()) : 0;
}

//------------------------------------------------------------------------------
vtkirt::TracedField* vtkIsosurfaceRayTraceMeshInput::GetField(int number) const
{
  return this->Meshes[static_cast<std::size_t>(number)]->GetField();
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceMeshInput::GetCellSize(int field) const
{
  return this->Meshes[static_cast<std::size_t>(field)]->GetCellSize();
}

//------------------------------------------------------------------------------
vtkirt::Visibility vtkIsosurfaceRayTraceMeshInput::FindVisible(int field) const
{
  return this->Meshes[static_cast<std::size_t>(field)]->FindVisible();
}

//------------------------------------------------------------------------------
vtkirt::Matrix4 vtkIsosurfaceRayTraceMeshInput::FindPhysicalFromObject() const
{
  return Identity;
}

//------------------------------------------------------------------------------
const vtkirt::Matrix4& vtkIsosurfaceRayTraceMeshInput::GetPhysicalFromObject() const
{
  return Identity;
}

//------------------------------------------------------------------------------
std::unique_ptr<vtkirt::HitColors> vtkIsosurfaceRayTraceMeshInput::MakeColors(
  const vtkIsosurfaceRayTraceValueColors& colorsOfValues) const
{
  if (!this->Leaves.Get().front().Colors)
  {
    return nullptr;
  }
  std::vector<vtkIsosurfaceRayTraceMeshColors::Part> parts;
  for (std::size_t i = 0; i < this->Meshes.size(); ++i)
  {
    parts.push_back({ this->Meshes[i].get(), this->Leaves.Get()[i].Colors });
  }
  return std::make_unique<vtkIsosurfaceRayTraceMeshColors>(parts, colorsOfValues);
}

//------------------------------------------------------------------------------
const vtkIsosurfaceRayTraceMesh& vtkIsosurfaceRayTraceMeshInput::GetMesh(
  const vtkirt::Hit& hit) const
{
  return *this->Meshes[static_cast<std::size_t>(hit.Field)];
}

//------------------------------------------------------------------------------
const vtkIsosurfaceRayTraceLeaf& vtkIsosurfaceRayTraceMeshInput::GetLeaf(
  const vtkirt::Hit& hit) const
{
  return this->Leaves.Get()[static_cast<std::size_t>(hit.Field)];
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMeshInput::FindCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  parametric = hit.Parametric;
  return this->GetLeaf(hit).FirstCell + this->GetMesh(hit).FindCell(hit);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMeshInput::FindPoint(const vtkirt::Hit& hit) const
{
  return this->GetLeaf(hit).FirstPoint + this->GetMesh(hit).FindPoint(hit);
}

//------------------------------------------------------------------------------
vtkDataSet* vtkIsosurfaceRayTraceMeshInput::FindBlock(
  vtkIdType cellId, vtkIdType& cellInBlock, unsigned int& flatIndex) const
{
  return this->IsComposite ? this->Leaves.FindBlock(cellId, cellInBlock, flatIndex) : nullptr;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMeshInput::IsIntact() const
{
  return std::equal(this->Meshes.begin(), this->Meshes.end(), this->Leaves.Get().begin(),
    [](const std::unique_ptr<Mesh>& mesh, const vtkIsosurfaceRayTraceLeaf& leaf)
    {
      return mesh->IsIntact() &&
        (!leaf.Colors || leaf.Colors->GetNumberOfTuples() >= mesh->GetNumberOfPoints());
    });
}

//------------------------------------------------------------------------------
std::vector<vtkObject*> vtkIsosurfaceRayTraceMeshInput::GetObjects() const
{
  std::vector<vtkObject*> objects;
  for (const std::unique_ptr<Mesh>& mesh : this->Meshes)
  {
    mesh->AddObjects(objects);
  }
  for (const vtkIsosurfaceRayTraceLeaf& leaf : this->Leaves.Get())
  {
    objects.push_back(leaf.Colors);
  }
  return objects;
}

VTK_ABI_NAMESPACE_END
