// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What vtkIsosurfaceComparisonFilter says of the accuracy of surfaces, against what is known of
// planes and spheres, and against cells taken apart by brute force.

#include "AnalyticFields.h"
#include "Checks.h"
#include "TestImages.h"
#include "vtkIsosurfaceComparisonFilter.h"

#include "vtkAppendFilter.h"
#include "vtkCellArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariant.h"

#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

using namespace MapperTesting;
using AnalyticFields::Point;

namespace
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkIsosurfaceComparisonFilter> Compare(
  vtkDataSet* data, double isovalue, int pixels = 128, int outputRow = 0)
{
  auto comparison = vtkSmartPointer<vtkIsosurfaceComparisonFilter>::New();
  comparison->SetInputData(data);
  comparison->SetValue(0, isovalue);
  comparison->SetNumberOfRepeats(1);
  comparison->MarchingCubesOff();
  comparison->SynchronizedTemplatesOff();
  comparison->ContourFilterOff();
  comparison->SpanSpaceOff();
  comparison->PicturesOff();
  comparison->SetImageSize(pixels, pixels);
  comparison->SetOutputRow(outputRow);
  comparison->Update();
  return comparison;
}

double Get(vtkIsosurfaceComparisonFilter* comparison, vtkIdType row, const char* column)
{
  return comparison->GetOutput()->GetValueByName(row, column).ToDouble();
}

//------------------------------------------------------------------------------
// The trilinear interpolant of a plane is the plane, and so is the mesh: to rounding if the
// coordinates can be written in binary, else as far as the mesh has floats.
void TestPlanes(Checks& checks)
{
  const auto halves = Compare(NewCube(9, AnalyticFields::Plane{ { 1.0, 0.0, 0.0 }, 0.125 }), 0.0);
  checks.Near(Get(halves, 0, "MaximumDistance"), 0.0, 1e-15, "distance of a plane between samples");
  checks.Near(Get(halves, 0, "MaximumNormalError"), 0.0, 1e-5, "normal of a plane");
  checks.Equal(Get(halves, 0, "DifferentPixels"), 0.0, "pixels of a plane that differ");
  checks.Equal(Get(halves, 0, "LostPoints"), 0.0, "lost points of a plane");
  checks.Equal(Get(halves, 0, "AmbiguousCells"), 0.0, "ambiguous cells of a plane");

  const auto oblique = Compare(NewCube(9, AnalyticFields::Plane{ { 3.0, -2.0, 1.0 }, 0.3 }), 0.0);
  checks.That(Get(oblique, 0, "Triangles") > 100.0, "an oblique plane has triangles");
  checks.Near(Get(oblique, 0, "MaximumDistance"), 0.0, 1e-6, "distance of an oblique plane");
  checks.Near(Get(oblique, 0, "MedianNormalError"), 0.0, 1e-3, "normal of an oblique plane");
}

//------------------------------------------------------------------------------
// Along x the samples are 0 and 1; the other way they rise, so that a triangle that is flat in a
// cell is not on the isosurface x (1 + a y + b z) = 1/2 in its middle. Of the cell as an image, or
// as a mesh.
void CheckKnownDistance(Checks& checks, vtkDataSet* cell)
{
  const auto comparison = Compare(cell, 0.5);
  auto* mesh = vtkPolyData::SafeDownCast(comparison->GetOutputDataObject(1));
  vtkDataArray* cells = mesh->GetPointData()->GetArray("DistanceInCells");
  vtkDataArray* world = mesh->GetPointData()->GetArray("Distance");
  checks.Equal<vtkIdType>(mesh->GetNumberOfPoints(), 6, "points of two triangles and centroids");
  checks.Equal<vtkIdType>(mesh->GetNumberOfPolys(), 6, "triangles cut in three");
  double largest = 0.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    // The gradient line by bisection, with the interpolant written down by hand.
    const auto value = [](const Point& p)
    { return p[0] * (1.0 + p[1] + 2.0 * p[2] + 4.0 * p[1] * p[2]) - 0.5; };
    Point p;
    mesh->GetPoint(i, p.data());
    p = { p[0] / 2.0, p[1] / 2.0, p[2] / 2.0 };
    const Point gradient = { 1.0 + p[1] + 2.0 * p[2] + 4.0 * p[1] * p[2], p[0] * (1.0 + 4.0 * p[2]),
      p[0] * (2.0 + 4.0 * p[1]) };
    const double scale = (value(p) < 0.0 ? 1.0 : -1.0) / vtkMath::Norm(gradient.data());
    const auto along = [&](double t) -> Point
    {
      return { p[0] + t * scale * gradient[0], p[1] + t * scale * gradient[1],
        p[2] + t * scale * gradient[2] };
    };
    double low = 0.0;
    double high = 0.5;
    for (int step = 0; step < 60; ++step)
    {
      const double middle = 0.5 * (low + high);
      ((value(along(middle)) < 0.0) == (value(p) < 0.0) ? low : high) = middle;
    }
    largest = std::max(largest, low);
    checks.Near(cells->GetComponent(i, 0), low, 1e-6, "distance in cells");
    checks.Near(world->GetComponent(i, 0), 2.0 * low, 2e-6, "distance in the world");
  }
  checks.That(largest > 0.01, "the test has a distance to measure");
  checks.Near(Get(comparison, 0, "MaximumDistanceInCells"), largest, 1e-6, "largest distance");
  checks.Near(Get(comparison, 0, "MaximumDistance"), 2.0 * largest, 2e-6, "largest in the world");
}

//------------------------------------------------------------------------------
// A mesh that is off by a known distance must be said to be.
void TestKnownDistance(Checks& checks)
{
  vtkNew<vtkImageData> cell;
  cell->SetDimensions(2, 2, 2);
  cell->SetSpacing(2.0, 2.0, 2.0);
  cell->AllocateScalars(VTK_DOUBLE, 1);
  const double values[8] = { 0, 1, 0, 2, 0, 3, 0, 8 };
  for (int i = 0; i < 8; ++i)
  {
    cell->SetScalarComponentFromDouble(i & 1, i >> 1 & 1, i >> 2, 0, values[i]);
  }
  CheckKnownDistance(checks, cell);
  vtkNew<vtkAppendFilter> voxel;
  voxel->AddInputData(cell);
  voxel->Update();
  CheckKnownDistance(checks, voxel->GetOutput());
}

//------------------------------------------------------------------------------
double Order(double coarse, double fine)
{
  return std::log2(coarse / fine);
}

//------------------------------------------------------------------------------
// Triangles are chords: halving the cells quarters the distance, and halves the error of normals.
void TestOrder(Checks& checks)
{
  constexpr int levels = 3;
  std::array<vtkSmartPointer<vtkIsosurfaceComparisonFilter>, levels> comparisons;
  for (int level = 0; level < levels; ++level)
  {
    // No sample is on the sphere.
    const auto ball =
      NewCube(12 * (1 << level) + 1, AnalyticFields::Sphere{ { 0.013, -0.021, 0.017 }, 0.71 });
    comparisons[level] = Compare(ball, 0.0);
    checks.Equal(Get(comparisons[level], 0, "LostPoints"), 0.0, "lost points of a sphere");
  }
  for (const char* column : { "MedianDistance", "P99Distance" })
  {
    const double order =
      Order(Get(comparisons.front(), 0, column), Get(comparisons.back(), 0, column)) / (levels - 1);
    std::cout << column << " is of order " << order << "\n";
    checks.Near(order, 2.0, 0.15, column);
  }
  const double order =
    Order(Get(comparisons[1], 0, "MedianNormalError"), Get(comparisons[2], 0, "MedianNormalError"));
  std::cout << "MedianNormalError is of order " << order << "\n";
  checks.Near(order, 1.0, 0.15, "MedianNormalError");

  // Ours is the isosurface.
  checks.That(
    Get(comparisons[0], 1, "MaximumDistanceInCells") < 1e-11, "hits are on the isosurface");
  checks.That(Get(comparisons[0], 1, "MaximumNormalError") < 1e-8, "normals of hits are gradients");
  checks.That(std::isnan(Get(comparisons[0], 1, "TopologyDifferences")), "nothing to compare with");
}

//------------------------------------------------------------------------------
// The picture of the difference agrees with the table, and with where the surfaces are.
void TestDifferenceImage(Checks& checks)
{
  const auto ball = NewCube(9, AnalyticFields::Sphere{ { 0.0, 0.0, 0.0 }, 0.7 });
  const auto comparison = Compare(ball, 0.0, 200);
  auto* image = vtkImageData::SafeDownCast(comparison->GetOutputDataObject(2));
  checks.Equal(image->GetDimensions()[0], 200, "width of the difference");
  checks.Equal(std::string(image->GetPointData()->GetScalars()->GetName()),
    std::string("DepthDifference"), "active scalars of the difference");
  vtkDataArray* depths = image->GetPointData()->GetArray("DepthDifference");
  vtkDataArray* coverage = image->GetPointData()->GetArray("Coverage");
  int counts[4] = { 0, 0, 0, 0 };
  double largest = 0.0;
  double sum = 0.0;
  for (vtkIdType i = 0; i < depths->GetNumberOfTuples(); ++i)
  {
    const int covered = static_cast<int>(coverage->GetComponent(i, 0));
    const double depth = depths->GetComponent(i, 0);
    ++counts[covered];
    checks.Equal(covered != 1, std::isnan(depth), "a depth where both surfaces are");
    if (covered == 1)
    {
      largest = std::max(largest, std::abs(depth));
      sum += depth;
    }
  }
  checks.Equal(
    Get(comparison, 0, "CoveredPixels"), 1.0 * (counts[1] + counts[2]), "covered pixels");
  checks.Equal(
    Get(comparison, 0, "DifferentPixels"), 1.0 * (counts[2] + counts[3]), "different pixels");
  checks.That(
    counts[1] > 5000 && counts[0] > 5000, "the ball is in the picture, and not all of it");
  checks.That(counts[2] > 0, "the outline of chords is inside that of the ball");
  checks.That(counts[2] + counts[3] < 0.05 * counts[1], "the outlines are about the same");
  checks.That(largest > 1e-3, "chords are not the ball");
  checks.That(sum > 0.0, "chords are inside the ball, behind its surface");

  const auto ours = Compare(ball, 0.0, 200, 1);
  auto* hits = vtkPolyData::SafeDownCast(ours->GetOutputDataObject(1));
  checks.Equal(
    1.0 * hits->GetNumberOfVerts(), Get(ours, 1, "CoveredPixels"), "hits of the picture");
  const auto none = Compare(ball, 0.0, 200, 2);
  hits = vtkPolyData::SafeDownCast(none->GetOutputDataObject(1));
  checks.Equal<vtkIdType>(hits->GetNumberOfPoints(), 0, "points of a row that does not exist");
}

//------------------------------------------------------------------------------
// A cell taken apart by brute force: a lattice of points is flooded from corner to corner.

using Corners = std::array<double, 8>;
using Triangle = std::array<Point, 3>;

double Interpolate(const Corners& corners, const Point& p)
{
  double value = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    value += corners[i] * ((i & 1) != 0 ? p[0] : 1.0 - p[0]) *
      ((i >> 1 & 1) != 0 ? p[1] : 1.0 - p[1]) * ((i >> 2) != 0 ? p[2] : 1.0 - p[2]);
  }
  return value;
}

// Edges belong to the triangle: nothing may slip through between two of them.
bool AreParted(const Point& a, const Point& b, const Triangle& triangle)
{
  constexpr double tolerance = 1e-6;
  Point ab;
  Point u;
  Point v;
  Point w;
  vtkMath::Subtract(b.data(), a.data(), ab.data());
  vtkMath::Subtract(triangle[1].data(), triangle[0].data(), u.data());
  vtkMath::Subtract(triangle[2].data(), triangle[0].data(), v.data());
  vtkMath::Subtract(a.data(), triangle[0].data(), w.data());
  Point normal;
  vtkMath::Cross(u.data(), v.data(), normal.data());
  const double slope = vtkMath::Dot(normal.data(), ab.data());
  if (std::abs(slope) < 1e-12)
  {
    return false;
  }
  const double t = -vtkMath::Dot(normal.data(), w.data()) / slope;
  const Point p = { w[0] + t * ab[0], w[1] + t * ab[1], w[2] + t * ab[2] };
  const double scale = vtkMath::Dot(normal.data(), normal.data());
  Point pv;
  Point up;
  vtkMath::Cross(p.data(), v.data(), pv.data());
  vtkMath::Cross(u.data(), p.data(), up.data());
  const double s = vtkMath::Dot(pv.data(), normal.data()) / scale;
  const double r = vtkMath::Dot(up.data(), normal.data()) / scale;
  return t >= 0.0 && t <= 1.0 && s >= -tolerance && r >= -tolerance && s + r <= 1.0 + tolerance;
}

// Which corners are together, for points on a lattice between whose neighbours one may pass or not.
template <typename MayPass>
std::array<bool, 64> Flood(int steps, const MayPass& mayPass)
{
  const int side = steps + 1;
  std::vector<int> parents(static_cast<std::size_t>(side * side * side));
  std::iota(parents.begin(), parents.end(), 0);
  const auto find = [&parents](int i)
  {
    while (parents[i] != i)
    {
      parents[i] = parents[parents[i]];
      i = parents[i];
    }
    return i;
  };
  const auto number = [side](int x, int y, int z) { return x + side * (y + side * z); };
  const auto point = [steps](int x, int y, int z) -> Point {
    return { 1.0 * x / steps, 1.0 * y / steps, 1.0 * z / steps };
  };
  for (int z = 0; z < side; ++z)
  {
    for (int y = 0; y < side; ++y)
    {
      for (int x = 0; x < side; ++x)
      {
        const int next[3][3] = { { x + 1, y, z }, { x, y + 1, z }, { x, y, z + 1 } };
        for (const auto& n : next)
        {
          if (std::max({ n[0], n[1], n[2] }) < side &&
            mayPass(point(x, y, z), point(n[0], n[1], n[2])))
          {
            parents[find(number(x, y, z))] = find(number(n[0], n[1], n[2]));
          }
        }
      }
    }
  }
  std::array<bool, 64> together;
  for (int i = 0; i < 64; ++i)
  {
    const int a = find(number((i & 1) * steps, (i >> 1 & 1) * steps, (i >> 2 & 1) * steps));
    const int b = find(number((i >> 3 & 1) * steps, (i >> 4 & 1) * steps, (i >> 5) * steps));
    together[i] = a == b;
  }
  return together;
}

std::vector<Triangle> Extract(vtkImageData* image)
{
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(image);
  edges->SetValue(0, 0.0);
  edges->Update();
  vtkPolyData* mesh = edges->GetOutput();
  std::vector<Triangle> triangles(static_cast<std::size_t>(mesh->GetNumberOfPolys()));
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPolys(); ++i)
  {
    mesh->GetPolys()->GetCellAtId(i, ids);
    for (int corner = 0; corner < 3; ++corner)
    {
      mesh->GetPoint(ids->GetId(corner), triangles[i][corner].data());
    }
  }
  return triangles;
}

void TestTopology(Checks& checks)
{
  std::mt19937 bits(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  vtkNew<vtkImageData> cell;
  cell->SetDimensions(2, 2, 2);
  cell->AllocateScalars(VTK_DOUBLE, 1);
  int ambiguous = 0;
  int different = 0;
  int tunnels = 0;
  int undecided = 0;
  for (int round = 0; round < 150; ++round)
  {
    Corners corners;
    for (int i = 0; i < 8; ++i)
    {
      // Half of them are two corners against six, where tunnels are.
      corners[i] = round % 2 == 0 ? uniform(bits)
                                  : (i == 0 || i == 7 ? 1.0 : -0.35) * (1.0 + 0.5 * uniform(bits));
      cell->SetScalarComponentFromDouble(i & 1, i >> 1 & 1, i >> 2, 0, corners[i]);
    }
    cell->Modified();
    const auto comparison = Compare(cell, 0.0, 1);

    const auto sameSign = [&corners](const Point& a, const Point& b)
    { return (Interpolate(corners, a) >= 0.0) == (Interpolate(corners, b) >= 0.0); };
    const std::vector<Triangle> mesh = Extract(cell);
    const auto notParted = [&mesh](const Point& a, const Point& b)
    {
      return std::none_of(mesh.begin(), mesh.end(),
        [&a, &b](const Triangle& triangle) { return AreParted(a, b, triangle); });
    };
    const auto alongEdges = Flood(1, sameSign);
    const auto isosurface = Flood(31, sameSign);
    const auto triangles = Flood(12, notParted);
    if (isosurface != Flood(23, sameSign) || triangles != Flood(9, notParted))
    {
      ++undecided; // A neck too narrow for a lattice.
      continue;
    }
    // Two regions are inside and outside: of 64 pairs all that have the same sign are together.
    bool isAmbiguous = false;
    for (int i = 0; i < 64; ++i)
    {
      const bool same = (corners[i & 7] >= 0.0) == (corners[i >> 3] >= 0.0);
      isAmbiguous = isAmbiguous || same != alongEdges[i];
    }
    const bool isDifferent = isAmbiguous && isosurface != triangles;
    checks.Equal(Get(comparison, 0, "AmbiguousCells"), isAmbiguous ? 1.0 : 0.0, "ambiguous");
    checks.Equal(Get(comparison, 0, "TopologyDifferences"), isDifferent ? 1.0 : 0.0,
      "topology of cell " + std::to_string(round));
    ambiguous += isAmbiguous ? 1 : 0;
    different += isDifferent ? 1 : 0;
    tunnels += round % 2 == 1 && isosurface != alongEdges ? 1 : 0;
  }
  std::cout << ambiguous << " ambiguous cells, " << different << " differ, " << tunnels
            << " tunnels, " << undecided << " undecided\n";
  checks.That(different > 20 && ambiguous - different > 20, "cells of both kinds were tried");
  checks.That(tunnels > 10, "tunnels were tried");
  checks.That(undecided < 30, "most cells were decided by brute force");
}

//------------------------------------------------------------------------------
// An extent that does not begin at 0, a turned and stretched volume: nothing about it may change.
void TestGeometry(Checks& checks)
{
  const AnalyticFields::Gyroid gyroid = { 6.0 };
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(14, 13, 12);
  image->AllocateScalars(VTK_DOUBLE, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    Point p;
    image->GetPoint(i, p.data());
    image->GetPointData()->GetScalars()->SetComponent(i, 0, gyroid(p));
  }
  const auto plain = Compare(image, 0.1, 16);
  image->SetExtent(-20, -7, 30, 42, 5, 16);
  image->SetOrigin(-3.0, 4.0, 5.0);
  image->SetSpacing(2.0, 2.0, 2.0);
  image->SetDirectionMatrix(0.0, -1.0, 0.0, 0.6, 0.0, -0.8, 0.8, 0.0, 0.6);
  const auto moved = Compare(image, 0.1, 16);
  for (const char* column : { "AmbiguousCells", "TopologyDifferences", "LostPoints", "Triangles" })
  {
    checks.Equal(Get(moved, 0, column), Get(plain, 0, column), column);
  }
  for (const char* column : { "MedianDistanceInCells", "P99DistanceInCells" })
  {
    checks.Near(Get(moved, 0, column), Get(plain, 0, column), 1e-4, column);
  }
  checks.Near(
    Get(moved, 0, "MedianDistance"), 2.0 * Get(plain, 0, "MedianDistance"), 1e-4, "in the world");
  checks.That(Get(plain, 0, "MedianDistance") > 1e-3, "there is a distance to measure");
}

} // anonymous namespace

//------------------------------------------------------------------------------
int TestIsosurfaceComparisonFilterAccuracy(int, char*[])
{
  Checks checks;
  TestPlanes(checks);
  TestKnownDistance(checks);
  TestOrder(checks);
  TestDifferenceImage(checks);
  TestTopology(checks);
  TestGeometry(checks);
  return checks.Result();
}
