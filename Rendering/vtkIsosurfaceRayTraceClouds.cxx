// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceRayTraceClouds.h"

#include "vtkIsosurfaceRayTraceScene.h"
#include "vtkIsosurfaceRayTraceValueColors.h"

#include "vtkDataArray.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// Whatever the unit distance is, numbers stay finite.
constexpr double LargestAttenuation = 1e30;
/// How far a function may be from the line between two nodes, or as a part of it where it is more
/// than 1.
constexpr double Tolerance = 1e-4;
/// How often the interval between two nodes is halved at most, next to jumps.
constexpr int MaximumHalvings = 16;

using Rgba = std::array<double, 4>;

class NodeMaker
{
public:
  NodeMaker(const vtkIsosurfaceRayTraceValueColors& colors, double unitDistance)
    : Colors(colors)
    , UnitDistance(unitDistance)
  {
  }

  std::vector<vtkirt::CloudNode> Make()
  {
    const std::vector<double> values = this->Colors.FindNodes();
    if (values.empty())
    {
      this->Add(0.0, this->Get(0.0));
      return this->Nodes;
    }
    // Where functions are not clamped, they jump to zero.
    this->Add(values.front(), this->Get(std::nextafter(values.front(), -HUGE_VAL)));
    Rgba last = this->Get(values.front());
    this->Add(values.front(), last);
    for (std::size_t i = 1; i < values.size(); ++i)
    {
      const Rgba next = this->Get(values[i]);
      this->AddBetween(values[i - 1], last, values[i], next, MaximumHalvings);
      this->Add(values[i], next);
      last = next;
    }
    this->Add(values.back(), this->Get(std::nextafter(values.back(), HUGE_VAL)));
    return this->Nodes;
  }

private:
  void Add(double value, const Rgba& rgba)
  {
    const double attenuation = std::min(rgba[3] / this->UnitDistance, LargestAttenuation);
    this->Nodes.push_back(
      { value, rgba[3] > 0.0 ? attenuation : 0.0, { rgba[0], rgba[1], rgba[2] } });
  }

  /// The opacity is an attenuation, which may be more than 1.
  Rgba Get(double value) const
  {
    const vtkirt::Vector3 color = this->Colors.GetColor(value);
    return { color[0], color[1], color[2], std::max(0.0, this->Colors.GetOpacity(value)) };
  }

  /// Adds nodes between two.
  void AddBetween(double low, const Rgba& atLow, double high, const Rgba& atHigh, int halvings)
  {
    if (halvings == 0 || this->IsLinear(low, atLow, high, atHigh))
    {
      return;
    }
    const double middle = low + 0.5 * (high - low);
    const Rgba there = this->Get(middle);
    this->AddBetween(low, atLow, middle, there, halvings - 1);
    this->Add(middle, there);
    this->AddBetween(middle, there, high, atHigh, halvings - 1);
  }

  bool IsLinear(double low, const Rgba& atLow, double high, const Rgba& atHigh) const
  {
    // Functions that are symmetric about the middle must not pass for linear.
    for (const double fraction : { 0.125, 0.3, 0.5, 0.7, 0.875 })
    {
      const Rgba there = this->Get(low + fraction * (high - low));
      for (std::size_t i = 0; i < 4; ++i)
      {
        const double linear = atLow[i] + fraction * (atHigh[i] - atLow[i]);
        if (std::abs(there[i] - linear) > Tolerance * std::max(1.0, std::abs(linear)))
        {
          return false;
        }
      }
    }
    return true;
  }

  const vtkIsosurfaceRayTraceValueColors& Colors;
  double UnitDistance;
  std::vector<vtkirt::CloudNode> Nodes;
};

using Nodes = std::vector<vtkirt::CloudNode>;

/// Those of the functions of a component of a property.
Nodes MakeNodes(vtkVolumeProperty* property, int component)
{
  const vtkIsosurfaceRayTraceValueColors colors(property, component);
  return NodeMaker(colors, property->GetScalarOpacityUnitDistance(component)).Make();
}

/// Multiplies the attenuation by a weight.
void Scale(double weight, Nodes& nodes)
{
  for (vtkirt::CloudNode& node : nodes)
  {
    node.Attenuation *= weight;
  }
}

/// Of two components, the first has the colours, and the second the attenuation.
std::vector<Nodes> SplitNodes(const Nodes& nodes)
{
  std::vector<Nodes> split(2, nodes);
  Scale(0.0, split[0]);
  for (vtkirt::CloudNode& node : split[1])
  {
    node.Color = { 0.0, 0.0, 0.0 };
  }
  return split;
}

/// Red, green, blue and the opacity are values themselves, up to a largest one.
std::vector<Nodes> MakeDirectNodes(double largest, double unitDistance)
{
  std::vector<Nodes> direct(4, Nodes{ { 0.0, 0.0, {} }, { largest, 0.0, {} } });
  for (std::size_t i = 0; i < 3; ++i)
  {
    direct[i][1].Color[i] = 1.0;
  }
  direct[3][1].Attenuation = std::min(1.0 / unitDistance, LargestAttenuation);
  return direct;
}

/// A component that is not shaded is as if the light were white and ambient.
vtkirt::CloudMaterial MakeMaterial(vtkVolumeProperty* property, int component)
{
  const vtkirt::Material own = vtkIsosurfaceRayTraceScene::GetMaterial(property, component);
  return own.Shade
    ? vtkirt::CloudMaterial{ own.Ambient, own.Diffuse, own.Specular, own.SpecularPower }
    : vtkirt::CloudMaterial{ 1.0, 0.0, 0.0, 1.0 };
}

}

namespace vtkIsosurfaceRayTraceClouds
{

//------------------------------------------------------------------------------
Components FindComponents(vtkDataArray* array, vtkVolumeProperty* property)
{
  Components components;
  if (array)
  {
    components.Count = array->GetNumberOfComponents();
    components.AreBytes = components.Count == 4 && !property->GetIndependentComponents() &&
      array->GetDataType() == VTK_UNSIGNED_CHAR;
  }
  return components;
}

//------------------------------------------------------------------------------
std::string FindProblem(const Components& components, vtkVolumeProperty* property)
{
  const int count = components.Count;
  if (count <= 1 || count == 2 || count == 4 || property->GetIndependentComponents())
  {
    return "";
  }
  return "The scalars have " + std::to_string(count) +
    " components, which vtkVolumeProperty::IndependentComponentsOff() takes for one cloud. That "
    "needs 2 (for colour and opacity) or 4 (red, green, blue and opacity). Call "
    "IndependentComponentsOn(), SetVectorModeToComponent() and SetVectorComponent(), or "
    "SetVectorModeToMagnitude().";
}

//------------------------------------------------------------------------------
int FindLitComponents(const Components& components, vtkVolumeProperty* property, int component)
{
  if (components.Count <= 1)
  {
    return property->GetShade(component) ? 1 : 0;
  }
  if (!property->GetIndependentComponents())
  {
    return property->GetShade() ? 1 : 0;
  }
  for (int i = 0; i < components.Count; ++i)
  {
    if (property->GetShade(i))
    {
      return components.Count;
    }
  }
  return 0;
}

//------------------------------------------------------------------------------
std::vector<vtkirt::CloudMaterial> MakeMaterials(
  const Components& components, vtkVolumeProperty* property, int component)
{
  const bool areMixed = components.Count > 1 && property->GetIndependentComponents();
  std::vector<vtkirt::CloudMaterial> materials;
  for (int i = 0; i < FindLitComponents(components, property, component); ++i)
  {
    const int dependent = components.Count <= 1 ? component : 0;
    materials.push_back(MakeMaterial(property, areMixed ? i : dependent));
  }
  return materials;
}

//------------------------------------------------------------------------------
std::unique_ptr<vtkirt::CloudMedium> MakeMedium(
  const Components& components, vtkVolumeProperty* property, int component)
{
  const bool areMixed = components.Count > 1 && property->GetIndependentComponents();
  std::vector<Nodes> nodes;
  if (components.Count <= 1)
  {
    nodes.push_back(MakeNodes(property, component));
  }
  else if (areMixed)
  {
    for (int i = 0; i < components.Count; ++i)
    {
      nodes.push_back(MakeNodes(property, i));
      Scale(property->GetComponentWeight(i), nodes.back());
    }
  }
  else
  {
    nodes = components.Count == 2 ? SplitNodes(MakeNodes(property, 0))
                                  : MakeDirectNodes(components.AreBytes ? 255.0 : 1.0,
                                      property->GetScalarOpacityUnitDistance());
  }
  auto medium = std::make_unique<vtkirt::CloudMedium>(nodes, areMixed || components.Count <= 1);
  medium->SetMaterials(MakeMaterials(components, property, component));
  return medium;
}

}

VTK_ABI_NAMESPACE_END
