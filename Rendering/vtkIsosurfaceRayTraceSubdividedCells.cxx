// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceSubdividedCells.h"

#include "vtkIsosurfaceRayTraceSubdivision.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkUnstructuredGrid.h"

#include "Field/FirstException.h"
#include "Math/ThreadsOfLoop.h"
#include "Mesh/MeshCell.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <omp.h>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// So many cells are subdivided by one thread at once.
constexpr vtkIdType CellsOfBlock = 1024;

/// What a thread subdivides with.
struct Tools
{
  std::map<int, vtkIsosurfaceRayTraceSubdivision> Types;
  vtkNew<vtkIdList> Points;
  vtkNew<vtkIdList> Parts;
};

/// What some cells become, one after the other. The centre of a polyhedron is a corner less than 0:
/// the first one is -1.
struct Block
{
  std::vector<unsigned char> Shapes;
  std::vector<vtkIdType> Corners;
  std::vector<vtkIdType> Ids;
  std::vector<std::vector<vtkIdType>> Centers;
  vtkIdType FirstHull = -1;
  vtkIdType FirstBad = -1;

  void Add(vtkUnstructuredGrid* grid, vtkIdType cell, Tools& tools);
  void AddParts(int shape, vtkIdType cell, vtkIdList* corners);
};

//------------------------------------------------------------------------------
int CountCorners(int shape)
{
  return vtkirt::GetTraits(static_cast<vtkirt::CellShape>(shape)).Corners;
}

//------------------------------------------------------------------------------
/// Adds what a cell becomes, if it has three dimensions.
void Block::Add(vtkUnstructuredGrid* grid, vtkIdType cell, Tools& tools)
{
  const int shape = grid->GetCellType(cell);
  vtkIdList* points = tools.Points;
  if (CountCorners(shape) > 0)
  {
    grid->GetCellPoints(cell, points);
    this->AddParts(shape, cell, points);
    return;
  }
  vtkIsosurfaceRayTraceSubdivision& type = tools.Types.try_emplace(shape, shape).first->second;
  if (!type.IsSolid())
  {
    return;
  }
  grid->GetCellPoints(cell, points);
  vtkIdList* parts = tools.Parts;
  if (!type.FindParts(grid, cell, points, parts))
  {
    this->FirstBad = this->FirstBad < 0 ? cell : this->FirstBad;
    return;
  }
  constexpr vtkIdType center = vtkIsosurfaceRayTracePolyhedron::Center;
  if (std::find(parts->begin(), parts->end(), center) != parts->end())
  {
    this->Centers.emplace_back(points->begin(), points->end());
    std::replace(
      parts->begin(), parts->end(), center, -static_cast<vtkIdType>(this->Centers.size()));
  }
  this->FirstHull = this->FirstHull < 0 && type.IsHull() ? cell : this->FirstHull;
  this->AddParts(type.GetPartType(), cell, parts);
}

//------------------------------------------------------------------------------
/// Adds cells of a shape, given the ids of their corners.
void Block::AddParts(int shape, vtkIdType cell, vtkIdList* corners)
{
  const auto count = static_cast<std::size_t>(corners->GetNumberOfIds() / CountCorners(shape));
  this->Shapes.insert(this->Shapes.end(), count, static_cast<unsigned char>(shape));
  this->Ids.insert(this->Ids.end(), count, cell);
  this->Corners.insert(this->Corners.end(), corners->begin(), corners->end());
}

//------------------------------------------------------------------------------
std::vector<Block> MakeBlocks(vtkUnstructuredGrid* grid, int threads)
{
  const vtkIdType cells = grid->GetNumberOfCells();
  std::vector<Block> blocks(static_cast<std::size_t>((cells + CellsOfBlock - 1) / CellsOfBlock));
  const int worth = vtkirt::GetThreadsOfLoop(static_cast<std::size_t>(cells), 500.0, threads);
  std::vector<Tools> toolsOfThreads(static_cast<std::size_t>(worth));
  vtkirt::FirstException exception;
#pragma omp parallel for schedule(dynamic) num_threads(worth)
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    exception.Guard(
      [&]
      {
        Tools& tools = toolsOfThreads[static_cast<std::size_t>(omp_get_thread_num())];
        const vtkIdType first = static_cast<vtkIdType>(i) * CellsOfBlock;
        for (vtkIdType cell = first; cell < std::min(first + CellsOfBlock, cells); ++cell)
        {
          blocks[i].Add(grid, cell, tools);
        }
      });
  }
  exception.Rethrow();
  return blocks;
}

}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceSubdividedCells::Subdivide(vtkUnstructuredGrid* grid, int threads)
{
  this->Offsets = { 0 };
  for (Block& block : MakeBlocks(grid, threads))
  {
    if (block.FirstBad >= 0)
    {
      return "Cell " + std::to_string(block.FirstBad) +
        " has a wrong number of points, or a face of it has, or its HigherOrderDegrees or "
        "RationalWeights do not fit them.";
    }
    const vtkIdType firstCenter =
      grid->GetNumberOfPoints() + static_cast<vtkIdType>(this->Centers.size());
    for (const vtkIdType corner : block.Corners)
    {
      this->Connectivity.push_back(corner < 0 ? firstCenter - 1 - corner : corner);
    }
    for (const unsigned char shape : block.Shapes)
    {
      this->Offsets.push_back(this->Offsets.back() + CountCorners(shape));
    }
    this->Shapes.insert(this->Shapes.end(), block.Shapes.begin(), block.Shapes.end());
    this->Ids.insert(this->Ids.end(), block.Ids.begin(), block.Ids.end());
    std::move(block.Centers.begin(), block.Centers.end(), std::back_inserter(this->Centers));
    this->FirstHull = this->FirstHull < 0 ? block.FirstHull : this->FirstHull;
    block = {};
  }
  return "";
}

VTK_ABI_NAMESPACE_END
