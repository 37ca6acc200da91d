// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ScalarType_h
#define ScalarType_h

#include <cstdint>
#include <type_traits>

namespace vtkIsosurfaceRayTracing
{

/// The types of samples that the ray tracer reads without a copy.
enum class ScalarType
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float32,
  Float64
};

/// The number of types.
constexpr int NumberOfScalarTypes = static_cast<int>(ScalarType::Float64) + 1;

/// The name of type T.
template <typename T>
constexpr ScalarType ScalarTypeOf()
{
  if constexpr (std::is_same_v<T, float>)
  {
    return ScalarType::Float32;
  }
  else if constexpr (std::is_same_v<T, double>)
  {
    return ScalarType::Float64;
  }
  else
  {
    constexpr ScalarType types[2][4] = { { ScalarType::UInt8, ScalarType::UInt16,
                                           ScalarType::UInt32, ScalarType::UInt64 },
      { ScalarType::Int8, ScalarType::Int16, ScalarType::Int32, ScalarType::Int64 } };
    return types[std::is_signed_v<T> ? 1 : 0][sizeof(T) == 1 ? 0
        : sizeof(T) == 2                                     ? 1
        : sizeof(T) == 4                                     ? 2
                                                             : 3];
  }
}

/// Calls a generic function with a value of the type.
template <typename Function>
auto DispatchScalarType(ScalarType type, Function&& function)
{
  switch (type)
  {
    case ScalarType::Int8:
      return function(std::int8_t{});
    case ScalarType::UInt8:
      return function(std::uint8_t{});
    case ScalarType::Int16:
      return function(std::int16_t{});
    case ScalarType::UInt16:
      return function(std::uint16_t{});
    case ScalarType::Int32:
      return function(std::int32_t{});
    case ScalarType::UInt32:
      return function(std::uint32_t{});
    case ScalarType::Int64:
      return function(std::int64_t{});
    case ScalarType::UInt64:
      return function(std::uint64_t{});
    case ScalarType::Float32:
      return function(float{});
    case ScalarType::Float64:
      break;
  }
  return function(double{});
}

}

#endif
