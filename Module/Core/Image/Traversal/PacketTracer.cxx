// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Traversal/PacketTracer.h"

#include "Image/Traversal/BlockWalk.h"
#include "Image/Traversal/FrustumTraversal.h"
#include "Math/Compiler.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

int FirstOf(const RaySet& set)
{
  return set.Words[0] != 0 ? LowestBit(set.Words[0]) : 64 + LowestBit(set.Words[1]);
}

/// The major axis of a ray of a packet.
int GetMainAxis(const RayPacket& packet, int ray)
{
  int axis = 0;
  for (int other = 1; other < 3; ++other)
  {
    if (std::abs(packet.Direction[other][ray]) > std::abs(packet.Direction[axis][ray]))
    {
      axis = other;
    }
  }
  return axis;
}

/// Whether a frustum is so wide, by the number of blocks across it, that few of its rays meet in
/// one.
bool HaveLittleInCommon(const Frustum& frustum, int count)
{
  double blocks = 1.0;
  for (int j = 0; j < 2; ++j)
  {
    const double width =
      0.5 * (frustum.Most[j][0] - frustum.Least[j][0] + frustum.Most[j][1] - frustum.Least[j][1]);
    blocks *= width / BlockMask::Edge + 1.0;
  }
  return blocks > count;
}

}

//------------------------------------------------------------------------------
bool PacketTracer::MayMeet(
  const Kernels& kernels, const BlockTree& tree, const CellLattice& lattice, RayPacket& lines)
{
  // Points on lines that begin farther away are not exact enough.
  constexpr double farthest = 1e6;
  const int axis = GetMainAxis(lines, 0);
  for (int i = 0; i < lines.Count; ++i)
  {
    Add(i, lines.Exists);
    for (const auto& origins : lines.Origin)
    {
      if (!(std::abs(origins[i]) < farthest))
      {
        return true;
      }
    }
    const double inverse = 1.0 / lines.Direction[axis][i];
    const double first = -lines.Origin[axis][i] * inverse;
    const double last =
      (lattice.GetCells()[static_cast<std::size_t>(axis)] - lines.Origin[axis][i]) * inverse;
    lines.Inverse[axis][i] = inverse;
    lines.Begin[i] = std::min(first, last);
    lines.End[i] = std::max(first, last);
  }
  AlignedRays aligned;
  Frustum frustum;
  if (!kernels.Align(lines, lines.Exists, axis, aligned, frustum) ||
    FrustumTraversal::IsTooWide(frustum))
  {
    return true;
  }
  bool meets = false;
  FrustumTraversal(tree, lattice.GetPlanes(), frustum)
    .ForEachSlice([&meets](const FrustumTraversal::Members&) { return meets = true; });
  return meets;
}

//------------------------------------------------------------------------------
void PacketTracer::Trace(const RayPacket& packet, Cells& cells, Order order)
{
  this->Packet = &packet;
  this->Source = &cells;
  this->TheOrder = order;
  this->TraceSet(packet.Exists, CountOf(packet.Exists));
}

//------------------------------------------------------------------------------
/// Traces rays as one frustum or, where that is not narrow, each by itself, or one half of them
/// after the other.
void PacketTracer::TraceSet(const RaySet& rays, int count)
{
  if (count == 0)
  {
    return;
  }
  const int axis = GetMainAxis(*this->Packet, FirstOf(rays));
  Frustum frustum;
  const bool isFrustum = this->TheKernels.Align(*this->Packet, rays, axis, this->Aligned, frustum);
  const bool mayBeApart =
    this->TheOrder != Order::FrontToBack && !this->Planes && !this->Cropped && count > 1;
  if (mayBeApart && (!isFrustum || HaveLittleInCommon(frustum, count)))
  {
    this->TraceAlike(rays, axis);
  }
  else if (count > 1 && (!isFrustum || FrustumTraversal::IsTooWide(frustum)))
  {
    this->TraceHalves(rays, count);
  }
  else
  {
    this->Going = rays;
    this->TraceFrustum(frustum);
  }
}

//------------------------------------------------------------------------------
void PacketTracer::TraceHalves(const RaySet& rays, int count)
{
  RaySet half = {};
  RaySet rest = rays;
  for (int i = 0; i < count / 2; ++i)
  {
    const int ray = FirstOf(rest);
    Add(ray, half);
    Remove(ray, rest);
  }
  this->TraceSet(half, count / 2);
  this->TraceSet(rest, count - count / 2);
}

//------------------------------------------------------------------------------
/// Traces the rays that go the same way along the axis as the first, each by itself; then the
/// others. None is too steep for a frustum: the axis is the main one of each.
void PacketTracer::TraceAlike(const RaySet& rays, int axis)
{
  const bool isUp = this->Packet->Direction[axis][FirstOf(rays)] > 0.0;
  RaySet alike = {};
  RaySet others = {};
  ForEachRay(rays,
    [&](int ray)
    {
      const bool isAlike = GetMainAxis(*this->Packet, ray) == axis &&
        (this->Packet->Direction[axis][ray] > 0.0) == isUp;
      Add(ray, isAlike ? alike : others);
    });
  Frustum frustum;
  this->TheKernels.Align(*this->Packet, alike, axis, this->Aligned, frustum);
  this->Going = alike;
  this->TraceApart(frustum);
  this->TraceSet(others, CountOf(others));
}

//------------------------------------------------------------------------------
void PacketTracer::TraceFrustum(const Frustum& frustum)
{
  this->AreApart = false;
  this->ClearPassages();
  this->BeginFrustum(frustum);
  FrustumTraversal(this->Tree, this->Lattice.GetPlanes(), frustum)
    .ForEachSlice(
      [this, &frustum](const FrustumTraversal::Members& blocks)
      {
        for (int i = 0; i < blocks.GetCount(); ++i)
        {
          this->Source->Prefetch(blocks.Get(i));
        }
        for (int i = 0; i < blocks.GetCount(); ++i)
        {
          this->VisitBlock(frustum, blocks.Get(i));
        }
        this->EndSlice(frustum);
        return IsEmpty(this->Going);
      });
  this->EndFrustum();
}

//------------------------------------------------------------------------------
void PacketTracer::TraceApart(const Frustum& frustum)
{
  BlockWalk walk(this->TheKernels, this->Tree, this->Aligned, frustum, this->Going);
  this->AreApart = true;
  this->ClearPassages();
  this->BeginFrustum(frustum);
  walk.ForEachRound(
    [this, &walk, &frustum](const BlockWalk::Step* steps, int count)
    {
      const RaySet going = this->Going;
      for (int i = 0; i < count; ++i)
      {
        this->Source->Prefetch(steps[i].Block);
      }
      for (int i = 0; i < count; ++i)
      {
        this->PassBlock(frustum, steps[i].Ray, steps[i].Block);
      }
      this->EndSlice(frustum);
      if (this->TheOrder == Order::Nearest)
      {
        walk.EndBehind(Without(going, this->Going), steps, count);
        this->Going = going;
      }
    });
  this->EndFrustum();
}

//------------------------------------------------------------------------------
/// Finds the cells of a block that one ray may pass.
void PacketTracer::PassBlock(const Frustum& frustum, int ray, const Index3& block)
{
  BlockMask own;
  const BlockMask& mask = this->Source->GetMask(block, own);
  const Index3 cell = BlockMask::GetFirstCell(block);
  const int before = this->Passed.Count;
  this->TheKernels.FindPassage(
    this->Aligned, ray, frustum.Axis, cell.data(), mask.Slices[frustum.Axis], this->Passed);
  if (this->Passed.Count > before)
  {
    this->AddBlock(frustum, block);
  }
}

//------------------------------------------------------------------------------
/// Finds the cells of a block that the rays may pass.
void PacketTracer::VisitBlock(const Frustum& frustum, const Index3& block)
{
  BlockMask own;
  const BlockMask& mask = this->Source->GetMask(block, own);
  if (!this->Cropped || this->Cropped->IsVisible(block))
  {
    if (this->FindPassages(frustum, block, mask))
    {
      this->AddBlock(frustum, block);
    }
    return;
  }
  BlockMask whole;
  BlockMask part;
  this->Cropped->Split(block, mask, whole, part);
  if (this->FindPassages(frustum, block, whole))
  {
    this->AddBlock(frustum, block);
  }
  const int first = this->Passed.Count;
  if (this->FindPassages(frustum, block, part))
  {
    this->AddCroppedCells(frustum, block, first);
  }
}

//------------------------------------------------------------------------------
/// Adds the passages through the cells of a mask. Returns whether there are any.
bool PacketTracer::FindPassages(const Frustum& frustum, const Index3& block, const BlockMask& mask)
{
  const int first[3] = { block[0] * BlockMask::Edge, block[1] * BlockMask::Edge,
    block[2] * BlockMask::Edge };
  const int before = this->Passed.Count;
  this->TheKernels.FindPassages(this->Aligned, this->Going, frustum.Axis, first,
    mask.Slices[frustum.Axis], this->Planes, this->Passed);
  return this->Passed.Count > before;
}

//------------------------------------------------------------------------------
void PacketTracer::ClearPassages()
{
  this->Passed.Count = 0;
  this->Passed.BlockCount = 0;
  this->Passed.HasEnds = false;
  this->Passed.AreUneven = this->Planes != nullptr;
}

}
