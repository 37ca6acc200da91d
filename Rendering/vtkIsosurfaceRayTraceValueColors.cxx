// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceValueColors.h"

#include "vtkColorTransferFunction.h"
#include "vtkDiscretizableColorTransferFunction.h"
#include "vtkPiecewiseFunction.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// What DeepCopy of VTK 9.1 leaves out: steps, and the colours of categories.
void CopySteps(
  vtkDiscretizableColorTransferFunction* function, vtkDiscretizableColorTransferFunction* copy)
{
  function->Build(); // It has the colours of categories as they were then.
  copy->SetDiscretize(function->GetDiscretize());
  copy->SetNumberOfValues(function->GetNumberOfValues());
  copy->SetUseLogScale(function->GetUseLogScale());
  const unsigned int colors = function->GetNumberOfIndexedColors();
  copy->SetNumberOfIndexedColors(colors);
  for (unsigned int i = 0; i < colors; ++i)
  {
    double color[4];
    function->GetIndexedColor(i, color);
    copy->SetIndexedColorRGBA(i, color);
  }
}

/// Replaces a function in the colour space Lab/CIEDE2000, in which VTK takes a twentieth of a
/// second for each colour, by what it is at many points between each two, and linear between these.
/// (VTK's has steps of 1/255 itself.)
void Tabulate(vtkColorTransferFunction* function)
{
  constexpr int steps = 64;
  const int count = function->GetSize();
  std::vector<double> points;
  for (int i = 0; i < count; ++i)
  {
    double node[6]; // with a midpoint and a sharpness
    function->GetNodeValue(i, node);
    points.insert(points.end(), node, node + 4);
    double next[6];
    function->GetNodeValue(std::min(i + 1, count - 1), next);
    if (next[0] <= node[0])
    {
      continue;
    }
    double colors[steps + 1][3];
    function->GetTable(node[0], next[0], steps + 1, colors[0]);
    for (int k = 1; k < steps; ++k)
    {
      points.push_back(node[0] + (next[0] - node[0]) * k / steps);
      points.insert(points.end(), colors[k], colors[k] + 3);
    }
  }
  function->SetColorSpaceToRGB();
  function->FillFromDataPointer(static_cast<int>(points.size() / 4), points.data());
}

/// A copy with all that GetColor uses, some of which DeepCopy of VTK 9.1 leaves out.
vtkSmartPointer<vtkColorTransferFunction> Copy(vtkColorTransferFunction* function)
{
  auto copy = vtk::TakeSmartPointer(function->NewInstance());
  copy->SetAllowDuplicateScalars(function->GetAllowDuplicateScalars());
  copy->DeepCopy(function);
  copy->SetNanColor(function->GetNanColor());
  copy->SetBelowRangeColor(function->GetBelowRangeColor());
  copy->SetUseBelowRangeColor(function->GetUseBelowRangeColor());
  copy->SetAboveRangeColor(function->GetAboveRangeColor());
  copy->SetUseAboveRangeColor(function->GetUseAboveRangeColor());
  copy->SetVectorMode(function->GetVectorMode());
  copy->SetVectorComponent(function->GetVectorComponent());
  if (auto* discrete = vtkDiscretizableColorTransferFunction::SafeDownCast(function))
  {
    CopySteps(discrete, vtkDiscretizableColorTransferFunction::SafeDownCast(copy));
  }
  if (copy->GetColorSpace() == VTK_CTF_LAB_CIEDE2000)
  {
    Tabulate(copy);
  }
  copy->Build();
  return copy;
}

vtkSmartPointer<vtkPiecewiseFunction> Copy(vtkPiecewiseFunction* function)
{
  auto copy = vtk::TakeSmartPointer(function->NewInstance());
  copy->SetAllowDuplicateScalars(function->GetAllowDuplicateScalars());
  copy->DeepCopy(function);
  copy->SetUseLogScale(function->GetUseLogScale());
  return copy;
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceValueColors::vtkIsosurfaceRayTraceValueColors(
  vtkVolumeProperty* property, int component)
  : Property(property)
  , Component(component)
{
  // A property makes missing functions at their first use, and is modified by that.
  if (property->GetColorChannels(component) == 1)
  {
    this->Gray = Copy(property->GetGrayTransferFunction(component));
  }
  else
  {
    this->Color = Copy(property->GetRGBTransferFunction(component));
  }
  this->Opacity = Copy(property->GetScalarOpacity(component));
  this->PropertyTime = property->GetMTime();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceValueColors::AreOf(vtkVolumeProperty* property, int component) const
{
  return this->Property == property && this->PropertyTime == property->GetMTime() &&
    this->Component == component;
}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceValueColors::GetColor(double value) const
{
  vtkirt::Vector3 color;
  if (this->Gray)
  {
    color.fill(this->Gray->GetValue(value));
  }
  else
  {
    this->Color->GetColor(value, color.data());
  }
  return color;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceValueColors::AreOfMagnitudes() const
{
  return this->Color && this->Color->GetVectorMode() == vtkScalarsToColors::MAGNITUDE;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceValueColors::GetVectorComponent() const
{
  return this->Color ? std::max(0, this->Color->GetVectorComponent()) : 0;
}

//------------------------------------------------------------------------------
std::array<double, 4> vtkIsosurfaceRayTraceValueColors::Get(double value) const
{
  const vtkirt::Vector3 color = this->GetColor(value);
  return { color[0], color[1], color[2], std::clamp(this->GetOpacity(value), 0.0, 1.0) };
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceValueColors::GetOpacity(double value) const
{
  return this->Opacity->GetValue(value);
}

//------------------------------------------------------------------------------
std::vector<double> vtkIsosurfaceRayTraceValueColors::FindNodes() const
{
  std::vector<double> nodes;
  const auto add = [&nodes](auto* function)
  {
    double node[6];
    for (int i = 0; i < function->GetSize(); ++i)
    {
      function->GetNodeValue(i, node);
      nodes.push_back(node[0]);
    }
  };
  if (this->Gray)
  {
    add(this->Gray.Get());
  }
  else
  {
    add(this->Color.Get());
  }
  add(this->Opacity.Get());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

VTK_ABI_NAMESPACE_END
