// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What a set of fields is made of.

#ifndef PlacedField_h
#define PlacedField_h

#include "Field/TracedField.h"
#include "Math/Bounds.h"

#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// Where a member of a set of fields comes from.
class FieldSource
{
public:
  virtual ~FieldSource() = default;

  /// Whether rays may hit anything of a request without caps, as far as it is known without making
  /// the field. Called by one thread at a time.
  virtual bool MayHit(const TraceRequest& /*request*/) { return true; }

  /// The field, which is made if it is not there. Called by one thread at a time.
  virtual TracedField& GetField() = 0;

  /// What of the field is visible, in its object space. It must be there.
  virtual Visibility FindVisible() const = 0;

  /// The number of the block that a hit is of: of hits of several fields in one place, that of the
  /// first block counts.
  virtual unsigned int GetBlock(const Hit& /*hit*/) const { return 0; }

  /// What is kept for the field besides what it tells itself, in bytes.
  virtual std::size_t GetMemory() const { return 0; }
};

/// A field of a set, and where it lies.
struct PlacedField
{
  /// It must outlive the set.
  FieldSource* Source;
  /// From the object space of the field to that of the set: an affine transformation.
  Matrix4 SetFromOwn;
  /// The box that its hits are in, in the object space of the set: rays are cut to it.
  Bounds Box;
  /// The size of its cells in its own object space, about.
  double CellSize = 1.0;
  /// Its share of the memory that all may have, in any unit.
  double MemoryShare = 1.0;
  /// Whether it is made and selected when the first ray comes to its box, by the thread of this
  /// ray; otherwise in Select, with all threads. A field that no ray comes to costs nothing.
  bool IsOnDemand = false;
  /// Whether the fields of all members with this mark are one where their boxes touch. A hit that
  /// two of them have there is one.
  bool IsSeamless = false;
};

}

#endif
