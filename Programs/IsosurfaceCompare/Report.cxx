// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Report.h"

#include "Chart.h"
#include "Comparison.h"
#include "Pictures.h"
#include "Support/OutputFile.h"
#include "vtkIsosurfaceComparisonFilter.h"

#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace Compare
{
namespace
{

const char* const Style = R"(
body { font: 16px/1.5 sans-serif; color: #222; max-width: 1100px; margin: 2em auto; padding: 0 1em }
h1 { font-size: 1.6em } h2 { font-size: 1.25em; margin-top: 2em }
table { border-collapse: collapse; margin: 1em 0; font-size: 0.9em }
th, td { border-bottom: 1px solid #ccc; padding: 0.3em 0.7em; text-align: right; vertical-align: bottom }
td { white-space: nowrap }
th:first-child, td:first-child { text-align: left }
figure { display: inline-block; margin: 0 0.6em 1em 0; vertical-align: top; width: 512px; max-width: 100% }
figure.wide { width: 900px }
figure img { width: 100%; display: block }
figcaption, .small { font-size: 0.85em; color: #555 }
code { background: #f2f2f2; padding: 0 0.3em }
)";

//------------------------------------------------------------------------------
std::string Escape(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
  {
    switch (c)
    {
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '&':
        escaped += "&amp;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

//------------------------------------------------------------------------------
/// Three significant digits, large numbers rounded to integers; a dash for NaN, not measured.
std::string Format(double value)
{
  if (std::isnan(value))
  {
    return "&ndash;";
  }
  std::ostringstream text;
  if (std::abs(value) >= 1000.0 && std::abs(value) < 1e15)
  {
    text << std::fixed << std::setprecision(0) << value;
  }
  else
  {
    text << std::setprecision(3) << value;
  }
  return text.str();
}

//------------------------------------------------------------------------------
/// A column of the report: the values of the table times a factor.
struct Column
{
  const char* Title;
  const char* Name;
  double Factor;
};

void WriteTable(std::ostream& out, vtkTable* table, const std::vector<Column>& columns)
{
  out << "<table>\n<tr><th>method</th><th>isovalue</th>";
  for (const Column& column : columns)
  {
    out << "<th>" << column.Title << "</th>";
  }
  out << "</tr>\n";
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    out << "<tr><td>" << Escape(table->GetValueByName(row, "Method").ToString()) << "</td><td>"
        << Format(table->GetValueByName(row, "Isovalue").ToDouble()) << "</td>";
    for (const Column& column : columns)
    {
      const double value = table->GetValueByName(row, column.Name).ToDouble();
      out << "<td>" << Format(column.Factor * value) << "</td>";
    }
    out << "</tr>\n";
  }
  out << "</table>\n";
}

//------------------------------------------------------------------------------
void WriteFigure(
  std::ostream& out, const std::string& png, const std::string& caption, bool isWide = false)
{
  if (!png.empty())
  {
    out << "<figure" << (isWide ? " class=\"wide\"" : "") << "><img alt=\"" << Escape(caption)
        << "\" src=\"data:image/png;base64," << png << "\"><figcaption>" << Escape(caption)
        << "</figcaption></figure>\n";
  }
}

//------------------------------------------------------------------------------
void WriteNotes(std::ostream& out, vtkTable* table)
{
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const std::string note = table->GetValueByName(row, "Note").ToString();
    if (!note.empty())
    {
      out << "<p class=\"small\">" << Escape(table->GetValueByName(row, "Method").ToString())
          << " at " << Format(table->GetValueByName(row, "Isovalue").ToDouble()) << ": "
          << Escape(note) << "</p>\n";
    }
  }
}

//------------------------------------------------------------------------------
/// What a method makes pictures of.
enum class Kind
{
  Rays,
  Triangles,
  Samples
};

Kind GetKind(vtkTable* table, vtkIdType row)
{
  const std::string method = table->GetValueByName(row, "Method").ToString();
  if (method == "vtkGPUVolumeRayCastMapper")
  {
    return Kind::Samples;
  }
  return method.rfind("vtkIsosurfaceRayTrace", 0) == 0 ? Kind::Rays : Kind::Triangles;
}

//------------------------------------------------------------------------------
/// The fastest row of the first isovalue, among those of a kind; -1 if nothing was measured.
vtkIdType FindFastest(vtkTable* table, Kind kind)
{
  vtkIdType fastest = -1;
  double least = std::numeric_limits<double>::max();
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const double seconds = table->GetValueByName(row, "NewIsovaluePictureTime").ToDouble();
    if (GetKind(table, row) == kind &&
      table->GetValueByName(row, "Isovalue") == table->GetValueByName(0, "Isovalue") &&
      seconds < least)
    {
      fastest = row;
      least = seconds;
    }
  }
  return fastest;
}

//------------------------------------------------------------------------------
/// The most important results, for the first isovalue.
void WriteSummary(std::ostream& out, vtkTable* table)
{
  const vtkIdType rays = FindFastest(table, Kind::Rays);
  const vtkIdType mesh = FindFastest(table, Kind::Triangles);
  const vtkIdType samples = FindFastest(table, Kind::Samples);
  if (rays < 0 || mesh < 0 || !(table->GetValueByName(mesh, "Triangles").ToDouble() > 0.0))
  {
    return;
  }
  const auto get = [table](vtkIdType row, const char* column, double factor = 1.0)
  { return Format(factor * table->GetValueByName(row, column).ToDouble()); };
  const double milli = 1e3;
  const double mega = 1e-6;
  out << "<h2>Summary</h2>\n<p>The time from a new isovalue to the first complete frame is "
      << get(rays, "NewIsovaluePictureTime", milli) << " ms with ray tracing and "
      << get(mesh, "NewIsovaluePictureTime", milli) << " ms with "
      << Escape(table->GetValueByName(mesh, "Method").ToString())
      << ", the fastest extraction here; the next frame takes "
      << get(rays, "NextPictureTime", milli) << " ms and " << get(mesh, "NextPictureTime", milli)
      << " ms. The memory kept is " << get(rays, "Bytes", mega) << " MB and "
      << get(mesh, "Bytes", mega) << " MB. Half of the triangles are farther than "
      << get(mesh, "MedianDistanceInCells")
      << " cells from the isosurface of the interpolant, one in a hundred farther than "
      << get(mesh, "P99DistanceInCells") << "; ";
  if (!std::isnan(table->GetValueByName(mesh, "AmbiguousCells").ToDouble()))
  {
    out << "in " << get(mesh, "TopologyDifferences") << " of " << get(mesh, "AmbiguousCells")
        << " ambiguous cells they connect corners that it separates, or the reverse; ";
  }
  out << get(mesh, "DifferentPixels") << " of " << get(mesh, "CoveredPixels") << " pixels differ.";
  if (samples >= 0)
  {
    out << " vtkGPUVolumeRayCastMapper, drawn by " << Escape(GetOpenGLRenderer()) << ", takes "
        << get(samples, "NewIsovaluePictureTime", milli) << " ms for a new isovalue and "
        << get(samples, "NextPictureTime", milli) << " ms for the next frame; "
        << get(samples, "DifferentPixels") << " of its pixels differ.";
  }
  out << "</p>\n";
}

//------------------------------------------------------------------------------
void WriteTables(std::ostream& out, vtkTable* table)
{
  const double milli = 1e3;
  const double mega = 1e-6;
  out << "<h2>Time</h2>\n";
  WriteTable(out, table,
    { { "build, ms", "BuildTime", milli }, { "extraction, ms", "ExtractionTime", milli },
      { "first picture, ms", "FirstPictureTime", milli },
      { "next picture, ms", "NextPictureTime", milli },
      { "new isovalue, ms", "NewIsovaluePictureTime", milli } });
  out << "<p class=\"small\">Build: the structures that serve all isovalues. Extraction: the "
         "triangles, "
         "without normals. First picture: from the image in memory to a picture in an open window, "
         "build and extraction included. Next picture: from another side. New isovalue: from an "
         "isovalue that differs by a thousandth of the range of the scalars to its first picture. "
         "All are medians of the repeats.</p>\n<h2>Memory</h2>\n";
  WriteTable(out, table,
    { { "triangles", "Triangles", 1.0 }, { "points", "Points", 1.0 },
      { "memory, MB", "Bytes", mega }, { "peak growth, MB", "PeakBytes", mega } });
  out << "<p class=\"small\">Memory: coordinates and triangles, or macrocells and bricks, or a "
         "tree. Peak "
         "growth: of the memory of the process meanwhile, as reported by Linux.</p>\n"
         "<h2>Accuracy</h2>\n";
  WriteTable(out, table,
    { { "distance, cells:<br>median", "MedianDistanceInCells", 1.0 },
      { "99 %", "P99DistanceInCells", 1.0 }, { "max", "MaximumDistanceInCells", 1.0 },
      { "in the world:<br>median", "MedianDistance", 1.0 }, { "99 %", "P99Distance", 1.0 },
      { "max", "MaximumDistance", 1.0 }, { "normal, degrees:<br>median", "MedianNormalError", 1.0 },
      { "99 %", "P99NormalError", 1.0 }, { "max", "MaximumNormalError", 1.0 } });
  WriteTable(out, table,
    { { "lost points", "LostPoints", 1.0 }, { "covered pixels", "CoveredPixels", 1.0 },
      { "different pixels", "DifferentPixels", 1.0 },
      { "isosurface alone", "IsosurfaceAlonePixels", 1.0 },
      { "mesh alone", "MeshAlonePixels", 1.0 }, { "ambiguous cells", "AmbiguousCells", 1.0 },
      { "different topology", "TopologyDifferences", 1.0 } });
  out << "<p class=\"small\">Distance from the isosurface of the interpolant, at the "
         "centroids of the triangles (at the hits of the picture for ray tracing). Angles between "
         "the normals of the triangles and those of the isosurface. Lost points: points from which "
         "no isosurface was found. Different pixels show one surface and not the other: the "
         "isosurface alone, or the mesh (or what the GPU's samples find) alone. Different "
         "topology: ambiguous cells in which the mesh connects corners that the isosurface "
         "separates, or the reverse.</p>\n";
  WriteNotes(out, table);
}

//------------------------------------------------------------------------------
/// From 1 to 1000 pictures, four points for each power of ten.
std::vector<std::array<double, 2>> SampleTotals(const Costs& costs)
{
  std::vector<std::array<double, 2>> points;
  for (int quarter = 0; quarter <= 12; ++quarter)
  {
    const double pictures = std::pow(10.0, quarter / 4.0);
    points.push_back({ pictures, costs.GetTotal(pictures) });
  }
  return points;
}

std::string DrawTotals(vtkTable* table)
{
  std::vector<Curve> curves;
  const double isovalue = table->GetValueByName(0, "Isovalue").ToDouble();
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    if (table->GetValueByName(row, "Isovalue").ToDouble() == isovalue)
    {
      const Costs costs = { table->GetValueByName(row, "NewIsovaluePictureTime").ToDouble(),
        table->GetValueByName(row, "NextPictureTime").ToDouble() };
      curves.push_back(
        { table->GetValueByName(row, "Method").ToString(), SampleTotals(costs), false, false });
    }
  }
  return DrawChart(
    "Time for a number of pictures of a new isovalue", "pictures", "seconds", curves);
}

//------------------------------------------------------------------------------
std::string DrawCosts(const std::vector<Crossover>& crossovers)
{
  Curve curves[] = { { "triangles, new isovalue", {} }, { "triangles, next picture", {}, true },
    { "rays, new isovalue", {} }, { "rays, next picture", {}, true } };
  for (const Crossover& crossover : crossovers)
  {
    const double seconds[] = { crossover.Triangles.First, crossover.Triangles.Next,
      crossover.Rays.First, crossover.Rays.Next };
    for (int i = 0; i < 4; ++i)
    {
      curves[i].Points.push_back({ crossover.Samples, seconds[i] });
    }
  }
  return DrawChart("Seconds for a picture", "samples", "seconds",
    std::vector<Curve>(std::begin(curves), std::end(curves)));
}

//------------------------------------------------------------------------------
/// For numbers of pictures, how many times as long triangles take as rays.
std::string DrawCrossover(const std::vector<Crossover>& crossovers)
{
  std::vector<Curve> curves;
  for (const int pictures : { 1, 10, 100 })
  {
    const std::string name = std::to_string(pictures) + (pictures == 1 ? " picture" : " pictures");
    Curve drawn = { name, {} };
    Curve free = { name + ", drawing in no time", {}, true };
    for (const Crossover& crossover : crossovers)
    {
      const double rays = crossover.Rays.GetTotal(pictures);
      drawn.Points.push_back({ crossover.Samples, crossover.Triangles.GetTotal(pictures) / rays });
      free.Points.push_back(
        { crossover.Samples, crossover.GetFreeTriangles().GetTotal(pictures) / rays });
    }
    curves.push_back(drawn);
    curves.push_back(free);
  }
  return DrawChart("Time of triangles divided by that of rays", "samples", "ratio", curves);
}

//------------------------------------------------------------------------------
void WriteCrossover(std::ostream& out, const std::vector<Crossover>& crossovers)
{
  out
    << "<h2>Rays or triangles</h2>\n<p>Extraction takes less time if enough pictures follow. For "
       "the "
       "first isovalue, vtkFlyingEdges3D and vtkIsosurfaceRayTraceMapper, with the volume "
       "resampled:</p>\n<table>\n<tr><th>samples</th><th>triangles: new isovalue, ms</th><th>next "
       "picture, ms</th><th>rays: new isovalue, ms</th><th>next picture, ms</th><th>faster "
       "here</th><th>if drawing triangles took no time</th></tr>\n";
  for (const Crossover& crossover : crossovers)
  {
    const int* size = crossover.Dimensions;
    out << "<tr><td>" << size[0] << " &times; " << size[1] << " &times; " << size[2] << "</td>";
    for (const double seconds : { crossover.Triangles.First, crossover.Triangles.Next,
           crossover.Rays.First, crossover.Rays.Next })
    {
      out << "<td>" << Format(1e3 * seconds) << "</td>";
    }
    out << "<td>" << Describe(Judge(crossover.Triangles, crossover.Rays)) << "</td><td>"
        << Describe(Judge(crossover.GetFreeTriangles(), crossover.Rays)) << "</td></tr>\n";
  }
  out
    << "</table>\n<p class=\"small\">Triangles were drawn by " << Escape(GetOpenGLRenderer())
    << ". The last column is the limit for a fast graphics card: it counts extraction and normals, "
       "but not drawing.</p>\n";
  WriteFigure(out, DrawCosts(crossovers), "The times of the table", true);
  WriteFigure(out, DrawCrossover(crossovers),
    "Above 1, rays need less time for so many pictures of an isovalue. Dashed: if drawing "
    "triangles "
    "took no time.",
    true);
}

//------------------------------------------------------------------------------
/// The fraction of the points of the mesh that are farther from the isosurface than a distance. The
/// vertices of the triangles, which come first, are left out; the centroids count.
std::string DrawDistances(const Comparison& comparison)
{
  vtkDataArray* distances = comparison.Mesh->GetPointData()->GetScalars();
  const vtkIdType first = comparison.Table->GetValueByName(0, "Points").ToTypeInt64();
  std::vector<double> sorted;
  for (vtkIdType i = first; distances && i < distances->GetNumberOfTuples(); ++i)
  {
    const double distance = distances->GetComponent(i, 0);
    if (!std::isnan(distance))
    {
      sorted.push_back(distance);
    }
  }
  std::sort(sorted.begin(), sorted.end());
  Curve curve = { comparison.Table->GetValueByName(0, "Method").ToString(), {}, false, false };
  for (int i = 0; i <= 200 && !sorted.empty(); ++i)
  {
    const double fraction = std::pow(10.0, -4.0 * i / 200.0);
    const auto last = static_cast<double>(sorted.size() - 1);
    curve.Points.push_back(
      { std::max(1e-6, sorted[static_cast<std::size_t>((1.0 - fraction) * last)]), fraction });
  }
  return DrawChart("Fraction of the surface farther from the isosurface", "distance, cells",
    "fraction of the points", { curve });
}

//------------------------------------------------------------------------------
/// The edge of a cube, if as many as there are cells filled the box around them.
double GetCellSize(vtkDataSet* data)
{
  const double* box = data->GetBounds();
  return std::cbrt((box[1] - box[0]) * (box[3] - box[2]) * (box[5] - box[4]) /
    static_cast<double>(data->GetNumberOfCells()));
}

//------------------------------------------------------------------------------
std::string DescribeSize(vtkDataSet* data)
{
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    const int* size = image->GetDimensions();
    return std::to_string(size[0]) + " &times; " + std::to_string(size[1]) + " &times; " +
      std::to_string(size[2]) + " samples";
  }
  return std::to_string(data->GetNumberOfCells()) + " cells, " +
    std::to_string(data->GetNumberOfPoints()) + " points";
}

//------------------------------------------------------------------------------
void WritePictures(std::ostream& out, const Comparison& comparison, bool canDraw)
{
  vtkDataSet* data = comparison.Data;
  vtkTable* table = comparison.Table;
  const double isovalue = table->GetValueByName(0, "Isovalue").ToDouble();
  out << "<h2>Pictures of isovalue " << Format(isovalue) << "</h2>\n";
  if (canDraw)
  {
    vtkNew<vtkCamera> close;
    close->DeepCopy(comparison.Camera);
    close->SetViewAngle(comparison.Camera->GetViewAngle() / 10.0);
    close->SetParallelScale(comparison.Camera->GetParallelScale() / 10.0);
    WriteFigure(out, DrawTriangles(data, isovalue, comparison.Camera),
      "Triangles of " + GetExtractionName(data));
    WriteFigure(out, DrawRayTraced(data, isovalue, comparison.Camera), "Ray traced");
    WriteFigure(out, DrawTriangles(data, isovalue, close), "The centre, magnified ten times");
    WriteFigure(out, DrawRayTraced(data, isovalue, close), "The same, ray traced");
  }
  const std::string method = table->GetValueByName(0, "Method").ToString();
  const vtkIdType vertices = table->GetValueByName(0, "Points").ToTypeInt64();
  if (comparison.Difference->GetNumberOfPoints() > 0)
  {
    WriteFigure(out, DrawDifference(comparison.Difference, GetCellSize(data)),
      "Where the surface of " + method +
        " is behind (red) or in front of (blue) the isosurface along the ray, saturated at one "
        "cell; yellow where only one of the two is present");
  }
  if (canDraw && comparison.Mesh->GetNumberOfPolys() > 0)
  {
    WriteFigure(out, DrawErrors(comparison.Mesh, vertices, comparison.Camera),
      "The distance of " + method + " from the isosurface");
    WriteFigure(
      out, DrawDistances(comparison), "The same, as a distribution over the triangles", true);
  }
}

}

//------------------------------------------------------------------------------
void WriteReport(const Comparison& comparison, const std::string& fileName)
{
  const std::string whyNot = vtkIsosurfaceComparisonFilter::WhyNoPictures();
  std::ostringstream out;
  out
    << "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\n<title>Isosurfaces of "
    << Escape(comparison.Input) << "</title>\n<style>" << Style << "</style></head>\n<body>\n"
    << "<h1>Isosurfaces of " << Escape(comparison.Input) << "</h1>\n<p>"
    << DescribeSize(comparison.Data) << ". Repeats: " << comparison.Repeats << ". "
    << Escape(comparison.Machine) << ".</p>\n<p><code>" << Escape(comparison.Command)
    << "</code></p>\n";
  WriteSummary(out, comparison.Table);
  WriteTables(out, comparison.Table);
  if (!whyNot.empty())
  {
    out << "<p>" << Escape(whyNot) << "</p>\n";
  }
  if (whyNot.empty() && comparison.Table->GetNumberOfRows() > 0)
  {
    WriteFigure(out, DrawTotals(comparison.Table),
      "The time from a new isovalue to a number of pictures of it, for the first isovalue", true);
  }
  if (!comparison.Crossovers.empty())
  {
    WriteCrossover(out, comparison.Crossovers);
  }
  const bool hasSurface = comparison.Difference->GetNumberOfPoints() > 0;
  if (hasSurface)
  {
    WritePictures(out, comparison, whyNot.empty());
  }
  out << "</body>\n</html>\n";

  Programs::WriteFile(out.str(), fileName);
}

}
