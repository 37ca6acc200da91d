// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef EmbreeCells_h
#define EmbreeCells_h

#include "CellGrid.h"
#include "Views.h"

#include <memory>

namespace Benchmark
{

/// Tetrahedra as a user geometry of Embree, which asks for the hits in cells: its tree knows no
/// values.
class EmbreeCells
{
public:
  /// Builds the tree, on so many threads. The cells must outlive it.
  EmbreeCells(const TetrahedronList& cells, double isovalue, int threads);
  ~EmbreeCells();

  /// Returns the t of the first hit of a ray; infinite if there is none.
  double FindFirst(const Triple& origin, const Triple& direction) const;

  /// In bytes.
  double GetMemory() const;

private:
  struct Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
