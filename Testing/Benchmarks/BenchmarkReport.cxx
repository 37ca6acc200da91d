// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "BenchmarkReport.h"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkColorTransferFunction.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDelimitedTextWriter.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>
#include <vtk_jsoncpp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

namespace Benchmark
{
namespace
{

/// What is too small for a double, and for a logarithmic axis.
constexpr double SmallestError = 1e-17;

std::string Format(double value, int digits)
{
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

std::string GetName(const Result& result)
{
  return result.Family + (result.Knob.empty() ? "" : ", " + result.Knob);
}

std::string GetFileName(std::string name)
{
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '-');
  return name;
}

std::vector<std::string> GetInputs(const std::vector<Result>& results)
{
  std::vector<std::string> inputs;
  for (const Result& result : results)
  {
    if (inputs.empty() || inputs.back() != result.Input)
    {
      inputs.push_back(result.Input);
    }
  }
  return inputs;
}

//------------------------------------------------------------------------------
void WriteMarkdown(
  const std::vector<Result>& results, const std::string& machine, const std::string& fileName)
{
  std::ofstream out(fileName);
  out << "# Speed against error\n\n"
      << machine << "\n\n"
      << "One thread; the median of the repeats, in brackets the fastest and the slowest. Errors "
         "are\n"
      << "distances along the ray to the first hit that 113 bits find, in cells. Wrong: more than\n"
      << "0.05 cell off.\n";
  for (const std::string& input : GetInputs(results))
  {
    out << "\n## " << input << "\n\n"
        << "| method | ns per ray | ns per cell | missed | invented | wrong | median error | p99 | "
           "max |\n|---|---|---|---|---|---|---|---|---|\n";
    for (const Result& result : results)
    {
      if (result.Input != input)
      {
        continue;
      }
      out << "| " << GetName(result) << " | " << Format(result.NanosecondsPerRay, 3) << " ("
          << Format(result.Fastest, 3) << "-" << Format(result.Slowest, 3) << ") | "
          << (result.NanosecondsPerCell > 0.0 ? Format(result.NanosecondsPerCell, 2) : "") << " | "
          << result.Missed << " | " << result.Invented << " | " << result.Wrong << " | "
          << Format(result.GetError(0.5), 2) << " | " << Format(result.GetError(0.99), 2) << " | "
          << Format(result.GetError(1.0), 2) << " |\n";
    }
    const auto first = std::find_if(results.begin(), results.end(),
      [&input](const Result& result) { return result.Input == input; });
    out << "\n" << first->Rays << " rays, of which " << first->Hits << " meet the surface.\n\n";
    for (const char* plot : { "speed-error", "speed-misjudged", "errors", "heat" })
    {
      out << "![" << plot << "](" << GetFileName(input) << "-" << plot << ".png)\n";
    }
  }
}

//------------------------------------------------------------------------------
void WriteCsv(const std::vector<Result>& results, const std::string& fileName)
{
  vtkNew<vtkTable> table;
  const auto addText = [&](const char* name, const std::function<std::string(const Result&)>& get)
  {
    vtkNew<vtkStringArray> column;
    column->SetName(name);
    for (const Result& result : results)
    {
      column->InsertNextValue(get(result));
    }
    table->AddColumn(column);
  };
  const auto addNumber = [&](const char* name, const std::function<double(const Result&)>& get)
  {
    vtkNew<vtkDoubleArray> column;
    column->SetName(name);
    for (const Result& result : results)
    {
      column->InsertNextValue(get(result));
    }
    table->AddColumn(column);
  };
  addText("Input", [](const Result& r) { return r.Input; });
  addText("Method", [](const Result& r) { return r.Family; });
  addText("Knob", [](const Result& r) { return r.Knob; });
  addNumber("Rays", [](const Result& r) { return r.Rays; });
  addNumber("Hits", [](const Result& r) { return r.Hits; });
  addNumber("NanosecondsPerRay", [](const Result& r) { return r.NanosecondsPerRay; });
  addNumber("Fastest", [](const Result& r) { return r.Fastest; });
  addNumber("Slowest", [](const Result& r) { return r.Slowest; });
  addNumber("NanosecondsPerCell", [](const Result& r) { return r.NanosecondsPerCell; });
  addNumber("Missed", [](const Result& r) { return r.Missed; });
  addNumber("Invented", [](const Result& r) { return r.Invented; });
  addNumber("Wrong", [](const Result& r) { return r.Wrong; });
  addNumber("MedianError", [](const Result& r) { return r.GetError(0.5); });
  addNumber("P99Error", [](const Result& r) { return r.GetError(0.99); });
  addNumber("MaximumError", [](const Result& r) { return r.GetError(1.0); });
  vtkNew<vtkDelimitedTextWriter> writer;
  writer->SetInputData(table);
  writer->SetFileName(fileName.c_str());
  writer->Write();
}

//------------------------------------------------------------------------------
void WriteJson(
  const std::vector<Result>& results, const std::string& machine, const std::string& fileName)
{
  Json::Value root;
  root["machine"] = machine;
  for (const Result& result : results)
  {
    Json::Value row;
    row["input"] = result.Input;
    row["method"] = result.Family;
    row["knob"] = result.Knob;
    row["rays"] = result.Rays;
    row["hits"] = result.Hits;
    row["nanosecondsPerRay"] = result.NanosecondsPerRay;
    row["fastest"] = result.Fastest;
    row["slowest"] = result.Slowest;
    row["nanosecondsPerCell"] = result.NanosecondsPerCell;
    row["missed"] = result.Missed;
    row["invented"] = result.Invented;
    row["wrong"] = result.Wrong;
    row["medianError"] = result.GetError(0.5);
    row["p99Error"] = result.GetError(0.99);
    row["maximumError"] = result.GetError(1.0);
    root["results"].append(row);
  }
  std::ofstream out(fileName);
  out << root << "\n";
}

//------------------------------------------------------------------------------
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
      markers ? static_cast<int>(vtkPlotPoints::CROSS + number % 5) : vtkPlotPoints::NONE);
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
    AddCurve(chart, curves[i].first, curves[i].second, i, markers);
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

Curves MakeCurves(const std::vector<Result>& results, const std::string& input,
  const std::function<double(const Result&)>& getX,
  const std::function<double(const Result&)>& getY)
{
  Curves curves;
  for (const Result& result : results)
  {
    if (result.Input != input)
    {
      continue;
    }
    if (curves.empty() || curves.back().first != result.Family)
    {
      curves.push_back({ result.Family, {} });
    }
    curves.back().second.push_back({ getX(result), getY(result) });
  }
  return curves;
}

void WritePlots(
  const std::vector<Result>& results, const std::string& input, const std::string& start)
{
  const auto speed = [](const Result& result) { return result.NanosecondsPerRay; };
  const Curves errors = MakeCurves(results, input, speed,
    [](const Result& result) { return std::max(SmallestError, result.GetError(0.99)); });
  const auto x = GetDecades(errors, 0);
  WriteChart({ input + ": speed against error", "ns per ray, one thread",
               "error of 99 % of the rays, cells" },
    errors, { x[0], x[1], SmallestError, 10.0 }, true, start + "-speed-error.png");

  const Curves misjudged = MakeCurves(results, input, speed,
    [](const Result& result)
    {
      // Less than one ray is none at all, which a logarithmic axis does not have.
      return std::max(0.3, static_cast<double>(result.Missed + result.Invented + result.Wrong)) /
        result.Rays;
    });
  const auto y = GetDecades(misjudged, 1);
  WriteChart({ input + ": rays missed, invented or on a wrong sheet (lowest: none)",
               "ns per ray, one thread", "share of the rays" },
    misjudged, { x[0], x[1], y[0], 1.0 }, true, start + "-speed-misjudged.png");

  Curves histogram;
  std::set<std::string> shown;
  for (const Result& result : results)
  {
    const bool isMiddle =
      result.Knob.empty() || result.Knob == "N = 3" || result.Knob == "0.5 cells";
    if (result.Input != input || !isMiddle || !shown.insert(result.Family).second)
    {
      continue;
    }
    std::vector<std::array<double, 2>> points;
    for (int i = 1; i <= 200 && !result.Errors.empty(); ++i)
    {
      // The share of rays whose error is larger.
      const double share = std::pow(10.0, -4.0 * i / 200.0);
      points.push_back({ std::max(SmallestError, result.GetError(1.0 - share)), share });
    }
    histogram.push_back({ GetName(result), points });
  }
  WriteChart({ input + ": how many rays have which error", "error, cells",
               "share of the rays with a larger error" },
    histogram, { SmallestError, 10.0, 1e-4, 1.0 }, false, start + "-errors.png");
}

}

//------------------------------------------------------------------------------
double Result::GetError(double share) const
{
  if (this->Errors.empty())
  {
    return 0.0;
  }
  const auto last = static_cast<double>(this->Errors.size() - 1);
  return this->Errors[static_cast<std::size_t>(std::lround(share * last))];
}

//------------------------------------------------------------------------------
std::vector<std::string> WriteReport(
  const std::vector<Result>& results, const std::string& machine, const std::string& folder)
{
  std::vector<std::string> files = { "results.md", "results.csv", "results.json" };
  WriteMarkdown(results, machine, folder + "/results.md");
  WriteCsv(results, folder + "/results.csv");
  WriteJson(results, machine, folder + "/results.json");
  for (const std::string& input : GetInputs(results))
  {
    WritePlots(results, input, folder + "/" + GetFileName(input));
    for (const char* plot : { "-speed-error.png", "-speed-misjudged.png", "-errors.png" })
    {
      files.push_back(GetFileName(input) + plot);
    }
  }
  return files;
}

//------------------------------------------------------------------------------
void WriteHeatMap(
  const std::vector<std::vector<double>>& errors, int pixels, const std::string& fileName)
{
  constexpr int gap = 4;
  const int count = static_cast<int>(errors.size());
  vtkNew<vtkImageData> image;
  image->SetDimensions(count * (pixels + gap) - gap, pixels, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  vtkNew<vtkColorTransferFunction> colors;
  colors->AddRGBPoint(-16.0, 0.0, 0.0, 0.1);
  colors->AddRGBPoint(-12.0, 0.1, 0.1, 0.6);
  colors->AddRGBPoint(-8.0, 0.0, 0.6, 0.6);
  colors->AddRGBPoint(-5.0, 0.2, 0.8, 0.2);
  colors->AddRGBPoint(-2.0, 1.0, 0.9, 0.2);
  colors->AddRGBPoint(0.0, 1.0, 1.0, 1.0);
  const int* dimensions = image->GetDimensions();
  for (int y = 0; y < dimensions[1]; ++y)
  {
    for (int x = 0; x < dimensions[0]; ++x)
    {
      auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      std::fill(pixel, pixel + 3, static_cast<unsigned char>(255));
      const int column = x % (pixels + gap);
      if (column >= pixels)
      {
        continue;
      }
      const double error = errors[static_cast<std::size_t>(x / (pixels + gap))]
                                 [static_cast<std::size_t>(column + y * pixels)];
      double rgb[3] = { 0.5, 0.5, 0.5 }; // Nothing there, and nothing found.
      if (error == std::numeric_limits<double>::infinity())
      {
        rgb[0] = 1.0;
        rgb[1] = 0.0;
        rgb[2] = 0.0;
      }
      else if (!std::isnan(error))
      {
        colors->GetColor(std::log10(std::max(1e-16, error)), rgb);
      }
      for (int channel = 0; channel < 3; ++channel)
      {
        pixel[channel] = static_cast<unsigned char>(std::lround(255.0 * rgb[channel]));
      }
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(fileName.c_str());
  writer->Write();
}

}
