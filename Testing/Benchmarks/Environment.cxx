// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Environment.h"

#ifdef BENCHMARK_HAS_EMBREE
#include "EmbreeTriangles.h"
#endif
#include "Baselines.h"
#include "Core/Math/Compiler.h"
#include "OffScreenWindow.h"
#include "Schedule.h"

#include <vtkSMPTools.h>
#include <vtkVersion.h>
#include <vtksys/SystemInformation.hxx>

#include <ctime>
#include <thread>

namespace Benchmark
{
namespace
{

/// The widest vectors of the processor, which decide about times; empty if nothing is known.
std::string GetInstructionSet()
{
#if defined(__x86_64__)
  return vtkIsosurfaceRayTracing::HasAvx512() ? ", AVX-512"
    : vtkIsosurfaceRayTracing::HasAvx2()      ? ", AVX2"
                                              : ", SSE2";
#else
  return "";
#endif
}

}

//------------------------------------------------------------------------------
Json::Value DescribeEnvironment(const std::vector<std::string>& command, OffScreenWindow* window)
{
  Json::Value environment;
  vtksys::SystemInformation system;
  system.RunCPUCheck();
  const std::time_t now = std::time(nullptr);
  char date[32];
  std::strftime(date, sizeof(date), "%Y-%m-%d", std::gmtime(&now));
  std::string line;
  for (const std::string& word : command)
  {
    line += (line.empty() ? "" : " ") + word;
  }
  environment["date"] = date;
  environment["command"] = line;
  environment["machine"] = std::string(system.GetModelName()) + ", " +
    std::to_string(std::thread::hardware_concurrency()) + " logical processors" +
    GetInstructionSet();
  environment["load of the machine before"] =
    ToText(system.GetLoadAverage()) + " (read ratios where it is not near 0)";
  environment["compiler"] = __VERSION__;
  environment["VTK"] = std::string(vtkVersion::GetVTKVersion()) +
    ", threads of its filters: " + vtkSMPTools::GetBackend();
#ifdef BENCHMARK_HAS_EMBREE
  environment["Embree"] = EmbreeTriangles::GetVersion();
#endif
  environment["OpenGL"] = window
    ? std::string(window->GetDriver())
    : "none: there is no display (xvfb-run -a gives one); pictures are rays of CastRays, whole "
      "frames are not measured";
  return environment;
}

//------------------------------------------------------------------------------
double GetResidentMebibytes()
{
  vtksys::SystemInformation system;
  return static_cast<double>(system.GetProcMemoryUsed()) / 1024.0;
}

//------------------------------------------------------------------------------
std::vector<std::string> SelectAvailable(
  const std::vector<std::string>& baselines, Json::Value& environment)
{
  std::vector<std::string> available;
  for (const std::string& name : baselines)
  {
    const std::string absence = GetAbsence(name);
    if (absence.empty())
    {
      available.push_back(name);
      continue;
    }
    environment["absent"].append(name + ", because " + absence);
    Log(name + " is absent, because " + absence);
  }
  return available;
}

}
