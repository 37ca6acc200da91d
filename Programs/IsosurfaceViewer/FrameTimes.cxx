// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "FrameTimes.h"

#include "vtkIsosurfaceRayTraceMapper.h"

#include <vtkCommand.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <algorithm>
#include <cstddef>
#include <iomanip>
#include <sstream>

namespace Viewer
{
namespace
{

/// The value below which this part of the values is.
double FindQuantile(std::vector<double> values, double part)
{
  const auto place =
    values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}

//------------------------------------------------------------------------------
FrameTimes::FrameTimes(vtkRenderWindow* window, vtkIsosurfaceRayTraceMapper* mapper)
  : Window(window)
  , Mapper(mapper)
{
  window->AddObserver(vtkCommand::StartEvent, this, &FrameTimes::Start);
  window->AddObserver(vtkCommand::EndEvent, this, &FrameTimes::End);
}

//------------------------------------------------------------------------------
void FrameTimes::Start()
{
  this->Begin = std::chrono::steady_clock::now();
}

//------------------------------------------------------------------------------
void FrameTimes::End()
{
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const double time = Milliseconds(std::chrono::steady_clock::now() - this->Begin).count();
  vtkRenderWindowInteractor* interactor = this->Window->GetInteractor();
  if (this->Window->GetDesiredUpdateRate() > interactor->GetStillUpdateRate())
  {
    this->Moving.push_back({ time, static_cast<double>(this->Mapper->GetImageSampleDistance()) });
  }
  else if (this->Mapper->GetTraceTime() > 0.0)
  {
    this->MillisecondsAtRest = time;
  }
}

//------------------------------------------------------------------------------
std::string FrameTimes::Describe() const
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(0) << this->MillisecondsAtRest << " ms a frame at rest";
  if (!this->Moving.empty())
  {
    text << ", " << this->Moving.back().Milliseconds << " ms moving";
    if (this->Moving.back().Distance > 1.0)
    {
      text << " (a ray for " << this->Moving.back().Distance << " x "
           << this->Moving.back().Distance << " pixels)";
    }
  }
  return text.str();
}

//------------------------------------------------------------------------------
std::string FrameTimes::Summarize() const
{
  if (this->Moving.empty())
  {
    return {};
  }
  std::vector<double> times;
  std::vector<double> distances;
  for (const Frame& frame : this->Moving)
  {
    times.push_back(frame.Milliseconds);
    distances.push_back(frame.Distance);
  }
  const double median = FindQuantile(times, 0.5);
  std::ostringstream text;
  text << times.size() << " frames while moving: median " << std::fixed << std::setprecision(1)
       << median << " ms (" << 1000.0 / median << " frames a second), 95 % within "
       << FindQuantile(times, 0.95) << " ms, with a ray for every " << std::setprecision(0)
       << FindQuantile(distances, 0.5) << " pixels in both directions\n";
  return text.str();
}

}
