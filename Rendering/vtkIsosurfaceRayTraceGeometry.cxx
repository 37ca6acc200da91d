// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceGeometry.h"

#include "vtkIsosurfaceRayTraceProblems.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkRectilinearGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using AxisCoordinates = std::vector<double>;

vtkDataArray* GetCoordinateArray(vtkRectilinearGrid* grid, std::size_t axis)
{
  return axis == 0 ? grid->GetXCoordinates()
                   : (axis == 1 ? grid->GetYCoordinates() : grid->GetZCoordinates());
}

AxisCoordinates GetCoordinates(vtkRectilinearGrid* grid, std::size_t axis)
{
  vtkDataArray* array = GetCoordinateArray(grid, axis);
  AxisCoordinates coordinates;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    coordinates.push_back(array->GetComponent(i, 0));
  }
  return coordinates;
}

/// The problem with the coordinates of an axis; empty if there is none.
std::string FindProblemOfAxis(const AxisCoordinates& coordinates, int points, char name)
{
  std::ostringstream problem;
  if (coordinates.size() != static_cast<std::size_t>(points))
  {
    problem << "The rectilinear grid has " << coordinates.size() << " " << name
            << " coordinates for " << points << " points along " << name << ". Give one for each.";
    return problem.str();
  }
  const double length = coordinates.back() - coordinates.front();
  if (!std::all_of(
        coordinates.begin(), coordinates.end(), [](double v) { return std::isfinite(v); }) ||
    !std::isfinite(length) || !(std::abs(length) >= std::numeric_limits<double>::min() * points))
  {
    problem << "The " << name << " coordinates of the rectilinear grid do not enclose a finite "
            << "volume: they must be finite numbers, and the last must differ from the first.";
    return problem.str();
  }
  for (std::size_t i = 1; i < coordinates.size(); ++i)
  {
    if ((coordinates[i] - coordinates[i - 1]) * std::copysign(1.0, length) < 0.0)
    {
      problem << "The " << name
              << " coordinates of the rectilinear grid are not in order: " << coordinates[i - 1]
              << " (number " << i - 1 << ") is followed by " << coordinates[i]
              << ". They must ascend or descend throughout.";
      return problem.str();
    }
  }
  return "";
}

/// The matrix of an image, with the position of the sample that is counted 0.
vtkirt::Matrix4 GetPhysicalFromObject(const double origin[3], const double spacing[3],
  const double direction[9], const vtkirt::Vector3& firstSample)
{
  vtkirt::Matrix4 matrix;
  vtkImageData::ComputeIndexToPhysicalMatrix(origin, spacing, direction, matrix.data());
  // The position of the first sample is computed first: no digits are lost in an extent far from
  // zero.
  const vtkirt::Vector3 first = vtkirt::TransformPoint(matrix, firstSample);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    matrix[4 * axis + 3] = first[axis];
  }
  return matrix;
}

/// Maps coordinates so that the first is 0 and the last, number n, is n; those that are equal stay
/// so. Returns whether all of them are whole numbers then, to within the rounding of the
/// coordinates.
bool Normalize(AxisCoordinates& coordinates)
{
  const double first = coordinates.front();
  const double back = coordinates.back();
  const auto last = static_cast<double>(coordinates.size() - 1);
  const double spacing = (back - first) / last;
  const double slack = 4.0 * std::numeric_limits<double>::epsilon() *
    (std::max(std::abs(first), std::abs(back)) / std::abs(spacing) + last);
  bool isEven = true;
  for (std::size_t i = 0; i < coordinates.size(); ++i)
  {
    coordinates[i] =
      coordinates[i] == back ? last : std::min((coordinates[i] - first) / spacing, last);
    isEven = isEven && std::abs(coordinates[i] - static_cast<double>(i)) <= slack;
  }
  for (std::size_t i = 0; isEven && i < coordinates.size(); ++i)
  {
    coordinates[i] = static_cast<double>(i);
  }
  return isEven;
}

}

//------------------------------------------------------------------------------
vtkirt::Index3 vtkIsosurfaceRayTraceGeometry::GetDimensions(vtkDataSet* grid)
{
  vtkirt::Index3 dimensions = { 0, 0, 0 };
  if (auto* image = vtkImageData::SafeDownCast(grid))
  {
    image->GetDimensions(dimensions.data());
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    rectilinear->GetDimensions(dimensions.data());
  }
  return dimensions;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceGeometry::FindProblem(vtkDataSet* grid)
{
  if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    const vtkirt::Index3 points = GetDimensions(grid);
    std::string problem;
    for (std::size_t axis = 0; axis < 3 && problem.empty(); ++axis)
    {
      problem = FindProblemOfAxis(GetCoordinates(rectilinear, axis), points[axis], "xyz"[axis]);
    }
    return problem;
  }
  const vtkIsosurfaceRayTraceGeometry geometry(grid, false);
  return vtkIsosurfaceRayTraceProblems::IsInvertible(geometry.PhysicalFromObject)
    ? ""
    : "The origin, spacing and direction of the input leave it without a finite volume. Give "
      "finite numbers, a spacing other than 0 and a direction matrix of full rank.";
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceGeometry::vtkIsosurfaceRayTraceGeometry(vtkDataSet* grid, bool atCenters)
  : AtCenters(atCenters)
{
  if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    this->SetRectilinear(rectilinear);
  }
  else
  {
    this->SetImage(vtkImageData::SafeDownCast(grid));
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceGeometry::SetImage(vtkImageData* image)
{
  image->GetOrigin(this->Origin.data());
  image->GetSpacing(this->Spacing.data());
  std::copy_n(image->GetDirectionMatrix()->GetData(), 9, this->Direction.begin());
  const int* extent = image->GetExtent();
  this->FirstIndex = { extent[0], extent[2], extent[4] };
  this->FirstSample = this->AtCenters ? 0.5 : 0.0;
  this->PhysicalFromObject =
    ::GetPhysicalFromObject(this->Origin.data(), this->Spacing.data(), this->Direction.data(),
      { this->FirstIndex[0] + this->FirstSample, this->FirstIndex[1] + this->FirstSample,
        this->FirstIndex[2] + this->FirstSample });
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceGeometry::SetRectilinear(vtkRectilinearGrid* grid)
{
  std::array<AxisCoordinates, 3> samples;
  bool isEven = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    AxisCoordinates& coordinates = samples[axis];
    coordinates = GetCoordinates(grid, axis);
    this->Coordinates[axis] = coordinates;
    if (this->AtCenters)
    {
      std::transform(coordinates.begin() + 1, coordinates.end(), coordinates.begin(),
        coordinates.begin(),
        [](double upper, double lower) { return lower + 0.5 * (upper - lower); });
      coordinates.pop_back();
    }
    this->Origin[axis] = coordinates.front();
    this->Spacing[axis] =
      (coordinates.back() - coordinates.front()) / static_cast<double>(coordinates.size() - 1);
    isEven = Normalize(coordinates) && isEven;
  }
  this->Direction = { 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };
  this->PhysicalFromObject = ::GetPhysicalFromObject(
    this->Origin.data(), this->Spacing.data(), this->Direction.data(), { 0.0, 0.0, 0.0 });
  if (!isEven)
  {
    this->Planes.emplace(std::move(samples));
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceGeometry::HasSamePoints(const vtkIsosurfaceRayTraceGeometry& other) const
{
  if (!this->Coordinates[0].empty())
  {
    return this->Coordinates == other.Coordinates;
  }
  return this->Origin == other.Origin && this->Spacing == other.Spacing &&
    this->Direction == other.Direction && this->FirstIndex == other.FirstIndex &&
    other.Coordinates[0].empty();
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceGeometry::GetIndex(std::size_t axis, double coordinate) const
{
  return (coordinate - this->Origin[axis]) / this->Spacing[axis] - this->FirstIndex[axis] -
    this->FirstSample;
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceGeometry::ComputeShareOfFirst(std::size_t axis, int sample) const
{
  const double* points = &this->Coordinates[axis][static_cast<std::size_t>(sample)];
  const double both = points[2] - points[0];
  return both != 0.0 ? (points[1] - points[0]) / both : 0.5;
}

VTK_ABI_NAMESPACE_END
