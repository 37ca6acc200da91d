// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Views.h"

#include <vtkCamera.h>
#include <vtkMath.h>

#include <algorithm>
#include <cmath>

namespace Benchmark
{
namespace
{

const double VerticalAngle = 30.0 / 1.4;

Triple GetMiddle(const Bounds& bounds)
{
  return { 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
    0.5 * (bounds[4] + bounds[5]) };
}

double GetDistance(const Bounds& bounds)
{
  const double half =
    0.5 * std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
  return half / std::sin(vtkMath::RadiansFromDegrees(15.0));
}

View LookFrom(
  const std::string& name, const Triple& focus, Triple toEye, double distance, const Triple& up)
{
  vtkMath::Normalize(toEye.data());
  View view{ name, focus, focus, up, VerticalAngle };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    view.Eye[axis] += distance * toEye[axis];
  }
  return view;
}

}

//------------------------------------------------------------------------------
void View::Apply(vtkCamera* camera) const
{
  camera->SetPosition(this->Eye.data());
  camera->SetFocalPoint(this->Focus.data());
  camera->SetViewUp(this->Up.data());
  camera->SetViewAngle(this->Angle);
}

//------------------------------------------------------------------------------
std::vector<View> MakeOrbit(const Bounds& bounds, int views)
{
  std::vector<View> orbit;
  for (int k = 0; k < views; ++k)
  {
    const double angle = 2.0 * vtkMath::Pi() * k / views;
    orbit.push_back(LookFrom("orbit " + std::to_string(k), GetMiddle(bounds),
      { std::sin(angle), -std::cos(angle), 0.3 }, GetDistance(bounds), { 0.0, 0.0, 1.0 }));
  }
  return orbit;
}

//------------------------------------------------------------------------------
std::vector<View> MakePaperViews(const Bounds& bounds)
{
  const Triple middle = GetMiddle(bounds);
  const double distance = GetDistance(bounds);
  const Triple upper = { middle[0], middle[1], bounds[4] + 0.75 * (bounds[5] - bounds[4]) };
  const Triple z = { 0.0, 0.0, 1.0 };
  return { LookFrom("front", middle, { 0.0, -1.0, 0.0 }, distance, z),
    LookFrom("close", upper, { 0.3, -1.0, 0.1 }, 0.4 * distance, z),
    LookFrom("from above", middle, { 0.4, -0.6, 1.0 }, distance, z),
    LookFrom("from the feet", middle, { 0.0, -0.1, -1.0 }, distance, { 0.0, 1.0, 0.0 }) };
}

//------------------------------------------------------------------------------
PictureRays::PictureRays(const View& view, int size)
  : Size(size)
  , Origin(view.Eye)
{
  vtkMath::Subtract(view.Focus.data(), view.Eye.data(), this->Forward.data());
  vtkMath::Normalize(this->Forward.data());
  vtkMath::Cross(this->Forward.data(), view.Up.data(), this->StepX.data());
  vtkMath::Normalize(this->StepX.data());
  vtkMath::Cross(this->StepX.data(), this->Forward.data(), this->StepY.data());
  const double pixel = 2.0 * std::tan(0.5 * vtkMath::RadiansFromDegrees(view.Angle)) / size;
  vtkMath::MultiplyScalar(this->StepX.data(), pixel);
  vtkMath::MultiplyScalar(this->StepY.data(), pixel);
}

//------------------------------------------------------------------------------
Triple PictureRays::GetDirection(int x, int y) const
{
  const double right = x + 0.5 - 0.5 * this->Size;
  const double up = y + 0.5 - 0.5 * this->Size;
  Triple direction;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    direction[axis] = this->Forward[axis] + right * this->StepX[axis] + up * this->StepY[axis];
  }
  return direction;
}

//------------------------------------------------------------------------------
PixelRectangle PictureRays::GetPixels(const Bounds& box) const
{
  double low[2] = { 1.0 * this->Size, 1.0 * this->Size };
  double high[2] = { 0.0, 0.0 };
  const double squaredPixel = vtkMath::Dot(this->StepX.data(), this->StepX.data());
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    const Triple toCorner = { box[corner & 1U] - this->Origin[0],
      box[2 + (corner >> 1U & 1U)] - this->Origin[1], box[4 + (corner >> 2U)] - this->Origin[2] };
    const double depth = vtkMath::Dot(toCorner.data(), this->Forward.data());
    if (depth <= 0.0)
    {
      return { 0, 0, this->Size, this->Size };
    }
    const Triple* steps[2] = { &this->StepX, &this->StepY };
    for (int axis = 0; axis < 2; ++axis)
    {
      const double pixel = 0.5 * this->Size +
        vtkMath::Dot(toCorner.data(), steps[axis]->data()) / (depth * squaredPixel);
      low[axis] = std::min(low[axis], pixel);
      high[axis] = std::max(high[axis], pixel);
    }
  }
  const auto toPixel = [this](double pixel)
  { return static_cast<int>(std::clamp(pixel, 0.0, 1.0 * this->Size)); };
  const int x = toPixel(std::floor(low[0]));
  const int y = toPixel(std::floor(low[1]));
  return { x, y, std::max(0, toPixel(std::ceil(high[0])) - x),
    std::max(0, toPixel(std::ceil(high[1])) - y) };
}

}
