// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceInputs.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceInputs::SetNumber(int number)
{
  while (this->GetNumber() < number)
  {
    this->Inputs.push_back(this->NewInput(this->GetNumber()));
  }
  this->Inputs.resize(static_cast<std::size_t>(number));
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceInputs::FindCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  vtkIdType before = 0;
  for (int i = 0; i < hit.Field; ++i)
  {
    before += this->Get(i).GetNumberOfCells();
  }
  return before + this->Get(hit.Field).FindCell(hit, parametric);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceInputs::FindPoint(const vtkirt::Hit& hit) const
{
  vtkIdType before = 0;
  for (int i = 0; i < hit.Field; ++i)
  {
    before += this->Get(i).GetNumberOfPoints();
  }
  return before + this->Get(hit.Field).FindPoint(hit);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceInputs::GetNumberOfCells() const
{
  vtkIdType all = 0;
  for (const auto& input : this->Inputs)
  {
    all += input->GetNumberOfCells();
  }
  return all;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceInputs::GetNumberOfPoints() const
{
  vtkIdType all = 0;
  for (const auto& input : this->Inputs)
  {
    all += input->GetNumberOfPoints();
  }
  return all;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceInputs::FindConnection(vtkIdType& cellId) const
{
  vtkIdType cell = cellId;
  for (int i = 0; i < this->GetNumber(); ++i)
  {
    const vtkIdType count = this->Get(i).GetNumberOfCells();
    if (cell >= 0 && cell < count)
    {
      cellId = cell;
      return i;
    }
    cell -= count;
  }
  return -1;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceInputs::ReadSlab(int threads)
{
  const auto unread = std::find_if(this->Inputs.begin(), this->Inputs.end(),
    [](const std::unique_ptr<vtkIsosurfaceRayTraceInput>& input)
    { return input->GetFractionRead() < 1.0; });
  if (unread != this->Inputs.end())
  {
    (*unread)->ReadSlab(threads);
  }
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceInputs::GetFractionRead() const
{
  double sum = 0.0;
  for (const auto& input : this->Inputs)
  {
    sum += input->GetFractionRead();
  }
  return sum / this->GetNumber();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceInputs::IsCoarse() const
{
  return std::any_of(this->Inputs.begin(), this->Inputs.end(),
    [](const std::unique_ptr<vtkIsosurfaceRayTraceInput>& input) { return input->IsCoarse(); });
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceInputs::HasData() const
{
  return std::any_of(this->Inputs.begin(), this->Inputs.end(),
    [](const std::unique_ptr<vtkIsosurfaceRayTraceInput>& input) { return input->HasData(); });
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceInputs::GetWarning() const
{
  std::string warning;
  for (int i = 0; i < this->GetNumber() && warning.empty(); ++i)
  {
    warning = this->Get(i).GetWarning();
  }
  return warning;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceInputs::IsIntact(int threads) const
{
  return std::all_of(this->Inputs.begin(), this->Inputs.end(),
    [threads](const std::unique_ptr<vtkIsosurfaceRayTraceInput>& input)
    { return input->IsIntact(threads); });
}

//------------------------------------------------------------------------------
vtkirt::FieldStatistics vtkIsosurfaceRayTraceInputs::GetStatistics() const
{
  vtkirt::FieldStatistics all;
  for (const auto& input : this->Inputs)
  {
    if (const vtkirt::TracedField* field = input->GetField())
    {
      all += field->GetStatistics();
    }
  }
  return all;
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceInputs::GetGradientSeconds() const
{
  double all = 0.0;
  for (const auto& input : this->Inputs)
  {
    const vtkirt::TracedField* field = input->GetField();
    all += field ? field->GetGradientSeconds() : 0.0;
  }
  return all;
}

VTK_ABI_NAMESPACE_END
