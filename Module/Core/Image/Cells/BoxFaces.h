// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BoxFaces_h
#define BoxFaces_h

#include "Image/Cells/CellSegment.h"
#include "Math/TrilinearCell.h"
#include "Rays/TraceRequest.h"

#include <cstdint>
#include <vector>

// Interpolant::Nearest: every sample is a box of one value, which ends half way to the next sample,
// and surfaces are the faces between boxes. A face lies in the middle of four cells, so the cells
// that a ray passes are those where it may cross faces, and a cell that it crosses one in has
// corners on both sides.

namespace vtkIsosurfaceRayTracing
{

/// The corner of a cell in whose box a ray is at a crossing, which is in the cell or before it. A
/// ray that lies in a plane between boxes stays in those above.
int FindBox(const Ray& ray, const Index3& cell, const Crossing& at);

/// A hit with a face between boxes, and where the ray crosses it.
struct FaceHit
{
  Crossing At;
  /// The number of the cell across the face, counted along the ray: faces in flat cells may be
  /// crossed at one place.
  int Number;
  Hit TheHit;

  /// The order along the ray. Where a face is several surfaces, a ray that enters them meets the
  /// smaller isovalue first, and a ray that leaves them the larger one.
  bool operator<(const FaceHit& other) const
  {
    if (this->At < other.At || other.At < this->At)
    {
      return this->At < other.At;
    }
    if (this->Number != other.Number)
    {
      return this->Number < other.Number;
    }
    return this->TheHit.Entering ? this->TheHit.Surface < other.TheHit.Surface
                                 : other.TheHit.Surface < this->TheHit.Surface;
  }
};

/// Appends the hits of a ray in a cell with those of the faces between boxes that are surfaces, in
/// order. Beside a box of no finite value there is no surface.
void FindFaceHits(const Ray& ray, const Index3& cell, const CellCorners& corners,
  const CellLattice& lattice, const std::vector<Isosurface>& surfaces, std::vector<FaceHit>& hits);

/// Hit::Jump at a face across an axis that a ray goes up or down.
std::int8_t GetJump(int axis, bool isEntering, bool isUp);

/// The axis that the face of a hit is across.
int GetAxisOfJump(const Hit& hit);

/// The direction in which values rise at a hit with a face, of length one.
Vector3 GetJumpDirection(const Hit& hit);

}

#endif
