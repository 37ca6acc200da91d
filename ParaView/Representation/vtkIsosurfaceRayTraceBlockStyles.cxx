// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceBlockStyles.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDataAssembly.h"
#include "vtkDataAssemblyUtilities.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkDataSet.h"
#include "vtkNew.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace
{
//------------------------------------------------------------------------------
// The nodes of composite data that selectors name.
class Nodes
{
public:
  Nodes(vtkDataObjectTree* root, vtkDataAssembly* hierarchy)
    : Hierarchy(hierarchy)
  {
    using Options = vtk::DataObjectTreeOptions;
    this->ByNumber[0] = root;
    for (const auto& node : vtk::Range(root, Options::TraverseSubTree | Options::SkipEmptyNodes))
    {
      this->ByNumber[node.GetFlatIndex()] = node.GetDataObject();
    }
  }

  // Calls function(block, value) with the blocks that have a value by their innermost node.
  template <typename Value, typename Function>
  void Visit(const std::map<std::string, Value>& values, const Function& function) const
  {
    std::map<unsigned int, Value> ofNodes; // Nodes come before those below them.
    for (const auto& [selector, value] : values)
    {
      for (const unsigned int number : this->Find(selector))
      {
        ofNodes[number] = value;
      }
    }
    for (const auto& [number, value] : ofNodes)
    {
      const auto node = this->ByNumber.find(number);
      if (node == this->ByNumber.end())
      {
        continue; // empty in this process
      }
      if (auto* tree = vtkCompositeDataSet::SafeDownCast(node->second))
      {
        for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets(tree))
        {
          function(block, value);
        }
      }
      else
      {
        function(node->second, value);
      }
    }
  }

private:
  std::vector<unsigned int> Find(const std::string& selector) const
  {
    return vtkDataAssemblyUtilities::GetSelectedCompositeIds({ selector }, this->Hierarchy);
  }

  vtkDataAssembly* Hierarchy;
  std::map<unsigned int, vtkDataObject*> ByNumber;
};
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceBlockStyles::AreSomeTranslucent() const
{
  return std::any_of(this->Opacities.begin(), this->Opacities.end(),
    [](const auto& item) { return item.second > 0.0 && item.second < 1.0; });
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceBlockStyles::Apply(
  vtkDataObject* data, vtkCompositeDataDisplayAttributes* attributes) const
{
  attributes->RemoveBlockVisibilities();
  attributes->RemoveBlockColors();
  attributes->RemoveBlockOpacities();
  const bool areAllVisible = this->Visible == std::vector<std::string>{ "/" };
  auto* tree = vtkDataObjectTree::SafeDownCast(data);
  const bool hasHierarchy =
    tree && (tree->IsA("vtkMultiBlockDataSet") || tree->IsA("vtkPartitionedDataSetCollection"));
  if (!hasHierarchy || (areAllVisible && this->Colors.empty() && this->Opacities.empty()))
  {
    return;
  }
  vtkNew<vtkDataAssembly> hierarchy;
  vtkDataAssemblyUtilities::GenerateHierarchy(tree, hierarchy);
  const Nodes nodes(tree, hierarchy);
  if (!areAllVisible)
  {
    std::map<std::string, bool> visible;
    for (const std::string& selector : this->Visible)
    {
      visible[selector] = true;
    }
    for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets(tree))
    {
      attributes->SetBlockVisibility(block, false);
    }
    nodes.Visit(visible,
      [attributes](vtkDataObject* block, bool isVisible)
      { attributes->SetBlockVisibility(block, isVisible); });
  }
  nodes.Visit(this->Colors,
    [attributes](vtkDataObject* block, const std::array<double, 3>& color)
    { attributes->SetBlockColor(block, color.data()); });
  nodes.Visit(this->Opacities,
    [attributes](vtkDataObject* block, double opacity)
    { attributes->SetBlockOpacity(block, opacity); });
}

VTK_ABI_NAMESPACE_END
