// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Growth.h"

#include "AnalyticFieldSource.h"
#include "Baselines.h"
#include "TracedIsosurface.h"

#include <vtkNew.h>

#include <cmath>

namespace Benchmark
{
namespace
{

/// time = Factor n^Exponent, by least squares of the logarithms.
struct PowerLaw
{
  double Exponent;
  double Factor;
};

PowerLaw Fit(const std::vector<double>& n, const std::vector<double>& times)
{
  const auto count = static_cast<double>(n.size());
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < n.size(); ++i)
  {
    const double u = std::log(n[i]);
    const double v = std::log(times[i]);
    x += u / count;
    y += v / count;
    xx += u * u / count;
    xy += u * v / count;
  }
  const double exponent = (xy - x * y) / (xx - x * x);
  return { exponent, std::exp(y - exponent * x) };
}

/// The n from which on the second takes longer than the first; NaN if it does not grow faster.
double Cross(const PowerLaw& first, const PowerLaw& second)
{
  return first.Exponent >= second.Exponent
    ? NotMeasured
    : std::pow(second.Factor / first.Factor, 1.0 / (first.Exponent - second.Exponent));
}

struct Times
{
  Samples Trace;
  Samples Cold;
  Samples Extraction;
};

Times MeasureAt(const Setup& setup, int n)
{
  Log("Growth: making " + std::to_string(n) + "^3 samples");
  vtkNew<AnalyticFieldSource> source;
  source->SetField("gyroid");
  source->SetDimensions({ n, n, n });
  source->Update();
  vtkImageData* image = source->GetOutput();
  Bounds bounds;
  image->GetBounds(bounds.data());
  const std::vector<View> views = MakeOrbit(bounds, setup.Views);
  TracedIsosurface ours(image, setup.Size, setup.GetMostThreads());
  const auto theirs = NewBaseline("flying-edges", image, setup.Size, setup.GetMostThreads());
  Times times;
  ours.SetIsovalue(0.0);
  ours.Draw(views.front(), setup.GetMostThreads()); // The window and its shaders.
  for (int repeat = 0; repeat < setup.Repeats; ++repeat)
  {
    setup.LogTurn("Growth: n = " + std::to_string(n), repeat);
    ours.Reset();
    ours.SetIsovalue(0.0);
    times.Cold.Add(1e3 * ours.Draw(views.front(), setup.GetMostThreads()).GetSeconds());
    for (const View& view : views)
    {
      ours.Draw(view, setup.GetMostThreads()); // Makes the bricks.
      times.Trace.Add(1e3 * ours.Draw(view, setup.GetMostThreads()).Trace);
    }
    times.Extraction.Add(1e3 * theirs->ChangeIsovalue(0.0, views.front()));
  }
  return times;
}

}

//------------------------------------------------------------------------------
void MeasureGrowth(const Setup& setup, int largest, Report& report)
{
  Table table{ "growth", "Growth: a gyroid of n^3 samples, " + setup.GetPictureSize(),
    "On " + std::to_string(setup.GetMostThreads()) +
      " threads. Cold start: nothing was built before.",
    { "n", "trace, ms", "cold start to first picture, ms", "flying edges, ms" }, {} };
  std::vector<double> n;
  std::vector<double> trace;
  std::vector<double> cold;
  std::vector<double> extraction;
  for (int edge = 64; edge <= largest; edge *= 2)
  {
    const Times times = MeasureAt(setup, edge);
    table.Rows.push_back({ static_cast<double>(edge), times.Trace, times.Cold, times.Extraction });
    n.push_back(edge);
    trace.push_back(times.Trace.GetMedian());
    cold.push_back(times.Cold.GetMedian());
    extraction.push_back(times.Extraction.GetMedian());
  }
  const PowerLaw tracing = Fit(n, trace);
  const PowerLaw starting = Fit(n, cold);
  const PowerLaw extracting = Fit(n, extraction);
  report.Tables.push_back(table);
  report.Tables.push_back({ "growth fits", "Growth: powers of n",
    "The exponent of the power that fits best, and the n from which on, by these powers, "
    "extraction alone takes longer.",
    { "what", "exponent", "crossing" },
    { { "trace", tracing.Exponent, Cross(tracing, extracting) },
      { "cold start", starting.Exponent, Cross(starting, extracting) },
      { "flying edges", extracting.Exponent, Cell() } } });
  report.Goals.push_back(
    { 7, "growth of the trace: its power of n (the papers: 1 at worst, 1/3 typically)",
      tracing.Exponent, true, 1.0 });
}

}
