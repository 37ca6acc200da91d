// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "CloudProcesses.h"

#include "MeshTracer.h"
#include "Samples.h"

#include "Picture/SharedTiles.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace Benchmark
{
namespace
{

namespace vtkirt = vtkIsosurfaceRayTracing;

// What is assumed of the network, in seconds and in bytes a second.
constexpr double MessageTime = 2e-6;
constexpr double Bandwidth = 10e9;

vtkSmartPointer<vtkUnstructuredGrid> TakeCells(
  vtkUnstructuredGrid* grid, vtkIdType first, vtkIdType stride)
{
  vtkNew<vtkIdTypeArray> ids;
  for (vtkIdType cell = first; cell < grid->GetNumberOfCells(); cell += stride)
  {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    grid->GetCellPoints(cell, count, corners);
    for (vtkIdType i = 0; i < count; ++i)
    {
      ids->InsertNextValue(corners[i]);
    }
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(4, ids);
  auto piece = vtkSmartPointer<vtkUnstructuredGrid>::New();
  piece->SetPoints(grid->GetPoints());
  piece->GetPointData()->SetScalars(grid->GetPointData()->GetScalars());
  piece->SetCells(VTK_TETRA, cells);
  return piece;
}

/// The least of a few measurements of the time to find the segments of all tiles.
double MeasureFinding(const vtkirt::Scene& scene)
{
  Samples seconds;
  CloudTiles tiles(scene);
  for (int repeat = 0; repeat < 3; ++repeat)
  {
    seconds.Add(MeasureOn(1,
      [&]()
      {
        for (int tile = 0; tile < tiles.GetCount(); ++tile)
        {
          tiles.Find(tile);
        }
      }));
  }
  return seconds.GetMinimum();
}

/// What drawing takes the owners of tiles.
struct DrawingTimes
{
  /// Of the slowest one.
  double Slowest;
  /// If all wait for the slowest one after so many tiles as they may be apart.
  double Waiting;
};

DrawingTimes FindDrawingTimes(
  const vtkirt::SharedTiles& tiles, const std::vector<double>& ofTiles, int processes)
{
  const auto count = static_cast<std::size_t>(processes);
  const int window = std::max({ 16, 2 * processes, tiles.GetCount() / 64 });
  std::vector<double> all(count, 0.0);
  double waiting = 0.0;
  for (int first = 0; first < tiles.GetCount(); first += window)
  {
    std::vector<double> some(count, 0.0);
    for (int turn = first; turn < std::min(first + window, tiles.GetCount()); ++turn)
    {
      const int tile = tiles.GetTile(turn);
      const auto owner = static_cast<std::size_t>(tiles.GetOwner(tile));
      some[owner] += ofTiles[static_cast<std::size_t>(tile)];
    }
    waiting += *std::max_element(some.begin(), some.end());
    std::transform(all.begin(), all.end(), some.begin(), all.begin(), std::plus<>());
  }
  return { *std::max_element(all.begin(), all.end()), waiting };
}

}

//------------------------------------------------------------------------------
CloudTiles::CloudTiles(const vtkirt::Scene& scene)
  : TheScene(scene)
  , Tiles(vtkirt::MakeTiles(scene))
  , Finder(scene, &vtkirt::GetBestKernels())
  , Renderer(scene, &vtkirt::GetBestKernels())
{
  const auto pixels =
    static_cast<std::size_t>(scene.Pixels.Width) * static_cast<std::size_t>(scene.Pixels.Height);
  this->Picture.Colors.resize(4 * pixels);
  this->Picture.Depths.resize(pixels);
}

//------------------------------------------------------------------------------
const vtkirt::TileSegments& CloudTiles::Find(int tile)
{
  const vtkirt::PixelRectangle& pixels = this->Tiles[static_cast<std::size_t>(tile)];
  std::uint32_t open[vtkirt::CloudTile::Edge];
  std::fill(std::begin(open), std::end(open), ~0U);
  this->Found.Clear();
  vtkirt::MakeCloudRays(this->TheScene, pixels, vtkirt::GetBestKernels(), this->Rays);
  this->Finder.Begin(pixels, this->Rays, 0.0);
  while (std::isfinite(this->Finder.GetNextDepth()))
  {
    const std::size_t field = this->Finder.FindMore(open, this->Segments);
    this->Found.Add(field, this->Segments);
  }
  return this->Found;
}

//------------------------------------------------------------------------------
void CloudTiles::Draw(int tile)
{
  this->Renderer.Begin(this->Tiles[static_cast<std::size_t>(tile)]);
  vtkirt::MessageExchange::Message message;
  vtkirt::NoteWriter writer(message);
  this->Found.Write(writer);
  vtkirt::NoteReader reader(message.data(), message.size());
  vtkirt::TileSegments::Read(reader, this->Segments,
    [this](std::size_t field, const vtkirt::CloudSegments& some)
    { this->Renderer.Add(field, some); });
  this->Renderer.Finish(this->Picture);
}

//------------------------------------------------------------------------------
void CloudTiles::Render(int tile)
{
  this->Renderer.Begin(this->Tiles[static_cast<std::size_t>(tile)]);
  this->Renderer.Render(this->Finder, this->Picture);
}

//------------------------------------------------------------------------------
std::array<double, 4> CloudTiles::GetLight(int x, int y)
{
  const int inX = x - this->TheScene.Pixels.X;
  const int inY = y - this->TheScene.Pixels.Y;
  const auto isOf = [inX, inY](const vtkirt::PixelRectangle& tile) {
    return vtkirt::Overlap(tile, { inX, inY, 1, 1 });
  };
  const auto tile = std::find_if(this->Tiles.begin(), this->Tiles.end(), isOf);
  if (tile == this->Tiles.end())
  {
    return { 0.0, 0.0, 0.0, 0.0 };
  }
  const int number = static_cast<int>(tile - this->Tiles.begin());
  this->Render(number);
  return this->Renderer.GetLight(inX - tile->X, inY - tile->Y);
}

//------------------------------------------------------------------------------
CloudTimes MeasureCloud(const vtkirt::Scene& scene)
{
  CloudTimes times;
  CloudTiles tiles(scene);
  for (int tile = 0; tile < tiles.GetCount(); ++tile)
  {
    times.Render += MeasureOn(1, [&]() { tiles.Render(tile); });
    times.Find += MeasureOn(1, [&]() { tiles.Find(tile); });
    times.Segments += static_cast<std::int64_t>(tiles.Find(tile).GetCount());
  }
  return times;
}

//------------------------------------------------------------------------------
void SimulateProcesses(vtkUnstructuredGrid* grid, const std::vector<vtkirt::CloudNode>& nodes,
  const View& view, int size, int most)
{
  const vtkirt::CloudMedium medium(nodes);
  vtkDataArray* values = grid->GetPointData()->GetScalars();
  const PictureRays rays(view, size);
  std::vector<double> drawing;
  std::int64_t segments = 0;
  vtkirt::Scene whole;
  {
    const MeshTracer tracer(grid, values, 1);
    whole = tracer.MakeCloudScene(view, rays, size, medium);
    CloudTiles tiles(whole);
    for (int tile = 0; tile < tiles.GetCount(); ++tile)
    {
      segments += static_cast<std::int64_t>(tiles.Find(tile).GetCount());
      drawing.push_back(MeasureOn(1, [&]() { tiles.Draw(tile); }));
    }
  }
  std::printf(
    "%lld tetrahedra, %d x %d pixels, %lld segments\n\n"
    "| processes | find, ms | draw, slowest, ms | messages, ms | picture, ms | efficiency "
    "| picture if all wait for each other, ms | efficiency |\n"
    "|---|---|---|---|---|---|---|---|\n",
    static_cast<long long>(grid->GetNumberOfCells()), size, size, static_cast<long long>(segments));
  double alone = 0.0;
  for (int processes = 1; processes <= most; processes *= processes == 1 ? 8 : 4)
  {
    const auto piece = TakeCells(grid, processes / 2, processes);
    const MeshTracer tracer(piece, values, 1);
    vtkirt::Scene own = tracer.MakeCloudScene(view, rays, size, medium);
    own.Pixels = whole.Pixels;
    const double finding = MeasureFinding(own);
    const vtkirt::SharedTiles tiles(whole, processes);
    const DrawingTimes times = FindDrawingTimes(tiles, drawing, processes);
    const double sent = static_cast<double>(segments) / processes * (processes - 1.0) / processes;
    // A message for each part, and the tiles of which it says that they are finished.
    const double messages = processes == 1 ? 0.0
                                           : MessageTime * 2.0 * tiles.GetCount() +
        sent * static_cast<double>(vtkirt::TileSegments::GetBytesOfOne(1, 0)) / Bandwidth;
    const double picture = finding + times.Slowest + messages;
    const double waiting = finding + times.Waiting + messages;
    alone = processes == 1 ? picture : alone;
    std::printf("| %d | %.2f | %.2f | %.2f | %.2f | %.0f %% | %.2f | %.0f %% |\n", processes,
      1e3 * finding, 1e3 * times.Slowest, 1e3 * messages, 1e3 * picture,
      100.0 * alone / (processes * picture), 1e3 * waiting, 100.0 * alone / (processes * waiting));
    std::fflush(stdout);
  }
}

}
