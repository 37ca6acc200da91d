// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "BenchmarkReport.h"

#include "Contestant.h"
#include "OffScreenWindow.h"

#include <vtkActor2D.h>
#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkColorTransferFunction.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDelimitedTextWriter.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkImageMapper.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkVariant.h>
#include <vtkWindowToImageFilter.h>
#include <vtk_jsoncpp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iomanip>
#include <set>
#include <sstream>

namespace Benchmark
{
namespace
{

/// What is too small for a double, and for a logarithmic axis.
constexpr double SmallestError = 1e-17;

/// Nothing for NaN.
std::string Format(double value, int digits)
{
  std::ostringstream text;
  text << std::setprecision(digits);
  if (!std::isnan(value))
  {
    text << value;
  }
  return text.str();
}

std::string Format(const Samples& samples)
{
  return samples.IsEmpty() ? std::string()
                           : Format(samples.GetMedian(), 3) + " (" +
      Format(samples.GetMinimum(), 3) + "-" + Format(samples.GetMaximum(), 3) + ")";
}

double GetMedian(const Samples& samples)
{
  return samples.IsEmpty() ? NotMeasured : samples.GetMedian();
}

std::string GetName(const Result& result)
{
  return result.Family + (result.Knob.empty() ? "" : ", " + result.Knob);
}

std::vector<std::string> GetInputs(const Results& results)
{
  std::vector<std::string> inputs;
  for (const Result& result : results.Rays)
  {
    if (inputs.empty() || inputs.back() != result.Input)
    {
      inputs.push_back(result.Input);
    }
  }
  return inputs;
}

std::vector<Result> Select(const std::vector<Result>& results, const std::string& input)
{
  std::vector<Result> selected;
  std::copy_if(results.begin(), results.end(), std::back_inserter(selected),
    [&input](const Result& result) { return result.Input == input; });
  return selected;
}

//------------------------------------------------------------------------------
// Tables

std::string FormatJudgement(const Judgement& judged)
{
  std::ostringstream out;
  out << judged.Missed << " | " << judged.Invented << " | ";
  if (!judged.Errors.empty())
  {
    out << judged.Wrong;
  }
  out << " | " << Format(judged.GetError(0.5), 2) << " | " << Format(judged.GetError(0.99), 2)
      << " | " << Format(judged.GetError(1.0), 2) << " |\n";
  return out.str();
}

/// The medians and, but for the first, how many times the first they are.
void WritePrices(const std::vector<Result>& results, const Samples Result::*time, std::ostream& out)
{
  double first = NotMeasured;
  for (const char* name : { "Robust", "Fast", "Marmitt, N = 3" })
  {
    const auto result = std::find_if(results.begin(), results.end(),
      [name](const Result& candidate) { return GetName(candidate) == name; });
    const double median = GetMedian((*result).*time);
    out << " | " << Format(median, 3)
        << (std::isnan(first) ? std::string() : " (x " + Format(median / first, 2) + ")");
    first = std::isnan(first) ? median : first;
  }
}

void WriteAllPrices(const Results& results, std::ostream& out)
{
  out << "\n## The price of the default solver\n\n"
      << "| input | ns per ray: Robust | Fast | Marmitt, N = 3 | ms per frame: Robust | Fast | "
         "Marmitt, N = 3 |\n|---|---|---|---|---|---|---|\n";
  for (const std::string& input : GetInputs(results))
  {
    out << "| " << input;
    WritePrices(Select(results.Rays, input), &Result::NanosecondsPerRay, out);
    WritePrices(Select(results.Pictures, input), &Result::FrameMilliseconds, out);
    out << " |\n";
  }
}

void WriteMarkdown(const Results& results,
  const std::vector<std::pair<std::string, std::string>>& circumstances,
  const std::string& fileName)
{
  std::ofstream out(fileName);
  out << "# Speed against error\n\n";
  for (const auto& [name, value] : circumstances)
  {
    out << "- " << name << ": " << value << "\n";
  }
  out << R"(
Times are the median of the repeats, in brackets the fastest and the slowest: of rays on one thread,
of pictures on all. Errors are distances along the ray to the first hit that 113 bits find, in cells.
Wrong: more than 0.05 cell off. Pictures are asked about the same rays, through the middles of their
pixels. The GPU mode is believed its depth image, whose floats tell about 1e-5 cells apart. The
fixed-point mapper and polygons are asked whether they show anything. The fixed-point mapper shows all
that is inside: where a ray enters the volume inside, it shows the side of the volume, which is invented.
)";
  WriteAllPrices(results, out);
  for (const std::string& input : GetInputs(results))
  {
    const std::vector<Result> rays = Select(results.Rays, input);
    out << "\n## " << input << "\n\n"
        << rays.front().Judged.Rays << " rays, of which " << rays.front().Judged.Hits
        << " meet the surface.\n\n"
        << "| rays | ns per ray | ns per cell | missed | invented | wrong | median error | p99 | "
           "max |\n|---|---|---|---|---|---|---|---|---|\n";
    for (const Result& result : rays)
    {
      out << "| " << GetName(result) << " | " << Format(result.NanosecondsPerRay) << " | "
          << (result.NanosecondsPerCell > 0.0 ? Format(result.NanosecondsPerCell, 2) : "") << " | "
          << FormatJudgement(result.Judged);
    }
    out << "\n| pictures | ms per frame | of it, tracing | missed | invented | wrong | median "
           "error | "
           "p99 | max |\n|---|---|---|---|---|---|---|---|---|\n";
    for (const Result& result : Select(results.Pictures, input))
    {
      out << "| " << GetName(result) << " | " << Format(result.FrameMilliseconds) << " | "
          << Format(GetMedian(result.TraceMilliseconds), 3) << " | "
          << FormatJudgement(result.Judged);
    }
  }
}

//------------------------------------------------------------------------------
// What is known of each result, for programs

struct Column
{
  const char* Name;
  std::function<vtkVariant(const Result&)> Get;
};

const std::vector<Column>& GetColumns()
{
  static const std::vector<Column> columns = {
    { "input", [](const Result& r) { return vtkVariant(r.Input); } },
    { "what",
      [](const Result& r)
      { return vtkVariant(r.NanosecondsPerRay.IsEmpty() ? "pictures" : "rays"); } },
    { "method", [](const Result& r) { return vtkVariant(r.Family); } },
    { "knob", [](const Result& r) { return vtkVariant(r.Knob); } },
    { "rays", [](const Result& r) { return vtkVariant(r.Judged.Rays); } },
    { "hits", [](const Result& r) { return vtkVariant(r.Judged.Hits); } },
    { "missed", [](const Result& r) { return vtkVariant(r.Judged.Missed); } },
    { "invented", [](const Result& r) { return vtkVariant(r.Judged.Invented); } },
    { "wrong", [](const Result& r) { return vtkVariant(r.Judged.Wrong); } },
    { "medianError", [](const Result& r) { return vtkVariant(r.Judged.GetError(0.5)); } },
    { "p99Error", [](const Result& r) { return vtkVariant(r.Judged.GetError(0.99)); } },
    { "maximumError", [](const Result& r) { return vtkVariant(r.Judged.GetError(1.0)); } },
    { "nanosecondsPerRay",
      [](const Result& r) { return vtkVariant(GetMedian(r.NanosecondsPerRay)); } },
    { "nanosecondsPerCell", [](const Result& r) { return vtkVariant(r.NanosecondsPerCell); } },
    { "millisecondsPerFrame",
      [](const Result& r) { return vtkVariant(GetMedian(r.FrameMilliseconds)); } },
    { "millisecondsTracing",
      [](const Result& r) { return vtkVariant(GetMedian(r.TraceMilliseconds)); } },
  };
  return columns;
}

void WriteCsv(const std::vector<Result>& results, const std::string& fileName)
{
  vtkNew<vtkTable> table;
  for (const Column& column : GetColumns())
  {
    vtkSmartPointer<vtkAbstractArray> array = vtkSmartPointer<vtkDoubleArray>::New();
    if (column.Get(results.front()).IsString())
    {
      array = vtkSmartPointer<vtkStringArray>::New();
    }
    array->SetName(column.Name);
    for (std::size_t i = 0; i < results.size(); ++i)
    {
      array->InsertVariantValue(static_cast<vtkIdType>(i), column.Get(results[i]));
    }
    table->AddColumn(array);
  }
  vtkNew<vtkDelimitedTextWriter> writer;
  writer->SetInputData(table);
  writer->SetFileName(fileName.c_str());
  writer->Write();
}

void WriteJson(const std::vector<Result>& results,
  const std::vector<std::pair<std::string, std::string>>& circumstances,
  const std::string& fileName)
{
  Json::Value root;
  for (const auto& [name, value] : circumstances)
  {
    root["circumstances"][name] = value;
  }
  for (const Result& result : results)
  {
    Json::Value row;
    for (const Column& column : GetColumns())
    {
      const vtkVariant value = column.Get(result);
      if (value.IsString())
      {
        row[column.Name] = value.ToString();
      }
      else if (value.IsInt())
      {
        row[column.Name] = value.ToInt();
      }
      else if (!std::isnan(value.ToDouble())) // JSON has no word for it.
      {
        row[column.Name] = value.ToDouble();
      }
    }
    root["results"].append(row);
  }
  std::ofstream out(fileName);
  out << root << "\n";
}

//------------------------------------------------------------------------------
// Plots

void WritePicture(vtkRenderWindow* window, const std::string& fileName)
{
  window->Render();
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(fileName.c_str());
  writer->Write();
}

/// Curves that are drawn in a chart: the points of a family, in order.
using Curves = std::vector<std::pair<std::string, std::vector<std::array<double, 2>>>>;

void AddCurve(vtkChartXY* chart, const std::string& name,
  const std::vector<std::array<double, 2>>& points, std::size_t number, bool markers)
{
  // Twelve colours that are told apart on white, and by those who do not see all colours too.
  static const unsigned char colors[][3] = { { 0, 0, 0 }, { 230, 25, 75 }, { 0, 130, 200 },
    { 245, 130, 48 }, { 60, 180, 75 }, { 145, 30, 180 }, { 70, 200, 220 }, { 128, 128, 0 },
    { 170, 110, 40 }, { 128, 128, 128 }, { 240, 50, 230 }, { 0, 0, 128 } };
  vtkNew<vtkTable> table;
  vtkNew<vtkDoubleArray> x;
  x->SetName("x");
  vtkNew<vtkDoubleArray> y;
  y->SetName(name.c_str());
  for (const auto& point : points)
  {
    x->InsertNextValue(point[0]);
    y->InsertNextValue(point[1]);
  }
  table->AddColumn(x);
  table->AddColumn(y);
  vtkPlot* plot = chart->AddPlot(points.size() > 1 ? vtkChart::LINE : vtkChart::POINTS);
  plot->SetInputData(table, 0, 1);
  const unsigned char* color = colors[number % 12];
  plot->SetColor(color[0], color[1], color[2], 255);
  plot->SetWidth(2.0F);
  if (auto* marked = vtkPlotPoints::SafeDownCast(plot))
  {
    marked->SetMarkerStyle(
      markers ? static_cast<int>(vtkPlotPoints::SQUARE + number % 3) : vtkPlotPoints::NONE);
    marked->SetMarkerSize(11.0F);
  }
}

void SetAxis(vtkAxis* axis, const std::string& title, double low, double high)
{
  axis->SetTitle(title);
  axis->LogScaleOn();
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetUnscaledRange(low, high);
  axis->GetTitleProperties()->SetFontSize(16);
  axis->GetLabelProperties()->SetFontSize(14);
  if (high / low > 1e9) // As many labels as decades, side by side.
  {
    axis->SetNotation(vtkAxis::SCIENTIFIC_NOTATION);
    axis->SetPrecision(0);
    axis->GetLabelProperties()->SetFontSize(11);
  }
  axis->SetGridVisible(true);
}

struct Labels
{
  std::string Title;
  std::string X;
  std::string Y;
};

void WriteChart(const Labels& labels, const Curves& curves, const std::array<double, 4>& ranges,
  bool markers, const std::string& fileName)
{
  vtkNew<vtkContextView> view;
  view->GetRenderer()->SetBackground(1.0, 1.0, 1.0);
  view->GetRenderWindow()->SetOffScreenRendering(true);
  view->GetRenderWindow()->SetMultiSamples(0);
  view->GetRenderWindow()->SetSize(1000, 650);
  vtkNew<vtkChartXY> chart;
  view->GetScene()->AddItem(chart);
  chart->SetTitle(labels.Title);
  chart->GetTitleProperties()->SetFontSize(18);
  chart->SetShowLegend(true);
  chart->GetLegend()->SetLabelSize(14);
  chart->GetLegend()->SetInline(false);
  for (std::size_t i = 0; i < curves.size(); ++i)
  {
    if (!curves[i].second.empty())
    {
      AddCurve(chart, curves[i].first, curves[i].second, i, markers);
    }
  }
  SetAxis(chart->GetAxis(vtkAxis::BOTTOM), labels.X, ranges[0], ranges[1]);
  SetAxis(chart->GetAxis(vtkAxis::LEFT), labels.Y, ranges[2], ranges[3]);
  WritePicture(view->GetRenderWindow(), fileName);
}

/// A power of ten below all and one above all.
std::array<double, 2> GetDecades(const Curves& curves, std::size_t coordinate)
{
  double low = 1e300;
  double high = 1e-300;
  for (const auto& curve : curves)
  {
    for (const auto& point : curve.second)
    {
      low = std::min(low, point[coordinate]);
      high = std::max(high, point[coordinate]);
    }
  }
  return { std::pow(10.0, std::floor(std::log10(low) - 0.05)),
    std::pow(10.0, std::ceil(std::log10(high) + 0.05)) };
}

using Get = std::function<double(const Result&)>;

/// A curve for each family, so that its colour is the same everywhere; without the points of which
/// something is not known.
Curves MakeCurves(const std::vector<Result>& results, const Get& getX, const Get& getY)
{
  Curves curves;
  for (const Result& result : results)
  {
    const std::array<double, 2> point = { getX(result), getY(result) };
    if (curves.empty() || curves.back().first != result.Family)
    {
      curves.push_back({ result.Family, {} });
    }
    if (!std::isnan(point[0]) && !std::isnan(point[1]))
    {
      curves.back().second.push_back(point);
    }
  }
  return curves;
}

/// Writes what a time buys, as start-error.png and start-misjudged.png.
void WriteSpeedPlots(const std::vector<Result>& results, const Get& getTime,
  const std::string& timeTitle, const std::string& start)
{
  const std::string& input = results.front().Input;
  const Curves errors = MakeCurves(results, getTime,
    [](const Result& result)
    {
      const double error = result.Judged.GetError(0.99);
      return std::isnan(error) ? error : std::max(SmallestError, error);
    });
  const Curves misjudged = MakeCurves(results, getTime,
    [](const Result& result)
    {
      const Judgement& judged = result.Judged;
      // Less than one ray is none at all, which a logarithmic axis does not have.
      return std::max(0.3, 1.0 * judged.Missed + judged.Invented + judged.Wrong) / judged.Rays;
    });
  const auto x = GetDecades(misjudged, 0);
  const auto y = GetDecades(misjudged, 1);
  WriteChart({ input + ": speed against error", timeTitle, "error of 99 % of the rays, cells" },
    errors, { x[0], x[1], SmallestError, 1000.0 }, true, start + "-error.png");
  WriteChart({ input + ": rays missed, invented or on a wrong sheet (lowest: none)", timeTitle,
               "share of the rays" },
    misjudged, { x[0], x[1], y[0], 1.0 }, true, start + "-misjudged.png");
}

void WriteHistogram(const std::vector<Result>& results, const std::string& fileName)
{
  Curves histogram;
  std::set<std::string> shown;
  for (const Result& result : results)
  {
    const bool isMiddle =
      result.Knob.empty() || result.Knob == "N = 3" || result.Knob == "0.5 cells";
    if (result.Judged.Errors.empty() || !isMiddle || !shown.insert(result.Family).second)
    {
      continue;
    }
    std::vector<std::array<double, 2>> points;
    for (int i = 1; i <= 200; ++i)
    {
      // The share of rays whose error is larger.
      const double share = std::pow(10.0, -4.0 * i / 200.0);
      points.push_back({ std::max(SmallestError, result.Judged.GetError(1.0 - share)), share });
    }
    histogram.push_back({ GetName(result), points });
  }
  WriteChart({ results.front().Input + ": how many rays have which error", "error, cells",
               "share of the rays with a larger error" },
    histogram, { SmallestError, 10.0, 1e-4, 1.0 }, false, fileName);
}

//------------------------------------------------------------------------------
// The picture of errors

constexpr int PanelsInRow = 4;
constexpr int Gap = 8;
constexpr int TitleHeight = 36;
constexpr int LegendHeight = 110;

/// From errors, as powers of ten.
vtkSmartPointer<vtkColorTransferFunction> NewHeatColors()
{
  auto colors = vtkSmartPointer<vtkColorTransferFunction>::New();
  colors->AddRGBPoint(-16.0, 0.0, 0.0, 0.1);
  colors->AddRGBPoint(-12.0, 0.1, 0.1, 0.6);
  colors->AddRGBPoint(-8.0, 0.0, 0.6, 0.6);
  colors->AddRGBPoint(-5.0, 0.2, 0.8, 0.2);
  colors->AddRGBPoint(-2.0, 1.0, 0.9, 0.2);
  colors->AddRGBPoint(0.0, 1.0, 1.0, 1.0);
  return colors;
}

const std::array<double, 3> MisjudgedColor = { 1.0, 0.0, 0.0 };
const std::array<double, 3> UnknownColor = { 0.75, 0.55, 0.85 };
const std::array<double, 3> NothingColor = { 0.5, 0.5, 0.5 };

std::array<double, 3> GetHeatColor(double error, vtkColorTransferFunction* colors)
{
  if (std::isnan(error))
  {
    return NothingColor;
  }
  if (std::isinf(error))
  {
    return MisjudgedColor;
  }
  if (error == UnknownError)
  {
    return UnknownColor;
  }
  std::array<double, 3> color;
  colors->GetColor(std::log10(std::max(1e-16, error)), color.data());
  return color;
}

/// How many pixels show one, so that small pictures can be seen.
int GetHeatScale(int pixels)
{
  constexpr int smallestPanel = 512;
  return std::max(1, smallestPanel / pixels);
}

vtkSmartPointer<vtkImageData> NewHeatImage(
  const std::vector<double>& errors, int pixels, vtkColorTransferFunction* colors)
{
  const int scale = GetHeatScale(pixels);
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(pixels * scale, pixels * scale, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* channel = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int y = 0; y < pixels * scale; ++y)
  {
    for (int x = 0; x < pixels * scale; ++x)
    {
      const auto pixel = static_cast<std::size_t>(x / scale + y / scale * pixels);
      for (const double part : GetHeatColor(errors[pixel], colors))
      {
        *channel++ = static_cast<unsigned char>(std::lround(255.0 * part));
      }
    }
  }
  return image;
}

void AddText(vtkRenderer* renderer, const std::string& text, int x, int y,
  const std::array<double, 3>& color = { 0.0, 0.0, 0.0 })
{
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->SetPosition(x, y);
  actor->GetTextProperty()->SetFontSize(24);
  actor->GetTextProperty()->SetColor(color.data());
  renderer->AddViewProp(actor);
}

void AddLegend(vtkRenderer* renderer, vtkColorTransferFunction* colors)
{
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colors);
  bar->SetOrientationToHorizontal();
  bar->SetNumberOfLabels(9);
  bar->SetLabelFormat("1e%.0f");
  bar->UnconstrainedFontSizeOn();
  bar->GetLabelTextProperty()->SetFontSize(20);
  bar->GetLabelTextProperty()->SetColor(0.0, 0.0, 0.0);
  bar->GetLabelTextProperty()->ShadowOff();
  bar->GetLabelTextProperty()->ItalicOff();
  bar->GetPositionCoordinate()->SetCoordinateSystemToDisplay();
  bar->GetPositionCoordinate()->SetValue(260.0, 0.0);
  bar->GetPosition2Coordinate()->SetCoordinateSystemToDisplay();
  bar->GetPosition2Coordinate()->SetValue(800.0, 90.0);
  renderer->AddViewProp(bar);
  AddText(renderer, "error, cells", Gap, 40);
  AddText(renderer, "misjudged", 1130, 40, MisjudgedColor);
  AddText(renderer, "nothing there", 1330, 40, NothingColor);
  AddText(renderer, "seen, distance not known", 1560, 40, UnknownColor);
}

}

//------------------------------------------------------------------------------
std::string GetFileName(std::string name)
{
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '-');
  return name;
}

//------------------------------------------------------------------------------
std::vector<std::string> WriteReport(const Results& results,
  const std::vector<std::pair<std::string, std::string>>& circumstances, const std::string& folder)
{
  std::vector<std::string> files = { "results.md", "results.csv", "results.json" };
  std::vector<Result> all = results.Rays;
  all.insert(all.end(), results.Pictures.begin(), results.Pictures.end());
  WriteMarkdown(results, circumstances, folder + "/results.md");
  WriteCsv(all, folder + "/results.csv");
  WriteJson(all, circumstances, folder + "/results.json");
  if (!OffScreenWindow::IsPossible())
  {
    return files;
  }
  for (const std::string& input : GetInputs(results))
  {
    const std::string name = GetFileName(input);
    const std::string start = folder + "/" + name;
    const std::vector<Result> rays = Select(results.Rays, input);
    WriteSpeedPlots(
      rays, [](const Result& result) { return GetMedian(result.NanosecondsPerRay); },
      "ns per ray, one thread", start + "-speed");
    WriteSpeedPlots(
      Select(results.Pictures, input),
      [](const Result& result) { return GetMedian(result.FrameMilliseconds); },
      "ms per frame, all threads", start + "-frame");
    WriteHistogram(rays, start + "-errors.png");
    for (const char* plot : { "-speed-error.png", "-speed-misjudged.png", "-frame-error.png",
           "-frame-misjudged.png", "-errors.png" })
    {
      files.push_back(name + plot);
    }
  }
  return files;
}

//------------------------------------------------------------------------------
void WriteHeatMap(const std::vector<HeatPanel>& panels, int pixels, const std::string& fileName)
{
  const vtkSmartPointer<vtkColorTransferFunction> colors = NewHeatColors();
  const int edge = pixels * GetHeatScale(pixels);
  const int rows = (static_cast<int>(panels.size()) + PanelsInRow - 1) / PanelsInRow;
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  for (int i = 0; i < static_cast<int>(panels.size()); ++i)
  {
    const HeatPanel& panel = panels[static_cast<std::size_t>(i)];
    const int x = i % PanelsInRow * (edge + Gap);
    const int y = LegendHeight + (rows - 1 - i / PanelsInRow) * (edge + TitleHeight);
    vtkNew<vtkImageMapper> mapper;
    mapper->SetInputData(NewHeatImage(panel.Errors, pixels, colors));
    mapper->SetColorWindow(255.0);
    mapper->SetColorLevel(127.5);
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    actor->SetPosition(x, y);
    renderer->AddViewProp(actor);
    AddText(renderer, panel.Title, x + Gap, y + edge + Gap);
  }
  AddLegend(renderer, colors);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(true);
  window->SetMultiSamples(0);
  window->SetSize(PanelsInRow * (edge + Gap) - Gap, LegendHeight + rows * (edge + TitleHeight));
  window->AddRenderer(renderer);
  WritePicture(window, fileName);
}

}
