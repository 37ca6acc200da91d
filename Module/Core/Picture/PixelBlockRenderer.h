// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PixelBlockRenderer_h
#define PixelBlockRenderer_h

#include "Picture/Compositor.h"
#include "Picture/OpaqueEnds.h"
#include "Picture/RenderTiles.h"
#include "Picture/Scene.h"
#include "Picture/Shader.h"

#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Traces and shades blocks of pixels, as many as a packet has rays, for one thread. First Trace,
/// then Shade.
class PixelBlockRenderer
{
public:
  /// There is a shader for each field of the scene. All must outlive the renderer.
  PixelBlockRenderer(const Scene& scene, const std::vector<Shader>& shaders, Frame& frame);

  /// Begins with a tile that the next blocks are of, counted from the rectangle drawn.
  void BeginTile(const PixelRectangle& tile);

  /// Finds the hits of the rays through a block of pixels, counted from the rectangle drawn.
  void Trace(const PixelRectangle& block);

  /// Writes the pixels of the block that was traced last.
  void Shade();

private:
  /// The rays through the block and their hits, of one field.
  struct TracedPacket
  {
    RayPacket Packet;
    RayHits Hits;
  };

  /// Pixels that are counted from the rectangle drawn, in the viewport.
  PixelRectangle InViewport(const PixelRectangle& pixels) const;
  bool MayHit(const SceneField& field, TracedField::Beam* beam, RayPacket& corners) const;
  void FindCorners(const Camera& view, const PixelRectangle& pixels, RayPacket& corners) const;
  void TraceField(std::size_t number, const PixelRectangle& pixels, const PixelDepths& depths);
  void WriteBackground();
  void WriteOpaque();
  void WriteFragments();
  void WriteHits();
  std::size_t GetOffset(int x, int y) const;

  const Scene& TheScene;
  const std::vector<Shader>& Shaders;
  Frame& Picture;
  PixelRectangle Block;
  std::unique_ptr<TracedPacket[]> Traced;
  /// Of each field.
  std::vector<std::unique_ptr<TracedField::Beam>> Beams;
  OpaqueEnds Ends;
  std::vector<Fragments> FragmentsOfFields;
  Fragments Merged;
};

}

#endif
