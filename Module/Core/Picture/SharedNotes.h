// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SharedNotes_h
#define SharedNotes_h

#include "Kernels/CloudTile.h"
#include "Picture/Compositor.h"
#include "Picture/MessageExchange.h"
#include "Picture/SharedTiles.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
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
    /// Some segments of a share, and at first the fragments, for its owner.
    Part,
    /// The rays of a share that are open, for a process whose last part was not its last one.
    Answer,
    /// A share is drawn.
    Finished
  };

  std::int32_t Kind;
  std::int32_t Share;
  /// The size of what follows.
  std::int64_t Bytes;
};

/// How what follows begins in a part.
struct PartHeader
{
  /// Of each tile of the group: no segment in a later part begins before this depth; infinite if
  /// there is none.
  double Horizons[SharedTiles::MaximumGroupSize];
  std::int64_t Fragments;
  std::int64_t Segments;
};

/// What follows in an answer: the open rays of each row.
struct OpenRays
{
  std::uint32_t Rows[CloudTile::Edge];
};

/// A fragment and the number of its pixel in the share.
struct TileFragment
{
  int Pixel;
  Fragment Own;
};

/// Where the segments of a row of a tile go: the number of a share, and the first pixel there.
struct RowPlace
{
  std::uint8_t Share;
  std::uint8_t Pixel;
};

/// Segments of one field, of the shares of a group.
class SharedSegments
{
public:
  /// What a segment takes in a message: its pixel, two depths, two values of each component, and
  /// two of each gradient.
  static std::size_t GetBytesOfOne(int components, int gradients)
  {
    return 1 + 2 * (1 + static_cast<std::size_t>(components)) * sizeof(double) +
      2 * 3 * static_cast<std::size_t>(gradients) * sizeof(float);
  }

  void Clear();
  std::size_t GetCount() const { return this->Pixels.size(); }

  /// Adds the segments of a tile whose rows go to some places.
  void Add(const CloudSegments& segments, const RowPlace (&places)[CloudTile::Edge]);

  /// Puts those of each share together; to be called before they are counted and written.
  void Sort();
  std::size_t GetCountOf(int share) const { return this->First[share + 1] - this->First[share]; }
  void Write(std::size_t field, int share, NoteWriter& writer) const;

  /// Calls add(field, segments) for all that was written.
  template <typename AddSegments>
  static void Read(NoteReader& reader, CloudSegments& segments, const AddSegments& add)
  {
    std::uint8_t pixels[CloudSegments::Batch];
    while (!reader.IsAtEnd())
    {
      const Run run = reader.Take<Run>();
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
  /// How what is written begins: some segments, no more than a batch.
  struct Run
  {
    std::int32_t Field;
    std::int32_t Count;
    std::int32_t Components;
    std::int32_t Gradients;
  };

  int Components = 0;
  int Gradients = 0;
  std::vector<std::uint8_t> Shares;
  std::vector<std::uint8_t> Pixels;
  std::vector<double> Depths[2];
  std::vector<double> Values[MaximumCloudComponents][2];
  std::vector<float> Coordinates[3 * MaximumCloudComponents][2];
  /// The places of the segments of each share, from its first on.
  std::vector<std::uint32_t> Order;
  std::size_t First[SharedTiles::MaximumGroupSize + 1] = {};
};

}

#endif
