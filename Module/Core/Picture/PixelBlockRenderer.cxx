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
}

//------------------------------------------------------------------------------
/// The place of a pixel of the block in the arrays of a frame.
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
  const PixelRectangle pixels = { scene.Pixels.X + block.X, scene.Pixels.Y + block.Y, block.Width,
    block.Height };
  const PixelDepths depths = { scene.Depth ? scene.Depth + this->GetOffset(0, 0) : nullptr,
    scene.Pixels.Width };
  for (std::size_t i = 0; i < scene.Fields.size(); ++i)
  {
    const SceneField& field = scene.Fields[i];
    TracedPacket& traced = this->Traced[i];
    if (!this->MayHit(field, traced.Packet))
    {
      traced.Packet.Count = pixels.Width * pixels.Height;
      traced.Packet.Exists = {};
      traced.Hits.Hits.clear();
      traced.Hits.First.assign(static_cast<std::size_t>(traced.Packet.Count) + 1, 0);
      continue;
    }
    field.Field->MakeRays(field.View, pixels, depths, traced.Packet);
    this->EndAtOpaqueHits(i, traced.Packet);
    field.Field->Trace(traced.Packet, traced.Hits);
    if (i > 0)
    {
      std::for_each(traced.Hits.Hits.begin(), traced.Hits.Hits.end(),
        [i](Hit& hit) { hit.Field = static_cast<int>(i); });
    }
  }
}

//------------------------------------------------------------------------------
/// Whether a ray through the block may hit a field: asks for those at the corners.
bool PixelBlockRenderer::MayHit(const SceneField& field, RayPacket& corners) const
{
  const PixelRectangle& block = this->Block;
  corners.Count = 0;
  corners.Exists = {};
  for (const int y : { block.Y, block.Y + block.Height - 1 })
  {
    for (const int x : { block.X, block.X + block.Width - 1 })
    {
      const Camera::PixelRay ray =
        field.View.GetRay(this->TheScene.Pixels.X + x, this->TheScene.Pixels.Y + y, 1.0);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        corners.Origin[axis][corners.Count] = ray.Origin[axis];
        corners.Direction[axis][corners.Count] = ray.Direction[axis];
      }
      ++corners.Count;
    }
  }
  return field.Field->MayHitBetween(corners);
}

//------------------------------------------------------------------------------
/// Ends the rays of a field at the opaque hits with those before: nothing is seen behind.
void PixelBlockRenderer::EndAtOpaqueHits(std::size_t field, RayPacket& packet) const
{
  for (std::size_t other = 0; other < field; ++other)
  {
    const TracedField& before = *this->TheScene.Fields[other].Field;
    const RayHits& hits = this->Traced[other].Hits;
    for (std::size_t ray = 0; ray + 1 < hits.First.size(); ++ray)
    {
      const int i = static_cast<int>(ray);
      if (hits.First[ray] == hits.First[ray + 1] || !Has(packet.Exists, i))
      {
        continue;
      }
      const Hit& last = hits.Hits[hits.First[ray + 1] - 1];
      if (!before.GetRequest().Projection && before.GetOpacity(last) >= 1.0)
      {
        packet.End[i] = std::min(packet.End[i], last.T - packet.Base[i]);
        if (!(packet.Begin[i] <= packet.End[i]))
        {
          Remove(i, packet.Exists);
        }
      }
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
    std::fill_n(&this->Picture.Depths[first], this->Block.Width, Frame::NoSurface);
  }
}

//------------------------------------------------------------------------------
/// Where one opaque surface is all there is, no fragments are needed.
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
      this->Picture.Depths[pixel] = isHit ? made.Depths[hit] : Frame::NoSurface;
      hit += isHit ? 1 : 0;
    }
  }
}

//------------------------------------------------------------------------------
void PixelBlockRenderer::WriteFragments()
{
  const std::vector<SceneField>& fields = this->TheScene.Fields;
  for (std::size_t i = 0; i < fields.size(); ++i)
  {
    this->Shaders[i].MakeFragments(
      this->Traced[i].Packet, this->Traced[i].Hits, this->FragmentsOfFields[i]);
  }
  if (fields.size() > 1)
  {
    Merge(this->FragmentsOfFields, this->Merged);
  }
  const Fragments& fragments = fields.size() > 1 ? this->Merged : this->FragmentsOfFields.front();
  const bool isProjection = fields.size() == 1 && fields.front().Field->GetRequest().Projection;
  std::size_t ray = 0;
  for (int y = 0; y < this->Block.Height; ++y)
  {
    for (int x = 0; x < this->Block.Width; ++x, ++ray)
    {
      const Fragment* first = fragments.List.data() + fragments.First[ray];
      const std::size_t count = fragments.First[ray + 1] - fragments.First[ray];
      const CompositedPixel made =
        isProjection && count == 1 ? ToPixel(*first) : Composite(first, count);
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
      const int place = static_cast<int>(ray);
      Hit& kept =
        this->Picture.Hits[this->GetOffset(place % this->Block.Width, place / this->Block.Width)];
      const Hit& hit = hits.Hits[hits.First[ray]];
      if (kept.Surface == Hit::NoSurface || hit.T < kept.T)
      {
        kept = hit;
      }
    }
  }
}

}
