// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceSource.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
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

/// The ray tracer's name for a scalar type of VTK; none for what is not a number.
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

/// The lengths of vectors. Those of small numbers fit single precision as well as any.
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
  vtkUnsignedCharArray* flags, const vtkirt::Index3& first, const vtkirt::Index3& size, int wanted)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    const vtkirt::Index3 place = { first[0] + (corner & 1), first[1] + (corner >> 1 & 1),
      first[2] + (corner >> 2) };
    if ((flags->GetValue(static_cast<vtkIdType>(vtkirt::Offset(place, size))) & wanted) != 0)
    {
      return true;
    }
  }
  return false;
}

}

//------------------------------------------------------------------------------
/// Where an image lies, without the volume's own matrix.
struct vtkIsosurfaceRayTraceSource::Geometry
{
  std::array<double, 3> Origin;
  std::array<double, 3> Spacing;
  std::array<double, 9> Direction;
  std::array<int, 3> FirstIndex;

  explicit Geometry(vtkImageData* image)
  {
    image->GetOrigin(this->Origin.data());
    image->GetSpacing(this->Spacing.data());
    std::copy_n(image->GetDirectionMatrix()->GetData(), 9, this->Direction.begin());
    const int* extent = image->GetExtent();
    this->FirstIndex = { extent[0], extent[2], extent[4] };
  }

  bool operator==(const Geometry& other) const
  {
    return this->Origin == other.Origin && this->Spacing == other.Spacing &&
      this->Direction == other.Direction && this->FirstIndex == other.FirstIndex;
  }

  /// From indices, counted from so many samples behind the first point, to the coordinates of the
  /// image. The place of the first sample is computed first: an extent far from zero costs no
  /// digits.
  vtkirt::Matrix4 GetPhysicalFromIndex(double behind) const
  {
    vtkirt::Matrix4 matrix;
    vtkImageData::ComputeIndexToPhysicalMatrix(
      this->Origin.data(), this->Spacing.data(), this->Direction.data(), matrix.data());
    const vtkirt::Vector3 first = vtkirt::TransformPoint(matrix,
      { this->FirstIndex[0] + behind, this->FirstIndex[1] + behind, this->FirstIndex[2] + behind });
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      matrix[4 * axis + 3] = first[axis];
    }
    return matrix;
  }

  bool IsUsable() const
  {
    const vtkirt::Matrix4 m = this->GetPhysicalFromIndex(0.0);
    return std::all_of(m.begin(), m.end(), [](double v) { return std::isfinite(v); }) &&
      vtkMath::Determinant3x3(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]) != 0.0;
  }
};

//------------------------------------------------------------------------------
/// What a volume was built from, and how. While it is the same, so is the volume.
struct vtkIsosurfaceRayTraceSource::Key
{
  vtkDataArray* Array;
  vtkMTimeType ArrayTime;
  const void* Buffer;
  vtkirt::Index3 Dimensions;
  bool AreOfCells;
  int Component;
  vtkirt::VolumeSettings Settings;

  bool operator==(const Key& other) const
  {
    return this->Array == other.Array && this->ArrayTime == other.ArrayTime &&
      this->Buffer == other.Buffer && this->Dimensions == other.Dimensions &&
      this->AreOfCells == other.AreOfCells && this->Component == other.Component &&
      this->Settings == other.Settings;
  }
};

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSource::vtkIsosurfaceRayTraceSource() = default;
vtkIsosurfaceRayTraceSource::~vtkIsosurfaceRayTraceSource() = default;

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceSource::FindProblem(
  vtkImageData* image, const Selection& selection)
{
  std::ostringstream problem;
  vtkDataArray* scalars = selection.Scalars;
  const int* dimensions = image->GetDimensions();
  const int least = selection.AreOfCells ? 3 : 2;
  const vtkIdType tuples =
    selection.AreOfCells ? image->GetNumberOfCells() : image->GetNumberOfPoints();
  if (!scalars)
  {
    problem
      << "The input has no scalars of the kind asked for. Add scalars to its points or cells, "
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
            << ", which is no number.";
  }
  else if (selection.Component >= scalars->GetNumberOfComponents())
  {
    problem << "The scalars have " << scalars->GetNumberOfComponents()
            << " components, numbered from 0; there is no component " << selection.Component
            << " (SetVectorComponent).";
  }
  else if (!Geometry(image).IsUsable())
  {
    problem << "The origin, spacing and direction of the input leave it without a finite volume. "
               "Give finite numbers, a spacing other than 0 and a direction matrix of full rank.";
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
bool vtkIsosurfaceRayTraceSource::Update(vtkImageData* image, const Selection& selection,
  const vtkirt::VolumeSettings& settings, int threads)
{
  vtkDataArray* scalars = selection.Scalars;
  Key key;
  key.Array = scalars;
  key.ArrayTime = scalars->GetMTime();
  key.Buffer = scalars->HasStandardMemoryLayout() ? scalars->GetVoidPointer(0) : nullptr;
  key.AreOfCells = selection.AreOfCells;
  key.Component = selection.Component;
  key.Settings = settings;
  const int fewer = selection.AreOfCells ? 1 : 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    key.Dimensions[axis] = image->GetDimensions()[axis] - fewer;
  }

  // Those who write into the scalars often tell the image, not the array. So a change of the image
  // counts as one of the scalars, unless its geometry has changed, which explains it.
  const Geometry geometry(image);
  const bool sameGeometry = this->ImageGeometry && *this->ImageGeometry == geometry;
  const bool isNewer = image->GetMTime() != this->ImageTime;
  const bool imageChanged = isNewer && sameGeometry;
  if (isNewer || !this->Built || this->Built->AreOfCells != key.AreOfCells)
  {
    this->UpdateHiddenCells(image, selection.AreOfCells);
  }
  this->ImageTime = image->GetMTime();
  this->UpdateGeometry(geometry, selection.AreOfCells);
  if (this->Volume && this->Built && *this->Built == key && !imageChanged)
  {
    return false;
  }

  this->Volume.reset(); // Its memory first.
  int component = 0;
  vtkDataArray* plain = this->GetPlainScalars(selection, component);
  vtkirt::VolumeView view;
  view.Type = *FindScalarType(plain->GetDataType());
  view.Samples = plain->GetVoidPointer(component);
  view.Stride = plain->GetNumberOfComponents();
  view.Dimensions = key.Dimensions;
  this->Volume = vtkirt::TracedVolume::New(view, settings, threads);
  this->Built = std::make_unique<Key>(key);
  return true;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSource::UpdateGeometry(const Geometry& geometry, bool areOfCells)
{
  this->ImageGeometry = std::make_unique<Geometry>(geometry);
  this->FirstSample = areOfCells ? 0.5 : 0.0;
  this->PhysicalFromIndex = geometry.GetPhysicalFromIndex(this->FirstSample);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSource::UpdateHiddenCells(vtkImageData* image, bool areOfCells)
{
  const int* dimensions = image->GetDimensions();
  const vtkirt::Index3 points = { dimensions[0], dimensions[1], dimensions[2] };
  this->Cells = { points[0] - 1, points[1] - 1, points[2] - 1 };
  this->HiddenCells.clear();
  vtkUnsignedCharArray* pointFlags = image->GetPointGhostArray();
  vtkUnsignedCharArray* cellFlags = image->GetCellGhostArray();
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
double vtkIsosurfaceRayTraceSource::GetIndex(std::size_t axis, double place) const
{
  const Geometry& geometry = *this->ImageGeometry;
  return (place - geometry.Origin[axis]) / geometry.Spacing[axis] - geometry.FirstIndex[axis] -
    this->FirstSample;
}

//------------------------------------------------------------------------------
const unsigned char* vtkIsosurfaceRayTraceSource::GetHiddenCells() const
{
  return this->HiddenCells.empty() ? nullptr : this->HiddenCells.data();
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceSource::FindCell(
  const vtkirt::Hit& hit, vtkirt::Vector3& parametric) const
{
  vtkirt::Index3 cell = hit.Cell;
  parametric = hit.Parametric;
  if (this->FirstSample != 0.0)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double place = parametric[axis] + this->FirstSample;
      const int step = hit.IsNearUpper(axis) ? 1 : 0;
      cell[axis] += step;
      parametric[axis] = place - step;
    }
  }
  return static_cast<vtkIdType>(vtkirt::Offset(cell, this->Cells));
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceSource::FindPoint(const vtkirt::Hit& hit) const
{
  vtkirt::Index3 point;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Between the centres of two cells it is the one between these.
    point[axis] = hit.Cell[axis] + (this->FirstSample != 0.0 || hit.IsNearUpper(axis) ? 1 : 0);
  }
  return static_cast<vtkIdType>(
    vtkirt::Offset(point, { this->Cells[0] + 1, this->Cells[1] + 1, this->Cells[2] + 1 }));
}

VTK_ABI_NAMESPACE_END
