// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/RenderSharedTiles.h"

#include "Field/FirstException.h"
#include "Math/Arithmetic.h"
#include "Picture/CloudMedium.h"
#include "Picture/CloudTileRenderer.h"
#include "Picture/PartFinder.h"
#include "Picture/SharedNotes.h"
#include "Picture/SharedTiles.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <iterator>
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
/// A part of a share as its owner has it.
struct Part
{
  int Process;
  PartHeader Header;
  /// What follows the header.
  Message Bytes;

  bool IsLast() const
  {
    return std::all_of(std::begin(this->Header.Horizons), std::end(this->Header.Horizons),
      [](double horizon) { return horizon == Infinity; });
  }
};

/// A share that the process owns.
struct OwnShare
{
  /// How many processes send the next part, and those that have come.
  int Awaited;
  std::vector<Part> Parts;
  /// While it is begun and not finished.
  std::unique_ptr<CloudTileRenderer> Renderer;
  /// How many of its segments there are.
  std::int64_t Stored = 0;
};

/// What a process has found of a group of tiles.
struct FoundGroup
{
  /// What is looked for next, and how many owners have not answered which rays are open.
  PartRequest Next;
  int Awaited = 0;
};

/// Gives the fragments of all parts to the renderer of their share, those of each pixel front to
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
  std::size_t bytes = SharedSegments::GetBytesOfOne(1, 0);
  for (const SceneField& field : scene.Fields)
  {
    if (field.Cloud)
    {
      const MixedTransfers& mixed = field.Cloud->GetMixed();
      bytes = std::max(bytes, SharedSegments::GetBytesOfOne(mixed.Components, mixed.Gradients));
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
    , OwnShares(static_cast<std::size_t>(this->Tiles.GetNumberOfShares()))
    , Groups(static_cast<std::size_t>(this->Tiles.GetNumberOfGroups()))
    , GroupsLeft(this->Tiles.GetNumberOfGroups())
    , Unfinished(this->Groups.size(), this->Tiles.GetGroupSize())
    , MessageBytes(sharing.BufferDepth * FindBytesOfSegment(scene))
    , Outgoing(static_cast<std::size_t>(this->Processes))
  {
    for (std::size_t share = 0; share < this->OwnShares.size(); ++share)
    {
      this->OwnShares[share].Awaited = this->Processes;
      this->SharesLeft += this->Tiles.GetOwner(static_cast<int>(share)) == this->Own ? 1 : 0;
    }
    // The same for all processes.
    this->Window = this->Tiles.FindWindow(execution.Threads);
    exchange.FindLargest(&this->Window, 1);
    this->Jobs = this->GroupsLeft + this->SharesLeft;
  }

  bool IsDone() const { return this->IsOver; }

  double GetFractionDone() const
  {
    return static_cast<double>(this->JobsDone.load()) /
      static_cast<double>(std::max(this->Jobs, 1));
  }

  /// Works until the progress is to be reported, or all is done.
  void TakeStep();

  /// What is left to do is done without drawing: the others wait for it.
  void Abandon() { this->IsAbandoned = true; }

  /// To be called when all is done.
  void Rethrow() const { this->Exception.Rethrow(); }

private:
  /// What a thread does next: parts of a group are found, or a share is drawn.
  struct Job
  {
    enum Kinds
    {
      None,
      Find,
      Draw
    };

    Kinds Kind = None;
    /// The group or the share.
    int Number = 0;
    PartRequest Request{};
  };

  /// Whether groups must wait for earlier ones.
  bool IsWindowed() const { return this->Window < this->Tiles.GetNumberOfGroups(); }

  Job TakeJob();
  void Do(const Job& job);
  const PartFinder* FindParts(const Job& job, std::vector<Message>& notes);
  void Find(const Job& job);
  void Await(const PartRequest& rest, FoundGroup& group);
  void FinishGroup();
  void Draw(int share);
  bool DrawParts(OwnShare& own, int share);
  std::unique_ptr<CloudTileRenderer> TakeRenderer();
  void Answer(int share, bool isFinished);
  bool IsWanted(const Part& part, const OpenRays& open) const;
  void Finish(int share);
  template <typename... Body>
  void Tell(int process, NoteHeader::Kinds kind, int share, const Body&... body);
  void TellNothing(int owner, int share);
  void TakeOwn();
  void Take(int process, const Message& message);
  void Deliver(Part&& part, int share);
  void TakeAnswer(int share, const OpenRays& open);
  void MarkFinished(int share);
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
  std::vector<OwnShare> OwnShares;
  std::vector<std::unique_ptr<CloudTileRenderer>> FreeRenderers;
  std::deque<int> Drawable;
  std::vector<FoundGroup> Groups;
  std::deque<int> Requested;
  /// Those in which something may be left to find, and own shares that are not drawn.
  int GroupsLeft;
  int SharesLeft = 0;
  /// The next group, and the first that is not drawn; how many shares of each are not.
  int NextGroup = 0;
  int FirstGroup = 0;
  std::vector<int> Unfinished;
  std::int64_t Stored = 0;
  /// What is sent to each process when it has so many bytes.
  std::size_t MessageBytes;
  std::vector<Message> Outgoing;

  int Jobs = 0;
  std::atomic<int> JobsDone{ 0 };
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
    job.Number = this->Drawable.front();
    this->Drawable.pop_front();
  }
  else if (!this->Requested.empty())
  {
    job.Kind = Job::Find;
    job.Number = this->Requested.front();
    job.Request = this->Groups[static_cast<std::size_t>(job.Number)].Next;
    this->Requested.pop_front();
  }
  else if (this->NextGroup <
    std::min(this->FirstGroup + this->Window, this->Tiles.GetNumberOfGroups()))
  {
    job.Kind = Job::Find;
    job.Number = this->NextGroup++;
    job.Request = PartRequest::MakeFirst();
  }
  return job;
}

//------------------------------------------------------------------------------
void SharedRenderer::Do(const Job& job)
{
  if (job.Kind == Job::Draw)
  {
    this->Draw(job.Number);
  }
  else
  {
    this->Find(job);
  }
}

//------------------------------------------------------------------------------
/// Writes the parts of a group to notes, one for each share. Returns what has found them; null if
/// there are none, because something has gone wrong.
const PartFinder* SharedRenderer::FindParts(const Job& job, std::vector<Message>& notes)
{
  const PartFinder* found = nullptr;
  if (this->IsAbandoned)
  {
    return found;
  }
  this->Exception.Guard(
    [&]
    {
      std::unique_ptr<PartFinder>& finder =
        this->Finders[static_cast<std::size_t>(omp_get_thread_num())];
      if (!finder)
      {
        finder = std::make_unique<PartFinder>(this->TheScene, this->Tiles, this->Shaders,
          this->TheExecution.PacketKernels, this->Picture,
          this->TheSharing.FindSegmentsOfPart(this->Processes));
      }
      finder->Find(job.Number, job.Request);
      for (int number = 0; number < this->Tiles.GetGroupSize(); ++number)
      {
        if (job.Request.IsLookedFor(this->Tiles, number))
        {
          finder->Write(job.Number, number, notes[static_cast<std::size_t>(number)]);
        }
      }
      found = finder.get();
    });
  return found;
}

//------------------------------------------------------------------------------
/// Finds a part of a group. Whatever happens, there is one: others wait for it.
void SharedRenderer::Find(const Job& job)
{
  std::vector<Message> notes(static_cast<std::size_t>(this->Tiles.GetGroupSize()));
  const PartFinder* found = this->FindParts(job, notes);
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->IsAbandoned = this->IsAbandoned || !found;
  for (int number = 0; number < this->Tiles.GetGroupSize(); ++number)
  {
    if (!job.Request.IsLookedFor(this->Tiles, number))
    {
      continue;
    }
    const int share = this->Tiles.GetShare(job.Number, number);
    const int owner = this->Tiles.GetOwner(share);
    if (found)
    {
      const Message& note = notes[static_cast<std::size_t>(number)];
      Message& outgoing = this->Outgoing[static_cast<std::size_t>(owner)];
      outgoing.insert(outgoing.end(), note.begin(), note.end());
    }
    else
    {
      this->TellNothing(owner, share);
    }
  }
  FoundGroup& group = this->Groups[static_cast<std::size_t>(job.Number)];
  if (found)
  {
    this->Counts.SegmentsFound += static_cast<std::int64_t>(found->GetNumberOfSegments());
    this->Await(found->GetRest(), group);
  }
  if (group.Awaited == 0)
  {
    this->FinishGroup();
  }
  this->TakeOwn();
}

//------------------------------------------------------------------------------
/// Waits until the owners of shares whose part was not the last one have answered which rays are
/// open. The mutex is held.
void SharedRenderer::Await(const PartRequest& rest, FoundGroup& group)
{
  group.Next = rest;
  for (int number = 0; number < this->Tiles.GetGroupSize(); ++number)
  {
    group.Awaited += rest.IsLookedFor(this->Tiles, number) ? 1 : 0;
  }
  for (PartRequest::OfTile& tile : group.Next.Tiles)
  {
    std::fill(std::begin(tile.Open), std::end(tile.Open), 0U);
  }
}

//------------------------------------------------------------------------------
void SharedRenderer::FinishGroup()
{
  --this->GroupsLeft;
  ++this->JobsDone;
}

//------------------------------------------------------------------------------
/// Draws the parts of a share, all of which have come.
void SharedRenderer::Draw(int share)
{
  OwnShare& own = this->OwnShares[static_cast<std::size_t>(share)];
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
        isFinished = this->DrawParts(own, share);
        left = isFinished ? 0 : static_cast<std::int64_t>(own.Renderer->GetNumberOfPending());
      });
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Stored += left - own.Stored;
  own.Stored = left;
  this->Answer(share, isFinished);
  if (isFinished)
  {
    this->Finish(share);
  }
  this->TakeOwn();
}

//------------------------------------------------------------------------------
/// Returns whether no more will be seen of the share.
bool SharedRenderer::DrawParts(OwnShare& own, int share)
{
  std::vector<NoteReader> readers;
  double depths[CloudTile::Edge];
  std::fill(std::begin(depths), std::end(depths), Infinity);
  for (const Part& part : own.Parts)
  {
    readers.emplace_back(part.Bytes.data(), part.Bytes.size());
    for (int row = 0; row < CloudTile::Edge; ++row)
    {
      depths[row] = std::min(depths[row], part.Header.Horizons[this->Tiles.GetTileOfRow(row)]);
    }
  }
  if (!own.Renderer)
  {
    own.Renderer = this->TakeRenderer();
    own.Renderer->Begin(this->Tiles.FindRows(share));
    SetFragments(own.Parts, readers, *own.Renderer);
  }
  auto segments = std::make_unique<CloudSegments>();
  for (NoteReader& reader : readers)
  {
    SharedSegments::Read(reader, *segments,
      [&own](std::size_t field, const CloudSegments& some) { own.Renderer->Add(field, some); });
  }
  own.Renderer->DrawBefore(depths);
  for (int row = 0; row < CloudTile::Edge; ++row)
  {
    if (depths[row] < Infinity && own.Renderer->GetOpen()[row] != 0)
    {
      return false;
    }
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
/// Tells those that may find more which rays are open. The mutex is held, as for all that follow.
void SharedRenderer::Answer(int share, bool isFinished)
{
  OwnShare& own = this->OwnShares[static_cast<std::size_t>(share)];
  OpenRays open = {};
  if (!isFinished)
  {
    std::copy_n(own.Renderer->GetOpen(), CloudTile::Edge, open.Rows);
  }
  own.Awaited = 0;
  for (const Part& part : own.Parts)
  {
    if (!part.IsLast())
    {
      own.Awaited += this->IsWanted(part, open) ? 1 : 0;
      this->Tell(part.Process, NoteHeader::Answer, share, open);
    }
  }
  own.Parts.clear();
}

//------------------------------------------------------------------------------
/// Whether a next part follows one.
bool SharedRenderer::IsWanted(const Part& part, const OpenRays& open) const
{
  for (int row = 0; row < CloudTile::Edge; ++row)
  {
    if (open.Rows[row] != 0 && part.Header.Horizons[this->Tiles.GetTileOfRow(row)] < Infinity)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
void SharedRenderer::Finish(int share)
{
  OwnShare& own = this->OwnShares[static_cast<std::size_t>(share)];
  if (own.Renderer)
  {
    this->FreeRenderers.push_back(std::move(own.Renderer));
  }
  std::vector<Part>().swap(own.Parts);
  --this->SharesLeft;
  ++this->JobsDone;
  for (int process = 0; process < this->Processes && this->IsWindowed(); ++process)
  {
    this->Tell(process, NoteHeader::Finished, share);
  }
}

//------------------------------------------------------------------------------
/// Tells a process, which may be this one, something about a share.
template <typename... Body>
void SharedRenderer::Tell(int process, NoteHeader::Kinds kind, int share, const Body&... body)
{
  NoteWriter writer(this->Outgoing[static_cast<std::size_t>(process)]);
  writer.Add(NoteHeader{ kind, share, (std::int64_t{ 0 } + ... + std::int64_t{ sizeof(body) }) });
  (writer.Add(body), ...);
}

//------------------------------------------------------------------------------
/// Tells the owner of a share that nothing more comes.
void SharedRenderer::TellNothing(int owner, int share)
{
  PartHeader part = {};
  std::fill(std::begin(part.Horizons), std::end(part.Horizons), Infinity);
  this->Tell(owner, NoteHeader::Part, share, part);
}

//------------------------------------------------------------------------------
/// Takes what the process tells itself.
void SharedRenderer::TakeOwn()
{
  Message message;
  message.swap(this->Outgoing[static_cast<std::size_t>(this->Own)]);
  this->Take(this->Own, message);
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
      this->Deliver({ process, part, Message(bytes, bytes + size) }, header.Share);
    }
    else if (header.Kind == NoteHeader::Answer)
    {
      this->TakeAnswer(header.Share, reader.Take<OpenRays>());
    }
    else
    {
      this->MarkFinished(header.Share);
    }
  }
}

//------------------------------------------------------------------------------
void SharedRenderer::Deliver(Part&& part, int share)
{
  OwnShare& own = this->OwnShares[static_cast<std::size_t>(share)];
  const std::int64_t count = part.Header.Segments;
  own.Stored += count;
  this->Stored += count;
  this->Counts.MostStored = std::max(this->Counts.MostStored, this->Stored);
  this->Counts.SegmentsDrawn += count;
  own.Parts.push_back(std::move(part));
  if (static_cast<int>(own.Parts.size()) == own.Awaited)
  {
    this->Drawable.push_back(share);
  }
}

//------------------------------------------------------------------------------
/// When the owners of all shares of a group have answered, more of it is found, or it is finished.
void SharedRenderer::TakeAnswer(int share, const OpenRays& open)
{
  const int number = this->Tiles.GetGroup(share);
  FoundGroup& group = this->Groups[static_cast<std::size_t>(number)];
  for (int row = 0; row < CloudTile::Edge; ++row)
  {
    const int inTile = this->Tiles.GetRowInTile(this->Tiles.GetNumber(share), row);
    group.Next.Tiles[this->Tiles.GetTileOfRow(row)].Open[inTile] = open.Rows[row];
  }
  if (--group.Awaited > 0)
  {
    return;
  }
  bool isAnyOpen = false;
  for (PartRequest::OfTile& tile : group.Next.Tiles)
  {
    const bool isOpen = tile.NextDepth < Infinity &&
      std::any_of(
        std::begin(tile.Open), std::end(tile.Open), [](std::uint32_t row) { return row != 0; });
    tile.NextDepth = isOpen ? tile.NextDepth : Infinity;
    isAnyOpen = isAnyOpen || isOpen;
  }
  if (isAnyOpen)
  {
    this->Requested.push_back(number);
  }
  else
  {
    this->FinishGroup();
  }
}

//------------------------------------------------------------------------------
void SharedRenderer::MarkFinished(int share)
{
  --this->Unfinished[static_cast<std::size_t>(this->Tiles.GetGroup(share))];
  while (this->FirstGroup < this->Tiles.GetNumberOfGroups() &&
    this->Unfinished[static_cast<std::size_t>(this->FirstGroup)] == 0)
  {
    ++this->FirstGroup;
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
/// Whether all is found and drawn, and all that is told to or by this process has come.
bool SharedRenderer::IsNothingLeft()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  bool isLeft = this->GroupsLeft > 0 || this->SharesLeft > 0 ||
    (this->IsWindowed() && this->FirstGroup < this->Tiles.GetNumberOfGroups());
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
  // Of the least numbers those with the other sign are the largest.
  enum
  {
    HasRefused,
    MinusX,
    MinusY,
    EndX,
    EndY,
    Fields,
    MinusFields,
    Numbers
  };
  constexpr int none = std::numeric_limits<int>::min() / 2;
  int largest[Numbers] = { 1, none, none, none, none, none, none };
  if (scene)
  {
    const PixelRectangle& pixels = scene->Pixels;
    const auto fields = static_cast<int>(scene->Fields.size());
    largest[HasRefused] = 0;
    largest[Fields] = fields;
    largest[MinusFields] = -fields;
    if (!IsEmpty(pixels))
    {
      largest[MinusX] = -pixels.X;
      largest[MinusY] = -pixels.Y;
      largest[EndX] = pixels.X + pixels.Width;
      largest[EndY] = pixels.Y + pixels.Height;
    }
  }
  exchange.FindLargest(largest, Numbers);
  if (largest[HasRefused] != 0)
  {
    return Agreement::Refused;
  }
  if (largest[Fields] != -largest[MinusFields])
  {
    return Agreement::DifferentFields;
  }
  scene->Pixels = {};
  if (largest[EndX] > none)
  {
    scene->Pixels = { -largest[MinusX], -largest[MinusY], largest[EndX] + largest[MinusX],
      largest[EndY] + largest[MinusY] };
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
