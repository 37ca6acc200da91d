// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PartFinder_h
#define PartFinder_h

#include "Picture/CloudFinder.h"
#include "Picture/MessageExchange.h"
#include "Picture/PixelBlockRenderer.h"
#include "Picture/SharedNotes.h"
#include "Picture/SharedTiles.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// What is looked for in a group of tiles: segments of the open rays of each tile.
struct PartRequest
{
  struct OfTile
  {
    /// None of them begins before this depth; infinite if there is none.
    double NextDepth = 0.0;
    /// Where the finder of clouds begins; empty at first.
    std::vector<double> Position;
    std::uint32_t Open[CloudTile::Edge] = {};
  };

  OfTile Tiles[SharedTiles::MaximumGroupSize];

  /// Everything.
  static PartRequest MakeFirst();

  /// Whether any ray of a share is open in a tile in which something is looked for.
  bool IsLookedFor(const SharedTiles& tiles, int number) const;
};

/// Finds parts of groups of tiles, for one thread: the segments of the cells that a process has,
/// and with the first part the fragments of its surfaces.
class PartFinder final : private FragmentSink
{
public:
  /// So many segments of a tile are enough for a part, in which there may be more. All must outlive
  /// the finder.
  PartFinder(const Scene& scene, const SharedTiles& tiles, const std::vector<Shader>& shaders,
    const Kernels* kernels, Frame& frame, std::size_t enough);

  void Find(int group, const PartRequest& request);

  /// What is left to find, if all rays are open that were.
  const PartRequest& GetRest() const { return this->Rest; }

  std::size_t GetNumberOfSegments() const;

  /// Appends the note for the owner of a share of the group.
  void Write(int group, int number, MessageExchange::Message& message) const;

private:
  void SetFragments(int x, int y, const Fragment* fragments, std::size_t count) override;
  void FindTile(
    const PixelRectangle& tile, const PartRequest::OfTile& request, PartRequest::OfTile& rest);
  void FindFragments(const PixelRectangle& tile);

  const Scene& TheScene;
  const SharedTiles& Tiles;
  const Kernels& TheKernels;
  std::size_t Enough;
  int BlocksAtOnce;
  PixelBlockRenderer Blocks;
  CloudFinder Clouds;
  CloudTile Rays;
  std::unique_ptr<CloudSegments> Segments;
  /// Where the rows of the tile go.
  RowPlace Places[CloudTile::Edge];
  PartRequest Rest;
  std::vector<std::vector<TileFragment>> FragmentsOfShares;
  std::vector<SharedSegments> SegmentsOfFields;
};

}

#endif
