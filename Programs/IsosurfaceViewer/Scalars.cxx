// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Scalars.h"

#include <vtkArrayDispatch.h>
#include <vtkCell.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataArrayRange.h>
#include <vtkDataSet.h>
#include <vtkMath.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace Viewer
{
namespace
{

/// Those with a volume, or the data themselves. Throws if there is none.
std::vector<vtkDataSet*> FindBlocks(vtkDataObject* data)
{
  std::vector<vtkDataSet*> blocks = vtkCompositeDataSet::GetDataSets<vtkDataSet>(data);
  const auto isNone = [](vtkDataSet* block)
  { return block->GetNumberOfCells() == 0 || vtkPolyData::SafeDownCast(block); };
  blocks.erase(std::remove_if(blocks.begin(), blocks.end(), isNone), blocks.end());
  if (blocks.empty())
  {
    throw std::runtime_error("there is no image, no grid and no mesh of volume cells");
  }
  return blocks;
}

//------------------------------------------------------------------------------
/// Calls visit(value) for each tuple of an array.
struct VisitValues
{
  template <typename ArrayT, typename Visit>
  void operator()(ArrayT* array, const Visit& visit) const
  {
    for (const auto tuple : vtk::DataArrayTupleRange(array))
    {
      double value = static_cast<double>(tuple[0]);
      if (tuple.size() > 1)
      {
        value = std::sqrt(std::accumulate(tuple.begin(), tuple.end(), 0.0,
          [](double sum, auto x)
          { return sum + static_cast<double>(x) * static_cast<double>(x); }));
      }
      visit(value);
    }
  }
};

}

//------------------------------------------------------------------------------
Scalars::Scalars(vtkDataObject* data, const std::string& name)
  : Scalars(FindBlocks(data), name)
{
}

//------------------------------------------------------------------------------
Scalars::Scalars(const std::vector<vtkDataSet*>& blocks, const std::string& name)
  : Choice(blocks, name)
  , Range{ std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest() }
{
  std::vector<vtkDataArray*> arrays;
  for (vtkDataSet* block : blocks)
  {
    if (vtkDataArray* array = this->Choice.FindIn(block))
    {
      arrays.push_back(array);
    }
  }
  this->Vectors = arrays.front()->GetNumberOfComponents() > 1;
  for (vtkDataArray* array : arrays)
  {
    double range[2];
    array->GetFiniteRange(range, this->Vectors ? -1 : 0);
    this->Range = { std::min(this->Range[0], range[0]), std::max(this->Range[1], range[1]) };
  }
  if (!(this->Range[0] < this->Range[1]))
  {
    throw std::runtime_error("the array " + this->GetName() +
      " has no two different values, so there is no surface; --array chooses another:" +
      Programs::ListArrays(blocks));
  }
  // Whole numbers that are few have a part each.
  constexpr double mostBins = 256.0;
  const int type = arrays.front()->GetDataType();
  const bool areWhole = !this->Vectors && type != VTK_FLOAT && type != VTK_DOUBLE;
  const double values = areWhole ? this->Range[1] - this->Range[0] + 1.0 : mostBins;
  this->Histogram.resize(static_cast<std::size_t>(std::min(values, mostBins)), 0.0);
  for (vtkDataArray* array : arrays)
  {
    this->Count(array);
  }
}

//------------------------------------------------------------------------------
void Scalars::Count(vtkDataArray* array)
{
  const auto bins = static_cast<double>(this->Histogram.size());
  const double scale = bins / (this->Range[1] - this->Range[0]);
  const auto count = [&](double value)
  {
    if (std::isfinite(value))
    {
      const double bin = std::clamp((value - this->Range[0]) * scale, 0.0, bins - 1.0);
      this->Histogram[static_cast<std::size_t>(bin)] += 1.0;
    }
  };
  if (!vtkArrayDispatch::Dispatch::Execute(array, VisitValues{}, count))
  {
    VisitValues{}(array, count);
  }
}

//------------------------------------------------------------------------------
double Scalars::FindThreshold() const
{
  const double all = std::accumulate(this->Histogram.begin(), this->Histogram.end(), 0.0);
  double sum = 0.0;
  for (std::size_t bin = 0; bin < this->Histogram.size(); ++bin)
  {
    sum += static_cast<double>(bin) * this->Histogram[bin];
  }
  double below = 0.0;
  double sumBelow = 0.0;
  double best = -1.0;
  // Where parts are empty many thresholds are as good: the one in their middle.
  std::size_t first = 0;
  std::size_t last = 0;
  for (std::size_t bin = 0; bin + 1 < this->Histogram.size(); ++bin)
  {
    below += this->Histogram[bin];
    sumBelow += static_cast<double>(bin) * this->Histogram[bin];
    const double above = all - below;
    if (below > 0.0 && above > 0.0)
    {
      const double difference = sumBelow / below - (sum - sumBelow) / above;
      const double between = below * above * difference * difference;
      first = between > best ? bin : first;
      last = between >= best ? bin : last;
      best = std::max(best, between);
    }
  }
  const double edge = 0.5 * static_cast<double>(first + last) + 1.0;
  return this->Range[0] +
    edge / static_cast<double>(this->Histogram.size()) * (this->Range[1] - this->Range[0]);
}

//------------------------------------------------------------------------------
double Scalars::GetValue(vtkDataSet* block, vtkIdType cell, const double parametric[3]) const
{
  vtkDataArray* array = this->Choice.FindIn(block);
  const auto get = [&](vtkIdType tuple)
  {
    return this->Vectors ? vtkMath::Norm(array->GetTuple(tuple), array->GetNumberOfComponents())
                         : array->GetComponent(tuple, 0);
  };
  if (this->Choice.IsOfCells())
  {
    return get(cell);
  }
  vtkCell* interpolated = block->GetCell(cell);
  std::vector<double> weights(static_cast<std::size_t>(interpolated->GetNumberOfPoints()));
  double position[3];
  int part = 0;
  interpolated->EvaluateLocation(part, parametric, position, weights.data());
  double value = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    value += weights[i] * get(interpolated->GetPointId(static_cast<int>(i)));
  }
  return value;
}

}
