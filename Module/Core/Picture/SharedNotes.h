// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SharedNotes_h
#define SharedNotes_h

#include "Kernels/CloudTile.h"
#include "Picture/Compositor.h"
#include "Picture/MessageExchange.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <type_traits>
#include <vector>

// What processes tell each other about the tiles of a picture that they draw together. A message is
// a list of notes.

namespace vtkIsosurfaceRayTracing
{

/// Appends numbers to a message, as bytes. (All processes have one byte order, as MPI has it for
/// bytes.)
class NoteWriter
{
public:
  explicit NoteWriter(MessageExchange::Message& message)
    : Message(message)
  {
  }

  template <typename Number>
  void Add(const Number* numbers, std::size_t count)
  {
    static_assert(std::is_trivially_copyable_v<Number>, "Numbers are sent as bytes.");
    const auto* bytes = reinterpret_cast<const unsigned char*>(numbers);
    this->Message.insert(this->Message.end(), bytes, bytes + count * sizeof(Number));
  }

  template <typename Number>
  void Add(const Number& number)
  {
    this->Add(&number, 1);
  }

private:
  MessageExchange::Message& Message;
};

/// Takes them out again.
class NoteReader
{
public:
  NoteReader(const unsigned char* first, std::size_t size)
    : Next(first)
    , End(first + size)
  {
  }

  bool IsAtEnd() const { return this->Next == this->End; }

  template <typename Number>
  void Take(Number* numbers, std::size_t count)
  {
    static_assert(std::is_trivially_copyable_v<Number>, "Numbers are sent as bytes.");
    std::copy_n(this->Skip(count * sizeof(Number)), count * sizeof(Number),
      reinterpret_cast<unsigned char*>(numbers));
  }

  template <typename Number>
  Number Take()
  {
    Number number;
    this->Take(&number, 1);
    return number;
  }

  /// Passes over some bytes, and returns where they begin.
  const unsigned char* Skip(std::size_t bytes)
  {
    this->Next += bytes;
    return this->Next - bytes;
  }

private:
  const unsigned char* Next;
  const unsigned char* End;
};

/// How each note begins.
struct NoteHeader
{
  enum Kinds : std::int32_t
  {
    /// Some segments of a tile, and at first the fragments, for its owner.
    Part,
    /// More segments are wanted: by which rays, and from which depth on.
    Request,
    /// A tile is drawn.
    Finished
  };

  std::int32_t Kind;
  std::int32_t Tile;
  /// The size of what follows.
  std::int64_t Bytes;
};

/// How what follows begins in a part.
struct PartHeader
{
  /// No segment in a later part begins before this depth; infinite if there is none.
  double Horizon;
  std::int64_t Fragments;
  std::int64_t Segments;
};

/// What follows in a request.
struct SegmentRequest
{
  double From;
  std::uint32_t Open[CloudTile::Edge];
};

/// A fragment and the number of its pixel in the tile.
struct TileFragment
{
  int Pixel;
  Fragment Own;
};

/// Segments of a tile, of any fields.
class TileSegments
{
public:
  /// What a segment takes in a message: its pixel, two depths, two values of each component, and
  /// two of each gradient.
  static std::size_t GetBytesOfOne(int components, int gradients)
  {
    return 1 + 2 * (1 + static_cast<std::size_t>(components)) * sizeof(double) +
      2 * 3 * static_cast<std::size_t>(gradients) * sizeof(float);
  }

  void Clear()
  {
    this->Least = std::numeric_limits<double>::infinity();
    this->Runs.clear();
    this->Pixels.clear();
    for (int end = 0; end < 2; ++end)
    {
      this->Depths[end].clear();
      for (auto& values : this->Values)
      {
        values[end].clear();
      }
      for (auto& coordinates : this->Gradients)
      {
        coordinates[end].clear();
      }
    }
  }

  std::size_t GetCount() const { return this->Pixels.size(); }
  double GetLeastDepth() const { return this->Least; }

  void Add(std::size_t field, const CloudSegments& segments)
  {
    const std::size_t before = this->GetCount();
    this->Runs.push_back({ static_cast<std::int32_t>(field), segments.Count, segments.Components,
      segments.Gradients });
    this->Pixels.insert(this->Pixels.end(), segments.Pixel, segments.Pixel + segments.Count);
    for (int end = 0; end < 2; ++end)
    {
      const double* depths = segments.Depth[end];
      this->Depths[end].insert(this->Depths[end].end(), depths, depths + segments.Count);
      for (int i = 0; i < segments.Components; ++i)
      {
        Append(segments.Value[i][end], segments.Count, before, this->Values[i][end]);
      }
      for (int i = 0; i < 3 * segments.Gradients; ++i)
      {
        Append(segments.Gradient[i][end], segments.Count, before, this->Gradients[i][end]);
      }
    }
    this->Least = std::accumulate(segments.Depth[0], segments.Depth[0] + segments.Count,
      this->Least, [](double a, double b) { return std::min(a, b); });
  }

  /// Keeps those that begin before a depth.
  void CutAt(double depth)
  {
    std::size_t kept = 0;
    std::size_t next = 0;
    for (Run& run : this->Runs)
    {
      const std::size_t keptBefore = kept;
      for (const std::size_t end = next + static_cast<std::size_t>(run.Count); next < end; ++next)
      {
        if (this->Depths[0][next] < depth)
        {
          this->Move(next, kept++, run);
        }
      }
      run.Count = static_cast<std::int32_t>(kept - keptBefore);
    }
    this->Pixels.resize(kept);
  }

  void Write(NoteWriter& writer) const
  {
    writer.Add(static_cast<std::int64_t>(this->Runs.size()));
    writer.Add(this->Runs.data(), this->Runs.size());
    std::size_t first = 0;
    for (const Run& run : this->Runs)
    {
      const auto count = static_cast<std::size_t>(run.Count);
      for (int end = 0; end < 2; ++end)
      {
        writer.Add(this->Depths[end].data() + first, count);
        for (int i = 0; i < run.Components; ++i)
        {
          writer.Add(this->Values[i][end].data() + first, count);
        }
        for (int i = 0; i < 3 * run.Gradients; ++i)
        {
          writer.Add(this->Gradients[i][end].data() + first, count);
        }
      }
      writer.Add(this->Pixels.data() + first, count);
      first += count;
    }
  }

  /// Calls add(field, segments) for what was written.
  template <typename AddSegments>
  static void Read(NoteReader& reader, CloudSegments& segments, const AddSegments& add)
  {
    std::vector<Run> runs(static_cast<std::size_t>(reader.Take<std::int64_t>()));
    reader.Take(runs.data(), runs.size());
    std::uint8_t pixels[CloudSegments::Capacity];
    for (const Run& run : runs)
    {
      segments.Count = run.Count;
      segments.Components = run.Components;
      segments.Gradients = run.Gradients;
      const auto count = static_cast<std::size_t>(run.Count);
      for (int end = 0; end < 2; ++end)
      {
        reader.Take(segments.Depth[end], count);
        for (int i = 0; i < run.Components; ++i)
        {
          reader.Take(segments.Value[i][end], count);
        }
        for (int i = 0; i < 3 * run.Gradients; ++i)
        {
          reader.Take(segments.Gradient[i][end], count);
        }
      }
      reader.Take(pixels, count);
      std::copy_n(pixels, count, segments.Pixel);
      add(static_cast<std::size_t>(run.Field), segments);
    }
  }

private:
  /// Segments of one field, no more than CloudSegments has room for.
  struct Run
  {
    std::int32_t Field;
    std::int32_t Count;
    std::int32_t Components;
    std::int32_t Gradients;
  };

  /// Appends numbers to those of the runs before, which may have fewer components.
  template <typename Number>
  static void Append(const Number* numbers, int count, std::size_t before, std::vector<Number>& all)
  {
    all.resize(before);
    all.insert(all.end(), numbers, numbers + count);
  }

  void Move(std::size_t from, std::size_t to, const Run& run)
  {
    this->Pixels[to] = this->Pixels[from];
    for (int end = 0; end < 2; ++end)
    {
      this->Depths[end][to] = this->Depths[end][from];
      for (int i = 0; i < run.Components; ++i)
      {
        this->Values[i][end][to] = this->Values[i][end][from];
      }
      for (int i = 0; i < 3 * run.Gradients; ++i)
      {
        this->Gradients[i][end][to] = this->Gradients[i][end][from];
      }
    }
  }

  double Least = std::numeric_limits<double>::infinity();
  std::vector<Run> Runs;
  std::vector<std::uint8_t> Pixels;
  std::vector<double> Depths[2];
  std::vector<double> Values[MaximumCloudComponents][2];
  std::vector<float> Gradients[3 * MaximumCloudComponents][2];
};

}

#endif
