// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Tracers/StopTracer.h"

#include "Image/Traversal/CandidateSets.h"

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
const StoppedRays& StopTracer::FindStopped()
{
  this->TraceSurfaces(Order::Any);
  return this->Stopped;
}

//------------------------------------------------------------------------------
int StopTracer::KeepNeeded(const Frustum& /*frustum*/, int* passages, int count) const
{
  return KeepOthers([this](int passage)
    { return Has(this->Stopped.Stopped, this->Passed.Segments[passage].Ray); },
    passages, count);
}

//------------------------------------------------------------------------------
/// A hit is sure only far from where the ray starts: there the value is zero but for rounding.
void StopTracer::KeepSureHits(const Frustum& frustum, int surface, const RaySet (&hits)[2])
{
  for (const bool rise : { false, true })
  {
    const bool entering = rise == frustum.IsUp;
    ForEachRay(Without(hits[rise ? 1 : 0], this->Stopped.Stopped),
      [this, surface, entering](int ray)
      {
        if (!this->Departures[ray].Is(surface, entering))
        {
          Add(ray, this->Stopped.Stopped);
        }
      });
  }
}

//------------------------------------------------------------------------------
/// Where a ray is surely stopped, there is nothing to solve.
void StopTracer::DropCandidates()
{
  Candidates& waiting = this->Waiting;
  int count = 0;
  for (int i = 0; i < waiting.Count; ++i)
  {
    const int ray = waiting.Ray[i];
    for (auto& coordinates : waiting.Cell)
    {
      coordinates[count] = coordinates[i];
    }
    waiting.Ray[count] = ray;
    waiting.First[count] = waiting.First[i];
    count += Has(this->Stopped.Stopped, ray) ? 0 : 1;
  }
  waiting.Count = count;
}

//------------------------------------------------------------------------------
void StopTracer::KeepSolutions(int surface)
{
  ForEachCandidate(
    this->Solved.Found, [this, surface](int candidate) { this->KeepSolution(candidate, surface); });
  ForEachCandidate(this->Solved.Extreme,
    [this](int candidate)
    { this->StopInCell(this->Waiting.Ray[candidate], this->GetCell(candidate)); });
}

//------------------------------------------------------------------------------
/// Takes the first root of a candidate. Where that may be the crossing that the ray starts on,
/// further roots may follow.
void StopTracer::KeepSolution(int candidate, int surface)
{
  const int ray = this->Waiting.Ray[candidate];
  if (!this->Departures[ray].Is(surface, HasCandidate(this->Solved.Entering, candidate)))
  {
    this->Stopped.AddCrossing(
      ray, this->Solved.T[candidate] * Length(this->Rays.GetDirection(ray)));
  }
  else if (HasCandidate(this->Solved.Further, candidate))
  {
    this->StopInCell(ray, this->GetCell(candidate));
  }
}

//------------------------------------------------------------------------------
/// Solves a cell for a single ray.
void StopTracer::StopInCell(int ray, const Index3& cell)
{
  if (!Has(this->Stopped.Stopped, ray))
  {
    FindStopsInCell(ray, this->Selection.TakeRay(this->Rays, ray), cell, this->Departures[ray],
      this->TheCells, this->InCell, this->Stopped);
  }
}

//------------------------------------------------------------------------------
void StopTracer::EndQueuedSlice(const Frustum& /*frustum*/)
{
  this->Going = Without(this->Going, this->Stopped.Stopped);
}

}
