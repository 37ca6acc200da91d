// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// How blocks of composite data are displayed, as ParaView's multiblock inspector sets it: by
// selectors, which are paths in the hierarchy of the data (see vtkDataAssembly::SelectNodes).

#ifndef vtkIsosurfaceRayTraceBlockStyles_h
#define vtkIsosurfaceRayTraceBlockStyles_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include <array>  // for std::array
#include <map>    // for std::map
#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCompositeDataDisplayAttributes;
class vtkDataObject;

class vtkIsosurfaceRayTraceBlockStyles
{
public:
  ///@{
  /// The blocks that are visible. Default: all.
  void AddVisible(const std::string& selector) { this->Visible.push_back(selector); }
  void RemoveVisible() { this->Visible.clear(); }
  ///@}

  ///@{
  /// The blocks that have colours and opacities of their own. Default: none.
  void SetColor(const std::string& selector, const std::array<double, 3>& color)
  {
    this->Colors[selector] = color;
  }
  void RemoveColors() { this->Colors.clear(); }
  void SetOpacity(const std::string& selector, double opacity)
  {
    this->Opacities[selector] = opacity;
  }
  void RemoveOpacities() { this->Opacities.clear(); }
  ///@}

  /// Whether any block is translucent.
  bool AreSomeTranslucent() const;

  /// Sets the attributes of the blocks of data, if they are multiblock data or a collection of
  /// partitioned data sets; others have none. What is said of the innermost node holds.
  void Apply(vtkDataObject* data, vtkCompositeDataDisplayAttributes* attributes) const;

private:
  std::vector<std::string> Visible = { "/" };
  std::map<std::string, std::array<double, 3>> Colors;
  std::map<std::string, double> Opacities;
};

VTK_ABI_NAMESPACE_END

#endif
