// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/PixelBlockRenderer.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
PixelBlockRenderer::PixelBlockRenderer(
  const Scene& scene, const std::vector<Shader>& shaders, Frame& frame)
  : TheScene(scene)
  , Shaders(shaders)
  , Picture(frame)
  , Traced(new TracedPacket[scene.Fields.size()])
  , FragmentsOfFields(scene.Fields.size())
{
  for (const SceneField& field : scene.Fields)
  {
    this->Beams.push_back(field.Field->MakeBeam());
  }
}

//------------------------------------------------------------------------------
void PixelBlockRenderer::BeginTile(const PixelRectangle& tile)
{
  for (std::size_t i = 0; i < this->Beams.size(); ++i)
  {
    const SceneField& field = this->TheScene.Fields[i];
    if (this->Beams[i] && Overlap(field.Pixels, this->InViewport(tile)))
    {
      RayPacket& corners = this->Traced[i].Packet;
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
/// The index of a pixel of the block in the arrays of a frame.
std::size_t PixelBlockRenderer::GetOffset(int x, int y) const
{
  return static_cast<std::size_t>(this->Block.X + x) +
    static_cast<std::size_t>(this->Block.Y + y) *
    static_cast<std::size_t>(this->TheScene.Pixels.Width);
}

//------------------------------------------------------------------------------
void PixelBlockRenderer::Trace(const PixelRectangle& block)
{
  const Scene& scene = this->TheScene;
  this->Block = block;
  const PixelRectangle pixels = this->InViewport(block);
  const PixelDepths depths = { scene.Depth ? scene.Depth + this->GetOffset(0, 0) : nullptr,
    scene.Pixels.Width };
  this->Ends.Clear();
  // Projections last: they end at the surfaces of all fields.
  for (const bool isProjection : { false, true })
  {
    for (std::size_t i = 0; i < scene.Fields.size(); ++i)
    {
      if (scene.Fields[i].Field->GetRequest().Projection.has_value() == isProjection)
      {
        this->TraceField(i, pixels, depths);
      }
    }
  }
}

//------------------------------------------------------------------------------
void PixelBlockRenderer::TraceField(
  std::size_t number, const PixelRectangle& pixels, const PixelDepths& depths)
{
  const SceneField& field = this->TheScene.Fields[number];
  TracedPacket& traced = this->Traced[number];
  TracedField::Beam* beam = this->Beams[number].get();
  if (!this->MayHit(field, beam, traced.Packet))
  {
    traced.Packet.Clear();
    traced.Packet.Count = pixels.Width * pixels.Height;
    traced.Hits.Hits.clear();
    traced.Hits.First.assign(static_cast<std::size_t>(traced.Packet.Count) + 1, 0);
    return;
  }
  field.Field->MakeRays(field.View, pixels, depths, traced.Packet);
  if (this->TheScene.Fields.size() == 1)
  {
    field.Field->Trace(traced.Packet, traced.Hits, beam);
    return;
  }
  this->Ends.Cut(traced.Packet);
  field.Field->Trace(traced.Packet, traced.Hits, beam);
  for (Hit& hit : traced.Hits.Hits)
  {
    hit.Field = static_cast<int>(number);
  }
  this->Ends.Add(field.Field->GetRequest(), traced.Hits);
}

//------------------------------------------------------------------------------
/// Whether a ray through the block may hit a field: decided by the rays at its corners.
bool PixelBlockRenderer::MayHit(
  const SceneField& field, TracedField::Beam* beam, RayPacket& corners) const
{
  if (!Overlap(field.Pixels, this->InViewport(this->Block)))
  {
    return false;
  }
  this->FindCorners(field.View, this->Block, corners);
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
  const std::size_t fields = this->TheScene.Fields.size();
  const bool isEmpty = std::all_of(this->Traced.get(), this->Traced.get() + fields,
    [](const TracedPacket& traced) { return traced.Hits.Hits.empty(); });
  if (isEmpty)
  {
    this->WriteBackground();
    return;
  }
  if (fields == 1 && this->Shaders.front().CanMakePixels())
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
  for (int y = 0; y < this->Block.Height; ++y)
  {
    const std::size_t first = this->GetOffset(0, y);
    std::fill_n(&this->Picture.Colors[4 * first], 4 * this->Block.Width, std::uint8_t{ 0 });
    std::fill_n(&this->Picture.Depths[first], this->Block.Width, PixelWithoutDepth);
  }
}

//------------------------------------------------------------------------------
/// A single opaque surface needs no fragments.
void PixelBlockRenderer::WriteOpaque()
{
  const RayHits& hits = this->Traced[0].Hits;
  HitPixels made;
  this->Shaders.front().MakePixels(this->Traced[0].Packet, hits, made);
  std::size_t ray = 0;
  std::size_t hit = 0;
  for (int y = 0; y < this->Block.Height; ++y)
  {
    std::size_t pixel = this->GetOffset(0, y);
    for (int x = 0; x < this->Block.Width; ++x, ++ray, ++pixel)
    {
      const bool isHit = hits.First[ray + 1] > hit;
      const std::uint32_t color = isHit ? made.Colors[hit] : 0;
      for (std::size_t k = 0; k < 4; ++k)
      {
        this->Picture.Colors[4 * pixel + k] = static_cast<std::uint8_t>(color >> (8 * k));
      }
      this->Picture.Depths[pixel] = isHit ? made.Depths[hit] : PixelWithoutDepth;
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
        this->Shaders[i].MakeFragments(
          this->Traced[i].Packet, this->Traced[i].Hits, this->FragmentsOfFields[next++]);
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
  for (int y = 0; y < this->Block.Height; ++y)
  {
    for (int x = 0; x < this->Block.Width; ++x, ++ray)
    {
      const Fragment* first = fragments.List.data() + fragments.First[ray];
      const std::size_t count = fragments.First[ray + 1] - fragments.First[ray];
      const CompositedPixel made =
        isLoneValue && count == 1 ? ToPixel(*first) : Composite(first, count);
      const std::size_t pixel = this->GetOffset(x, y);
      std::copy_n(made.Rgba, 4, &this->Picture.Colors[4 * pixel]);
      this->Picture.Depths[pixel] = made.Depth;
    }
  }
}

//------------------------------------------------------------------------------
/// Keeps the nearest hit of each ray.
void PixelBlockRenderer::WriteHits()
{
  for (std::size_t i = 0; i < this->TheScene.Fields.size(); ++i)
  {
    const RayHits& hits = this->Traced[i].Hits;
    for (std::size_t ray = 0; ray + 1 < hits.First.size(); ++ray)
    {
      if (hits.First[ray] == hits.First[ray + 1])
      {
        continue;
      }
      const int index = static_cast<int>(ray);
      Hit& kept =
        this->Picture.Hits[this->GetOffset(index % this->Block.Width, index / this->Block.Width)];
      const Hit& hit = hits.Hits[hits.First[ray]];
      if (i == 0 || kept.Surface == Hit::NoSurface || hit.T < kept.T)
      {
        kept = hit;
      }
    }
  }
}

}
