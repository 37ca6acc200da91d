// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceSource.h"

#include "vtkIsosurfaceRayTraceProblems.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <type_traits>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

template <typename T>
constexpr vtkirt::ScalarType IntegerType()
{
  using vtkirt::ScalarType;
  switch (sizeof(T))
  {
    case 1:
      return std::is_signed_v<T> ? ScalarType::Int8 : ScalarType::UInt8;
    case 2:
      return std::is_signed_v<T> ? ScalarType::Int16 : ScalarType::UInt16;
    case 4:
      return std::is_signed_v<T> ? ScalarType::Int32 : ScalarType::UInt32;
    default:
      return std::is_signed_v<T> ? ScalarType::Int64 : ScalarType::UInt64;
  }
}

/// The ray tracer's scalar type for a scalar type of VTK; none for types that are not numbers.
std::optional<vtkirt::ScalarType> FindScalarType(int vtkType)
{
  switch (vtkType)
  {
    case VTK_FLOAT:
      return vtkirt::ScalarType::Float32;
    case VTK_DOUBLE:
      return vtkirt::ScalarType::Float64;
    case VTK_CHAR:
      return IntegerType<char>();
    case VTK_SIGNED_CHAR:
      return IntegerType<signed char>();
    case VTK_UNSIGNED_CHAR:
      return IntegerType<unsigned char>();
    case VTK_SHORT:
      return IntegerType<short>();
    case VTK_UNSIGNED_SHORT:
      return IntegerType<unsigned short>();
    case VTK_INT:
      return IntegerType<int>();
    case VTK_UNSIGNED_INT:
      return IntegerType<unsigned int>();
    case VTK_LONG:
      return IntegerType<long>();
    case VTK_UNSIGNED_LONG:
      return IntegerType<unsigned long>();
    case VTK_LONG_LONG:
      return IntegerType<long long>();
    case VTK_UNSIGNED_LONG_LONG:
      return IntegerType<unsigned long long>();
    case VTK_ID_TYPE:
      return IntegerType<vtkIdType>();
    default:
      return std::nullopt;
  }
}

/// The magnitudes of vectors. For small types, single precision holds them as well.
vtkSmartPointer<vtkDataArray> ComputeMagnitudes(vtkDataArray* vectors)
{
  const bool isSingle = vectors->GetDataType() == VTK_FLOAT || vectors->GetDataTypeSize() <= 2;
  auto lengths =
    vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(isSingle ? VTK_FLOAT : VTK_DOUBLE));
  lengths->SetNumberOfTuples(vectors->GetNumberOfTuples());
  std::vector<double> vector(static_cast<std::size_t>(vectors->GetNumberOfComponents()));
  for (vtkIdType i = 0; i < vectors->GetNumberOfTuples(); ++i)
  {
    vectors->GetTuple(i, vector.data());
    double length = 0.0;
    for (const double component : vector)
    {
      length = std::hypot(length, component);
    }
    lengths->SetComponent(i, 0, length);
  }
  return lengths;
}

/// Whether any corner of a cell has one of some flags. Corners are counted from first.
bool HasFlagAtCorner(
  vtkUnsignedCharArray* flags, const vtkirt::Index3& first, const vtkirt::Index3& size, int bits)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    const vtkirt::Index3 index = { first[0] + (corner & 1), first[1] + (corner >> 1 & 1),
      first[2] + (corner >> 2) };
    if ((flags->GetValue(static_cast<vtkIdType>(vtkirt::Offset(index, size))) & bits) != 0)
    {
      return true;
    }
  }
  return false;
}

}

//------------------------------------------------------------------------------
/// What a field was built from, and how. While it is the same, so is the field.
struct vtkIsosurfaceRayTraceSource::Key
{
  vtkDataArray* Array;
  vtkMTimeType ArrayTime;
  const void* Buffer;
  vtkIdType NumberOfValues;
  vtkirt::Index3 Dimensions;
  bool AreOfCells;
  int Component;
  vtkirt::ImageSettings Settings;

  bool operator==(const Key& other) const
  {
    return this->Array == other.Array && this->ArrayTime == other.ArrayTime &&
      this->Buffer == other.Buffer && this->NumberOfValues == other.NumberOfValues &&
      this->Dimensions == other.Dimensions && this->AreOfCells == other.AreOfCells &&
      this->Component == other.Component && this->Settings == other.Settings;
  }
};

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSource::vtkIsosurfaceRayTraceSource() = default;
vtkIsosurfaceRayTraceSource::~vtkIsosurfaceRayTraceSource() = default;

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceSource::FindProblem(vtkDataSet* grid, const Selection& selection)
{
  std::ostringstream problem;
  vtkDataArray* scalars = selection.Scalars;
  const vtkirt::Index3 dimensions = vtkIsosurfaceRayTraceGeometry::GetDimensions(grid);
  const int least = selection.AreOfCells ? 3 : 2;
  const vtkIdType tuples =
    selection.AreOfCells ? grid->GetNumberOfCells() : grid->GetNumberOfPoints();
  if (!scalars)
  {
    problem
      << "The input has no scalars of the requested kind. Add scalars to its points or cells, "
         "or name an array with SetScalarModeToUsePointFieldData() (or "
         "SetScalarModeToUseCellFieldData()) and SelectScalarArray().";
  }
  else if (std::min({ dimensions[0], dimensions[1], dimensions[2] }) < least)
  {
    problem << "The input has " << dimensions[0] << " x " << dimensions[1] << " x " << dimensions[2]
            << " points. An isosurface needs at least 2 samples along each axis, which are "
            << (least == 2 ? "2 points." : "2 cells, as the scalars are those of cells.");
  }
  else if (scalars->GetNumberOfTuples() != tuples)
  {
    problem << "The scalars have " << scalars->GetNumberOfTuples() << " tuples for " << tuples
            << (selection.AreOfCells ? " cells. Give one for every cell."
                                     : " points. Give one for every point.");
  }
  else if (scalars->GetDataType() != VTK_BIT && !FindScalarType(scalars->GetDataType()))
  {
    problem << "The scalars are of type " << scalars->GetDataTypeAsString()
            << ", which is not numeric.";
  }
  else if (selection.Component >= scalars->GetNumberOfComponents())
  {
    problem << "The scalars have " << scalars->GetNumberOfComponents()
            << " components, numbered from 0; there is no component " << selection.Component
            << " (SetVectorComponent).";
  }
  else
  {
    const std::string ofGhosts = vtkIsosurfaceRayTraceProblems::FindInGhosts(grid);
    problem << (ofGhosts.empty() ? vtkIsosurfaceRayTraceGeometry::FindProblem(grid) : ofGhosts);
  }
  return problem.str();
}

//------------------------------------------------------------------------------
vtkDataArray* vtkIsosurfaceRayTraceSource::GetPlainScalars(
  const Selection& selection, int& component)
{
  component = 0;
  this->PlainScalars = nullptr;
  vtkDataArray* scalars = selection.Scalars;
  if (selection.Component == Selection::Magnitude)
  {
    this->PlainScalars = ComputeMagnitudes(scalars);
    return this->PlainScalars;
  }
  const bool isBits = scalars->GetDataType() == VTK_BIT;
  if (scalars->HasStandardMemoryLayout() && !isBits)
  {
    component = selection.Component;
    return scalars;
  }
  this->PlainScalars.TakeReference(
    vtkDataArray::CreateDataArray(isBits ? VTK_UNSIGNED_CHAR : scalars->GetDataType()));
  this->PlainScalars->SetNumberOfTuples(scalars->GetNumberOfTuples());
  this->PlainScalars->CopyComponent(0, scalars, selection.Component);
  return this->PlainScalars;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceSource::Update(
  vtkDataSet* grid, const Selection& selection, const vtkirt::ImageSettings& settings, int threads)
{
  vtkDataArray* scalars = selection.Scalars;
  Key key;
  key.Array = scalars;
  key.ArrayTime = scalars->GetMTime();
  key.Buffer = scalars->HasStandardMemoryLayout() ? scalars->GetVoidPointer(0) : nullptr;
  key.NumberOfValues = scalars->GetNumberOfValues();
  key.AreOfCells = selection.AreOfCells;
  key.Component = selection.Component;
  key.Settings = settings;
  key.Dimensions = vtkIsosurfaceRayTraceGeometry::GetDimensions(grid);
  for (int& dimension : key.Dimensions)
  {
    dimension -= selection.AreOfCells ? 1 : 0;
  }

  // After writing into the scalars, applications often call Modified() of the grid, not of the
  // array. So a change of the grid counts as one of the scalars, unless its geometry has changed,
  // which explains it.
  vtkIsosurfaceRayTraceGeometry geometry(grid, selection.AreOfCells);
  const bool isNewer = grid->GetMTime() != this->GridTime;
  const bool gridChanged = isNewer && geometry.HasSamePoints(this->Geometry);
  if (isNewer || !this->Built || this->Built->AreOfCells != key.AreOfCells)
  {
    this->GridTime = 0; // Until the hidden cells are there: memory for them may fail.
    this->UpdateHiddenCells(grid, selection.AreOfCells);
  }
  this->GridTime = grid->GetMTime();
  this->Geometry = std::move(geometry);
  if (this->Field && this->Built && *this->Built == key && !gridChanged)
  {
    this->Field->SetPlanes(this->Geometry.GetPlanes());
    return false;
  }

  this->Field.reset(); // Its memory first.
  int component = 0;
  vtkDataArray* plain = this->GetPlainScalars(selection, component);
  vtkirt::VolumeView view;
  view.Type = *FindScalarType(plain->GetDataType());
  view.Samples = plain->GetVoidPointer(component);
  view.Stride = plain->GetNumberOfComponents();
  view.Dimensions = key.Dimensions;
  this->Field = vtkirt::ImageField::New(view, settings, threads);
  this->Field->SetPlanes(this->Geometry.GetPlanes());
  this->Built = std::make_unique<Key>(key);
  return true;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceSource::IsIntact() const
{
  const Key& key = *this->Built;
  return this->PlainScalars ||
    (key.Array->GetSize() >= key.NumberOfValues && key.Array->GetVoidPointer(0) == key.Buffer);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSource::UpdateHiddenCells(vtkDataSet* grid, bool areOfCells)
{
  const vtkirt::Index3 points = vtkIsosurfaceRayTraceGeometry::GetDimensions(grid);
  this->Cells = { points[0] - 1, points[1] - 1, points[2] - 1 };
  this->HiddenCells.clear();
  vtkUnsignedCharArray* pointFlags = grid->GetPointGhostArray();
  vtkUnsignedCharArray* cellFlags = grid->GetCellGhostArray();
  if (!cellFlags && (areOfCells || !pointFlags))
  {
    return;
  }
  constexpr int blanked = vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;
  const int fewer = areOfCells ? 1 : 0;
  const vtkirt::Index3 size = { this->Cells[0] - fewer, this->Cells[1] - fewer,
    this->Cells[2] - fewer };
  this->HiddenCells.reserve(vtkirt::Count(size));
  for (int z = 0; z < size[2]; ++z)
  {
    for (int y = 0; y < size[1]; ++y)
    {
      for (int x = 0; x < size[0]; ++x)
      {
        const vtkirt::Index3 cell = { x, y, z };
        bool isHidden = false;
        if (areOfCells)
        {
          // A cell between the centres of eight: its samples may be those of another piece.
          isHidden = HasFlagAtCorner(cellFlags, cell, this->Cells, blanked);
        }
        else
        {
          const auto number = static_cast<vtkIdType>(vtkirt::Offset(cell, this->Cells));
          isHidden = (cellFlags &&
                       (cellFlags->GetValue(number) &
                         (blanked | vtkDataSetAttributes::DUPLICATECELL)) != 0) ||
            (pointFlags &&
              HasFlagAtCorner(pointFlags, cell, points, vtkDataSetAttributes::HIDDENPOINT));
        }
        this->HiddenCells.push_back(isHidden ? 1 : 0);
      }
    }
  }
  if (std::count(this->HiddenCells.begin(), this->HiddenCells.end(), 1) == 0)
  {
    this->HiddenCells.clear();
  }
}

//------------------------------------------------------------------------------
const unsigned char* vtkIsosurfaceRayTraceSource::GetHiddenCells() const
{
  return this->HiddenCells.empty() ? nullptr : this->HiddenCells.data();
}

//------------------------------------------------------------------------------
vtkirt::Index3 vtkIsosurfaceRayTraceSource::FindStructuredCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  vtkirt::Index3 cell = this->Field->GetLattice().GetCell(hit);
  parametric = hit.Parametric;
  for (std::size_t axis = 0; this->Built->AreOfCells && axis < 3; ++axis)
  {
    // From the centre of one cell to that of the next.
    const double coordinate = parametric[axis];
    const double border = this->Geometry.GetShareOfFirst(axis, cell[axis]);
    const bool isBeyond = coordinate > border || (coordinate == border && !hit.FallsAlong(axis));
    const bool isInNext = isBeyond && border < 1.0;
    cell[axis] += isInNext ? 1 : 0;
    parametric[axis] =
      isInNext ? 0.5 * (coordinate - border) / (1.0 - border) : 0.5 + 0.5 * coordinate / border;
  }
  return cell;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceSource::FindCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  return static_cast<vtkIdType>(
    vtkirt::Offset(this->FindStructuredCell(hit, parametric), this->Cells));
}

//------------------------------------------------------------------------------
vtkirt::Index3 vtkIsosurfaceRayTraceSource::FindStructuredPoint(const vtkirt::Hit& hit) const
{
  vtkirt::Index3 point = this->Field->GetLattice().GetCell(hit);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Between the centres of two cells it is the point between these.
    const bool isNext = this->Built->AreOfCells || hit.IsNearUpper(axis);
    point[axis] += isNext ? 1 : 0;
  }
  return point;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceSource::FindPoint(const vtkirt::Hit& hit) const
{
  return static_cast<vtkIdType>(
    vtkirt::Offset(this->FindStructuredPoint(hit), this->GetNumberOfPoints()));
}

VTK_ABI_NAMESPACE_END
