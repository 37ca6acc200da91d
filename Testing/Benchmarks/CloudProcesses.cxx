// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "CloudProcesses.h"

#include "MeshTracer.h"
#include "Samples.h"

#include "Picture/PartFinder.h"
#include "Picture/RenderSharedTiles.h"
#include "Picture/SharedNotes.h"
#include "Picture/SharedTiles.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>

namespace Benchmark
{
namespace
{

namespace vtkirt = vtkIsosurfaceRayTracing;

// What is assumed of the network, in seconds and in bytes a second.
constexpr double MessageTime = 2e-6;
constexpr double Bandwidth = 10e9;

// Cells are dealt out in runs of so many that follow each other.
constexpr vtkIdType CellsInRun = 64;

vtkSmartPointer<vtkUnstructuredGrid> TakeCells(
  vtkUnstructuredGrid* grid, vtkIdType process, vtkIdType processes)
{
  vtkNew<vtkIdTypeArray> ids;
  const vtkIdType cells = grid->GetNumberOfCells();
  for (vtkIdType run = process * CellsInRun; run < cells; run += processes * CellsInRun)
  {
    for (vtkIdType cell = run; cell < std::min(run + CellsInRun, cells); ++cell)
    {
      vtkIdType count = 0;
      const vtkIdType* corners = nullptr;
      grid->GetCellPoints(cell, count, corners);
      for (vtkIdType i = 0; i < count; ++i)
      {
        ids->InsertNextValue(corners[i]);
      }
    }
  }
  vtkNew<vtkCellArray> taken;
  taken->SetData(4, ids);
  auto piece = vtkSmartPointer<vtkUnstructuredGrid>::New();
  piece->SetPoints(grid->GetPoints());
  piece->GetPointData()->SetScalars(grid->GetPointData()->GetScalars());
  piece->SetCells(VTK_TETRA, taken);
  return piece;
}

//------------------------------------------------------------------------------
/// Finds the parts of groups of tiles, as a process does.
class GroupFinder
{
public:
  GroupFinder(const vtkirt::Scene& scene, const vtkirt::SharedTiles& tiles, std::size_t enough)
    : Tiles(tiles)
    , Shaders(vtkirt::MakeShaders(scene, &vtkirt::GetBestKernels()))
    , Finder(scene, tiles, this->Shaders, &vtkirt::GetBestKernels(), this->Picture, enough)
  {
  }

  /// Finds all parts of a group, if no ray becomes opaque, and calls take(number, message) for
  /// each.
  template <typename Take>
  void Find(int group, const Take& take)
  {
    vtkirt::PartRequest request = vtkirt::PartRequest::MakeFirst();
    for (bool isFinished = false; !isFinished;)
    {
      this->Finder.Find(group, request);
      for (int number = 0; number < this->Tiles.GetGroupSize(); ++number)
      {
        this->Message.clear();
        if (request.IsLookedFor(this->Tiles, number))
        {
          this->Finder.Write(group, number, this->Message);
          take(number, this->Message);
        }
      }
      request = this->Finder.GetRest();
      isFinished = std::all_of(std::begin(request.Tiles), std::end(request.Tiles),
        [](const auto& tile) { return !std::isfinite(tile.NextDepth); });
    }
  }

private:
  const vtkirt::SharedTiles& Tiles;
  std::vector<vtkirt::Shader> Shaders;
  vtkirt::Frame Picture;
  vtkirt::PartFinder Finder;
  vtkirt::MessageExchange::Message Message;
};

/// Draws the share of a message, and returns the seconds.
double DrawMessage(const vtkirt::MessageExchange::Message& message, const vtkirt::PixelRows& rows,
  vtkirt::CloudTileRenderer& renderer, vtkirt::Frame& frame)
{
  const auto segments = std::make_unique<vtkirt::CloudSegments>();
  return MeasureOn(1,
    [&]()
    {
      renderer.Begin(rows);
      vtkirt::NoteReader reader(message.data(), message.size());
      reader.Skip(sizeof(vtkirt::NoteHeader) + sizeof(vtkirt::PartHeader));
      vtkirt::SharedSegments::Read(reader, *segments,
        [&renderer](std::size_t field, const vtkirt::CloudSegments& some)
        { renderer.Add(field, some); });
      renderer.Finish(frame);
    });
}

/// What drawing takes the owners of shares.
struct DrawingCosts
{
  /// Of the slowest one.
  double Slowest = 0.0;
  /// If all wait for the slowest one after so many groups as they may be apart.
  double Waiting = 0.0;
};

//------------------------------------------------------------------------------
/// A picture by some processes: what one of them finds, and what all draw. Times are the least of
/// those that are measured, for the machine may be slow for a while.
class SimulatedPicture
{
public:
  /// All must outlive it.
  SimulatedPicture(const vtkirt::Scene& whole, vtkUnstructuredGrid* grid,
    const std::function<vtkirt::Scene(const MeshTracer&)>& makeScene, int processes)
    : Processes(processes)
    , Whole(whole)
    , Tiles(whole, processes)
    , Piece(TakeCells(grid, processes / 2, processes))
    , Tracer(this->Piece, grid->GetPointData()->GetScalars(), 1)
    , Own(makeScene(this->Tracer))
    , Drawing(static_cast<std::size_t>(this->Tiles.GetNumberOfShares()),
        std::numeric_limits<double>::infinity())
  {
    this->Own.Pixels = whole.Pixels;
  }

  void Measure()
  {
    this->MeasureFinding();
    this->MeasureDrawing();
  }

  std::int64_t GetNumberOfSegments() const { return this->Segments; }

  /// Prints a row of the table. Returns the seconds of the picture, given those by one process.
  double Report(double alone) const
  {
    const int processes = this->Processes;
    // The parts that go to others. What else processes tell each other goes with them, but for
    // answers to parts that are not the last ones.
    const double others = (processes - 1.0) / processes;
    const int answers = this->Messages - this->Tiles.GetNumberOfShares();
    const double sent = static_cast<double>(this->Segments) / processes *
      static_cast<double>(vtkirt::SharedSegments::GetBytesOfOne(1, 0));
    const double messages = others * (MessageTime * (this->Messages + answers) + sent / Bandwidth);
    const DrawingCosts drawing = this->FindDrawingCosts();
    const double picture = this->Finding + drawing.Slowest + messages;
    const double waiting = this->Finding + drawing.Waiting + messages;
    const double one = processes == 1 ? picture : alone;
    std::printf("| %d | %.2f | %.2f | %.2f | %.2f | %.0f %% | %.2f | %.0f %% |\n", processes,
      1e3 * this->Finding, 1e3 * drawing.Slowest, 1e3 * messages, 1e3 * picture,
      100.0 * one / (processes * picture), 1e3 * waiting, 100.0 * one / (processes * waiting));
    return picture;
  }

private:
  void MeasureFinding()
  {
    const vtkirt::Sharing sharing;
    GroupFinder finder(this->Own, this->Tiles, sharing.FindSegmentsOfPart(this->Processes));
    this->Messages = 0;
    const double seconds = MeasureOn(1,
      [&]()
      {
        for (int group = 0; group < this->Tiles.GetNumberOfGroups(); ++group)
        {
          finder.Find(
            group, [this](int, const vtkirt::MessageExchange::Message&) { ++this->Messages; });
        }
      });
    this->Finding = std::min(this->Finding, seconds);
  }

  void MeasureDrawing()
  {
    GroupFinder finder(this->Whole, this->Tiles, std::numeric_limits<std::size_t>::max());
    vtkirt::CloudTileRenderer renderer(this->Whole, &vtkirt::GetBestKernels());
    vtkirt::Frame frame;
    const auto pixels = static_cast<std::size_t>(this->Whole.Pixels.Width) *
      static_cast<std::size_t>(this->Whole.Pixels.Height);
    frame.Colors.resize(4 * pixels);
    frame.Depths.resize(pixels);
    this->Segments = 0;
    for (int group = 0; group < this->Tiles.GetNumberOfGroups(); ++group)
    {
      finder.Find(group,
        [&](int number, const vtkirt::MessageExchange::Message& message)
        {
          const int share = this->Tiles.GetShare(group, number);
          double& least = this->Drawing[static_cast<std::size_t>(share)];
          least =
            std::min(least, DrawMessage(message, this->Tiles.FindRows(share), renderer, frame));
          vtkirt::PartHeader part;
          std::memcpy(&part, message.data() + sizeof(vtkirt::NoteHeader), sizeof(part));
          this->Segments += part.Segments;
        });
    }
  }

  DrawingCosts FindDrawingCosts() const
  {
    DrawingCosts costs;
    std::vector<double> all(static_cast<std::size_t>(this->Processes), 0.0);
    std::vector<double> some = all;
    const int window = this->Tiles.FindWindow(1) * this->Tiles.GetGroupSize();
    const int shares = this->Tiles.GetNumberOfShares();
    for (int share = 0; share < shares; ++share)
    {
      some[static_cast<std::size_t>(this->Tiles.GetOwner(share))] +=
        this->Drawing[static_cast<std::size_t>(share)];
      if ((share + 1) % window == 0 || share + 1 == shares)
      {
        costs.Waiting += *std::max_element(some.begin(), some.end());
        std::transform(all.begin(), all.end(), some.begin(), all.begin(), std::plus<>());
        std::fill(some.begin(), some.end(), 0.0);
      }
    }
    costs.Slowest = *std::max_element(all.begin(), all.end());
    return costs;
  }

  int Processes;
  const vtkirt::Scene& Whole;
  vtkirt::SharedTiles Tiles;
  vtkSmartPointer<vtkUnstructuredGrid> Piece;
  MeshTracer Tracer;
  vtkirt::Scene Own;
  double Finding = std::numeric_limits<double>::infinity();
  /// Of all parts, those to the process itself, too.
  int Messages = 0;
  /// Of each share.
  std::vector<double> Drawing;
  std::int64_t Segments = 0;
};

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
std::int64_t CloudTiles::Find(int tile)
{
  const vtkirt::PixelRectangle& pixels = this->Tiles[static_cast<std::size_t>(tile)];
  std::uint32_t open[vtkirt::CloudTile::Edge];
  std::fill(std::begin(open), std::end(open), ~0U);
  vtkirt::MakeCloudRays(this->TheScene, pixels, vtkirt::GetBestKernels(), this->Rays);
  this->Finder.Begin(pixels, this->Rays);
  std::int64_t count = 0;
  while (std::isfinite(this->Finder.GetNextDepth()))
  {
    this->Finder.FindMore(open, this->Segments);
    count += this->Segments.Count;
  }
  return count;
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
    times.Segments += tiles.Find(tile);
  }
  return times;
}

//------------------------------------------------------------------------------
void SimulateProcesses(vtkUnstructuredGrid* grid, const std::vector<vtkirt::CloudNode>& nodes,
  const View& view, int size, int most)
{
  const vtkirt::CloudMedium medium(nodes);
  const PictureRays rays(view, size);
  const auto makeScene = [&](const MeshTracer& tracer)
  { return tracer.MakeCloudScene(view, rays, size, medium); };
  const MeshTracer tracer(grid, grid->GetPointData()->GetScalars(), 1);
  const vtkirt::Scene whole = makeScene(tracer);
  std::vector<std::unique_ptr<SimulatedPicture>> pictures;
  for (int processes = 1; processes <= most; processes *= processes == 1 ? 8 : 4)
  {
    pictures.push_back(std::make_unique<SimulatedPicture>(whole, grid, makeScene, processes));
  }
  for (int repeat = 0; repeat < 3; ++repeat)
  {
    for (const auto& picture : pictures)
    {
      picture->Measure();
    }
  }
  std::printf("%lld tetrahedra, %d x %d pixels, %lld segments\n\n"
              "| processes | find, ms | draw, slowest, ms | messages, ms | picture, ms "
              "| efficiency | picture if all wait for each other, ms | efficiency |\n"
              "|---|---|---|---|---|---|---|---|\n",
    static_cast<long long>(grid->GetNumberOfCells()), size, size,
    static_cast<long long>(pictures.front()->GetNumberOfSegments()));
  double alone = 0.0;
  for (const auto& picture : pictures)
  {
    const double seconds = picture->Report(alone);
    alone = picture == pictures.front() ? seconds : alone;
  }
}

}
