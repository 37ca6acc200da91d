// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef VolumeView_h
#define VolumeView_h

#include "Math/Vector.h"

#include <cstddef>
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

/// The samples of a volume in the memory of their owner. Nothing is copied, nothing is owned.
struct VolumeView
{
  const void* Samples = nullptr;
  ScalarType Type = ScalarType::Float32;
  /// The number of samples along x, y, z; at least two each.
  Index3 Dimensions = { 0, 0, 0 };
  /// The distance between neighbours along x, in samples (the number of interleaved components).
  std::ptrdiff_t Stride = 1;
};

/// The view with its type known to the compiler.
template <typename T>
class Samples
{
public:
  using Value = T;

  explicit Samples(const VolumeView& view)
    : First(static_cast<const T*>(view.Samples))
    , Dimensions(view.Dimensions)
    , Strides{ view.Stride, view.Stride * view.Dimensions[0],
      view.Stride * view.Dimensions[0] * view.Dimensions[1] }
  {
  }

  const Index3& GetDimensions() const { return this->Dimensions; }
  std::ptrdiff_t GetStride(int axis) const { return this->Strides[static_cast<std::size_t>(axis)]; }
  const std::ptrdiff_t* GetStrides() const { return this->Strides.data(); }

  const T* At(const Index3& i) const
  {
    return this->First + i[0] * this->Strides[0] + i[1] * this->Strides[1] +
      i[2] * this->Strides[2];
  }

private:
  const T* First;
  Index3 Dimensions;
  std::array<std::ptrdiff_t, 3> Strides;
};

/// Calls a generic function with the Samples of the type the view names.
template <typename Function>
auto DispatchScalarType(const VolumeView& view, Function&& function)
{
  switch (view.Type)
  {
    case ScalarType::Int8:
      return function(Samples<std::int8_t>(view));
    case ScalarType::UInt8:
      return function(Samples<std::uint8_t>(view));
    case ScalarType::Int16:
      return function(Samples<std::int16_t>(view));
    case ScalarType::UInt16:
      return function(Samples<std::uint16_t>(view));
    case ScalarType::Int32:
      return function(Samples<std::int32_t>(view));
    case ScalarType::UInt32:
      return function(Samples<std::uint32_t>(view));
    case ScalarType::Int64:
      return function(Samples<std::int64_t>(view));
    case ScalarType::UInt64:
      return function(Samples<std::uint64_t>(view));
    case ScalarType::Float32:
      return function(Samples<float>(view));
    case ScalarType::Float64:
      break;
  }
  return function(Samples<double>(view));
}

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

/// The type in which samples of type T are traced: the smallest of five that holds every value of T
/// exactly. (64-bit integers beyond 2^53 become the nearest double.)
template <typename T>
using Stored = std::conditional_t<std::is_same_v<T, std::int8_t>, std::int16_t,
  std::conditional_t<std::is_integral_v<T> && (sizeof(T) >= 4), double, T>>;

}

#endif
