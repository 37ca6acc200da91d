// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The segments of a ray in the cells that it may pass. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

unsigned int FindSegmentsInCells(const RayPacket& packet, int ray, const LatticePlanes* planes,
  const int (*cells)[SegmentsInCells::Capacity], int count, SegmentsInCells& segments)
{
  unsigned int passed = 0;
  for (int first = 0; first < count; first += DoubleWidth)
  {
    RaysInCells<Doubles> rays;
    for (int axis = 0; axis < 3; ++axis)
    {
      rays.Origin[axis] = packet.Origin[axis][ray];
      rays.Direction[axis] = packet.Direction[axis][ray];
      rays.Inverse[axis] = packet.Inverse[axis][ray];
      rays.Cell[axis] = LoadIntegers(&cells[axis][first]);
      rays.Lower[axis] =
        planes ? Gather(planes->Coordinates[axis], &cells[axis][first]) : rays.Cell[axis];
      rays.Upper[axis] =
        planes ? Gather(planes->Coordinates[axis] + 1, &cells[axis][first]) : rays.Cell[axis] + 1.0;
    }
    rays.Begin = packet.Begin[ray];
    rays.End = packet.End[ray];
    rays.Even = !planes;
    CellSegments<Doubles> found;
    passed |= ToBits(found.Find(rays)) << first;
    Store(found.Begin, &segments.Begin[first]);
    Store(found.End, &segments.End[first]);
    Store(found.BeginAxis, &segments.BeginAxis[first]);
    for (int axis = 0; axis < 3; ++axis)
    {
      Store(found.Entry[axis], &segments.Entry[axis][first]);
      Store(found.Exit[axis], &segments.Exit[axis][first]);
    }
  }
  return passed & ((1U << count) - 1U);
}

}
}
