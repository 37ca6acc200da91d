// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CloudProcesses_h
#define CloudProcesses_h

#include "Views.h"

#include "Picture/CloudFinder.h"
#include "Picture/CloudMedium.h"
#include "Picture/CloudTileRenderer.h"
#include "Picture/RenderTiles.h"
#include "vtkIsosurfaceRayTracingCompat.h"

#include <array>
#include <cstdint>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkUnstructuredGrid;
VTK_ABI_NAMESPACE_END

namespace Benchmark
{

/// Draws the tiles of a scene with a cloud one by one, in one thread.
class CloudTiles
{
public:
  /// The scene must outlive it.
  explicit CloudTiles(const vtkIsosurfaceRayTracing::Scene& scene);

  int GetCount() const { return static_cast<int>(this->Tiles.size()); }

  /// Finds the segments of a tile. Returns how many there are.
  std::int64_t Find(int tile);
  /// Finds and draws a tile, as a frame of one machine does.
  void Render(int tile);
  /// The light of a pixel of the viewport, unrounded.
  std::array<double, 4> GetLight(int x, int y);

private:
  const vtkIsosurfaceRayTracing::Scene& TheScene;
  std::vector<vtkIsosurfaceRayTracing::PixelRectangle> Tiles;
  vtkIsosurfaceRayTracing::CloudFinder Finder;
  vtkIsosurfaceRayTracing::CloudTileRenderer Renderer;
  vtkIsosurfaceRayTracing::CloudTile Rays;
  vtkIsosurfaceRayTracing::CloudSegments Segments;
  vtkIsosurfaceRayTracing::Frame Picture;
};

/// The seconds of one thread that the segments of a picture took, and how many there are.
struct CloudTimes
{
  /// Of a picture by one machine, and of finding alone.
  double Render = 0.0;
  double Find = 0.0;
  std::int64_t Segments = 0;
};

CloudTimes MeasureCloud(const vtkIsosurfaceRayTracing::Scene& scene);

/// Prints what a picture by up to so many processes would take, to which the cells of a mesh of
/// tetrahedra are dealt out in short runs, as a table in Markdown. What processes find and draw is
/// measured here, one after the other; messages are assumed.
void SimulateProcesses(vtkUnstructuredGrid* grid,
  const std::vector<vtkIsosurfaceRayTracing::CloudNode>& nodes, const View& view, int size,
  int most);

}

#endif
