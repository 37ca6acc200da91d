// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Comparison.h"

#include "Baselines.h"
#include "Environment.h"
#include "TracedIsosurface.h"

#ifdef __unix__
#include <sys/resource.h>
#endif

#include <cmath>
#include <memory>

namespace Benchmark
{
namespace
{

constexpr double Mebi = 1024.0 * 1024.0;

double GetPeakMebibytes()
{
#ifdef __unix__
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
#else
  return NotMeasured;
#endif
}

/// The pictures of a renderer with a number of threads: of every round and view, in order.
struct Run
{
  IsosurfaceRenderer* Renderer;
  int Threads;
  std::vector<FrameTimes> Frames;
  double Seconds = 0.0;
};

/// What a new isovalue costs a baseline.
struct NewIsovalueTimes
{
  Samples Seconds;
  /// To the time of this mapper.
  Samples Ratio;
};

class Comparison
{
public:
  Comparison(const Setup& setup, double isovalue, Report& report);
  void MeasureMemory();
  void MeasureNewIsovalue();
  void MeasurePictures();

private:
  std::string GetTitle(const std::string& what) const
  {
    return "Isovalue " + ToText(this->Isovalue) + ": " + what;
  }
  std::string GetTableName(const std::string& what) const
  {
    return what + " " + ToText(this->Isovalue);
  }
  void ReportNewIsovalue(const Samples& ours, const std::vector<NewIsovalueTimes>& baselines);
  void DrawRound(std::vector<Run>& runs, bool isFirst) const;
  void ReportPictures(const std::vector<Run>& runs);
  void ReportPictureGoals(const std::vector<Run>& runs);

  const Setup& Settings;
  double Isovalue;
  Report& Out;
  std::vector<View> Orbit;
  TracedIsosurface Ours;
  std::vector<std::unique_ptr<IsosurfaceRenderer>> Baselines;
};

//------------------------------------------------------------------------------
Comparison::Comparison(const Setup& setup, double isovalue, Report& report)
  : Settings(setup)
  , Isovalue(isovalue)
  , Out(report)
  , Orbit(setup.GetOrbit())
  , Ours(setup.Image, setup.Size, setup.GetMostThreads())
{
  for (const std::string& name : setup.Baselines)
  {
    this->Baselines.push_back(NewBaseline(name, setup.Image, setup.Size, setup.GetMostThreads()));
  }
}

//------------------------------------------------------------------------------
// This mapper alone, before the baselines need memory.
void Comparison::MeasureMemory()
{
  Log(this->GetTitle("memory"));
  const double before = GetResidentMebibytes();
  this->Ours.Reset();
  this->Ours.SetIsovalue(this->Isovalue);
  for (const View& view : this->Orbit)
  {
    this->Ours.Draw(view, this->Settings.GetMostThreads());
  }
  vtkIsosurfaceRayTraceMapper* mapper = this->Ours.GetMapper();
  const double data = this->Settings.GetDataBytes();
  const auto macrocells = static_cast<double>(mapper->GetMacrocellMemory());
  const auto bricks = static_cast<double>(mapper->GetBrickMemory());
  const auto exist = static_cast<double>(mapper->GetNumberOfBricks());
  const auto all = static_cast<double>(mapper->GetMaximumNumberOfBricks());
  this->Out.Tables.push_back({ this->GetTableName("memory"), this->GetTitle("memory"),
    "After the pictures of the orbit. Peak: of the whole program so far, including the volume and "
    "reading it.",
    { "what", "MiB", "% of the data" },
    { { "data", data / Mebi, 100.0 },
      { "macrocells", macrocells / Mebi, 100.0 * macrocells / data },
      { ToText(exist) + " of " + ToText(all) + " bricks", bricks / Mebi, 100.0 * bricks / data },
      { "growth of the program", GetResidentMebibytes() - before,
        100.0 * Mebi * (GetResidentMebibytes() - before) / data },
      { "peak of the program", GetPeakMebibytes(), 100.0 * Mebi * GetPeakMebibytes() / data } } });
  this->Out.Goals.push_back(
    { 4, this->GetTitle("macrocells, % of the data"), 100.0 * macrocells / data, true, 0.5 });
}

//------------------------------------------------------------------------------
void Comparison::MeasureNewIsovalue()
{
  Samples ours;
  std::vector<NewIsovalueTimes> baselines(this->Baselines.size());
  for (int repeat = 0; repeat < this->Settings.Repeats; ++repeat)
  {
    this->Settings.LogTurn(this->GetTitle("a new isovalue"), repeat);
    const double our = this->Ours.ChangeIsovalue(this->Isovalue, this->Orbit.front());
    ours.Add(our);
    for (std::size_t i = 0; i < baselines.size(); ++i)
    {
      if (!IsEnough(baselines[i].Seconds, this->Settings.Repeats))
      {
        Log("  " + this->Baselines[i]->GetName());
        const double their =
          this->Baselines[i]->ChangeIsovalue(this->Isovalue, this->Orbit.front());
        baselines[i].Seconds.Add(their);
        baselines[i].Ratio.Add(their / our);
      }
    }
  }
  this->ReportNewIsovalue(ours, baselines);
}

//------------------------------------------------------------------------------
std::string Describe(const IsosurfaceRenderer& renderer)
{
  std::string text;
  for (const auto& [name, value] : renderer.GetDetails())
  {
    text += (text.empty() ? "" : ", ") + name + ": " + ToText(value);
  }
  return text;
}

//------------------------------------------------------------------------------
void Comparison::ReportNewIsovalue(
  const Samples& ours, const std::vector<NewIsovalueTimes>& baselines)
{
  Table table{ this->GetTableName("new isovalue"),
    this->GetTitle("from a new isovalue to a picture"),
    "Time from a new isovalue to the first complete frame (flying-edges and marching-cubes: to "
    "the triangles). This mapper has drawn another isovalue before; triangles have no normals.",
    { "method", "s", "times this mapper's", "details" }, {} };
  table.Rows.push_back({ this->Ours.GetName(), ours, 1.0, "" });
  for (std::size_t i = 0; i < baselines.size(); ++i)
  {
    const std::string name = this->Baselines[i]->GetName();
    table.Rows.push_back(
      { name, baselines[i].Seconds, baselines[i].Ratio, Describe(*this->Baselines[i]) });
    if (name == "polygons")
    {
      this->Out.Goals.push_back({ 2,
        this->GetTitle("a new isovalue, flying edges and drawing polygons against this mapper"),
        baselines[i].Ratio.GetMedian(), false, this->Settings.IsLarge() ? 100.0 : 20.0 });
    }
  }
  this->Out.Tables.push_back(table);
}

//------------------------------------------------------------------------------
void Comparison::DrawRound(std::vector<Run>& runs, bool isFirst) const
{
  constexpr double patience = 30.0;
  for (const View& view : this->Orbit)
  {
    for (Run& run : runs)
    {
      // Slow renderers have one round.
      if (isFirst || run.Seconds < patience)
      {
        StartThreads(run.Threads);
        const FrameTimes times = run.Renderer->Draw(view, run.Threads);
        run.Frames.push_back(times);
        run.Seconds += times.GetSeconds();
      }
    }
  }
}

//------------------------------------------------------------------------------
void Comparison::MeasurePictures()
{
  std::vector<Run> runs;
  for (const int threads : this->Settings.Threads)
  {
    runs.push_back({ &this->Ours, threads, {} });
    for (const auto& baseline : this->Baselines)
    {
      if (baseline->HasPictures() &&
        (baseline->HasThreads() || threads == this->Settings.GetMostThreads()))
      {
        runs.push_back({ baseline.get(), threads, {} });
      }
    }
  }
  for (const View& view : this->Orbit)
  {
    this->Ours.Draw(view, this->Settings.GetMostThreads()); // Makes the bricks.
  }
  for (int repeat = 0; repeat < this->Settings.Repeats; ++repeat)
  {
    this->Settings.LogTurn(this->GetTitle("pictures"), repeat);
    this->DrawRound(runs, repeat == 0);
  }
  this->ReportPictures(runs);
  this->ReportPictureGoals(runs);
}

//------------------------------------------------------------------------------
// The ratios of measurements that followed each other: theirs to ours.
Samples GetRatios(const Run& theirs, const Run& ours)
{
  Samples ratios;
  for (std::size_t i = 0; i < std::min(theirs.Frames.size(), ours.Frames.size()); ++i)
  {
    ratios.Add(
      theirs.Frames[i].GetCommon(ours.Frames[i]) / ours.Frames[i].GetCommon(theirs.Frames[i]));
  }
  return ratios;
}

const Run& FindOurs(const std::vector<Run>& runs, const IsosurfaceRenderer& ours, int threads)
{
  return *std::find_if(runs.begin(), runs.end(),
    [&ours, threads](const Run& run) { return run.Renderer == &ours && run.Threads == threads; });
}

//------------------------------------------------------------------------------
void Comparison::ReportPictures(const std::vector<Run>& runs)
{
  Table table{ this->GetTableName("pictures"),
    this->GetTitle("pictures from " + std::to_string(this->Settings.Views) + " sides, " +
      this->Settings.GetPictureSize()),
    "Trace: generating the rays and finding their first hits. Frame: everything up to the finished "
    "picture in the window. Ratios are those of the traces if both methods have one. There is one "
    "ray per pixel. In brackets: over all views and repeats. Pixels hit: in the last picture.",
    { "method", "threads", "trace, ms", "trace, ns per ray", "frame, ms", "times this mapper's",
      "pixels hit, %" },
    {} };
  for (const Run& run : runs)
  {
    Samples trace;
    Samples whole;
    for (const FrameTimes& times : run.Frames)
    {
      if (!std::isnan(times.Trace))
      {
        trace.Add(1e3 * times.Trace);
      }
      if (!std::isnan(times.Whole))
      {
        whole.Add(1e3 * times.Whole);
      }
    }
    const double nanoseconds = 1e6 / this->Settings.Size / this->Settings.Size;
    // The share of the last picture, which is the same for all.
    const double share = 100.0 * run.Renderer->GetHitShare();
    table.Rows.push_back({ run.Renderer->GetName(), static_cast<double>(run.Threads), trace,
      trace.IsEmpty() ? NotMeasured : trace.GetMedian() * nanoseconds, whole,
      GetRatios(run, FindOurs(runs, this->Ours, run.Threads)), share });
  }
  this->Out.Tables.push_back(table);
}

//------------------------------------------------------------------------------
void Comparison::ReportPictureGoals(const std::vector<Run>& runs)
{
  for (const Run& run : runs)
  {
    const std::string onThreads = " on " + std::to_string(run.Threads) + " threads";
    const Run& ours = FindOurs(runs, this->Ours, run.Threads);
    if (run.Renderer->GetName() == "embree")
    {
      this->Out.Goals.push_back(
        { 1, this->GetTitle("trace, this mapper against Embree" + onThreads),
          GetRatios(ours, run).GetMedian(), true, this->Settings.IsLarge() ? 0.5 : 0.7 });
    }
    if (&run == &ours && run.Threads > 1 && this->Settings.Threads.front() == 1)
    {
      this->Out.Goals.push_back({ 6, this->GetTitle("speed-up of the trace" + onThreads),
        GetRatios(FindOurs(runs, this->Ours, 1), ours).GetMedian(), false, 0.975 * run.Threads });
    }
  }
}

}

//------------------------------------------------------------------------------
void CompareWithBaselines(const Setup& setup, double isovalue, Report& report)
{
  Comparison comparison(setup, isovalue, report);
  comparison.MeasureMemory();
  comparison.MeasureNewIsovalue();
  comparison.MeasurePictures();
}

}
