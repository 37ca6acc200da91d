// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshCloud_h
#define MeshCloud_h

#include "Field/CloudSource.h"
#include "Kernels/Kernels.h"
#include "Mesh/CellSubdivision.h"
#include "Mesh/MeshSelection.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The cells of a mesh, projected to tiles. Cells that are no tetrahedra are subdivided: see
/// CellSubdivision.h.
///
/// The blocks of cells that a tile may see are found by the tree, and put in order by the depths
/// that they begin at.
class MeshCloud final : public CloudSource
{
public:
  /// The selection must outlive the source. Tetrahedra without a value that is shown are passed
  /// over: see TracedField::AddClouds.
  MeshCloud(const MeshSelection& selection, const std::vector<ValueIntervals>& shown,
    const Kernels& kernels);

  void Begin(
    const Camera& view, const PixelRectangle& pixels, const CloudTile& tile, double from) override;
  double GetNextDepth() const override;
  bool IsPaused() const override;
  void FindMore(
    const std::uint32_t (&open)[CloudTile::Edge], bool pauses, CloudSegments& segments) override;

private:
  /// A block of cells and a depth that it does not begin before.
  struct Block
  {
    double Depth;
    std::size_t Number;
  };

  void FindCoordinates(const Camera& view, const PixelRectangle& pixels);
  void FindSides();
  void FindMargin();
  void CutRays(const Camera& view, const PixelRectangle& pixels, const CloudTile& tile);
  void CutRay(const Camera::PixelRay& ray, const CloudTile& tile, int pixel);
  bool IsSeen(const Bounds& box) const;
  bool IsShown(const CellTreeNode& node, int child) const;
  bool IsShown(int tetrahedron);
  void Move(int from, int to, int count);
  int KeepShown(int count);
  void FindBlocks(int level, std::size_t node);
  bool MayPause() const;
  void LoadCells(int most, bool pauses);
  void FindNextCells();
  int LoadTetrahedra(const std::uint32_t* cells, int count);
  int LoadCell(std::uint32_t number, int place);
  void LoadNumbers(const MeshCell& cell, double (*numbers)[MaximumCorners]) const;
  void FindGradients(int tetrahedron);
  void SetNumbers();
  /// The numbers of a tetrahedron that is loaded, each at the four corners.
  std::array<double, 4>* GetNumbers(int tetrahedron)
  {
    return &this->NumbersOfCorners[static_cast<std::size_t>(tetrahedron * this->Numbers)];
  }
  bool HasNumbers() const { return this->Numbers > 0; }

  const MeshSelection& Selection;
  const Kernels& TheKernels;
  bool AreTetrahedra;
  std::vector<ValueIntervals> Shown;
  int Components;
  int Gradients;
  /// Of each corner: the values of all components, and the coordinates of the gradients; none if
  /// there is no more than the value that corners have.
  int Numbers = 0;

  CloudTile Tile;
  /// The sides of what the tile sees: inside, the product with (x, y, z, 1) is not negative.
  double Sides[5][4];
  /// Where blocks begin that are looked at, and the depth that the last ray ends at.
  double From = 0.0;
  double LastEnd = 0.0;
  /// More than rounding changes a depth.
  double Margin = 0.0;
  std::vector<Block> Blocks;
  std::size_t NextBlock = 0;
  /// The cells of the next block that the tile may see.
  std::uint32_t NextCells[CellTree::Width];
  int NextCount = 0;

  ProjectedTetrahedra Projected;
  /// How many of them have been searched.
  int Searched = 0;
  /// Those that are loaded and not projected yet: what is left of the last block.
  static constexpr int MostLoaded =
    ProjectedTetrahedra::Capacity + MaximumTetrahedra * CellTree::Width;
  double Corners[MostLoaded][4][4];
  std::vector<std::array<double, 4>> NumbersOfCorners;
  int Loaded = 0;
  /// Those of the tetrahedra that are projected.
  std::unique_ptr<double[][4][ProjectedTetrahedra::Capacity]> GradientsOfProjected;
  /// What tetrahedra do not begin before: those that are projected, and those of the last block.
  double DepthOfProjected = 0.0;
  double DepthOfLast = 0.0;
};

}

#endif
