// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "EmbreeCells.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <atomic>
#include <limits>
#include <stdexcept>
#include <string>

namespace Benchmark
{

struct EmbreeCells::Internals
{
  const TetrahedronList* Cells;
  double Isovalue;
  RTCDevice Device = nullptr;
  RTCScene Scene = nullptr;
  std::atomic<ssize_t> Memory{ 0 };

  static bool Count(void* self, ssize_t bytes, bool /*isDone*/)
  {
    static_cast<Internals*>(self)->Memory += bytes;
    return true;
  }

  static void FindBounds(const RTCBoundsFunctionArguments* arguments)
  {
    const auto* self = static_cast<const Internals*>(arguments->geometryUserPtr);
    const TetrahedronList::Extent extent = self->Cells->GetExtent(arguments->primID);
    RTCBounds& box = *arguments->bounds_o;
    box.lower_x = extent.Lower[0];
    box.lower_y = extent.Lower[1];
    box.lower_z = extent.Lower[2];
    box.upper_x = extent.Upper[0];
    box.upper_y = extent.Upper[1];
    box.upper_z = extent.Upper[2];
  }

  /// Rays come one by one.
  static void Intersect(const RTCIntersectFunctionNArguments* arguments)
  {
    const auto* self = static_cast<const Internals*>(arguments->geometryUserPtr);
    auto* traced = reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    RTCRay& ray = traced->ray;
    const Triple origin = { static_cast<double>(ray.org_x), static_cast<double>(ray.org_y),
      static_cast<double>(ray.org_z) };
    const Triple direction = { static_cast<double>(ray.dir_x), static_cast<double>(ray.dir_y),
      static_cast<double>(ray.dir_z) };
    const auto t = static_cast<float>(
      self->Cells->Intersect(arguments->primID, origin, direction, self->Isovalue));
    if (arguments->valid[0] != 0 && t < ray.tfar)
    {
      ray.tfar = t;
      traced->hit.geomID = arguments->geomID;
      traced->hit.primID = arguments->primID;
    }
  }
};

//------------------------------------------------------------------------------
EmbreeCells::EmbreeCells(const TetrahedronList& cells, double isovalue, int threads)
  : Internal(std::make_unique<Internals>())
{
  Internals& self = *this->Internal;
  self.Cells = &cells;
  self.Isovalue = isovalue;
  self.Device = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
  if (!self.Device)
  {
    throw std::runtime_error("Embree has no device for this processor");
  }
  rtcSetDeviceMemoryMonitorFunction(self.Device, &Internals::Count, &self);
  self.Scene = rtcNewScene(self.Device);
  RTCGeometry geometry = rtcNewGeometry(self.Device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned int>(cells.GetSize()));
  rtcSetGeometryUserData(geometry, &self);
  rtcSetGeometryBoundsFunction(
    geometry, [](const RTCBoundsFunctionArguments* arguments) { Internals::FindBounds(arguments); },
    nullptr);
  rtcSetGeometryIntersectFunction(geometry, &Internals::Intersect);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(self.Scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(self.Scene);
  if (rtcGetDeviceError(self.Device) != RTC_ERROR_NONE)
  {
    throw std::runtime_error("Embree cannot build its hierarchy: too little memory?");
  }
}

//------------------------------------------------------------------------------
EmbreeCells::~EmbreeCells()
{
  rtcReleaseScene(this->Internal->Scene);
  rtcReleaseDevice(this->Internal->Device);
}

//------------------------------------------------------------------------------
double EmbreeCells::FindFirst(const Triple& origin, const Triple& direction) const
{
  RTCRayHit traced{};
  traced.ray.org_x = static_cast<float>(origin[0]);
  traced.ray.org_y = static_cast<float>(origin[1]);
  traced.ray.org_z = static_cast<float>(origin[2]);
  traced.ray.dir_x = static_cast<float>(direction[0]);
  traced.ray.dir_y = static_cast<float>(direction[1]);
  traced.ray.dir_z = static_cast<float>(direction[2]);
  traced.ray.tfar = std::numeric_limits<float>::infinity();
  traced.ray.mask = ~0U;
  traced.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  traced.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  rtcIntersect1(this->Internal->Scene, &traced, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(this->Internal->Scene, &context, &traced);
#endif
  return static_cast<double>(traced.ray.tfar);
}

//------------------------------------------------------------------------------
double EmbreeCells::GetMemory() const
{
  return static_cast<double>(this->Internal->Memory.load());
}

}
