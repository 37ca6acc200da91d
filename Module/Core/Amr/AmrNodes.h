// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AmrNodes_h
#define AmrNodes_h

#include "Image/Samples/VolumeView.h"

#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The samples of a region, as they are traced: at nodes, with a layer of them around the region.
struct AmrNodes
{
  /// Of all of the nodes.
  Index3 Dimensions;
  /// In double precision, or in single.
  std::vector<double> Values;
  std::vector<float> Singles;
  /// The places of those behind the data, which continue them for one-sided differences.
  std::vector<std::size_t> Continued;
  /// One for each cell of the samples, not zero where finer cells count, or none.
  std::vector<unsigned char> HiddenCells;

  /// Keeps the values in single precision, if that changes none of them but for those behind the
  /// data, which it rounds: those of samples often are of a smaller type, means of them are not.
  void Shorten();

  /// The nodes of the region and those of the layer behind it, before which there is a node along
  /// each axis. So no ray slips through between two regions: it goes on a little into the layer
  /// behind the first, whatever rounding makes of the border.
  VolumeView GetSamples() const;
  std::size_t GetMemory() const;
};

}

#endif
