// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CloudTileRenderer_h
#define CloudTileRenderer_h

#include "Picture/CloudFinder.h"
#include "Picture/Compositor.h"
#include "Picture/PendingSegments.h"
#include "Picture/PixelRows.h"
#include "Picture/Scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

struct Frame;

/// Draws the clouds of a scene, and the surfaces in them, tile by tile, for one thread.
///
/// The segments of all rays of the tile are found front to back, cell by cell (CloudFinder), their
/// light is integrated, and they are put in order by depth as far as no further cell may come
/// before. What is kept of a ray is its colour so far, its transmittance, and the few segments
/// whose turn has not come. So the order of the cells, of threads and of processes changes no bit.
/// (K.-L. Ma, T. W. Crockett: A Scalable Parallel Cell-Projection Volume Rendering Algorithm for
/// Three-Dimensional Unstructured Data, 1997.)
class CloudTileRenderer final : public FragmentSink
{
public:
  CloudTileRenderer(const Scene& scene, const Kernels* kernels);

  /// Begins with the rows of a tile.
  void Begin(const PixelRows& tile);

  /// Sets the fragments of the pixel (x, y) of the tile, front to back.
  void SetFragments(int x, int y, const Fragment* fragments, std::size_t count) override;

  /// Draws the clouds and the fragments of a tile of the picture.
  void Render(CloudFinder& finder, Frame& frame);

  ///@{
  /// The same, for segments that are found elsewhere: add those of any fields, in any order; draw
  /// those that begin before a depth, given for each row, when none of them is left to be added; at
  /// last, finish.
  void Add(std::size_t field, const CloudSegments& segments);
  void DrawBefore(const double (&depths)[CloudTile::Edge]);
  void Finish(Frame& frame);
  ///@}

  /// The rays on which more would be seen: a bit for each column of each row.
  const std::uint32_t (&GetOpen() const)[CloudTile::Edge] { return this->Open; }
  bool IsAnyOpen() const;

  /// The number of segments that wait to be drawn.
  std::size_t GetNumberOfPending() const { return this->Pending.GetCount(); }

  /// What was drawn at the pixel (x, y) of the tile, unrounded: red, green and blue, multiplied by
  /// the opacity, and the opacity.
  std::array<double, 4> GetLight(int x, int y) const
  {
    const int pixel = y * CloudTile::Edge + x;
    const auto& color = this->Light->Color;
    return { color[0][pixel], color[1][pixel], color[2][pixel],
      1.0 - this->Light->Transmittance[pixel] };
  }

private:
  /// What else is found on a ray.
  struct RayContents
  {
    float Depth;
    /// The largest value of a cloud that shows it, and the cloud.
    double Maximum;
    const SceneField* MaximumOf;
    /// The first fragment that is not drawn yet, and the one behind the last.
    std::size_t Fragment;
    std::size_t End;
  };

  struct SegmentEnds;

  void DrawAllBefore(double depth);
  void FindMaxima(const SceneField& field, const CloudSegments& segments);
  void DrawMaximum(int pixel);
  void IntegrateParts(const SceneField& field, const CloudSegments& whole);
  void AddPart(const SceneField& field, int pixel, const SegmentEnds& ends);
  void Integrate(const SceneField& field, const CloudSegments& segments);
  std::uint32_t FindMixed(int row) const;
  void DrawSegments(int pixel, double depth);
  void DrawFragments(int pixel, double depth);
  void CloseOpaque(int row);
  double GetDepth(const Fragment& fragment, int pixel) const
  {
    return fragment.T * this->RaysOfTile.DepthOfT[pixel];
  }
  void Write(Frame& frame) const;

  const Scene& TheScene;
  const Kernels& TheKernels;
  PixelRows Tile;
  CloudTile RaysOfTile;
  /// The bits of the columns whose rays are not opaque yet.
  std::uint32_t Open[CloudTile::Edge];
  std::unique_ptr<RayContents[]> Rays;
  std::unique_ptr<TileLight> Light;
  std::vector<Fragment> Surfaces;
  /// Null if no cloud is lit.
  std::unique_ptr<CloudLighting> Lighting;
  std::vector<CloudLight> Lamps;
  std::unique_ptr<CloudSegments> Segments;
  std::unique_ptr<CloudSegments> Parts;
  std::unique_ptr<SegmentLight[]> Lights;
  PendingSegments Pending;
};

}

#endif
