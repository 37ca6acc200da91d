// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PaperTables.h"

#include "TracedIsosurface.h"

#include <vtkDataArray.h>
#include <vtkIsosurfaceComparisonFilter.h>
#include <vtkNew.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace Benchmark
{
namespace
{

using Mapper = vtkIsosurfaceRayTraceMapper;

/// A way to set a mapper up, and its name as cells of a table.
struct Variant
{
  std::vector<Cell> Name;
  std::function<void(Mapper&)> Apply;
};

void UseLevels(Mapper& mapper, const std::vector<int>& branching)
{
  mapper.SetNumberOfMacrocellLevels(static_cast<int>(branching.size()));
  for (std::size_t level = 0; level < branching.size(); ++level)
  {
    mapper.SetMacrocellBranching(static_cast<int>(level), branching[level]);
  }
}

void UseTwoLevelBricks(Mapper& mapper, int n, int m)
{
  mapper.SetBrickLayoutToTwoLevelBricks();
  mapper.SetBrickSize(n);
  mapper.SetBrickGroupSize(m);
}

//------------------------------------------------------------------------------
// Where the time of frames goes, and how many there are in a second: a row of table I.
std::vector<Cell> MeasureShares(const Setup& setup, double isovalue, const std::vector<View>& views)
{
  TracedIsosurface surface(setup.Image, setup.Size, setup.GetMostThreads());
  surface.SetIsovalue(isovalue);
  Samples rates;
  double whole = 0.0;
  double trace = 0.0;
  double shade = 0.0;
  for (const View& view : views)
  {
    surface.Draw(view, setup.GetMostThreads()); // Makes the bricks.
    Samples seconds;
    for (int repeat = 0; repeat < setup.Repeats; ++repeat)
    {
      const FrameTimes times = surface.Draw(view, setup.GetMostThreads());
      seconds.Add(times.GetSeconds());
      whole += times.GetSeconds();
      trace += times.Trace;
      // Without a window nothing is shaded, and the time is that of another frame.
      shade += std::isnan(times.Whole) ? 0.0 : surface.GetMapper()->GetShadeTime();
    }
    rates.Add(1.0 / seconds.GetMedian());
  }
  const double rest = std::max(0.0, whole - trace - shade);
  return { isovalue, 100.0 * trace / whole, 100.0 * shade / whole, 100.0 * rest / whole, rates };
}

void MakeTable1(const Setup& setup, Report& report)
{
  Table table{ "parker 1998 table I", "Parker et al. 1998, table I: where the time goes",
    "Frames per second: the slowest and the fastest of the pictures of the orbit and of table "
    "III, " +
      setup.GetPictureSize() + ", on " + std::to_string(setup.GetMostThreads()) +
      " threads. The mapper does not measure traversal and intersection separately. The paper's "
      "abstract has 10 frames per second for the Visible Woman.",
    { "isovalue", "traversal and intersection, %", "shading, %", "display and VTK, %",
      "frames per second" },
    {} };
  std::vector<View> views = setup.GetOrbit();
  const std::vector<View> paper = MakePaperViews(setup.GetBounds());
  views.insert(views.end(), paper.begin(), paper.end());
  for (const double isovalue : setup.Isovalues)
  {
    Log("Parker 1998, table I: isovalue " + ToText(isovalue));
    table.Rows.push_back(MeasureShares(setup, isovalue, views));
  }
  report.Tables.push_back(table);
}

//------------------------------------------------------------------------------
// Frames per second by threads, for two views.
void MakeTable2(const Setup& setup, Report& report)
{
  const std::vector<View> all = MakePaperViews(setup.GetBounds());
  const double isovalue = setup.Isovalues.back();
  Table table{ "parker 1998 table II", "Parker et al. 1998, table II: speed-up by threads",
    "Isovalue " + ToText(isovalue) + ", whole frames, " + setup.GetPictureSize() +
      ". On 128 processors the paper has 91 % and 80 % of 128 times the speed of one.",
    { "threads", "view", "frames per second", "speed-up" }, {} };
  TracedIsosurface surface(setup.Image, setup.Size, setup.GetMostThreads());
  surface.SetIsovalue(isovalue);
  for (const View& view : { all.front(), all.back() })
  {
    surface.Draw(view, setup.GetMostThreads());
    std::vector<Samples> rates(setup.Threads.size());
    for (int repeat = 0; repeat < setup.Repeats; ++repeat)
    {
      setup.LogTurn("Parker 1998, table II: " + view.Name, repeat);
      for (std::size_t i = 0; i < rates.size(); ++i)
      {
        rates[i].Add(1.0 / surface.Draw(view, setup.Threads[i]).GetSeconds());
      }
    }
    for (std::size_t i = 0; i < rates.size(); ++i)
    {
      table.Rows.push_back({ static_cast<double>(setup.Threads[i]), view.Name, rates[i],
        rates[i].GetMedian() / rates.front().GetMedian() });
    }
  }
  report.Tables.push_back(table);
}

//------------------------------------------------------------------------------
// What bricks and the hierarchy gain.
std::vector<Variant> GetVariantsOfTable3()
{
  return {
    { { "initial" },
      [](Mapper& mapper)
      {
        mapper.SetBrickLayoutToNoBricks();
        mapper.SetNumberOfMacrocellLevels(0);
      } },
    { { "bricking" },
      [](Mapper& mapper)
      {
        UseTwoLevelBricks(mapper, 4, 4);
        mapper.SetNumberOfMacrocellLevels(0);
      } },
    { { "hierarchy and bricking" }, [](Mapper& mapper) { UseTwoLevelBricks(mapper, 4, 4); } },
    { { "this mapper's defaults" }, [](Mapper&) {} },
  };
}

Samples MeasureTrace(const Setup& setup, TracedIsosurface& surface, const View& view)
{
  surface.Draw(view, setup.GetMostThreads()); // Makes the bricks.
  Samples seconds;
  while (!IsEnough(seconds, setup.Repeats))
  {
    seconds.Add(surface.Draw(view, setup.GetMostThreads()).Trace);
  }
  return seconds * 1e3;
}

void MakeTable3(const Setup& setup, Report& report)
{
  Table table{ "parker 1998 table III", "Parker et al. 1998, table III: trace times, ms",
    "Initial: the array as it is and no macrocells. Bricking: the paper's two levels, n = 4, m = "
    "4. Hierarchy: the macrocells of the defaults. On " +
      std::to_string(setup.GetMostThreads()) + " threads, " + setup.GetPictureSize() + ".",
    { "isovalue", "view", "initial", "bricking", "hierarchy and bricking", "defaults" }, {} };
  for (const double isovalue : setup.Isovalues)
  {
    const std::vector<View> views = MakePaperViews(setup.GetBounds());
    std::vector<std::vector<Cell>> rows;
    for (const View& view : views)
    {
      rows.push_back({ isovalue, view.Name });
    }
    TracedIsosurface surface(setup.Image, setup.Size, setup.GetMostThreads());
    for (const Variant& variant : GetVariantsOfTable3())
    {
      Log("Parker 1998, table III: isovalue " + ToText(isovalue) + ", " +
        variant.Name.front().Value.asString());
      surface.Reset();
      surface.SetIsovalue(isovalue);
      variant.Apply(*surface.GetMapper());
      for (std::size_t i = 0; i < views.size(); ++i)
      {
        rows[i].emplace_back(MeasureTrace(setup, surface, views[i]));
      }
    }
    table.Rows.insert(table.Rows.end(), rows.begin(), rows.end());
  }
  report.Tables.push_back(table);
}

//------------------------------------------------------------------------------
// Each variant beside the defaults, from two sides, in turn.
void CompareVariants(const Setup& setup, const std::vector<Variant>& variants, Table& table)
{
  const std::vector<View> views = MakeOrbit(setup.GetBounds(), 2);
  const double isovalue = setup.Isovalues.back();
  TracedIsosurface usual(setup.Image, setup.Size, setup.GetMostThreads());
  TracedIsosurface other(setup.Image, setup.Size, setup.GetMostThreads());
  usual.SetIsovalue(isovalue);
  for (const Variant& variant : variants)
  {
    Log(table.Name + ", variant " + std::to_string(table.Rows.size() + 1) + " of " +
      std::to_string(variants.size()));
    other.Reset();
    other.SetIsovalue(isovalue);
    variant.Apply(*other.GetMapper());
    const double cold = other.Draw(views.front(), setup.GetMostThreads()).GetSeconds();
    other.Draw(views.back(), setup.GetMostThreads());
    Samples trace;
    Samples ratio;
    for (int repeat = 0; repeat < setup.Repeats; ++repeat)
    {
      for (const View& view : views)
      {
        const double ours = usual.Draw(view, setup.GetMostThreads()).Trace;
        const double theirs = other.Draw(view, setup.GetMostThreads()).Trace;
        trace.Add(1e3 * theirs);
        ratio.Add(theirs / ours);
      }
    }
    const double data = setup.GetDataBytes();
    std::vector<Cell> row = variant.Name;
    row.insert(row.end(),
      { 100.0 * static_cast<double>(other.GetMapper()->GetMacrocellMemory()) / data,
        100.0 * static_cast<double>(other.GetMapper()->GetBrickMemory()) / data, 1e3 * cold, trace,
        ratio.GetMedian() });
    table.Rows.push_back(row);
  }
}

std::string DescribeVariants(const Setup& setup)
{
  return "Isovalue " + ToText(setup.Isovalues.back()) + ", " + setup.GetPictureSize() +
    " from two sides, on " + std::to_string(setup.GetMostThreads()) +
    " threads. Cold: time of the first picture, with nothing built before.";
}

//------------------------------------------------------------------------------
void MakeHierarchyTable(const Setup& setup, Report& report)
{
  std::vector<Variant> variants;
  const std::vector<std::vector<int>> hierarchies = { {}, { 4 }, { 8 }, { 16 }, { 4, 4 }, { 4, 8 },
    { 8, 4 }, { 8, 8 }, { 4, 4, 4 }, { 8, 4, 4 }, { 2, 2, 2, 2, 2, 2 } };
  for (const std::vector<int>& branching : hierarchies)
  {
    std::string text;
    for (const int edge : branching)
    {
      text += (text.empty() ? "" : " x ") + std::to_string(edge);
    }
    variants.push_back({ { static_cast<double>(branching.size()), text },
      [branching](Mapper& mapper) { UseLevels(mapper, branching); } });
  }
  Table table{ "other hierarchies", "Other hierarchies of macrocells", DescribeVariants(setup),
    { "levels", "branching, finest first", "macrocells, % of the data", "bricks, % of the data",
      "cold, ms", "trace, ms", "times the defaults'" },
    {} };
  CompareVariants(setup, variants, table);
  report.Tables.push_back(table);
}

//------------------------------------------------------------------------------
void MakeBrickTable(const Setup& setup, Report& report)
{
  std::vector<Variant> variants = { { { "none", Cell(), Cell() },
    [](Mapper& mapper) { mapper.SetBrickLayoutToNoBricks(); } } };
  for (const double n : { 4.0, 8.0, 16.0 })
  {
    variants.push_back({ { "apron", n, Cell() },
      [n](Mapper& mapper)
      {
        mapper.SetBrickLayoutToApronBricks();
        mapper.SetBrickSize(static_cast<int>(n));
      } });
  }
  for (const double n : { 4.0, 8.0 })
  {
    for (const double m : { 1.0, 4.0, 8.0 })
    {
      variants.push_back({ { "two levels", n, m }, [n, m](Mapper& mapper) {
                            UseTwoLevelBricks(mapper, static_cast<int>(n), static_cast<int>(m));
                          } });
    }
  }
  Table table{ "other bricks", "Other bricks", DescribeVariants(setup),
    { "layout", "n", "m", "macrocells, % of the data", "bricks, % of the data", "cold, ms",
      "trace, ms", "times the defaults'" },
    {} };
  CompareVariants(setup, variants, table);
  report.Tables.push_back(table);
}

//------------------------------------------------------------------------------
// Those filters of the comparison that are baselines too, and nothing else.
void SelectExtraction(const Setup& setup, vtkIsosurfaceComparisonFilter& filter)
{
  const auto isRequested = [&setup](const char* baseline)
  { return std::count(setup.Baselines.begin(), setup.Baselines.end(), baseline) != 0; };
  filter.SetFlyingEdges(isRequested("flying-edges"));
  filter.SetMarchingCubes(isRequested("marching-cubes"));
  filter.SetSpanSpace(isRequested("marching-cubes"));
  filter.SynchronizedTemplatesOff();
  filter.ContourFilterOff();
  filter.RayTracingOff();
  filter.PicturesOff();
  filter.AccuracyOff();
}

void MakeExtractionTable(const Setup& setup, Report& report)
{
  vtkNew<vtkIsosurfaceComparisonFilter> filter;
  filter->SetInputData(setup.Image);
  filter->SetNumberOfRepeats(setup.IsLarge() ? 1 : setup.Repeats);
  SelectExtraction(setup, *filter);
  if (!filter->GetFlyingEdges() && !filter->GetMarchingCubes())
  {
    return;
  }
  for (std::size_t i = 0; i < setup.Isovalues.size(); ++i)
  {
    filter->SetValue(static_cast<int>(i), setup.Isovalues[i]);
  }
  Log("Parker 1998, table IV: extraction");
  filter->Update();
  Table table{ "extraction",
    "Parker et al. 1998, table IV; Ma and Parker 2001, table 1: extraction of triangles",
    "The cost of extracting triangles, which this mapper does not need; median of " +
      std::to_string(filter->GetNumberOfRepeats()) +
      ". The build is that of a span space (Livnat, Shen, Johnson 1996), as in the paper of 2001.",
    { "isovalue", "filter", "triangles", "build, s", "s", "MiB" }, {} };
  vtkTable* rows = filter->GetOutput();
  for (vtkIdType row = 0; row < rows->GetNumberOfRows(); ++row)
  {
    const auto get = [rows, row](const char* column) { return rows->GetValueByName(row, column); };
    table.Rows.push_back({ get("Isovalue").ToDouble(), get("Method").ToString(),
      get("Triangles").ToDouble(), get("BuildTime").ToDouble(), get("ExtractionTime").ToDouble(),
      get("Bytes").ToDouble() / 1024.0 / 1024.0 });
  }
  report.Tables.push_back(table);
}

}

//------------------------------------------------------------------------------
void MakePaperTables(const Setup& setup, Report& report)
{
  MakeTable1(setup, report);
  MakeTable2(setup, report);
  MakeTable3(setup, report);
  MakeHierarchyTable(setup, report);
  MakeBrickTable(setup, report);
  MakeExtractionTable(setup, report);
}

}
