// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/RenderSharedTiles.h"

#include "Field/FirstException.h"
#include "Math/Arithmetic.h"
#include "Picture/CloudFinder.h"
#include "Picture/CloudMedium.h"
#include "Picture/CloudTileRenderer.h"
#include "Picture/PixelBlockRenderer.h"
#include "Picture/SharedNotes.h"
#include "Picture/SharedTiles.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

namespace vtkIsosurfaceRayTracing
{
namespace
{

using Clock = std::chrono::steady_clock;
using Message = MessageExchange::Message;

/// The time between two reports of progress, as in RenderTiles.
constexpr std::chrono::milliseconds ReportInterval{ 20 };

/// How long a thread rests that finds nothing to do: processes may have to share a core.
constexpr std::chrono::microseconds Rest{ 20 };

//------------------------------------------------------------------------------
/// Finds the parts of tiles, for one thread.
class PartFinder final : public FragmentSink
{
public:
  PartFinder(const Scene& scene, const std::vector<Shader>& shaders, const Kernels* kernels,
    Frame& frame, std::size_t enough)
    : TheScene(scene)
    , TheKernels(kernels ? *kernels : BaselineKernels)
    , Enough(enough)
    , BlocksAtOnce(PixelBlockRenderer::GetBlocksAtOnce(scene))
    , Blocks(scene, shaders, this, frame)
    , Clouds(scene, kernels)
    , Segments(new CloudSegments)
  {
    this->Segments->Enough = static_cast<int>(std::min<std::size_t>(enough, CloudSegments::Batch));
  }

  void SetFragments(int x, int y, const Fragment* fragments, std::size_t count) override
  {
    const int pixel = y * CloudTile::Edge + x;
    for (std::size_t i = 0; i < count; ++i)
    {
      this->Fragments.push_back({ pixel, fragments[i] });
    }
    CutCloudRay(fragments, count, pixel, this->Rays);
  }

  /// Finds the next part of a tile: the first has the fragments, too.
  void Find(const PixelRectangle& tile, const SegmentRequest& request)
  {
    this->Fragments.clear();
    this->Found.Clear();
    MakeCloudRays(this->TheScene, tile, this->TheKernels, this->Rays);
    // Later parts begin behind the near plane.
    if (request.From == 0.0)
    {
      this->FindFragments(tile);
    }
    this->Clouds.Begin(tile, this->Rays, request.From);
    this->Horizon = this->Clouds.GetNextDepth();
    while (this->Horizon < Infinity &&
      (this->Found.GetCount() < this->Enough || this->Found.GetLeastDepth() >= this->Horizon))
    {
      const std::size_t field = this->Clouds.FindMore(request.Open, *this->Segments);
      this->Found.Add(field, *this->Segments);
      this->Horizon = this->Clouds.GetNextDepth();
    }
    this->Found.CutAt(this->Horizon);
  }

  std::size_t GetNumberOfSegments() const { return this->Found.GetCount(); }

  /// Writes the part that was found, as a note.
  void Write(int tile, Message& message) const
  {
    const PartHeader part = { this->Horizon, static_cast<std::int64_t>(this->Fragments.size()),
      static_cast<std::int64_t>(this->Found.GetCount()) };
    Message body;
    NoteWriter writer(body);
    writer.Add(part);
    writer.Add(this->Fragments.data(), this->Fragments.size());
    this->Found.Write(writer);
    NoteWriter(message).Add(
      NoteHeader{ NoteHeader::Part, tile, static_cast<std::int64_t>(body.size()) });
    message.insert(message.end(), body.begin(), body.end());
  }

  /// Writes a part with nothing, the last of a tile.
  static void WriteNothing(int tile, Message& message)
  {
    NoteWriter writer(message);
    writer.Add(NoteHeader{ NoteHeader::Part, tile, sizeof(PartHeader) + sizeof(std::int64_t) });
    writer.Add(PartHeader{ Infinity, 0, 0 });
    writer.Add(std::int64_t{ 0 });
  }

private:
  void FindFragments(const PixelRectangle& tile)
  {
    this->Blocks.BeginTile(tile);
    ForEachGroup(tile, this->BlocksAtOnce,
      [this](const PixelRectangle* blocks, int count)
      {
        this->Blocks.Trace(blocks, count);
        this->Blocks.Shade();
        return true;
      });
  }

  const Scene& TheScene;
  const Kernels& TheKernels;
  std::size_t Enough;
  int BlocksAtOnce;
  PixelBlockRenderer Blocks;
  CloudFinder Clouds;
  CloudTile Rays;
  std::unique_ptr<CloudSegments> Segments;
  std::vector<TileFragment> Fragments;
  TileSegments Found;
  double Horizon = 0.0;
};

//------------------------------------------------------------------------------
/// A part of a tile as its owner has it.
struct Part
{
  int Process;
  PartHeader Header;
  /// What follows the header.
  Message Bytes;
};

/// A tile that the process owns.
struct OwnTile
{
  /// How many processes send the next part, and those that have come.
  int Awaited;
  std::vector<Part> Parts;
  /// While it is begun and not finished.
  std::unique_ptr<CloudTileRenderer> Renderer;
  /// How many of its segments there are.
  std::int64_t Stored = 0;
};

/// Gives the fragments of all parts to the renderer of their tile, those of each pixel front to
/// back. They are passed over by the readers.
void SetFragments(
  const std::vector<Part>& parts, std::vector<NoteReader>& readers, CloudTileRenderer& renderer)
{
  std::vector<TileFragment> all;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const std::size_t before = all.size();
    const auto count = static_cast<std::size_t>(parts[i].Header.Fragments);
    all.resize(before + count);
    readers[i].Take(all.data() + before, count);
  }
  std::stable_sort(all.begin(), all.end(),
    [](const TileFragment& a, const TileFragment& b)
    { return std::tie(a.Pixel, a.Own.T) < std::tie(b.Pixel, b.Own.T); });
  std::vector<Fragment> ofPixel;
  for (std::size_t first = 0; first < all.size();)
  {
    const int pixel = all[first].Pixel;
    ofPixel.clear();
    for (; first < all.size() && all[first].Pixel == pixel; ++first)
    {
      ofPixel.push_back(all[first].Own);
    }
    renderer.SetFragments(
      pixel % CloudTile::Edge, pixel / CloudTile::Edge, ofPixel.data(), ofPixel.size());
  }
}

/// What a segment takes in a message, at most.
std::size_t FindBytesOfSegment(const Scene& scene)
{
  std::size_t bytes = TileSegments::GetBytesOfOne(1, 0);
  for (const SceneField& field : scene.Fields)
  {
    if (field.Cloud)
    {
      const MixedTransfers& mixed = field.Cloud->GetMixed();
      bytes = std::max(bytes, TileSegments::GetBytesOfOne(mixed.Components, mixed.Gradients));
    }
  }
  return bytes;
}

//------------------------------------------------------------------------------
class SharedRenderer
{
public:
  /// All must outlive the renderer.
  SharedRenderer(const Scene& scene, const Execution& execution, const Sharing& sharing,
    MessageExchange& exchange, Frame& frame, SharingCounts& counts)
    : TheScene(scene)
    , TheExecution(execution)
    , TheSharing(sharing)
    , Exchange(exchange)
    , Picture(frame)
    , Counts(counts)
    , Own(exchange.GetProcess())
    , Processes(exchange.GetNumberOfProcesses())
    , Tiles(scene, this->Processes)
    , Shaders(MakeShaders(scene, execution.PacketKernels))
    , Finders(static_cast<std::size_t>(execution.Threads))
    , OwnTiles(static_cast<std::size_t>(this->Tiles.GetCount()))
    , IsFinished(static_cast<std::size_t>(this->Tiles.GetCount()), false)
    , MessageBytes(sharing.BufferDepth * FindBytesOfSegment(scene))
    , Outgoing(static_cast<std::size_t>(this->Processes))
  {
    for (OwnTile& tile : this->OwnTiles)
    {
      tile.Awaited = this->Processes;
    }
    // Enough for all threads of all processes, and no more than it takes.
    this->Window =
      std::max({ 16, 2 * this->Processes, 4 * execution.Threads, this->Tiles.GetCount() / 64 });
  }

  bool IsDone() const { return this->IsOver; }

  double GetFractionDone() const
  {
    return static_cast<double>(this->NumberOfFinished.load()) /
      static_cast<double>(std::max(this->Tiles.GetCount(), 1));
  }

  /// Works until the progress is to be reported, or all is done.
  void TakeStep();

  /// What is left to do is done without drawing: the others wait for it.
  void Abandon() { this->IsAbandoned = true; }

  /// To be called when all is done.
  void Rethrow() const { this->Exception.Rethrow(); }

private:
  /// What a thread does next: a part of a tile is found, or a tile is drawn.
  struct Job
  {
    enum Kinds
    {
      None,
      Find,
      Draw
    };

    Kinds Kind = None;
    int Tile = 0;
    SegmentRequest Request{};
  };

  Job TakeJob();
  void Do(const Job& job);
  void Find(const Job& job);
  void Draw(int tile);
  bool DrawParts(OwnTile& own, int tile);
  std::unique_ptr<CloudTileRenderer> TakeRenderer();
  void RequestMore(int tile);
  void Finish(int tile);
  void Tell(int process, NoteHeader::Kinds kind, int tile, const SegmentRequest* request);
  void Post(int process, const Message& notes);
  void Take(int process, const Message& message);
  void Deliver(Part&& part, int tile);
  void MarkFinished(int tile);
  void Communicate(bool sendsAll);
  bool IsNothingLeft();

  const Scene& TheScene;
  const Execution& TheExecution;
  const Sharing& TheSharing;
  MessageExchange& Exchange;
  Frame& Picture;
  SharingCounts& Counts;
  int Own;
  int Processes;
  SharedTiles Tiles;
  std::vector<Shader> Shaders;
  /// Of each thread.
  std::vector<std::unique_ptr<PartFinder>> Finders;
  int Window = 0;

  /// Guards all that follows, up to the messages.
  std::mutex Mutex;
  std::vector<OwnTile> OwnTiles;
  std::vector<std::unique_ptr<CloudTileRenderer>> FreeRenderers;
  std::deque<int> Drawable;
  std::deque<Job> Requested;
  /// The next turn, and the first whose tile is not finished: see SharedTiles::GetTile.
  int NextTurn = 0;
  int FirstTurn = 0;
  std::vector<bool> IsFinished;
  std::int64_t Stored = 0;
  /// What is sent to each process when it has so many bytes.
  std::size_t MessageBytes;
  std::vector<Message> Outgoing;

  std::atomic<int> NumberOfFinished{ 0 };
  std::atomic<bool> IsAbandoned{ false };
  std::atomic<bool> IsOver{ false };
  std::atomic<bool> IsStepOver{ false };
  FirstException Exception;
};

//------------------------------------------------------------------------------
void SharedRenderer::TakeStep()
{
  const Clock::time_point start = Clock::now();
  this->IsStepOver = false;
#pragma omp parallel num_threads(this->TheExecution.Threads)
  {
    const bool isFirst = omp_get_thread_num() == 0;
    int partsSincePoll = 0;
    while (!this->IsStepOver && !this->IsOver)
    {
      const Job job = this->TakeJob();
      if (job.Kind != Job::None)
      {
        this->Do(job);
        ++partsSincePoll;
      }
      const bool isIdle = job.Kind == Job::None;
      if (isFirst && (isIdle || partsSincePoll >= this->TheSharing.PollingInterval))
      {
        this->Communicate(isIdle);
        partsSincePoll = 0;
        this->IsOver = this->IsNothingLeft();
        this->IsStepOver = Clock::now() - start >= ReportInterval;
      }
      if (isIdle)
      {
        std::this_thread::sleep_for(Rest);
      }
    }
  }
}

//------------------------------------------------------------------------------
/// What is drawn makes room; what was begun comes before what is new.
SharedRenderer::Job SharedRenderer::TakeJob()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  Job job;
  if (!this->Drawable.empty())
  {
    job.Kind = Job::Draw;
    job.Tile = this->Drawable.front();
    this->Drawable.pop_front();
  }
  else if (!this->Requested.empty())
  {
    job = this->Requested.front();
    this->Requested.pop_front();
  }
  else if (this->NextTurn < std::min(this->FirstTurn + this->Window, this->Tiles.GetCount()))
  {
    job.Kind = Job::Find;
    job.Tile = this->Tiles.GetTile(this->NextTurn++);
    std::fill(std::begin(job.Request.Open), std::end(job.Request.Open), ~0U);
  }
  return job;
}

//------------------------------------------------------------------------------
void SharedRenderer::Do(const Job& job)
{
  if (job.Kind == Job::Draw)
  {
    this->Draw(job.Tile);
  }
  else
  {
    this->Find(job);
  }
}

//------------------------------------------------------------------------------
/// Finds a part of a tile. Whatever happens, there is one: others wait for it.
void SharedRenderer::Find(const Job& job)
{
  Message message;
  std::size_t count = 0;
  bool isFound = false;
  if (!this->IsAbandoned)
  {
    this->Exception.Guard(
      [&]
      {
        std::unique_ptr<PartFinder>& finder =
          this->Finders[static_cast<std::size_t>(omp_get_thread_num())];
        if (!finder)
        {
          finder = std::make_unique<PartFinder>(this->TheScene, this->Shaders,
            this->TheExecution.PacketKernels, this->Picture,
            this->TheSharing.SegmentsAtOnce / static_cast<std::size_t>(this->Processes));
        }
        finder->Find(this->Tiles.Get(job.Tile), job.Request);
        finder->Write(job.Tile, message);
        count = finder->GetNumberOfSegments();
        isFound = true;
      });
  }
  if (!isFound)
  {
    this->IsAbandoned = true;
    message.clear();
    PartFinder::WriteNothing(job.Tile, message);
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Counts.SegmentsFound += static_cast<std::int64_t>(count);
  this->Post(this->Tiles.GetOwner(job.Tile), message);
}

//------------------------------------------------------------------------------
/// Draws the parts of a tile, all of which have come.
void SharedRenderer::Draw(int tile)
{
  OwnTile& own = this->OwnTiles[static_cast<std::size_t>(tile)];
  // Not in the order of their arrival, so that the picture does not depend on it.
  std::sort(own.Parts.begin(), own.Parts.end(),
    [](const Part& a, const Part& b) { return a.Process < b.Process; });
  std::int64_t left = 0;
  bool isFinished = true;
  if (!this->IsAbandoned)
  {
    this->Exception.Guard(
      [&]
      {
        isFinished = this->DrawParts(own, tile);
        left = isFinished ? 0 : static_cast<std::int64_t>(own.Renderer->GetNumberOfPending());
      });
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Stored += left - own.Stored;
  own.Stored = left;
  if (isFinished)
  {
    this->Finish(tile);
  }
  else
  {
    this->RequestMore(tile);
  }
}

//------------------------------------------------------------------------------
/// Returns whether no more will be seen of the tile.
bool SharedRenderer::DrawParts(OwnTile& own, int tile)
{
  std::vector<NoteReader> readers;
  double horizon = Infinity;
  for (const Part& part : own.Parts)
  {
    readers.emplace_back(part.Bytes.data(), part.Bytes.size());
    horizon = std::min(horizon, part.Header.Horizon);
  }
  if (!own.Renderer)
  {
    own.Renderer = this->TakeRenderer();
    own.Renderer->Begin(this->Tiles.Get(tile));
    SetFragments(own.Parts, readers, *own.Renderer);
  }
  auto segments = std::make_unique<CloudSegments>();
  for (NoteReader& reader : readers)
  {
    TileSegments::Read(reader, *segments,
      [&own](std::size_t field, const CloudSegments& some) { own.Renderer->Add(field, some); });
  }
  own.Renderer->DrawBefore(horizon);
  if (horizon < Infinity && own.Renderer->IsAnyOpen())
  {
    return false;
  }
  own.Renderer->Finish(this->Picture);
  return true;
}

//------------------------------------------------------------------------------
std::unique_ptr<CloudTileRenderer> SharedRenderer::TakeRenderer()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (this->FreeRenderers.empty())
  {
    return std::make_unique<CloudTileRenderer>(this->TheScene, this->TheExecution.PacketKernels);
  }
  std::unique_ptr<CloudTileRenderer> taken = std::move(this->FreeRenderers.back());
  this->FreeRenderers.pop_back();
  return taken;
}

//------------------------------------------------------------------------------
/// Requests the next parts of a tile from those that have more. The mutex is held, as for all that
/// follow.
void SharedRenderer::RequestMore(int tile)
{
  OwnTile& own = this->OwnTiles[static_cast<std::size_t>(tile)];
  SegmentRequest request{};
  std::copy_n(own.Renderer->GetOpen(), CloudTile::Edge, request.Open);
  std::vector<Part> parts;
  parts.swap(own.Parts);
  own.Awaited = 0;
  for (const Part& part : parts)
  {
    if (part.Header.Horizon < Infinity)
    {
      ++own.Awaited;
      request.From = part.Header.Horizon;
      this->Tell(part.Process, NoteHeader::Request, tile, &request);
    }
  }
}

//------------------------------------------------------------------------------
void SharedRenderer::Finish(int tile)
{
  OwnTile& own = this->OwnTiles[static_cast<std::size_t>(tile)];
  if (own.Renderer)
  {
    this->FreeRenderers.push_back(std::move(own.Renderer));
  }
  std::vector<Part>().swap(own.Parts);
  for (int process = 0; process < this->Processes; ++process)
  {
    this->Tell(process, NoteHeader::Finished, tile, nullptr);
  }
}

//------------------------------------------------------------------------------
/// Tells a process, which may be this one, something about a tile.
void SharedRenderer::Tell(
  int process, NoteHeader::Kinds kind, int tile, const SegmentRequest* request)
{
  Message message;
  NoteWriter writer(message);
  writer.Add(NoteHeader{ kind, tile, static_cast<std::int64_t>(request ? sizeof(*request) : 0) });
  writer.Add(request, request ? 1 : 0);
  this->Post(process, message);
}

//------------------------------------------------------------------------------
void SharedRenderer::Post(int process, const Message& notes)
{
  if (process == this->Own)
  {
    this->Take(this->Own, notes);
    return;
  }
  Message& outgoing = this->Outgoing[static_cast<std::size_t>(process)];
  outgoing.insert(outgoing.end(), notes.begin(), notes.end());
}

//------------------------------------------------------------------------------
/// Takes the notes of a message.
void SharedRenderer::Take(int process, const Message& message)
{
  NoteReader reader(message.data(), message.size());
  while (!reader.IsAtEnd())
  {
    const auto header = reader.Take<NoteHeader>();
    if (header.Kind == NoteHeader::Part)
    {
      const auto part = reader.Take<PartHeader>();
      const std::size_t size = static_cast<std::size_t>(header.Bytes) - sizeof(part);
      const unsigned char* bytes = reader.Skip(size);
      this->Deliver({ process, part, Message(bytes, bytes + size) }, header.Tile);
    }
    else if (header.Kind == NoteHeader::Request)
    {
      this->Requested.push_back({ Job::Find, header.Tile, reader.Take<SegmentRequest>() });
    }
    else
    {
      this->MarkFinished(header.Tile);
    }
  }
}

//------------------------------------------------------------------------------
void SharedRenderer::Deliver(Part&& part, int tile)
{
  OwnTile& own = this->OwnTiles[static_cast<std::size_t>(tile)];
  const std::int64_t count = part.Header.Segments;
  own.Stored += count;
  this->Stored += count;
  this->Counts.MostStored = std::max(this->Counts.MostStored, this->Stored);
  this->Counts.SegmentsDrawn += count;
  own.Parts.push_back(std::move(part));
  if (static_cast<int>(own.Parts.size()) == own.Awaited)
  {
    this->Drawable.push_back(tile);
  }
}

//------------------------------------------------------------------------------
void SharedRenderer::MarkFinished(int tile)
{
  this->IsFinished[static_cast<std::size_t>(tile)] = true;
  ++this->NumberOfFinished;
  const int count = this->Tiles.GetCount();
  while (this->FirstTurn < count &&
    this->IsFinished[static_cast<std::size_t>(this->Tiles.GetTile(this->FirstTurn))])
  {
    ++this->FirstTurn;
  }
}

//------------------------------------------------------------------------------
/// Sends what is enough for a message, or all, and takes what has come. One thread does so.
void SharedRenderer::Communicate(bool sendsAll)
{
  Message message;
  for (int process = 0; process < this->Processes; ++process)
  {
    if (process == this->Own || !this->Exchange.IsSent(process))
    {
      continue;
    }
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      Message& outgoing = this->Outgoing[static_cast<std::size_t>(process)];
      if (outgoing.empty() || (!sendsAll && outgoing.size() < this->MessageBytes))
      {
        continue;
      }
      message.clear();
      message.swap(outgoing);
    }
    this->Counts.Bytes += static_cast<std::int64_t>(message.size());
    this->Exchange.Send(process, message);
  }
  int process = 0;
  while (this->Exchange.Receive(process, message))
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Take(process, message);
  }
}

//------------------------------------------------------------------------------
/// Whether all tiles are finished, and all that are told so know it.
bool SharedRenderer::IsNothingLeft()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  bool isLeft = this->NumberOfFinished < this->Tiles.GetCount();
  for (int process = 0; process < this->Processes && !isLeft; ++process)
  {
    isLeft = process != this->Own &&
      (!this->Outgoing[static_cast<std::size_t>(process)].empty() ||
        !this->Exchange.IsSent(process));
  }
  return !isLeft;
}

}

//------------------------------------------------------------------------------
Agreement AgreeOnPicture(Scene* scene, MessageExchange& exchange)
{
  constexpr int none = std::numeric_limits<int>::min() / 2;
  int largest[7] = { 1, none, none, none, none, none, none };
  if (scene)
  {
    const PixelRectangle& pixels = scene->Pixels;
    const auto fields = static_cast<int>(scene->Fields.size());
    largest[0] = 0;
    largest[5] = fields;
    largest[6] = -fields;
    if (!IsEmpty(pixels))
    {
      largest[1] = -pixels.X;
      largest[2] = -pixels.Y;
      largest[3] = pixels.X + pixels.Width;
      largest[4] = pixels.Y + pixels.Height;
    }
  }
  exchange.FindLargest(largest, 7);
  if (largest[0] != 0)
  {
    return Agreement::Refused;
  }
  if (largest[5] != -largest[6])
  {
    return Agreement::DifferentFields;
  }
  scene->Pixels = {};
  if (largest[3] > none)
  {
    scene->Pixels = { -largest[1], -largest[2], largest[3] + largest[1], largest[4] + largest[2] };
  }
  return Agreement::Fine;
}

//------------------------------------------------------------------------------
bool RenderSharedTiles(const Scene& scene, const Execution& execution, const Sharing& sharing,
  MessageExchange& exchange, Frame& frame, SharingCounts& counts,
  const std::function<bool(double)>& keepGoing)
{
  const std::size_t pixels =
    static_cast<std::size_t>(scene.Pixels.Width) * static_cast<std::size_t>(scene.Pixels.Height);
  frame.Colors.assign(4 * pixels, 0);
  frame.Depths.assign(pixels, PixelWithoutDepth);
  frame.Hits.clear();
  frame.Fragments.clear();
  counts = {};
  SharedRenderer renderer(scene, execution, sharing, exchange, frame, counts);
  bool isComplete = true;
  while (!renderer.IsDone())
  {
    renderer.TakeStep();
    if (isComplete && !keepGoing(renderer.GetFractionDone()))
    {
      isComplete = false;
      renderer.Abandon();
    }
  }
  renderer.Rethrow();
  return isComplete;
}

}
