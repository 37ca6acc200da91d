// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RangeStore_h
#define RangeStore_h

#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// Keeps the ranges of the finest macrocells of some samples for those who build them again: the
/// levels above follow from these, without a look at the samples.
class RangeStore
{
public:
  virtual ~RangeStore() = default;

  /// Reads the bytes of the ranges of macrocells with an edge of so many cells. Returns whether
  /// they are there; if they are not, what was there before may be overwritten.
  virtual bool Read(int edge, void* ranges, std::size_t size) = 0;

  /// Keeps them. It may fail, and then they are built again.
  virtual void Write(int edge, const void* ranges, std::size_t size) = 0;
};

}

#endif
