// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Every pixel against the exact result: a plane, which trilinear interpolation reproduces, and a
// ball, whose error falls with the square of the spacing.

#include "AnalyticFields.h"
#include "Checks.h"
#include "DepthPicture.h"
#include "TestImages.h"
#include "TestScene.h"

#include <algorithm>

using namespace MapperTesting;

namespace
{

double Dot(const AnalyticFields::Point& a, const AnalyticFields::Point& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The nearest distance of a ray of a pixel to the middle of the world.
double GetDistanceOfRay(const DepthPicture& picture, int x, int y)
{
  const AnalyticFields::Point a = picture.GetPoint(x, y, 0.0);
  const AnalyticFields::Point b = picture.GetPoint(x, y, 1.0);
  const AnalyticFields::Point along = { b[0] - a[0], b[1] - a[1], b[2] - a[2] };
  const double t = -Dot(a, along) / Dot(along, along);
  const AnalyticFields::Point nearest = { a[0] + t * along[0], a[1] + t * along[1],
    a[2] + t * along[2] };
  return std::sqrt(Dot(nearest, nearest));
}

/// Where the ray of a pixel meets the plane: how far inside the cube, negative if outside.
double GetDepthInCube(const DepthPicture& picture, int x, int y, const AnalyticFields::Plane& plane)
{
  const AnalyticFields::Point a = picture.GetPoint(x, y, 0.0);
  const AnalyticFields::Point b = picture.GetPoint(x, y, 1.0);
  const double t = plane(a) / (plane(a) - plane(b));
  double inside = 1.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    inside = std::min(inside, 1.0 - std::abs(a[i] + t * (b[i] - a[i])));
  }
  return inside;
}

void CheckPlane(Checks& check, bool parallel)
{
  const AnalyticFields::Plane plane = { { 0.48, -0.6, 0.64 }, 0.1 };
  const auto image = NewCube(7, plane);
  Scene scene(image);
  scene.Renderer->GetActiveCamera()->SetParallelProjection(parallel);
  scene.Window->Render();
  const DepthPicture picture(scene.Window, scene.Renderer);
  int hits = 0;
  double worst = 0.0;
  for (int y = 0; y < picture.GetHeight(); ++y)
  {
    for (int x = 0; x < picture.GetWidth(); ++x)
    {
      const double inside = GetDepthInCube(picture, x, y, plane);
      if (std::abs(inside) > 1e-4)
      {
        check.That(picture.IsEmpty(x, y) == (inside < 0.0),
          "pixel " + std::to_string(x) + ", " + std::to_string(y) + " shows the plane or does not");
      }
      if (!picture.IsEmpty(x, y))
      {
        ++hits;
        worst = std::max(worst, std::abs(plane(picture.GetPoint(x, y))));
      }
    }
  }
  std::cout << "plane: " << hits << " pixels, off by up to " << worst << "\n";
  check.That(hits > 3000, "the plane covers thousands of pixels");
  // The resolution of 24 bits of depth.
  check.Near(worst, 0.0, parallel ? 1e-6 : 2e-6, "the distance of a pixel to the plane");
}

double CheckBall(Checks& check, int samples, bool parallel)
{
  const double radius = 0.7;
  const auto image = NewBall(samples, radius);
  Scene scene(image);
  scene.Renderer->GetActiveCamera()->SetParallelProjection(parallel);
  scene.Window->Render();
  const DepthPicture picture(scene.Window, scene.Renderer);
  const double spacing = image->GetSpacing()[0];
  // Linear interpolation errs by h^2 / 8 times the second derivative of the field along each axis;
  // the three add up to 2 / r, where r is the smallest distance in a cell with the surface.
  const double bound = spacing * spacing / 4.0 / (radius - spacing) + 2e-6;
  int hits = 0;
  double worst = 0.0;
  for (int y = 0; y < picture.GetHeight(); ++y)
  {
    for (int x = 0; x < picture.GetWidth(); ++x)
    {
      const double distance = GetDistanceOfRay(picture, x, y);
      const bool isHit = !picture.IsEmpty(x, y);
      if (distance < radius - bound || distance > radius)
      {
        check.That(isHit == (distance < radius),
          "pixel " + std::to_string(x) + ", " + std::to_string(y) + " is in the disc or it is not");
      }
      if (isHit)
      {
        ++hits;
        const AnalyticFields::Point p = picture.GetPoint(x, y);
        worst = std::max(worst, std::abs(std::sqrt(Dot(p, p)) - radius));
      }
    }
  }
  std::cout << "ball of " << samples << ": " << hits << " pixels, off by up to " << worst
            << ", bound " << bound << "\n";
  check.That(hits > 3000, "the ball covers thousands of pixels");
  check.That(worst <= bound, "the ball is round to the second order");
  return worst;
}

}

int TestIsosurfaceRayTraceMapperAnalytic(int, char*[])
{
  Checks check;
  for (const bool parallel : { false, true })
  {
    CheckPlane(check, parallel);
    const double coarse = CheckBall(check, 17, parallel);
    const double fine = CheckBall(check, 33, parallel);
    check.Near(coarse / fine, 4.0, 0.6, "the error at twice the spacing, over the error");
  }
  return check.Result();
}
