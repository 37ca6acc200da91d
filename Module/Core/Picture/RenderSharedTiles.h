// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RenderSharedTiles_h
#define RenderSharedTiles_h

#include "Field/Execution.h"
#include "Picture/MessageExchange.h"
#include "Picture/RenderTiles.h"
#include "Picture/Scene.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace vtkIsosurfaceRayTracing
{

/// How processes that draw a picture together send what they find.
struct Sharing
{
  /// A message is sent when it has about so many segments, or when there is nothing else to do.
  std::size_t BufferDepth = 4096;
  /// After so many groups of tiles in which segments are found, or shares of groups that are drawn,
  /// a process looks for messages.
  int PollingInterval = 1;
  /// So many segments of a tile are found by all together before rays may be found to be opaque,
  /// and so many by each process: to find less takes nearly as long.
  std::size_t SegmentsAtOnce = std::size_t{ 1 } << 15;
  std::size_t LeastSegmentsAtOnce = 2048;

  /// So many segments of a tile are enough for a part of one process.
  std::size_t FindSegmentsOfPart(int processes) const
  {
    return std::max(
      this->LeastSegmentsAtOnce, this->SegmentsAtOnce / static_cast<std::size_t>(processes));
  }
};

/// What a process did for a picture.
struct SharingCounts
{
  std::int64_t SegmentsFound = 0;
  /// Those of its own shares, and how many of them were there at once, at most.
  std::int64_t SegmentsDrawn = 0;
  std::int64_t MostStored = 0;
  std::int64_t Bytes = 0;
};

/// Whether processes can draw a picture together.
enum class Agreement
{
  Fine,
  /// A process refused; the scene is as it was.
  Refused,
  /// They have different numbers of fields.
  DifferentFields
};

/// To be called by all processes before they draw a picture together; with null by one that cannot.
/// The rectangle of the scene becomes that of all.
Agreement AgreeOnPicture(Scene* scene, MessageExchange& exchange);

/// Draws a scene with clouds whose fields lie in many processes: what one process would draw that
/// had them all, bit for bit if all fields have the same object space.
///
/// All processes work on the same tiles at about the same time, and their rows are dealt out to
/// owners: see SharedTiles. Of each tile they find the fragments and the segments of their cells,
/// front to back, and send these to the owners, which draw them in the order of their depths as far
/// as no process may send one that comes before. If that takes more than one part, the owners
/// answer which rays are not opaque yet. A process does not run ahead: so only a few tiles are
/// stored at any time. (After K.-L. Ma, T. W. Crockett: A Scalable Parallel Cell-Projection Volume
/// Rendering Algorithm for Three-Dimensional Unstructured Data, 1997. They deal out cells, and
/// agree on regions of space by a k-d tree, where we have tiles.)
///
/// All processes must call it, after they have agreed. The fields must be selected. As for
/// RenderTiles, keepGoing is called now and then; if it returns false the frame is abandoned, but
/// the process takes part until all are done. Afterwards the frame has the pixels of the shares
/// that the process owns; the others are black and transparent.
bool RenderSharedTiles(const Scene& scene, const Execution& execution, const Sharing& sharing,
  MessageExchange& exchange, Frame& frame, SharingCounts& counts,
  const std::function<bool(double)>& keepGoing);

}

#endif
