// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef VolumeView_h
#define VolumeView_h

#include "Field/ScalarType.h"
#include "Math/Vector.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace vtkIsosurfaceRayTracing
{

/// The samples of a volume in the memory of their owner. Nothing is copied, nothing is owned.
struct VolumeView
{
  const void* Samples = nullptr;
  ScalarType Type = ScalarType::Float32;
  /// The number of samples along x, y, z; at least two each.
  Index3 Dimensions = { 0, 0, 0 };
  /// The distance between neighbours along x, in samples (the number of interleaved components).
  std::ptrdiff_t Stride = 1;
  /// Whether the memory is that of a file, which is mapped.
  bool AreInFile = false;
  /// The number of further samples along each axis that memory has before these. Normals and the
  /// tricubic interpolant take them for neighbours; even spacing alone may have them.
  int Before = 0;
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
    , Before(view.Before)
    , Strides{ view.Stride, view.Stride * (view.Before + view.Dimensions[0]),
      view.Stride * (view.Before + view.Dimensions[0]) * (view.Before + view.Dimensions[1]) }
    , IsFile(view.AreInFile)
  {
  }

  const Index3& GetDimensions() const { return this->Dimensions; }
  int GetBefore() const { return this->Before; }
  std::ptrdiff_t GetStride(int axis) const { return this->Strides[static_cast<std::size_t>(axis)]; }
  const std::ptrdiff_t* GetStrides() const { return this->Strides.data(); }

  bool AreInFile() const { return this->IsFile; }

  const T* At(const Index3& i) const
  {
    return this->First + i[0] * this->Strides[0] + i[1] * this->Strides[1] +
      i[2] * this->Strides[2];
  }

private:
  const T* First;
  Index3 Dimensions;
  int Before;
  std::array<std::ptrdiff_t, 3> Strides;
  bool IsFile;
};

/// Calls a generic function with the Samples of the type the view names.
template <typename Function>
auto DispatchScalarType(const VolumeView& view, Function&& function)
{
  return DispatchScalarType(
    view.Type, [&view, &function](auto value) { return function(Samples<decltype(value)>(view)); });
}

/// The type in which samples of type T are traced: the smallest of five that holds every value of T
/// exactly. (64-bit integers beyond 2^53 become the nearest double.)
template <typename T>
using Stored = std::conditional_t<std::is_same_v<T, std::int8_t>, std::int16_t,
  std::conditional_t<std::is_integral_v<T> && (sizeof(T) >= 4), double, T>>;

}

#endif
