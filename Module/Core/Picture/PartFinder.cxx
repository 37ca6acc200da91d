// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/PartFinder.h"

#include "Kernels/Kernels.h"
#include "Math/Arithmetic.h"
#include "Picture/Tiles.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <numeric>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
PartRequest PartRequest::MakeFirst()
{
  PartRequest request{};
  for (OfTile& tile : request.Tiles)
  {
    std::fill(std::begin(tile.Open), std::end(tile.Open), ~0U);
  }
  return request;
}

//------------------------------------------------------------------------------
bool PartRequest::IsLookedFor(const SharedTiles& tiles, int number) const
{
  for (int row = 0; row < CloudTile::Edge; ++row)
  {
    const OfTile& tile = this->Tiles[tiles.GetTileOfRow(row)];
    if (tile.NextDepth < Infinity && tile.Open[tiles.GetRowInTile(number, row)] != 0)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
PartFinder::PartFinder(const Scene& scene, const SharedTiles& tiles,
  const std::vector<Shader>& shaders, const Kernels* kernels, Frame& frame, std::size_t enough)
  : TheScene(scene)
  , Tiles(tiles)
  , TheKernels(kernels ? *kernels : BaselineKernels)
  , Enough(enough)
  , BlocksAtOnce(PixelBlockRenderer::GetBlocksAtOnce(scene))
  , Blocks(scene, shaders, this, frame)
  , Clouds(scene, kernels)
  , Segments(new CloudSegments)
  , FragmentsOfShares(static_cast<std::size_t>(tiles.GetGroupSize()))
  , SegmentsOfFields(scene.Fields.size())
{
  this->Segments->Enough = static_cast<int>(std::min<std::size_t>(enough, CloudSegments::Batch));
}

//------------------------------------------------------------------------------
void PartFinder::Find(int group, const PartRequest& request)
{
  for (std::vector<TileFragment>& fragments : this->FragmentsOfShares)
  {
    fragments.clear();
  }
  for (SharedSegments& segments : this->SegmentsOfFields)
  {
    segments.Clear();
  }
  for (PartRequest::OfTile& rest : this->Rest.Tiles)
  {
    rest.NextDepth = Infinity;
  }
  for (int tile = 0; tile < this->Tiles.GetNumberOfTilesOf(group); ++tile)
  {
    for (int row = 0; row < CloudTile::Edge; ++row)
    {
      this->Places[row] = { static_cast<std::uint8_t>(this->Tiles.GetNumberOfShare(tile, row)),
        static_cast<std::uint8_t>(this->Tiles.GetRowInShare(tile, row) * CloudTile::Edge) };
    }
    const PartRequest::OfTile& ofTile = request.Tiles[tile];
    if (ofTile.NextDepth < Infinity)
    {
      this->FindTile(this->Tiles.GetTile(group, tile), ofTile, this->Rest.Tiles[tile]);
    }
  }
  for (SharedSegments& segments : this->SegmentsOfFields)
  {
    segments.Sort();
  }
}

//------------------------------------------------------------------------------
void PartFinder::FindTile(
  const PixelRectangle& tile, const PartRequest::OfTile& request, PartRequest::OfTile& rest)
{
  const bool isFirst = request.Position.empty();
  MakeCloudRays(this->TheScene, tile, this->TheKernels, this->Rays);
  if (isFirst)
  {
    this->FindFragments(tile);
  }
  this->Clouds.Begin(tile, this->Rays, isFirst ? nullptr : &request.Position);
  std::size_t count = 0;
  while (
    this->Clouds.GetNextDepth() < Infinity && (count < this->Enough || !this->Clouds.IsPaused()))
  {
    const std::size_t field = count < this->Enough
      ? this->Clouds.FindMore(request.Open, *this->Segments)
      : this->Clouds.FindMoreToPause(request.Open, *this->Segments);
    this->SegmentsOfFields[field].Add(*this->Segments, this->Places);
    count += static_cast<std::size_t>(this->Segments->Count);
  }
  rest.NextDepth = this->Clouds.GetNextDepth();
  rest.Position = this->Clouds.FindPosition();
  std::copy(std::begin(request.Open), std::end(request.Open), rest.Open);
}

//------------------------------------------------------------------------------
void PartFinder::FindFragments(const PixelRectangle& tile)
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

//------------------------------------------------------------------------------
void PartFinder::SetFragments(int x, int y, const Fragment* fragments, std::size_t count)
{
  const RowPlace& place = this->Places[y];
  const std::size_t visible = CountVisible(fragments, count);
  for (std::size_t i = 0; i < visible; ++i)
  {
    this->FragmentsOfShares[static_cast<std::size_t>(place.Share)].push_back(
      { place.Pixel + x, fragments[i] });
  }
  CutCloudRay(fragments, visible, y * CloudTile::Edge + x, this->Rays);
}

//------------------------------------------------------------------------------
std::size_t PartFinder::GetNumberOfSegments() const
{
  return std::accumulate(this->SegmentsOfFields.begin(), this->SegmentsOfFields.end(),
    std::size_t{ 0 },
    [](std::size_t sum, const SharedSegments& own) { return sum + own.GetCount(); });
}

//------------------------------------------------------------------------------
void PartFinder::Write(int group, int number, MessageExchange::Message& message) const
{
  const std::vector<TileFragment>& fragments =
    this->FragmentsOfShares[static_cast<std::size_t>(number)];
  PartHeader part = {};
  part.Fragments = static_cast<std::int64_t>(fragments.size());
  for (const SharedSegments& segments : this->SegmentsOfFields)
  {
    part.Segments += static_cast<std::int64_t>(segments.GetCountOf(number));
  }
  std::fill(std::begin(part.Horizons), std::end(part.Horizons), Infinity);
  for (int row = 0; row < CloudTile::Edge; ++row)
  {
    // The owner answers if it has open rays there.
    const PartRequest::OfTile& rest = this->Rest.Tiles[this->Tiles.GetTileOfRow(row)];
    if (rest.Open[this->Tiles.GetRowInTile(number, row)] != 0)
    {
      part.Horizons[this->Tiles.GetTileOfRow(row)] = rest.NextDepth;
    }
  }
  NoteHeader header = { NoteHeader::Part, this->Tiles.GetShare(group, number), 0 };
  const std::size_t begin = message.size();
  NoteWriter writer(message);
  writer.Add(header);
  writer.Add(part);
  writer.Add(fragments.data(), fragments.size());
  for (std::size_t field = 0; field < this->SegmentsOfFields.size(); ++field)
  {
    this->SegmentsOfFields[field].Write(field, number, writer);
  }
  header.Bytes = static_cast<std::int64_t>(message.size() - begin - sizeof(header));
  std::memcpy(message.data() + begin, &header, sizeof(header));
}

}
