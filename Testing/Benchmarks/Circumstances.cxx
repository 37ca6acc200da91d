// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Circumstances.h"

#ifdef BENCHMARK_HAS_EMBREE
#include "EmbreeTriangles.h"
#endif
#include "OffScreenWindow.h"
#include "Setup.h"

#include <vtkSMPTools.h>
#include <vtkVersion.h>
#include <vtksys/SystemInformation.hxx>

#include <ctime>
#include <thread>

namespace Benchmark
{

//------------------------------------------------------------------------------
std::vector<std::pair<std::string, std::string>> DescribeMachine(
  const std::vector<std::string>& command, OffScreenWindow* window)
{
  std::vector<std::pair<std::string, std::string>> circumstances;
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
  circumstances.emplace_back("date", date);
  circumstances.emplace_back("command", "`" + line + "`");
  circumstances.emplace_back("machine",
    std::string(system.GetModelName()) + ", " +
      std::to_string(std::thread::hardware_concurrency()) + " logical processors");
  circumstances.emplace_back("load of the machine before",
    ToText(system.GetLoadAverage()) + " (read ratios where it is not near 0)");
  circumstances.emplace_back("compiler", __VERSION__);
  circumstances.emplace_back("VTK",
    std::string(vtkVersion::GetVTKVersion()) +
      ", threads of its filters: " + vtkSMPTools::GetBackend());
#ifdef BENCHMARK_HAS_EMBREE
  circumstances.emplace_back("Embree", EmbreeTriangles::GetVersion());
#endif
  circumstances.emplace_back("OpenGL",
    window
      ? window->GetDriver()
      : "none: there is no display (xvfb-run -a gives one); pictures are rays of CastRays, whole "
        "frames are not measured");
  return circumstances;
}

}
