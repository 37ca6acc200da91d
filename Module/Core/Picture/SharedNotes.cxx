// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/SharedNotes.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Writes some numbers, given by their places.
template <typename Number>
void WriteSome(const std::vector<Number>& numbers, const std::uint32_t* places, std::size_t count,
  NoteWriter& writer)
{
  Number some[CloudSegments::Batch];
  std::transform(
    places, places + count, some, [&numbers](std::uint32_t place) { return numbers[place]; });
  writer.Add(some, count);
}

}

//------------------------------------------------------------------------------
void SharedSegments::Clear()
{
  this->Shares.clear();
  this->Pixels.clear();
  for (int end = 0; end < 2; ++end)
  {
    this->Depths[end].clear();
    for (auto& values : this->Values)
    {
      values[end].clear();
    }
    for (auto& coordinates : this->Coordinates)
    {
      coordinates[end].clear();
    }
  }
}

//------------------------------------------------------------------------------
void SharedSegments::Add(const CloudSegments& segments, const RowPlace (&places)[CloudTile::Edge])
{
  this->Components = segments.Components;
  this->Gradients = segments.Gradients;
  const auto append = [count = segments.Count](const auto* from, auto& to)
  { to.insert(to.end(), from, from + count); };
  for (int end = 0; end < 2; ++end)
  {
    append(segments.Depth[end], this->Depths[end]);
    for (int i = 0; i < segments.Components; ++i)
    {
      append(segments.Value[i][end], this->Values[i][end]);
    }
    for (int i = 0; i < 3 * segments.Gradients; ++i)
    {
      append(segments.Gradient[i][end], this->Coordinates[i][end]);
    }
  }
  std::uint8_t shares[CloudSegments::Capacity];
  std::uint8_t pixels[CloudSegments::Capacity];
  for (int i = 0; i < segments.Count; ++i)
  {
    const RowPlace& place = places[segments.Pixel[i] / CloudTile::Edge];
    shares[i] = place.Share;
    pixels[i] = static_cast<std::uint8_t>(place.Pixel + segments.Pixel[i] % CloudTile::Edge);
  }
  append(shares, this->Shares);
  append(pixels, this->Pixels);
}

//------------------------------------------------------------------------------
void SharedSegments::Sort()
{
  std::fill(std::begin(this->First), std::end(this->First), std::size_t{ 0 });
  for (const std::uint8_t share : this->Shares)
  {
    ++this->First[share + 1];
  }
  std::partial_sum(std::begin(this->First), std::end(this->First), std::begin(this->First));
  std::size_t next[SharedTiles::MaximumGroupSize];
  std::copy_n(this->First, SharedTiles::MaximumGroupSize, next);
  this->Order.resize(this->GetCount());
  for (std::size_t i = 0; i < this->Shares.size(); ++i)
  {
    this->Order[next[this->Shares[i]]++] = static_cast<std::uint32_t>(i);
  }
}

//------------------------------------------------------------------------------
void SharedSegments::Write(std::size_t field, int share, NoteWriter& writer) const
{
  const std::uint32_t* places = this->Order.data() + this->First[share];
  for (std::size_t left = this->GetCountOf(share); left > 0;)
  {
    const std::size_t count = std::min<std::size_t>(left, CloudSegments::Batch);
    writer.Add(Run{ static_cast<std::int32_t>(field), static_cast<std::int32_t>(count),
      this->Components, this->Gradients });
    for (int end = 0; end < 2; ++end)
    {
      WriteSome(this->Depths[end], places, count, writer);
      for (int i = 0; i < this->Components; ++i)
      {
        WriteSome(this->Values[i][end], places, count, writer);
      }
      for (int i = 0; i < 3 * this->Gradients; ++i)
      {
        WriteSome(this->Coordinates[i][end], places, count, writer);
      }
    }
    WriteSome(this->Pixels, places, count, writer);
    places += count;
    left -= count;
  }
}

}
