// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Tracers/CandidateTracer.h"

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
CandidateTracer::CandidateTracer(
  const ImageSelection& selection, const RayPacket& rays, Cells& cells, CornerSource& corners)
  : CellQueueTracer(*selection.PacketKernels, selection.GetTracedBlocks())
  , Selection(selection)
  , Rays(rays)
  , TheCells(cells)
  , TheCorners(corners)
{
  this->Waiting.Count = 0;
}

//------------------------------------------------------------------------------
void CandidateTracer::TraceSurfaces(Order order)
{
  this->TraceQueued(this->Rays, this->TheCells, this->TheCorners, order);
  this->SolveWaiting();
}

//------------------------------------------------------------------------------
void CandidateTracer::TakeQueue(const Frustum& frustum)
{
  if (!this->AllInRows)
  {
    // Waiting candidates are read from rows, new ones from copies.
    this->SolveWaiting();
    this->TheCorners.Copy(this->Queue, frustum.Axis, this->Passed);
    this->AreCopied = true;
  }
  if (this->Selection.Isovalues.size() > 1)
  {
    this->TakeSurfaces(frustum);
  }
  else
  {
    this->FindCandidates(frustum, this->Queue, 0);
    if (this->AreCopied || this->Waiting.Count >= Candidates::Batch)
    {
      this->SolveWaiting();
    }
  }
  this->AreCopied = false;
}

//------------------------------------------------------------------------------
/// Finds and solves the candidates of several surfaces, one after the other.
void CandidateTracer::TakeSurfaces(const Frustum& frustum)
{
  this->TheKernels.FindRanges[this->TheCorners.GetType(this->AreCopied)](
    this->Queue, this->TheCorners.GetStrides(this->AreCopied), this->Lowest, this->Highest);
  const std::vector<Isosurface>& surfaces = this->Selection.Request.Surfaces;
  for (std::size_t surface = 0; surface < surfaces.size(); ++surface)
  {
    this->SelectCells(static_cast<float>(surfaces[surface].Isovalue));
    if (this->Selected.Count > 0)
    {
      this->FindCandidates(frustum, this->Selected, static_cast<int>(surface));
      this->SolveCandidates(static_cast<int>(surface));
    }
  }
}

//------------------------------------------------------------------------------
/// Selects the queued cells whose values are on both sides of an isovalue. Rounding is monotonic:
/// none is left out.
void CandidateTracer::SelectCells(float isovalue)
{
  int count = 0;
  for (int i = 0; i < this->Queue.Count; ++i)
  {
    this->Selected.Codes[count] = this->Queue.Codes[i];
    this->Selected.First[count] = this->Queue.First[i];
    const bool isPassed = this->Lowest[i] <= isovalue && isovalue <= this->Highest[i];
    count += isPassed ? 1 : 0;
  }
  this->Selected.Count = count;
  Fill(this->Selected);
}

//------------------------------------------------------------------------------
void CandidateTracer::FindCandidates(const Frustum& frustum, const PassedCells& cells, int surface)
{
  RaySet hits[2] = {};
  this->TheKernels.ClassifyCells[this->TheCorners.GetType(this->AreCopied)](cells, frustum.Axis,
    this->TheCorners.GetStrides(this->AreCopied),
    this->Selection.Isovalues[static_cast<std::size_t>(surface)], this->Passed, this->Waiting,
    hits);
  this->KeepSureHits(frustum, surface, hits);
}

//------------------------------------------------------------------------------
/// Solves the waiting candidates, which are those of a surface.
void CandidateTracer::SolveCandidates(int surface)
{
  this->DropCandidates();
  if (this->Waiting.Count == 0)
  {
    return;
  }
  this->LoadCorners(this->AreCopied, this->Waiting);
  this->TheKernels.Solve(this->Rays, this->Waiting, this->Planes,
    this->Selection.Isovalues[static_cast<std::size_t>(surface)], this->Solved);
  this->KeepSolutions(surface);
  this->Waiting.Count = 0;
}

//------------------------------------------------------------------------------
Index3 CandidateTracer::GetCell(int candidate) const
{
  const Candidates& candidates = this->Waiting;
  return { candidates.Cell[0][candidate], candidates.Cell[1][candidate],
    candidates.Cell[2][candidate] };
}

}
