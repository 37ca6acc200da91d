// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CandidateTracer_h
#define CandidateTracer_h

#include "Image/Tracers/ImageSelection.h"
#include "Image/Traversal/CellQueueTracer.h"

namespace vtkIsosurfaceRayTracing
{

/// Solves the cells that the rays of a packet may pass for some surfaces of the trilinear
/// interpolant: single precision finds the candidates of each surface, which are then solved
/// together, exactly as for a single ray. What is done with the solutions, derived classes say.
class CandidateTracer : public CellQueueTracer
{
protected:
  /// All must outlive the tracer. The corners are those of the cells.
  CandidateTracer(
    const ImageSelection& selection, const RayPacket& rays, Cells& cells, CornerSource& corners);

  /// Takes all rays of the packet that exist to their ends.
  void TraceSurfaces(Order order);

  /// Solves the candidates that wait, which are those of the only surface.
  void SolveWaiting() { this->SolveCandidates(0); }

  /// Takes the rays that surely hit a surface in some queued cells: hits[0] where values fall along
  /// the axis, hits[1] where they rise.
  virtual void KeepSureHits(
    const Frustum& /*frustum*/, int /*surface*/, const RaySet (&/*hits*/)[2])
  {
  }
  /// Drops those of the waiting candidates that need not be solved.
  virtual void DropCandidates() {}
  /// Takes the solutions of the waiting candidates, which are those of a surface.
  virtual void KeepSolutions(int surface) = 0;

  Index3 GetCell(int candidate) const;

  const ImageSelection& Selection;
  const RayPacket& Rays;
  Candidates Waiting;
  Solutions Solved;

private:
  void TakeQueue(const Frustum& frustum) override;
  void TakeSurfaces(const Frustum& frustum);
  void SelectCells(float isovalue);
  void FindCandidates(const Frustum& frustum, const PassedCells& cells, int surface);
  void SolveCandidates(int surface);

  Cells& TheCells;
  CornerSource& TheCorners;
  /// Whether the corners of the candidates were copied.
  bool AreCopied = false;
  /// Of the queued cells, the ranges of values; and those that a surface passes.
  alignas(64) float Lowest[PassedCells::Capacity];
  alignas(64) float Highest[PassedCells::Capacity];
  PassedCells Selected;
};

}

#endif
