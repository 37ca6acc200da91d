// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceScalars.h"

#include "vtkIsosurfaceRayTraceScene.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkVolumeProperty.h"

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

double FindLength(vtkDataArray* vectors, vtkIdType number)
{
  double length = 0.0;
  for (int i = 0; i < vectors->GetNumberOfComponents(); ++i)
  {
    length = std::hypot(length, vectors->GetComponent(number, i));
  }
  return length;
}

/// The magnitudes of vectors, in double precision: those of small numbers need it as well. Arrays
/// of other layouts may not be read by several threads.
vtkSmartPointer<vtkDataArray> ComputeMagnitudes(vtkDataArray* vectors, int threads)
{
  constexpr vtkIdType many = 1 << 12;
  const vtkIdType count = vectors->GetNumberOfTuples();
  const bool isWorth = count > many && vectors->HasStandardMemoryLayout();
  auto lengths = vtkSmartPointer<vtkDoubleArray>::New();
  lengths->SetNumberOfTuples(count);
  double* length = lengths->GetPointer(0);
#pragma omp parallel for schedule(static) num_threads(threads) if (isWorth)
  for (vtkIdType i = 0; i < count; ++i)
  {
    length[i] = FindLength(vectors, i);
  }
  return lengths;
}

/// The names of the arrays of numbers that have one, but for the marks of ghosts.
std::string ListArrays(vtkDataSetAttributes* attributes)
{
  std::string names;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    const char* name = attributes->GetArray(i) ? attributes->GetArrayName(i) : nullptr;
    const bool isOffered = name && name != std::string(vtkDataSetAttributes::GhostArrayName());
    names += isOffered ? (names.empty() ? "\"" : ", \"") + std::string(name) + "\"" : "";
  }
  return names;
}

}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceScalars::SelectArray(vtkAbstractVolumeMapper* mapper, vtkDataSet* data)
{
  int association = 0;
  this->Array = vtkAbstractMapper::GetScalars(data, mapper->GetScalarMode(),
    mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), association);
  if (association == vtkDataObject::FIELD_ASSOCIATION_NONE)
  {
    this->Array = nullptr; // Field data lie nowhere.
  }
  this->AreOfCells = association == 1;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceScalars::DescribeMissing(
  vtkAbstractVolumeMapper* mapper, vtkDataSet* data)
{
  const int mode = mapper->GetScalarMode();
  const bool isNamed = mapper->GetArrayAccessMode() == VTK_GET_ARRAY_BY_NAME &&
    (mode == VTK_SCALAR_MODE_USE_POINT_FIELD_DATA || mode == VTK_SCALAR_MODE_USE_CELL_FIELD_DATA);
  if (!isNamed)
  {
    return "The input has no scalars of the requested kind. Add scalars to its points or cells, "
           "or name an array with SetScalarModeToUsePointFieldData() (or "
           "SetScalarModeToUseCellFieldData()) and SelectScalarArray().";
  }
  const bool areOfPoints = mode == VTK_SCALAR_MODE_USE_POINT_FIELD_DATA;
  vtkDataSetAttributes* points = data->GetPointData();
  vtkDataSetAttributes* cells = data->GetCellData();
  vtkDataSetAttributes* own = areOfPoints ? points : cells;
  vtkDataSetAttributes* others = areOfPoints ? cells : points;
  const char* name = mapper->GetArrayName();
  std::ostringstream text;
  text << "The input has no array \"" << name << "\" of " << (areOfPoints ? "points" : "cells");
  if (others->GetArray(name))
  {
    text << ", but one of "
         << (areOfPoints ? "cells. Call SetScalarModeToUseCellFieldData()."
                         : "points. Call SetScalarModeToUsePointFieldData().");
    return text.str();
  }
  const std::string names = ListArrays(own);
  text << (names.empty() ? " with numbers, nor any other. Add one."
                         : " with numbers. SelectScalarArray() takes one of " + names + ".");
  return text.str();
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceScalars::SelectComponent(
  std::optional<int> component, vtkVolumeProperty* property, int& propertyComponent)
{
  propertyComponent = 0;
  if (component)
  {
    this->Component = *component;
    return "";
  }
  const int count = this->Array ? this->Array->GetNumberOfComponents() : 1;
  if (count > VTK_MAX_VRCOMP)
  {
    return "The scalars have " + std::to_string(count) +
      " components. vtkVolumeProperty::SetComponentWeight selects one of at most " +
      std::to_string(VTK_MAX_VRCOMP) +
      ". Call "
      "SetVectorModeToComponent() and SetVectorComponent(), or SetVectorModeToMagnitude().";
  }
  propertyComponent = vtkIsosurfaceRayTraceScene::ChooseComponent(property, count);
  this->Component = propertyComponent;
  return "";
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceScalars::FindProblem(vtkIdType points, vtkIdType cells) const
{
  std::ostringstream problem;
  const vtkIdType tuples = this->AreOfCells ? cells : points;
  if (this->Array->GetNumberOfTuples() != tuples)
  {
    problem << "The scalars have " << this->Array->GetNumberOfTuples() << " tuples for " << tuples
            << (this->AreOfCells ? " cells. Give one for every cell."
                                 : " points. Give one for every point.");
  }
  else if (this->Array->GetDataType() != VTK_BIT && !FindScalarType(this->Array->GetDataType()))
  {
    problem << "The scalars are of type " << this->Array->GetDataTypeAsString()
            << ", which is not numeric.";
  }
  else if (this->Component >= this->Array->GetNumberOfComponents())
  {
    problem << "The scalars have " << this->Array->GetNumberOfComponents()
            << " components, numbered from 0; there is no component " << this->Component
            << " (SetVectorComponent).";
  }
  return problem.str();
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceScalars::View vtkIsosurfaceRayTraceScalars::MakeView(
  vtkSmartPointer<vtkDataArray>& storage, int threads) const
{
  storage = nullptr;
  vtkDataArray* plain = this->Array;
  int component = 0;
  const bool isBits = plain->GetDataType() == VTK_BIT;
  const int plainType = isBits ? VTK_UNSIGNED_CHAR : plain->GetDataType();
  if (this->Component == Magnitude)
  {
    storage = ComputeMagnitudes(this->Array, threads);
  }
  else if (plain->HasStandardMemoryLayout() && !isBits)
  {
    component = this->Component;
  }
  else if (this->HasOthers)
  {
    storage.TakeReference(vtkDataArray::CreateDataArray(plainType));
    storage->DeepCopy(plain);
    component = this->Component;
  }
  else
  {
    storage.TakeReference(vtkDataArray::CreateDataArray(plainType));
    storage->SetNumberOfTuples(plain->GetNumberOfTuples());
    storage->CopyComponent(0, plain, this->Component);
  }
  plain = storage ? storage.Get() : plain;
  return { plain->GetVoidPointer(component), *FindScalarType(plain->GetDataType()),
    plain->GetNumberOfComponents(), plain->GetVoidPointer(0) };
}

VTK_ABI_NAMESPACE_END
