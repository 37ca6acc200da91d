// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/PixelBlockRenderer.h"

#include "Picture/PlacesOfHits.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
PixelBlockRenderer::PixelBlockRenderer(
  const Scene& scene, const std::vector<Shader>& shaders, FragmentSink* sink, Frame& frame)
  : TheScene(scene)
  , Shaders(shaders)
  , Picture(frame)
  , BlocksAtOnce(GetBlocksAtOnce(scene))
  , Traced(new TracedPacket[scene.Fields.size() * static_cast<std::size_t>(this->BlocksAtOnce)])
  , FragmentsOfFields(scene.Fields.size())
  , Sink(sink)
{
  for (const SceneField& field : scene.Fields)
  {
    this->Beams.push_back(field.Field->MakeBeam());
  }
}

//------------------------------------------------------------------------------
int PixelBlockRenderer::GetBlocksAtOnce(const Scene& scene)
{
  int most = 1;
  for (const SceneField& field : scene.Fields)
  {
    most = std::max(most, field.Field->GetPacketsAtOnce());
  }
  return std::min(most, MaximumBlocks);
}

//------------------------------------------------------------------------------
void PixelBlockRenderer::BeginTile(const PixelRectangle& tile)
{
  this->Tile = tile;
  for (std::size_t i = 0; i < this->Beams.size(); ++i)
  {
    const SceneField& field = this->TheScene.Fields[i];
    if (this->Beams[i] && Overlap(field.Pixels, this->InViewport(tile)))
    {
      RayPacket& corners = this->GetTraced(i, 0).Corners;
      this->FindCorners(field.View, tile, corners);
      field.Field->Begin(corners, this->Beams[i].get());
    }
  }
}

//------------------------------------------------------------------------------
PixelRectangle PixelBlockRenderer::InViewport(const PixelRectangle& pixels) const
{
  return { this->TheScene.Pixels.X + pixels.X, this->TheScene.Pixels.Y + pixels.Y, pixels.Width,
    pixels.Height };
}

//------------------------------------------------------------------------------
/// The index of a pixel of a block in the arrays of a frame.
std::size_t PixelBlockRenderer::GetOffset(const PixelRectangle& block, int x, int y) const
{
  return static_cast<std::size_t>(block.X + x) +
    static_cast<std::size_t>(block.Y + y) * static_cast<std::size_t>(this->TheScene.Pixels.Width);
}

//------------------------------------------------------------------------------
void PixelBlockRenderer::Trace(const PixelRectangle* blocks, int count)
{
  this->BlockCount = count;
  std::copy_n(blocks, count, this->Blocks);
  for (int block = 0; block < count; ++block)
  {
    this->Ends[block].Clear();
  }
  // Projections last: they end at the surfaces of all fields.
  const std::vector<SceneField>& fields = this->TheScene.Fields;
  for (const bool isProjection : { false, true })
  {
    for (std::size_t i = 0; i < fields.size(); ++i)
    {
      if (fields[i].Field->GetRequest().Projection.has_value() == isProjection)
      {
        this->TraceField(i);
      }
    }
  }
}

//------------------------------------------------------------------------------
void PixelBlockRenderer::TraceField(std::size_t number)
{
  TracedField& field = *this->TheScene.Fields[number].Field;
  bool isAnyRay = false;
  for (int block = 0; block < this->BlockCount; ++block)
  {
    isAnyRay = this->MakeRays(number, block) || isAnyRay;
  }
  if (isAnyRay)
  {
    field.TracePackets(&this->GetTraced(number, 0), this->BlockCount, this->Beams[number].get());
  }
  for (int block = 0; this->TheScene.Fields.size() > 1 && block < this->BlockCount; ++block)
  {
    RayHits& hits = this->GetTraced(number, block).Hits;
    for (Hit& hit : hits.Hits)
    {
      hit.Field = static_cast<int>(number);
    }
    for (std::size_t i = 0; i < number; ++i)
    {
      MoveToEarlier(*this->TheScene.Fields[i].Field, this->GetTraced(i, block).Hits, field,
        this->GetTraced(number, block).Rays, hits);
    }
    this->Ends[block].Add(field.GetRequest(), hits);
  }
}

//------------------------------------------------------------------------------
/// Makes the rays through a block, unless none of them can hit the field: returns whether they may.
bool PixelBlockRenderer::MakeRays(std::size_t number, int block)
{
  const SceneField& field = this->TheScene.Fields[number];
  const PixelRectangle& pixels = this->Blocks[block];
  TracedPacket& traced = this->GetTraced(number, block);
  if (!this->MayHit(field, this->Beams[number].get(), pixels, traced.Corners))
  {
    traced.Rays.Clear();
    traced.Rays.Count = pixels.Width * pixels.Height;
    traced.Hits.Hits.clear();
    traced.Hits.First.assign(static_cast<std::size_t>(traced.Rays.Count) + 1, 0);
    return false;
  }
  const float* depth = this->TheScene.Depth;
  field.Field->MakeRays(field.View, this->InViewport(pixels),
    { depth ? depth + this->GetOffset(pixels, 0, 0) : nullptr, this->TheScene.Pixels.Width },
    traced.Rays);
  if (this->TheScene.Fields.size() > 1)
  {
    this->Ends[block].Cut(traced.Rays);
  }
  return true;
}

//------------------------------------------------------------------------------
/// Whether a ray through a block may hit a field: decided by the rays at its corners.
bool PixelBlockRenderer::MayHit(const SceneField& field, TracedField::Beam* beam,
  const PixelRectangle& block, RayPacket& corners) const
{
  const TraceRequest& request = field.Field->GetRequest();
  const bool isCloudAlone = request.Surfaces.empty() && !request.Projection;
  if (isCloudAlone || !Overlap(field.Pixels, this->InViewport(block)))
  {
    return false;
  }
  this->FindCorners(field.View, block, corners);
  return field.Field->MayHitBetween(corners, beam);
}

//------------------------------------------------------------------------------
/// The rays through the pixels at the corners of a rectangle.
void PixelBlockRenderer::FindCorners(
  const Camera& view, const PixelRectangle& pixels, RayPacket& corners) const
{
  corners.Clear();
  for (const int y : { pixels.Y, pixels.Y + pixels.Height - 1 })
  {
    for (const int x : { pixels.X, pixels.X + pixels.Width - 1 })
    {
      const Camera::PixelRay ray =
        view.GetRay(this->TheScene.Pixels.X + x, this->TheScene.Pixels.Y + y, 1.0);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        corners.Origin[axis][corners.Count] = ray.Origin[axis];
        corners.Direction[axis][corners.Count] = ray.Direction[axis];
      }
      ++corners.Count;
    }
  }
}

//------------------------------------------------------------------------------
void PixelBlockRenderer::Shade()
{
  for (this->Block = 0; this->Block < this->BlockCount; ++this->Block)
  {
    this->ShadeBlock();
  }
}

//------------------------------------------------------------------------------
void PixelBlockRenderer::ShadeBlock()
{
  const std::size_t fields = this->TheScene.Fields.size();
  bool isEmpty = true;
  for (std::size_t i = 0; i < fields; ++i)
  {
    isEmpty = isEmpty && this->GetTraced(i, this->Block).Hits.Hits.empty();
  }
  if (isEmpty)
  {
    if (!this->Sink)
    {
      this->WriteBackground();
    }
    return;
  }
  if (fields == 1 && this->Shaders.front().CanMakePixels() && !this->TheScene.KeepFragments &&
    !this->Sink)
  {
    this->WriteOpaque();
  }
  else
  {
    this->WriteFragments();
  }
  if (this->TheScene.KeepHits)
  {
    this->WriteHits();
  }
}

//------------------------------------------------------------------------------
void PixelBlockRenderer::WriteBackground()
{
  const PixelRectangle& block = this->Blocks[this->Block];
  for (int y = 0; y < block.Height; ++y)
  {
    const std::size_t first = this->GetOffset(0, y);
    std::fill_n(&this->Picture.Colors[4 * first], 4 * block.Width, std::uint8_t{ 0 });
    std::fill_n(&this->Picture.Depths[first], block.Width, PixelWithoutDepth);
  }
}

//------------------------------------------------------------------------------
/// A single opaque surface needs no fragments.
void PixelBlockRenderer::WriteOpaque()
{
  const PixelRectangle& block = this->Blocks[this->Block];
  const TracedPacket& traced = this->GetTraced(0, this->Block);
  const RayHits& hits = traced.Hits;
  HitPixels made;
  this->Shaders.front().MakePixels(traced.Rays, hits, made);
  std::size_t ray = 0;
  std::size_t hit = 0;
  for (int y = 0; y < block.Height; ++y)
  {
    const std::size_t first = this->GetOffset(0, y);
    std::uint8_t* bytes = &this->Picture.Colors[4 * first];
    float* depth = &this->Picture.Depths[first];
    for (int x = 0; x < block.Width; ++x, ++ray, bytes += 4, ++depth)
    {
      const bool isHit = hits.First[ray + 1] > hit;
      const std::uint32_t color = isHit ? made.Colors[hit] : 0;
      for (int k = 0; k < 4; ++k)
      {
        bytes[k] = static_cast<std::uint8_t>(color >> (8 * k));
      }
      *depth = isHit ? made.Depths[hit] : PixelWithoutDepth;
      hit += isHit ? 1 : 0;
    }
  }
}

//------------------------------------------------------------------------------
void PixelBlockRenderer::WriteFragments()
{
  const std::vector<SceneField>& fields = this->TheScene.Fields;
  // Projections first: where they end at a surface, they lie before it.
  std::size_t next = 0;
  for (const bool isProjection : { true, false })
  {
    for (std::size_t i = 0; i < fields.size(); ++i)
    {
      if (fields[i].Field->GetRequest().Projection.has_value() == isProjection)
      {
        const TracedPacket& traced = this->GetTraced(i, this->Block);
        this->Shaders[i].MakeFragments(traced.Rays, traced.Hits, this->FragmentsOfFields[next++]);
      }
    }
  }
  if (fields.size() > 1)
  {
    Merge(this->FragmentsOfFields, this->Merged);
  }
  const Fragments& fragments = fields.size() > 1 ? this->Merged : this->FragmentsOfFields.front();
  // A value by itself keeps its opacity; a sum of one would round it.
  const bool isLoneValue = fields.size() == 1 && fields.front().Field->GetRequest().Projection;
  std::size_t ray = 0;
  const PixelRectangle& block = this->Blocks[this->Block];
  for (int y = 0; y < block.Height; ++y)
  {
    for (int x = 0; x < block.Width; ++x, ++ray)
    {
      const Fragment* first = fragments.List.data() + fragments.First[ray];
      const std::size_t count = fragments.First[ray + 1] - fragments.First[ray];
      if (this->Sink)
      {
        this->Sink->SetFragments(
          block.X + x - this->Tile.X, block.Y + y - this->Tile.Y, first, count);
        continue;
      }
      const CompositedPixel made =
        isLoneValue && count == 1 ? ToPixel(*first) : Composite(first, count);
      const std::size_t pixel = this->GetOffset(x, y);
      std::copy_n(made.Rgba, 4, &this->Picture.Colors[4 * pixel]);
      this->Picture.Depths[pixel] = made.Depth;
      if (this->TheScene.KeepFragments)
      {
        this->Keep(first, count, pixel);
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Keeps the fragments of a pixel that are composited.
void PixelBlockRenderer::Keep(const Fragment* fragments, std::size_t count, std::size_t pixel)
{
  double transmittance = 1.0;
  for (std::size_t i = 0; i < count && transmittance >= NegligibleTransmittance; ++i)
  {
    this->Kept.push_back({ pixel, fragments[i] });
    transmittance *= 1.0 - fragments[i].Opacity;
  }
}

//------------------------------------------------------------------------------
/// Keeps the nearest hit of each ray.
void PixelBlockRenderer::WriteHits()
{
  const int width = this->Blocks[this->Block].Width;
  for (std::size_t i = 0; i < this->TheScene.Fields.size(); ++i)
  {
    const RayHits& hits = this->GetTraced(i, this->Block).Hits;
    for (std::size_t ray = 0; ray + 1 < hits.First.size(); ++ray)
    {
      if (hits.First[ray] == hits.First[ray + 1])
      {
        continue;
      }
      const int index = static_cast<int>(ray);
      Hit& kept = this->Picture.Hits[this->GetOffset(index % width, index / width)];
      const Hit& hit = hits.Hits[hits.First[ray]];
      if (i == 0 || kept.Surface == Hit::NoSurface || hit.T < kept.T)
      {
        kept = hit;
      }
    }
  }
}

}
