// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/BeamTracer.h"

#include <algorithm>
#include <limits>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr float FloatInfinity = std::numeric_limits<float>::infinity();
constexpr int GroupSize = BeamRays::GroupSize;

/// The ray of a packet in a place: rays of a rectangle are grouped in squares of 4 x 4 pixels, if
/// it can be cut into such.
int FindRay(const RayPacket& packet, int place)
{
  constexpr int edge = 4;
  const int columns = packet.Columns;
  if (columns == 0 || columns % edge != 0 || packet.Count % (columns * edge) != 0)
  {
    return place;
  }
  const int square = place / GroupSize;
  const int across = columns / edge;
  const int x = square % across * edge + place % edge;
  const int y = square / across * edge + place % GroupSize / edge;
  return x + columns * y;
}

}

//------------------------------------------------------------------------------
RaySet BeamTracer::Trace(
  const MeshSelection& selection, const RayPacket& packet, MeshBeam& beam, HitsOfRays& hits)
{
  this->Packet = &packet;
  this->Enter(selection, beam.GetFrame());
  this->Pairs.Count = 0;
  for (std::vector<Hit>& hitsOfRay : hits)
  {
    hitsOfRay.clear();
  }
  const Kernels& kernels = *selection.PacketKernels;
  for (std::size_t set = 0; set < beam.GetNumberOfSets() || beam.FindMore(selection, this->End);
       ++set)
  {
    kernels.FindPairs(beam.GetSet(set), this->Rays, this->Pairs);
    if (this->Pairs.Count >= BeamPairs::Batch)
    {
      this->Solve(beam.GetFrame(), hits);
    }
  }
  this->Solve(beam.GetFrame(), hits);
  return this->InBeam;
}

//------------------------------------------------------------------------------
void BeamTracer::Enter(const MeshSelection& selection, const BeamFrame& frame)
{
  const RayPacket& packet = *this->Packet;
  this->InBeam = {};
  this->Exact.clear();
  std::fill_n(this->Rays.End, BeamRays::Capacity, -FloatInfinity);
  for (int place = 0; place < packet.Count; ++place)
  {
    const int ray = FindRay(packet, place);
    this->Rays.Ray[place] = ray;
    this->Exact.emplace_back(selection, packet, ray);
    float label[2] = {};
    if (Has(packet.Exists, ray) && frame.FindLabel(packet, ray, label))
    {
      Add(ray, this->InBeam);
      this->Rays.End[place] = frame.GetEnd(packet, ray, packet.End[ray]);
    }
    this->Rays.Label[0][place] = label[0];
    this->Rays.Label[1][place] = label[1];
  }
  for (int group = 0; group < BeamRays::Groups; ++group)
  {
    for (std::size_t k = 0; k < 2; ++k)
    {
      float lower = FloatInfinity;
      float upper = -FloatInfinity;
      for (int place = group * GroupSize; place < (group + 1) * GroupSize; ++place)
      {
        const bool isThere = this->Rays.End[place] > -FloatInfinity;
        lower = isThere ? std::min(lower, this->Rays.Label[k][place]) : lower;
        upper = isThere ? std::max(upper, this->Rays.Label[k][place]) : upper;
      }
      this->Rays.Lower[k][group] = lower;
      this->Rays.Upper[k][group] = upper;
    }
  }
  this->FindEnds();
}

//------------------------------------------------------------------------------
void BeamTracer::FindEnds()
{
  this->End = -FloatInfinity;
  for (int group = 0; group < BeamRays::Groups; ++group)
  {
    const float* ends = this->Rays.End + group * GroupSize;
    this->Rays.GroupEnd[group] = *std::max_element(ends, ends + GroupSize);
    this->End = std::max(this->End, this->Rays.GroupEnd[group]);
  }
}

//------------------------------------------------------------------------------
void BeamTracer::Solve(const BeamFrame& frame, HitsOfRays& hits)
{
  for (int i = 0; i < this->Pairs.Count; ++i)
  {
    const int place = this->Pairs.Ray[i];
    const int ray = this->Rays.Ray[place];
    MeshRay& exact = this->Exact[static_cast<std::size_t>(place)];
    exact.FindHitsIn(this->Pairs.Cell[i], this->Pairs.Surface[i], this->InCell,
      hits[static_cast<std::size_t>(ray)]);
    this->Rays.End[place] = frame.GetEnd(*this->Packet, ray, exact.GetEnd());
  }
  this->Pairs.Count = 0;
  this->FindEnds();
}

}
