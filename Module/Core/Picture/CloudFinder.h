// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CloudFinder_h
#define CloudFinder_h

#include "Field/CloudSource.h"
#include "Picture/Compositor.h"
#include "Picture/PixelRows.h"
#include "Picture/Scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Whether the scene has clouds.
bool HasClouds(const Scene& scene);

/// Makes the rays of the rows of a tile: each begins at the near plane and ends at the depth of the
/// scene. Their lengths, which finding segments does not need, are not set.
void MakeCloudRays(
  const Scene& scene, const PixelRows& tile, const Kernels& kernels, CloudTile& rays);

/// The same with lengths, and, given a lighting, with its rays in the world.
void MakeMeasuredCloudRays(const Scene& scene, const PixelRows& tile, const Kernels& kernels,
  CloudTile& rays, CloudLighting* lighting);

/// How many of the fragments of a pixel, which are front to back, are seen: the hits of one field
/// end where those before transmit next to nothing, and so do those of several, and of processes.
std::size_t CountVisible(const Fragment* fragments, std::size_t count);

/// Ends a ray at the last of its fragments, if that is opaque: nothing is seen behind it.
void CutCloudRay(const Fragment* fragments, std::size_t count, int pixel, CloudTile& rays);

/// Finds the segments of rays in all clouds of a scene, tile by tile, for one thread.
class CloudFinder
{
public:
  /// The scene must outlive the finder.
  CloudFinder(const Scene& scene, const Kernels* kernels);

  /// Begins with a tile, counted from the rectangle drawn, whose rays are made: at the first cells,
  /// or, given a position, where it paused.
  void Begin(const PixelRectangle& tile, const CloudTile& rays,
    const std::vector<double>* position = nullptr);

  /// No segment that is not found yet begins before this depth; infinite if there is none.
  double GetNextDepth() const;

  /// Finds some of the next segments of the rays that are open, a bit for each column of each row,
  /// all of one cloud. Returns the number of its field.
  std::size_t FindMore(const std::uint32_t (&open)[CloudTile::Edge], CloudSegments& segments);

  ///@{
  /// To pause, find more until it is paused; the position is where to begin again.
  bool IsPaused() const;
  std::size_t FindMoreToPause(
    const std::uint32_t (&open)[CloudTile::Edge], CloudSegments& segments);
  std::vector<double> FindPosition() const;
  ///@}

private:
  struct Cloud
  {
    ViewedCloud Viewed;
    std::size_t Field;
  };

  const Scene& TheScene;
  std::vector<Cloud> Clouds;
  /// Those that the tile may see.
  std::vector<const Cloud*> Seen;
};

}

#endif
