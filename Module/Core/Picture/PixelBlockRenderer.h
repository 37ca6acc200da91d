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

/// Traces and shades blocks of pixels, of up to as many as a packet has rays, for one thread. First
/// Trace, then Shade.
class PixelBlockRenderer
{
public:
  /// There is a shader for each field of the scene. If a sink is given, it takes the fragments, and
  /// no pixels are written. All must outlive the renderer.
  PixelBlockRenderer(
    const Scene& scene, const std::vector<Shader>& shaders, FragmentSink* sink, Frame& frame);

  static constexpr int MaximumBlocks = 8;

  /// How many neighbouring blocks are best traced together, up to the maximum.
  static int GetBlocksAtOnce(const Scene& scene);

  /// Begins with a tile that the next blocks are of, counted from the rectangle drawn.
  void BeginTile(const PixelRectangle& tile);

  /// Finds the hits of the rays through blocks of pixels, counted from the rectangle drawn, up to
  /// as many as are best traced together.
  void Trace(const PixelRectangle* blocks, int count);

  /// Writes the pixels of the blocks that were traced last.
  void Shade();

  /// The fragments of all blocks so far, if the scene keeps them.
  const std::vector<FragmentOfPixel>& GetKept() const { return this->Kept; }

private:
  /// Pixels that are counted from the rectangle drawn, in the viewport.
  PixelRectangle InViewport(const PixelRectangle& pixels) const;
  bool MayHit(const SceneField& field, TracedField::Beam* beam, const PixelRectangle& block,
    RayPacket& corners) const;
  void FindCorners(const Camera& view, const PixelRectangle& pixels, RayPacket& corners) const;
  void TraceField(std::size_t number);
  bool MakeRays(std::size_t number, int block);
  /// What was traced of a block and a field.
  TracedPacket& GetTraced(std::size_t field, int block) const
  {
    return this->Traced[field * static_cast<std::size_t>(this->BlocksAtOnce) +
      static_cast<std::size_t>(block)];
  }
  void ShadeBlock();
  void WriteBackground();
  void WriteOpaque();
  void WriteFragments();
  void Keep(const Fragment* fragments, std::size_t count, std::size_t pixel);
  void WriteHits();
  std::size_t GetOffset(const PixelRectangle& block, int x, int y) const;
  std::size_t GetOffset(int x, int y) const
  {
    return this->GetOffset(this->Blocks[this->Block], x, y);
  }

  const Scene& TheScene;
  const std::vector<Shader>& Shaders;
  Frame& Picture;
  int BlocksAtOnce;
  PixelRectangle Blocks[MaximumBlocks];
  int BlockCount = 0;
  /// The one that is shaded.
  int Block = 0;
  std::unique_ptr<TracedPacket[]> Traced;
  /// Of each field.
  std::vector<std::unique_ptr<TracedField::Beam>> Beams;
  /// Of each block.
  OpaqueEnds Ends[MaximumBlocks];
  std::vector<Fragments> FragmentsOfFields;
  Fragments Merged;
  /// May be null.
  FragmentSink* Sink;
  PixelRectangle Tile;
  std::vector<FragmentOfPixel> Kept;
};

}

#endif
