// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef StopTracer_h
#define StopTracer_h

#include "Field/Departure.h"
#include "Field/RootSet.h"
#include "Image/Tracers/CandidateTracer.h"
#include "Image/Tracers/RootTracing.h"

namespace vtkIsosurfaceRayTracing
{

/// Finds the rays of a packet that opaque surfaces of the trilinear interpolant stop, wherever that
/// is: most by single precision alone.
class StopTracer final : public CandidateTracer
{
public:
  /// All must outlive the tracer. There is a departure for each ray; the corners are those of the
  /// cells.
  StopTracer(const ImageSelection& selection, const RayPacket& rays, const Departure* departures,
    RootCells& cells, CornerSource& corners)
    : CandidateTracer(selection, rays, cells, corners)
    , Departures(departures)
    , TheCells(cells)
  {
  }

  const StoppedRays& FindStopped();

private:
  int KeepNeeded(const Frustum& frustum, int* passages, int count) const override;
  void KeepSureHits(const Frustum& frustum, int surface, const RaySet (&hits)[2]) override;
  void DropCandidates() override;
  void KeepSolutions(int surface) override;
  void KeepSolution(int candidate, int surface);
  void StopInCell(int ray, const Index3& cell);
  void EndQueuedSlice(const Frustum& frustum) override;

  const Departure* Departures;
  RootCells& TheCells;
  StoppedRays Stopped;
  /// Kept for its memory.
  RootSet InCell;
};

}

#endif
