// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Pictures of clouds that many processes draw together: bit for bit those of one process that has
// all cells, whatever each has, however it is cut into parts, and whenever messages come. The
// processes are threads here.

#include "Math/Matrix.h"
#include "Matrices.h"
#include "Mesh/MeshField.h"
#include "Picture/CloudMedium.h"
#include "Picture/RenderSharedTiles.h"
#include "Picture/SharedTiles.h"
#include "RandomNumbers.h"
#include "TestMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <numeric>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr int Width = 150;
constexpr int Height = 130;

//------------------------------------------------------------------------------
/// What connects the processes: messages of each pair keep their order.
class Network
{
public:
  explicit Network(int processes)
    : Processes(processes)
    , Lines(static_cast<std::size_t>(processes * processes))
  {
  }

  std::deque<MessageExchange::Message>& GetLine(int from, int to)
  {
    return this->Lines[static_cast<std::size_t>(from * this->Processes + to)];
  }

  void FindLargest(int* numbers, int count)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Largest.resize(static_cast<std::size_t>(count), numbers[0]);
    if (this->Waiting == 0)
    {
      this->Largest.assign(numbers, numbers + count);
    }
    for (int i = 0; i < count; ++i)
    {
      int& largest = this->Largest[static_cast<std::size_t>(i)];
      largest = std::max(largest, numbers[i]);
    }
    const int turn = this->Turn;
    if (++this->Waiting == this->Processes)
    {
      this->Waiting = 0;
      ++this->Turn;
      this->Released = this->Largest;
      this->AllAreThere.notify_all();
    }
    this->AllAreThere.wait(lock, [&] { return this->Turn != turn; });
    std::copy(this->Released.begin(), this->Released.end(), numbers);
  }

  std::mutex Mutex;
  int Processes;

private:
  std::vector<std::deque<MessageExchange::Message>> Lines;
  std::condition_variable AllAreThere;
  std::vector<int> Largest;
  std::vector<int> Released;
  int Waiting = 0;
  int Turn = 0;
};

/// Messages come when they come.
class SlowExchange final : public MessageExchange
{
public:
  SlowExchange(Network& network, int process, unsigned int seed)
    : TheNetwork(network)
    , Process(process)
    , Random(seed)
  {
  }

  int GetNumberOfProcesses() const override { return this->TheNetwork.Processes; }
  int GetProcess() const override { return this->Process; }
  void FindLargest(int* numbers, int count) override
  {
    this->TheNetwork.FindLargest(numbers, count);
  }

  bool IsSent(int /*process*/) override { return this->Random.Integer(0, 2) > 0; }

  void Send(int process, Message& message) override
  {
    EXPECT_NE(process, this->Process);
    EXPECT_FALSE(message.empty());
    const std::lock_guard<std::mutex> lock(this->TheNetwork.Mutex);
    this->TheNetwork.GetLine(this->Process, process).push_back(std::move(message));
  }

  bool Receive(int& process, Message& message) override
  {
    const std::lock_guard<std::mutex> lock(this->TheNetwork.Mutex);
    const int processes = this->TheNetwork.Processes;
    const int first = this->Random.Integer(0, 2 * processes);
    for (int i = 0; i < processes && first < processes; ++i)
    {
      process = (first + i) % processes;
      std::deque<Message>& line = this->TheNetwork.GetLine(process, this->Process);
      if (!line.empty())
      {
        message = std::move(line.front());
        line.pop_front();
        return true;
      }
    }
    return false;
  }

private:
  Network& TheNetwork;
  int Process;
  RandomNumbers Random;
};

//------------------------------------------------------------------------------
/// Colours of isosurfaces by their values.
class Hues final : public ValueColors
{
public:
  std::array<double, 4> Get(double value) const override
  {
    return { 0.5 + 0.4 * value, 0.5, 0.5 - 0.4 * value, 0.7 };
  }
};

/// Some cells of a mesh, and what is drawn of them.
struct Piece
{
  Piece(const TestMesh& mesh, const CloudMedium& medium, const TraceRequest& request)
    : Mesh(mesh)
    , Field(this->Mesh.View(), 1)
    , Request(request)
  {
    const Matrix4 worldFromObject = Multiply(Rotation(0.3, 0.5), Scaling({ 1.0, 1.2, 0.9 }));
    const Vector3 eye =
      TransformPoint(worldFromObject, { 4.0, 3.5, 3.0 }) + Vector3{ 0.3, 0.2, 13 };
    const Matrix4 clipFromObject =
      Multiply(Perspective(1.0, 40.0, 0.45), Multiply(Invert(Translation(eye)), worldFromObject));
    SceneField field;
    field.Field = &this->Field;
    field.View = { clipFromObject, Invert(clipFromObject), worldFromObject, Width, Height };
    field.Cloud = &medium;
    field.ColorsOfValues = &this->Colors;
    field.Colors.assign(request.Surfaces.size(), { 0.9, 0.6, 0.3 });
    this->Shown.Fields = { field };
    this->Shown.Pixels = { 0, 0, Width, Height };
    this->Shown.TileWidth = CloudTile::Edge;
    this->Shown.TileHeight = CloudTile::Edge;
    this->Shown.Lights.resize(1);
    this->Field.Select(this->Request, { 1 });
  }

  TestMesh Mesh;
  MeshField Field;
  TraceRequest Request;
  Hues Colors;
  Scene Shown;
};

/// The cells of a mesh that a function takes.
template <typename Takes>
TestMesh TakeCells(const TestMesh& mesh, const Takes& takes)
{
  TestMesh taken = mesh;
  taken.Shapes.clear();
  taken.Offsets = { 0 };
  taken.Connectivity.clear();
  for (std::size_t cell = 0; cell < mesh.Shapes.size(); ++cell)
  {
    if (takes(cell))
    {
      taken.Shapes.push_back(mesh.Shapes[cell]);
      for (std::int64_t i = mesh.Offsets[cell]; i < mesh.Offsets[cell + 1]; ++i)
      {
        taken.Connectivity.push_back(mesh.Connectivity[static_cast<std::size_t>(i)]);
      }
      taken.Offsets.push_back(static_cast<std::int64_t>(taken.Connectivity.size()));
    }
  }
  return taken;
}

/// How cells are given to processes.
enum class Dealing
{
  RoundRobin,
  InOrder,
  AllButOneHaveNone
};

std::vector<TestMesh> Deal(const TestMesh& mesh, int processes, Dealing dealing)
{
  const auto count = static_cast<std::size_t>(processes);
  const std::size_t cells = mesh.Shapes.size();
  std::vector<TestMesh> pieces;
  for (std::size_t process = 0; process < count; ++process)
  {
    pieces.push_back(TakeCells(mesh,
      [&](std::size_t cell)
      {
        switch (dealing)
        {
          case Dealing::RoundRobin:
            return cell % count == process;
          case Dealing::InOrder:
            return cell * count / cells == process;
          default:
            return process == count / 2;
        }
      }));
  }
  return pieces;
}

//------------------------------------------------------------------------------
/// A mesh in which all is drawn, and its picture by one process.
struct Whole
{
  /// Of so many cells along the edge of a cube.
  Whole(double attenuation, bool hasSurfaces, bool hasComponents = false, bool isLit = false,
    int fineness = 1)
  {
    RandomNumbers random(17);
    this->Mesh = MakeMesh(random, Index3{ 8 * fineness, 7 * fineness, 6 * fineness },
      Cutting::Mixed, 0.2, [&](const Index3&) { return random.Uniform(-1.0, 1.0); });
    for (double& coordinate : this->Mesh.Points)
    {
      coordinate /= fineness;
    }
    this->Request.HasCloud = true;
    if (hasSurfaces)
    {
      this->Request.Surfaces = { { 0.1, 0.4 }, { 0.6, 1.0 } };
    }
    const std::vector<CloudNode> nodes = { { -1.0, 0.0, { 0.1, 0.2, 0.9 } },
      { 0.0, 0.3 * attenuation, { 0.4, 0.9, 0.1 } }, { 1.0, attenuation, { 1.0, 0.3, 0.2 } } };
    std::vector<CloudMedium::Nodes> ofComponents = { nodes };
    if (hasComponents)
    {
      ofComponents.push_back({ { -0.5, 0.0, { 0.9, 0.1, 0.1 } }, { 1.0, 0.5, { 0.2, 0.2, 1.0 } } });
      for (const double value : this->Mesh.Values)
      {
        this->Mesh.Components.insert(
          this->Mesh.Components.end(), { value, random.Uniform(-1.0, 1.0) });
      }
    }
    this->Medium = std::make_unique<CloudMedium>(ofComponents, true);
    if (isLit)
    {
      this->Medium->SetMaterials(
        std::vector<CloudMaterial>(ofComponents.size(), { 0.2, 0.7, 0.4, 12.0 }));
      this->Request.LitComponents = static_cast<int>(ofComponents.size());
      this->Request.Normals = NormalMode::InterpolantGradient;
    }
    Piece piece(this->Mesh, *this->Medium, this->Request);
    FrameTimes times;
    EXPECT_TRUE(RenderTiles(piece.Shown, { 1 }, this->Picture, times, [](double) { return true; }));
  }

  TestMesh Mesh;
  TraceRequest Request;
  std::unique_ptr<CloudMedium> Medium;
  Frame Picture;
};

/// What all processes drew.
struct Shared
{
  Frame Picture;
  SharingCounts Counts;
};

Shared RenderTogether(const Whole& whole, int processes, Dealing dealing, int threads,
  const Sharing& sharing, int stoppedProcess = -1)
{
  const std::vector<TestMesh> meshes = Deal(whole.Mesh, processes, dealing);
  std::vector<std::unique_ptr<Piece>> pieces;
  for (const TestMesh& mesh : meshes)
  {
    pieces.push_back(std::make_unique<Piece>(mesh, *whole.Medium, whole.Request));
  }
  Network network(processes);
  std::vector<Frame> frames(pieces.size());
  std::vector<SharingCounts> counts(pieces.size());
  std::vector<std::thread> running;
  for (int process = 0; process < processes; ++process)
  {
    running.emplace_back(
      [&, process]
      {
        const auto number = static_cast<std::size_t>(process);
        SlowExchange exchange(network, process, 100 + static_cast<unsigned int>(process));
        Scene& scene = pieces[number]->Shown;
        ASSERT_EQ(AgreeOnPicture(&scene, exchange), Agreement::Fine);
        const bool isComplete = RenderSharedTiles(scene, { threads }, sharing, exchange,
          frames[number], counts[number], [&](double) { return process != stoppedProcess; });
        EXPECT_EQ(isComplete, process != stoppedProcess);
      });
  }
  for (std::thread& thread : running)
  {
    thread.join();
  }
  Shared shared;
  const SharedTiles tiles(pieces.front()->Shown, processes);
  shared.Picture = frames.front();
  for (int share = 0; share < tiles.GetNumberOfShares(); ++share)
  {
    const Frame& from = frames[static_cast<std::size_t>(tiles.GetOwner(share))];
    for (const PixelRectangle& pixels : tiles.FindRows(share).Rows)
    {
      const auto first = static_cast<std::ptrdiff_t>(pixels.Y) * Width + pixels.X;
      std::copy_n(from.Colors.begin() + 4 * first, 4 * pixels.Width,
        shared.Picture.Colors.begin() + 4 * first);
      std::copy_n(from.Depths.begin() + first, pixels.Width, shared.Picture.Depths.begin() + first);
    }
  }
  for (const SharingCounts& own : counts)
  {
    shared.Counts.SegmentsFound += own.SegmentsFound;
    shared.Counts.SegmentsDrawn += own.SegmentsDrawn;
    EXPECT_LE(own.MostStored, own.SegmentsDrawn);
  }
  return shared;
}

void ExpectSame(const Frame& one, const Frame& other)
{
  EXPECT_TRUE(one.Colors == other.Colors);
  EXPECT_TRUE(one.Depths == other.Depths);
}

//------------------------------------------------------------------------------
/// Each pixel is in one row of one share, where the tile says, and all processes have about as
/// many.
TEST(SharedTiles, AreDealtOutEvenly)
{
  Scene scene;
  scene.TileWidth = CloudTile::Edge;
  scene.TileHeight = CloudTile::Edge;
  for (const int columns : { 1, 4, 30, 33 })
  {
    scene.Pixels = { 0, 0, 16 * columns - 3, 16 * 32 - 5 };
    for (const int processes : { 1, 2, 3, 4, 8, 12, 16, 40 })
    {
      const SharedTiles tiles(scene, processes);
      EXPECT_LE(tiles.GetGroupSize(), processes);
      std::vector<int> drawn(static_cast<std::size_t>(scene.Pixels.Width * scene.Pixels.Height), 0);
      std::vector<int> owned(static_cast<std::size_t>(processes), 0);
      for (int share = 0; share < tiles.GetNumberOfShares(); ++share)
      {
        const PixelRows rows = tiles.FindRows(share);
        ASSERT_EQ(rows.Count, CloudTile::Edge);
        for (int i = 0; i < rows.Count; ++i)
        {
          const PixelRectangle& row = rows.Rows[i];
          owned[static_cast<std::size_t>(tiles.GetOwner(share))] += row.Width;
          for (int x = row.X; x < row.X + row.Width; ++x)
          {
            ++drawn[static_cast<std::size_t>(row.Y * scene.Pixels.Width + x)];
          }
        }
      }
      EXPECT_TRUE(std::all_of(drawn.begin(), drawn.end(), [](int count) { return count == 1; }));
      EXPECT_LE(*std::max_element(owned.begin(), owned.end()),
        *std::min_element(owned.begin(), owned.end()) + 8 * CloudTile::Capacity);
      for (int group = 0; group < tiles.GetNumberOfGroups(); ++group)
      {
        for (int tile = 0; tile < tiles.GetNumberOfTilesOf(group); ++tile)
        {
          const PixelRectangle& pixels = tiles.GetTile(group, tile);
          for (int row = 0; row < pixels.Height; ++row)
          {
            const int number = tiles.GetNumberOfShare(tile, row);
            const int place = tiles.GetRowInShare(tile, row);
            EXPECT_EQ(tiles.GetTileOfRow(place), tile);
            EXPECT_EQ(tiles.GetRowInTile(number, place), row);
            const PixelRectangle found = tiles.FindRows(tiles.GetShare(group, number)).Rows[place];
            EXPECT_EQ(found.X, pixels.X);
            EXPECT_EQ(found.Y, pixels.Y + row);
          }
        }
      }
    }
  }
}

/// What is dense in one place is dealt out to all.
TEST(SharedTiles, HaveSharesAlikeOfWhatIsDense)
{
  Scene scene;
  scene.TileWidth = CloudTile::Edge;
  scene.TileHeight = CloudTile::Edge;
  scene.Pixels = { 0, 0, 512, 512 };
  for (const int processes : { 8, 32, 128, 512 })
  {
    const SharedTiles tiles(scene, processes);
    std::vector<double> work(static_cast<std::size_t>(processes), 0.0);
    for (int share = 0; share < tiles.GetNumberOfShares(); ++share)
    {
      for (const PixelRectangle& row : tiles.FindRows(share).Rows)
      {
        const double x = (row.X + 8 - 256) / 100.0;
        const double y = (row.Y - 200) / 100.0;
        work[static_cast<std::size_t>(tiles.GetOwner(share))] += std::exp(-x * x - y * y);
      }
    }
    const double sum = std::accumulate(work.begin(), work.end(), 0.0);
    const double most = *std::max_element(work.begin(), work.end());
    EXPECT_LT(most, (processes > 128 ? 1.45 : 1.1) * sum / processes) << processes;
  }
}

//------------------------------------------------------------------------------
class SharedPicture : public testing::TestWithParam<std::tuple<int, Dealing>>
{
};

TEST_P(SharedPicture, IsThatOfOneProcess)
{
  const auto [processes, dealing] = this->GetParam();
  for (const auto& [hasSurfaces, hasComponents, isLit] :
    { std::tuple(false, false, false), std::tuple(true, false, false),
      std::tuple(true, true, false), std::tuple(false, false, true), std::tuple(true, true, true) })
  {
    const Whole whole(0.5, hasSurfaces, hasComponents, isLit);
    EXPECT_GT(*std::max_element(whole.Picture.Colors.begin(), whole.Picture.Colors.end()), 100);
    const Shared shared = RenderTogether(whole, processes, dealing, 1, {});
    ExpectSame(shared.Picture, whole.Picture);
    EXPECT_EQ(shared.Counts.SegmentsFound, shared.Counts.SegmentsDrawn);
    EXPECT_GT(shared.Counts.SegmentsFound, 50000);
    // Many parts, and a message for each.
    ExpectSame(
      RenderTogether(whole, processes, dealing, 1, { 1, 3, 900, 1 }).Picture, whole.Picture);
    ExpectSame(RenderTogether(whole, processes, dealing, 3, {}).Picture, whole.Picture);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SharedPicture,
  testing::Combine(testing::Values(1, 2, 3, 8),
    testing::Values(Dealing::RoundRobin, Dealing::InOrder, Dealing::AllButOneHaveNone)));

//------------------------------------------------------------------------------
/// Each process has one row of each tile of a group.
TEST(SharedTiles, AreDrawnByManyProcesses)
{
  const Whole whole(0.5, true);
  ExpectSame(RenderTogether(whole, 20, Dealing::RoundRobin, 1, {}).Picture, whole.Picture);
  ExpectSame(
    RenderTogether(whole, 17, Dealing::InOrder, 1, { 100, 1, 900, 1 }).Picture, whole.Picture);
}

//------------------------------------------------------------------------------
/// Where a cloud is dense, no more is looked for than what is seen, and what is near to that.
TEST(SharedTiles, LeavesOutWhatIsHidden)
{
  const Whole thin(0.5, false, false, false, 3);
  const Whole dense(200.0, false, false, false, 3);
  const Sharing sharing = { 1, 1, 600, 1 };
  const Shared all = RenderTogether(thin, 3, Dealing::RoundRobin, 1, sharing);
  const Shared some = RenderTogether(dense, 3, Dealing::RoundRobin, 1, sharing);
  ExpectSame(some.Picture, dense.Picture);
  EXPECT_LT(some.Counts.SegmentsFound, all.Counts.SegmentsFound / 2);
}

//------------------------------------------------------------------------------
/// A process that is stopped does not keep the others waiting.
TEST(SharedTiles, GoOnWhenAProcessIsStopped)
{
  const Whole whole(0.5, false);
  RenderTogether(whole, 4, Dealing::RoundRobin, 2, {}, 2);
}

//------------------------------------------------------------------------------
TEST(SharedTiles, AgreeOnPictures)
{
  Network network(3);
  const auto agree = [&network](const std::array<Scene*, 3>& scenes)
  {
    std::array<Agreement, 3> all{};
    std::vector<std::thread> running;
    for (int process = 0; process < 3; ++process)
    {
      running.emplace_back(
        [&, process]
        {
          const auto number = static_cast<std::size_t>(process);
          SlowExchange exchange(network, process, 1);
          all[number] = AgreeOnPicture(scenes[number], exchange);
        });
    }
    for (std::thread& thread : running)
    {
      thread.join();
    }
    EXPECT_EQ(all[0], all[1]);
    EXPECT_EQ(all[0], all[2]);
    return all[0];
  };
  std::array<Scene, 3> scenes;
  for (Scene& scene : scenes)
  {
    scene.Fields.resize(2);
  }
  scenes[0].Pixels = { 16, 32, 20, 10 };
  scenes[1].Pixels = { 0, 0, 0, 0 };
  scenes[2].Pixels = { 0, 48, 7, 9 };
  EXPECT_EQ(agree({ &scenes[0], &scenes[1], &scenes[2] }), Agreement::Fine);
  for (const Scene& scene : scenes)
  {
    EXPECT_EQ(scene.Pixels.X, 0);
    EXPECT_EQ(scene.Pixels.Y, 32);
    EXPECT_EQ(scene.Pixels.Width, 36);
    EXPECT_EQ(scene.Pixels.Height, 25);
  }
  EXPECT_EQ(agree({ &scenes[0], nullptr, &scenes[2] }), Agreement::Refused);
  scenes[2].Fields.resize(1);
  EXPECT_EQ(agree({ &scenes[0], &scenes[1], &scenes[2] }), Agreement::DifferentFields);
  for (Scene& scene : scenes)
  {
    scene.Fields.resize(1);
    scene.Pixels = {};
  }
  EXPECT_EQ(agree({ &scenes[0], &scenes[1], &scenes[2] }), Agreement::Fine);
  EXPECT_TRUE(IsEmpty(scenes[1].Pixels));
}

}
}
