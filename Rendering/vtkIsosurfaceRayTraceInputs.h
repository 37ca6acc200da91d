// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The inputs of a mapper: one for each connection of its first port. Cells and points are numbered
// through all of them.

#ifndef vtkIsosurfaceRayTraceInputs_h
#define vtkIsosurfaceRayTraceInputs_h

#include "vtkIsosurfaceRayTraceInput.h"    // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                       // for vtkIdType

#include <cstddef>    // for std::size_t
#include <functional> // for std::function
#include <memory>     // for std::unique_ptr
#include <string>     // for std::string
#include <utility>    // for std::move
#include <vector>     // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTraceInputs
{
public:
  using Maker = std::function<std::unique_ptr<vtkIsosurfaceRayTraceInput>(int connection)>;

  /// The inputs are made when they are asked for first.
  explicit vtkIsosurfaceRayTraceInputs(Maker newInput)
    : NewInput(std::move(newInput))
  {
    this->SetNumber(1);
  }

  void SetNumber(int number);
  int GetNumber() const { return static_cast<int>(this->Inputs.size()); }
  vtkIsosurfaceRayTraceInput& Get(int connection) const
  {
    return *this->Inputs[static_cast<std::size_t>(connection)];
  }

  ///@{
  /// Those of the input that a hit is of, by numbers through all inputs.
  vtkIdType FindCell(
    const vtkIsosurfaceRayTracing::Hit& hit, vtkIsosurfaceRayTracing::Vector3& parametric) const;
  vtkIdType FindPoint(const vtkIsosurfaceRayTracing::Hit& hit) const;
  ///@}
  vtkIdType GetNumberOfCells() const;
  vtkIdType GetNumberOfPoints() const;

  /// The connection that has a cell, which becomes its number there; -1 if none has it.
  int FindConnection(vtkIdType& cellId) const;

  ///@{
  /// Of all inputs; see vtkIsosurfaceRayTraceInput.
  void ReadSlab(int threads);
  double GetFractionRead() const;
  bool IsCoarse() const;
  /// Whether any has data.
  bool HasData() const;
  /// Whether all samples are read, and traced.
  bool IsExact() const { return !this->IsCoarse() && this->GetFractionRead() == 1.0; }
  std::string GetWarning() const;
  bool IsIntact(int threads) const;
  vtkIsosurfaceRayTracing::FieldStatistics GetStatistics() const;
  double GetGradientSeconds() const;
  ///@}

private:
  Maker NewInput;
  std::vector<std::unique_ptr<vtkIsosurfaceRayTraceInput>> Inputs;
};

VTK_ABI_NAMESPACE_END

#endif
