// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Chart.h"

#include "Png.h"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Compare
{
namespace
{

/// The smallest and the largest value of a coordinate over all curves.
struct Range
{
  double Low = std::numeric_limits<double>::max();
  double High = 0.0;

  void Include(double value)
  {
    this->Low = std::min(this->Low, value);
    this->High = std::max(this->High, value);
  }
};

/// Adds a plot; widens the ranges by its points.
void AddCurve(vtkChartXY* chart, const Curve& curve, std::size_t number, Range ranges[2])
{
  // Distinct on white, for colour-blind readers too (M. Okabe, K. Ito 2008).
  constexpr unsigned char colors[][3] = { { 0, 114, 178 }, { 213, 94, 0 }, { 0, 158, 115 },
    { 204, 121, 167 }, { 230, 159, 0 }, { 86, 180, 233 }, { 0, 0, 0 } };
  vtkNew<vtkDoubleArray> coordinates[2];
  coordinates[0]->SetName("x");
  coordinates[1]->SetName(curve.Name.c_str());
  for (const auto& point : curve.Points)
  {
    const bool isDrawn = std::all_of(point.begin(), point.end(),
      [](double coordinate) { return coordinate > 0.0 && std::isfinite(coordinate); });
    for (int i = 0; i < 2 && isDrawn; ++i)
    {
      coordinates[i]->InsertNextValue(point[i]);
      ranges[i].Include(point[i]);
    }
  }
  if (coordinates[0]->GetNumberOfValues() == 0)
  {
    return;
  }
  vtkNew<vtkTable> table;
  table->AddColumn(coordinates[0]);
  table->AddColumn(coordinates[1]);
  const bool isLine = table->GetNumberOfRows() > 1;
  vtkPlot* plot = chart->AddPlot(isLine ? vtkChart::LINE : vtkChart::POINTS);
  plot->SetInputData(table, 0, 1);
  const unsigned char* color = colors[number % 7];
  plot->SetColor(color[0], color[1], color[2], 255);
  plot->SetWidth(2.5F);
  plot->GetPen()->SetLineType(curve.IsDashed ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE);
  auto* points = vtkPlotPoints::SafeDownCast(plot);
  const bool hasMarkers = curve.HasMarkers || !isLine;
  points->SetMarkerStyle(hasMarkers ? vtkPlotPoints::CIRCLE : vtkPlotPoints::NONE);
  points->SetMarkerSize(8.0F);
}

void SetAxis(vtkAxis* axis, const std::string& title, const Range& range)
{
  axis->SetTitle(title);
  axis->LogScaleOn();
  axis->SetBehavior(vtkAxis::FIXED);
  // Whole decades, so that they are labelled; at least one.
  const double low = std::floor(std::log10(range.Low) + 1e-6);
  const double high = std::max(low + 1.0, std::ceil(std::log10(range.High) - 1e-6));
  axis->SetUnscaledRange(std::pow(10.0, low), std::pow(10.0, high));
  // VTK places more labels than there is room for.
  vtkNew<vtkDoubleArray> ticks;
  vtkNew<vtkStringArray> labels;
  for (double decade = low; decade <= high; ++decade)
  {
    for (int digit = 1; digit <= (decade < high ? 9 : 1); ++digit)
    {
      std::ostringstream label;
      label << std::pow(10.0, decade);
      ticks->InsertNextValue(decade + std::log10(digit));
      labels->InsertNextValue(digit == 1 ? label.str() : "");
    }
  }
  axis->SetCustomTickPositions(ticks, labels);
  axis->GetTitleProperties()->SetFontSize(16);
  axis->GetLabelProperties()->SetFontSize(14);
}

}

//------------------------------------------------------------------------------
std::string DrawChart(const std::string& title, const std::string& xTitle,
  const std::string& yTitle, const std::vector<Curve>& curves)
{
  vtkNew<vtkContextView> view;
  view->GetRenderer()->SetBackground(1.0, 1.0, 1.0);
  view->GetRenderWindow()->SetOffScreenRendering(true);
  view->GetRenderWindow()->SetMultiSamples(0);
  view->GetRenderWindow()->SetSize(900, 520);
  vtkNew<vtkChartXY> chart;
  view->GetScene()->AddItem(chart);
  chart->SetTitle(title);
  chart->GetTitleProperties()->SetFontSize(18);
  chart->SetShowLegend(true);
  chart->GetLegend()->SetLabelSize(14);
  chart->GetLegend()->SetInline(false);
  chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::RIGHT);
  Range ranges[2];
  for (std::size_t i = 0; i < curves.size(); ++i)
  {
    AddCurve(chart, curves[i], i, ranges);
  }
  if (chart->GetNumberOfPlots() == 0)
  {
    return "";
  }
  SetAxis(chart->GetAxis(vtkAxis::BOTTOM), xTitle, ranges[0]);
  SetAxis(chart->GetAxis(vtkAxis::LEFT), yTitle, ranges[1]);
  return EncodePng(view->GetRenderWindow());
}

}
