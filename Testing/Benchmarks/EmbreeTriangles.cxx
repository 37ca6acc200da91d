// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "EmbreeTriangles.h"

#include <vtkCellArray.h>
#include <vtkPolyData.h>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstddef>
#include <limits>
#include <stdexcept>

namespace Benchmark
{
namespace
{

constexpr int PacketEdge = 4;
constexpr int PacketSize = PacketEdge * PacketEdge;

void Intersect(const int* valid, RTCScene scene, RTCRayHit16& packet)
{
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &packet, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, &packet);
#endif
}

/// The rays of a picture, in Embree's precision.
struct SingleRays
{
  float Origin[3];
  float Corner[3];
  float StepX[3];
  float StepY[3];

  explicit SingleRays(const PictureRays& rays)
  {
    const Triple corner = rays.GetDirection(0, 0);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Origin[axis] = static_cast<float>(rays.GetOrigin()[axis]);
      this->Corner[axis] = static_cast<float>(corner[axis]);
      this->StepX[axis] = static_cast<float>(rays.GetStepX()[axis]);
      this->StepY[axis] = static_cast<float>(rays.GetStepY()[axis]);
    }
  }
};

/// Traces a square of pixels; those outside of the part of the picture are switched off. Depths may
/// be null.
int TracePacket(RTCScene scene, const SingleRays& rays, const PixelRectangle& pixels, int left,
  int bottom, float* depths)
{
  RTCRayHit16 packet;
  alignas(64) int valid[PacketSize];
  float* origins[3] = { packet.ray.org_x, packet.ray.org_y, packet.ray.org_z };
  float* directions[3] = { packet.ray.dir_x, packet.ray.dir_y, packet.ray.dir_z };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < PacketSize; ++i)
    {
      const auto x = static_cast<float>(left + i % PacketEdge);
      const auto y = static_cast<float>(bottom + i / PacketEdge);
      origins[axis][i] = rays.Origin[axis];
      directions[axis][i] = rays.Corner[axis] + x * rays.StepX[axis] + y * rays.StepY[axis];
    }
  }
  for (int i = 0; i < PacketSize; ++i)
  {
    const bool isInside = left + i % PacketEdge < pixels.X + pixels.Width &&
      bottom + i / PacketEdge < pixels.Y + pixels.Height;
    valid[i] = isInside ? -1 : 0;
    packet.ray.tnear[i] = 0.0F;
    packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
    packet.ray.time[i] = 0.0F;
    packet.ray.mask[i] = ~0U;
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  Intersect(valid, scene, packet);
  int hits = 0;
  for (int i = 0; i < PacketSize; ++i)
  {
    hits += valid[i] != 0 && packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
    if (depths && valid[i] != 0)
    {
      const std::ptrdiff_t row = bottom + i / PacketEdge - pixels.Y;
      depths[row * pixels.Width + left + i % PacketEdge - pixels.X] = packet.ray.tfar[i];
    }
  }
  return hits;
}

}

struct EmbreeTriangles::Internals
{
  RTCDevice Device = nullptr;
  RTCScene Scene = nullptr;
};

//------------------------------------------------------------------------------
EmbreeTriangles::EmbreeTriangles(vtkPolyData* triangles, int threads)
  : Internal(std::make_unique<Internals>())
{
  const std::string settings = "threads=" + std::to_string(threads);
  this->Internal->Device = rtcNewDevice(settings.c_str());
  if (!this->Internal->Device)
  {
    throw std::runtime_error("Embree has no device for this processor");
  }
  this->Internal->Scene = rtcNewScene(this->Internal->Device);
  RTCGeometry geometry = rtcNewGeometry(this->Internal->Device, RTC_GEOMETRY_TYPE_TRIANGLE);

  const vtkIdType points = triangles->GetNumberOfPoints();
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
    RTC_FORMAT_FLOAT3, 3 * sizeof(float), static_cast<std::size_t>(points)));
  for (vtkIdType i = 0; i < points; ++i)
  {
    double point[3];
    triangles->GetPoint(i, point);
    for (int axis = 0; axis < 3; ++axis)
    {
      *vertices++ = static_cast<float>(point[axis]);
    }
  }
  vtkCellArray* cells = triangles->GetPolys();
  auto* corners = static_cast<unsigned int*>(
    rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
      3 * sizeof(unsigned int), static_cast<std::size_t>(cells->GetNumberOfCells())));
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCellAtId(i, size, ids);
    for (int corner = 0; corner < 3; ++corner)
    {
      *corners++ = static_cast<unsigned int>(ids[corner]);
    }
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(this->Internal->Scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(this->Internal->Scene);
  if (rtcGetDeviceError(this->Internal->Device) != RTC_ERROR_NONE)
  {
    throw std::runtime_error("Embree cannot build its hierarchy: too little memory?");
  }
}

//------------------------------------------------------------------------------
EmbreeTriangles::~EmbreeTriangles()
{
  rtcReleaseScene(this->Internal->Scene);
  rtcReleaseDevice(this->Internal->Device);
}

//------------------------------------------------------------------------------
int EmbreeTriangles::Trace(const PictureRays& rays, const PixelRectangle& pixels, int threads)
{
  return this->Trace(rays, pixels, threads, nullptr);
}

//------------------------------------------------------------------------------
std::vector<float> EmbreeTriangles::FindDepths(
  const PictureRays& rays, const PixelRectangle& pixels)
{
  std::vector<float> depths(
    static_cast<std::size_t>(pixels.Width) * static_cast<std::size_t>(pixels.Height));
  this->Trace(rays, pixels, 1, depths.data());
  return depths;
}

//------------------------------------------------------------------------------
int EmbreeTriangles::Trace(
  const PictureRays& picture, const PixelRectangle& pixels, int threads, float* depths)
{
  const SingleRays rays(picture);
  constexpr int tileEdge = 16;
  const int columns = (pixels.Width + tileEdge - 1) / tileEdge;
  const int rows = (pixels.Height + tileEdge - 1) / tileEdge;
  int hits = 0;
#pragma omp parallel for schedule(dynamic) num_threads(threads) reduction(+ : hits)
  for (int tile = 0; tile < columns * rows; ++tile)
  {
    const int left = pixels.X + tile % columns * tileEdge;
    const int bottom = pixels.Y + tile / columns * tileEdge;
    for (int y = bottom; y < bottom + tileEdge; y += PacketEdge)
    {
      for (int x = left; x < left + tileEdge; x += PacketEdge)
      {
        hits += TracePacket(this->Internal->Scene, rays, pixels, x, y, depths);
      }
    }
  }
  return hits;
}

//------------------------------------------------------------------------------
std::string EmbreeTriangles::GetVersion()
{
  return RTC_VERSION_STRING;
}

}
