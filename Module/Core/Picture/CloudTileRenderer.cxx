// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/CloudTileRenderer.h"

#include "Kernels/Kernels.h"
#include "Math/Arithmetic.h"
#include "Math/ByteColor.h"
#include "Math/Matrix.h"
#include "Picture/CloudMedium.h"
#include "Picture/RenderTiles.h"

#include <algorithm>
#include <iterator>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// How many segments of a pixel are drawn at once, at most, if not more must wait. (More leave the
/// cache.)
constexpr int SegmentsAtOnce = 48;

CloudLight MakeCloudLight(const Light& light)
{
  CloudLight made{};
  std::copy(light.DiffuseColor.begin(), light.DiffuseColor.end(), made.DiffuseColor);
  std::copy(light.SpecularColor.begin(), light.SpecularColor.end(), made.SpecularColor);
  std::copy(light.Direction.begin(), light.Direction.end(), made.Direction);
  made.IsPositional = light.Positional;
  std::copy(light.Position.begin(), light.Position.end(), made.Position);
  std::copy(light.Attenuation.begin(), light.Attenuation.end(), made.Attenuation);
  made.HasCone = light.ConeAngle < 90.0;
  made.LeastCosine = light.FindLeastCosine();
  made.Exponent = light.Exponent;
  return made;
}

}

//------------------------------------------------------------------------------
/// The depths, the values and the gradients at both ends of a segment.
struct CloudTileRenderer::SegmentEnds
{
  SegmentEnds(const CloudSegments& segments, int number)
    : Components(segments.Components)
    , Coordinates(3 * segments.Gradients)
  {
    for (int end = 0; end < 2; ++end)
    {
      this->Depth[end] = segments.Depth[end][number];
      for (int i = 0; i < this->Components; ++i)
      {
        this->Value[i][end] = segments.Value[i][end][number];
      }
      for (int i = 0; i < this->Coordinates; ++i)
      {
        this->Gradient[i][end] = segments.Gradient[i][end][number];
      }
    }
  }

  /// Returns the part before a depth, and becomes the rest.
  SegmentEnds CutOff(double depth)
  {
    SegmentEnds before = *this;
    const double fraction = (depth - this->Depth[0]) / (this->Depth[1] - this->Depth[0]);
    for (int i = 0; i < this->Components; ++i)
    {
      const double there = Lerp(this->Value[i][0], this->Value[i][1], fraction);
      before.Value[i][1] = there;
      this->Value[i][0] = there;
    }
    for (int i = 0; i < this->Coordinates; ++i)
    {
      const float there =
        Lerp(this->Gradient[i][0], this->Gradient[i][1], static_cast<float>(fraction));
      before.Gradient[i][1] = there;
      this->Gradient[i][0] = there;
    }
    before.Depth[1] = depth;
    this->Depth[0] = depth;
    return before;
  }

  void Write(CloudSegments& segments, int number) const
  {
    for (int end = 0; end < 2; ++end)
    {
      segments.Depth[end][number] = this->Depth[end];
      for (int i = 0; i < this->Components; ++i)
      {
        segments.Value[i][end][number] = this->Value[i][end];
      }
      for (int i = 0; i < this->Coordinates; ++i)
      {
        segments.Gradient[i][end][number] = this->Gradient[i][end];
      }
    }
  }

  int Components;
  /// Of all gradients.
  int Coordinates;
  double Depth[2];
  double Value[MaximumCloudComponents][2];
  float Gradient[3 * MaximumCloudComponents][2];
};

//------------------------------------------------------------------------------
CloudTileRenderer::CloudTileRenderer(const Scene& scene, const Kernels* kernels)
  : TheScene(scene)
  , TheKernels(kernels ? *kernels : BaselineKernels)
  , Rays(new RayContents[CloudTile::Capacity])
  , Light(new TileLight)
  , Segments(new CloudSegments)
  , Parts(new CloudSegments)
  , Lights(new SegmentLight[CloudSegments::Capacity])
{
  const bool isLit = std::any_of(scene.Fields.begin(), scene.Fields.end(),
    [](const SceneField& field)
    { return field.Cloud && !field.IsMaximum && field.Cloud->GetMixed().Gradients > 0; });
  if (isLit)
  {
    std::transform(
      scene.Lights.begin(), scene.Lights.end(), std::back_inserter(this->Lamps), MakeCloudLight);
    this->Lighting = std::make_unique<CloudLighting>();
    this->Lighting->LightCount = static_cast<int>(this->Lamps.size());
    this->Lighting->Lights = this->Lamps.data();
    this->Lighting->AreTwoSided = scene.TwoSidedLighting;
  }
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Begin(const PixelRows& tile)
{
  this->Tile = tile;
  this->Surfaces.clear();
  this->Pending.Clear();
  MakeMeasuredCloudRays(
    this->TheScene, tile, this->TheKernels, this->RaysOfTile, this->Lighting.get());
  for (int row = 0; row < CloudTile::Edge; ++row)
  {
    this->Open[row] = row < tile.Count ? (1U << tile.Rows[row].Width) - 1U : 0U;
  }
  std::fill_n(this->Rays.get(), CloudTile::Capacity,
    RayContents{ PixelWithoutDepth, -Infinity, nullptr, 0, 0 });
  std::fill_n(&this->Light->Color[0][0], 3 * CloudTile::Capacity, 0.0);
  std::fill_n(this->Light->Transmittance, CloudTile::Capacity, 1.0);
}

//------------------------------------------------------------------------------
void CloudTileRenderer::SetFragments(int x, int y, const Fragment* fragments, std::size_t count)
{
  const int pixel = y * CloudTile::Edge + x;
  RayContents& ray = this->Rays[static_cast<std::size_t>(pixel)];
  const std::size_t visible = CountVisible(fragments, count);
  ray.Fragment = this->Surfaces.size();
  this->Surfaces.insert(this->Surfaces.end(), fragments, fragments + visible);
  ray.End = this->Surfaces.size();
  CutCloudRay(fragments, visible, pixel, this->RaysOfTile);
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Render(CloudFinder& finder, Frame& frame)
{
  finder.Begin(this->Tile.FindRectangle(0), this->RaysOfTile);
  int enough = SegmentsAtOnce;
  while (this->IsAnyOpen() && finder.GetNextDepth() < Infinity)
  {
    const std::size_t field = finder.FindMore(this->Open, *this->Segments);
    this->Add(field, *this->Segments);
    if (this->Pending.GetLongest() >= enough)
    {
      this->DrawAllBefore(finder.GetNextDepth());
      // Those that are left are sorted again.
      enough = std::max(SegmentsAtOnce, 2 * this->Pending.GetLongest());
    }
  }
  this->Finish(frame);
}

//------------------------------------------------------------------------------
bool CloudTileRenderer::IsAnyOpen() const
{
  return std::any_of(
    std::begin(this->Open), std::end(this->Open), [](std::uint32_t row) { return row != 0; });
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Finish(Frame& frame)
{
  this->DrawAllBefore(Infinity);
  for (int pixel = 0; pixel < CloudTile::Capacity; ++pixel)
  {
    this->DrawMaximum(pixel);
    this->DrawFragments(pixel, Infinity);
  }
  this->Write(frame);
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Add(std::size_t number, const CloudSegments& segments)
{
  const SceneField& field = this->TheScene.Fields[number];
  if (field.IsMaximum)
  {
    this->FindMaxima(field, segments);
  }
  else if (this->Surfaces.empty())
  {
    this->Integrate(field, segments);
  }
  else
  {
    this->IntegrateParts(field, segments);
  }
}

//------------------------------------------------------------------------------
/// Of equal values, that of the first field counts. Segments that another process has found may be
/// behind an opaque surface that it does not know.
void CloudTileRenderer::FindMaxima(const SceneField& field, const CloudSegments& segments)
{
  for (int i = 0; i < segments.Count; ++i)
  {
    RayContents& ray = this->Rays[static_cast<std::size_t>(segments.Pixel[i])];
    const double end = this->RaysOfTile.End[segments.Pixel[i]];
    SegmentEnds ends(segments, i);
    if (end <= ends.Depth[0])
    {
      continue;
    }
    if (end < ends.Depth[1])
    {
      ends = ends.CutOff(end);
    }
    const double largest = std::max(ends.Value[0][0], ends.Value[0][1]);
    if (largest > ray.Maximum || (largest == ray.Maximum && &field < ray.MaximumOf))
    {
      ray.Maximum = largest;
      ray.MaximumOf = &field;
    }
  }
}

//------------------------------------------------------------------------------
/// Draws the largest value before all else.
void CloudTileRenderer::DrawMaximum(int pixel)
{
  const RayContents& ray = this->Rays[static_cast<std::size_t>(pixel)];
  if (ray.MaximumOf)
  {
    const std::array<double, 4> rgba = ray.MaximumOf->ColorsOfValues->Get(ray.Maximum);
    for (std::size_t k = 0; k < 3; ++k)
    {
      this->Light->Color[k][pixel] = rgba[k] * rgba[3];
    }
    this->Light->Transmittance[pixel] = 1.0 - rgba[3];
  }
}

//------------------------------------------------------------------------------
/// Integrates the segments in parts, between the fragments that are in them.
void CloudTileRenderer::IntegrateParts(const SceneField& field, const CloudSegments& whole)
{
  CloudSegments& parts = *this->Parts;
  parts.Count = 0;
  parts.Components = whole.Components;
  parts.Gradients = whole.Gradients;
  for (int i = 0; i < whole.Count; ++i)
  {
    const int pixel = whole.Pixel[i];
    const RayContents& ray = this->Rays[static_cast<std::size_t>(pixel)];
    SegmentEnds ends(whole, i);
    for (std::size_t k = ray.Fragment; k < ray.End; ++k)
    {
      const double at = this->GetDepth(this->Surfaces[k], pixel);
      if (ends.Depth[0] < at && at < ends.Depth[1])
      {
        this->AddPart(field, pixel, ends.CutOff(at));
      }
    }
    this->AddPart(field, pixel, ends);
  }
  this->Integrate(field, parts);
}

//------------------------------------------------------------------------------
void CloudTileRenderer::AddPart(const SceneField& field, int pixel, const SegmentEnds& ends)
{
  CloudSegments& parts = *this->Parts;
  if (parts.Count == CloudSegments::Batch)
  {
    this->Integrate(field, parts);
    parts.Count = 0;
  }
  parts.Pixel[parts.Count] = pixel;
  ends.Write(parts, parts.Count);
  ++parts.Count;
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Integrate(const SceneField& field, const CloudSegments& segments)
{
  const MixedTransfers& mixed = field.Cloud->GetMixed();
  SegmentLight* lights = this->Lights.get();
  if (segments.Gradients > 0)
  {
    const Matrix4 toWorld = NormalMatrix(field.View.GetWorldFromObject());
    std::copy(toWorld.begin(), toWorld.end(), this->Lighting->WorldFromGradient);
    this->TheKernels.IntegrateLitMixture(
      this->RaysOfTile, mixed, *this->Lighting, segments, lights);
  }
  else if (mixed.Components == 1)
  {
    this->TheKernels.IntegrateSegments(this->RaysOfTile, *mixed.Transfers[0], segments, lights);
  }
  else
  {
    this->TheKernels.IntegrateMixture(this->RaysOfTile, mixed, segments, lights);
  }
  for (int i = 0; i < segments.Count; ++i)
  {
    this->Pending.Add(segments.Pixel[i], segments.Depth[0][i], lights[i]);
  }
}

//------------------------------------------------------------------------------
void CloudTileRenderer::DrawAllBefore(double depth)
{
  double depths[CloudTile::Edge];
  std::fill(std::begin(depths), std::end(depths), depth);
  this->DrawBefore(depths);
}

//------------------------------------------------------------------------------
/// Draws the segments that begin before a depth: none that is found later comes before them.
void CloudTileRenderer::DrawBefore(const double (&depths)[CloudTile::Edge])
{
  for (int row = 0; row < CloudTile::Edge; ++row)
  {
    const double depth = depths[row];
    std::uint32_t others = this->FindMixed(row);
    others |= this->TheKernels.DrawSegments(
      this->Pending.GetLists(), row, depth, this->Open[row] & ~others, *this->Light);
    for (; others != 0; others &= others - 1)
    {
      this->DrawSegments(row * CloudTile::Edge + LowestBit(others), depth);
    }
    this->CloseOpaque(row);
    this->TheKernels.KeepSegments(this->Pending.GetLists(), row, depth, this->Open[row]);
  }
}

//------------------------------------------------------------------------------
/// The open rays of a row that have fragments which are not drawn yet; a bit for each column.
std::uint32_t CloudTileRenderer::FindMixed(int row) const
{
  std::uint32_t mixed = 0;
  for (int column = 0; column < CloudTile::Edge && !this->Surfaces.empty(); ++column)
  {
    const RayContents& ray = this->Rays[static_cast<std::size_t>(row * CloudTile::Edge + column)];
    mixed |= static_cast<std::uint32_t>(ray.Fragment < ray.End) << column;
  }
  return mixed & this->Open[row];
}

//------------------------------------------------------------------------------
/// Draws the segments of a ray that begin before a depth, and the fragments before them.
void CloudTileRenderer::DrawSegments(int pixel, double depth)
{
  for (const std::size_t segment : this->Pending.FindOrder(pixel))
  {
    const double at = this->Pending.GetDepth(segment);
    if (at >= depth || this->Light->Transmittance[pixel] < NegligibleLight)
    {
      return;
    }
    this->DrawFragments(pixel, at);
    const SegmentLight& light = this->Pending.GetLight(segment);
    double& transmittance = this->Light->Transmittance[pixel];
    for (int k = 0; k < 3; ++k)
    {
      this->Light->Color[k][pixel] += transmittance * static_cast<double>(light.Color[k]);
    }
    transmittance *= static_cast<double>(light.Transmittance);
  }
}

//------------------------------------------------------------------------------
/// Draws the fragments of a ray up to a depth.
void CloudTileRenderer::DrawFragments(int pixel, double depth)
{
  RayContents& ray = this->Rays[static_cast<std::size_t>(pixel)];
  double& transmittance = this->Light->Transmittance[pixel];
  for (; ray.Fragment < ray.End; ++ray.Fragment)
  {
    const Fragment& fragment = this->Surfaces[ray.Fragment];
    if (transmittance < NegligibleLight ||
      (depth < Infinity && depth < this->GetDepth(fragment, pixel)))
    {
      return;
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      this->Light->Color[k][pixel] += transmittance * fragment.Color[k];
    }
    transmittance *= 1.0 - fragment.Opacity;
    ray.Depth = fragment.Opacity >= 1.0 ? fragment.Depth : ray.Depth;
  }
}

//------------------------------------------------------------------------------
/// Closes the rays of a row on which nothing more is seen.
void CloudTileRenderer::CloseOpaque(int row)
{
  for (int column = 0; column < CloudTile::Edge; ++column)
  {
    const double transmittance = this->Light->Transmittance[row * CloudTile::Edge + column];
    this->Open[row] &= ~(static_cast<std::uint32_t>(transmittance < NegligibleLight) << column);
  }
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Write(Frame& frame) const
{
  for (int y = 0; y < this->Tile.Count; ++y)
  {
    const PixelRectangle& row = this->Tile.Rows[y];
    const std::size_t first = static_cast<std::size_t>(row.X) +
      static_cast<std::size_t>(row.Y) * static_cast<std::size_t>(this->TheScene.Pixels.Width);
    for (int x = 0; x < row.Width; ++x)
    {
      const int own = y * CloudTile::Edge + x;
      const std::size_t pixel = first + static_cast<std::size_t>(x);
      for (std::size_t k = 0; k < 3; ++k)
      {
        frame.Colors[4 * pixel + k] = ToByte(this->Light->Color[k][own]);
      }
      frame.Colors[4 * pixel + 3] = ToByte(1.0 - this->Light->Transmittance[own]);
      frame.Depths[pixel] = this->Rays[static_cast<std::size_t>(own)].Depth;
    }
  }
}

}
