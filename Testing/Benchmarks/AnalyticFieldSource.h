// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AnalyticFieldSource_h
#define AnalyticFieldSource_h

#include <vtkImageAlgorithm.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace Benchmark
{

/// Samples an analytic field on the cube from -1 to 1, as 16-bit numbers whose isovalue is 0. It
/// computes the requested extent only, so a volume larger than memory can be made slab by slab.
class AnalyticFieldSource : public vtkImageAlgorithm
{
public:
  static AnalyticFieldSource* New();
  vtkTypeMacro(AnalyticFieldSource, vtkImageAlgorithm);

  static std::vector<std::string> GetFieldNames();

  /// One of GetFieldNames. Throws std::runtime_error for another.
  void SetField(const std::string& name);
  /// The number of samples along each axis, 2 or more.
  void SetDimensions(const std::array<int, 3>& dimensions);

protected:
  AnalyticFieldSource();

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void ExecuteDataWithInformation(vtkDataObject* output, vtkInformation* info) override;

private:
  /// Between -1 and 1.
  std::function<double(const std::array<double, 3>&)> Field;
  std::array<int, 3> Dimensions = { 64, 64, 64 };
};

}

#endif
