// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TestVolume_h
#define TestVolume_h

#include "AnalyticFields.h"
#include "Image/Samples/VolumeView.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{

/// A volume that owns its samples: the last of Stride interleaved components.
template <typename T>
struct TestVolume
{
  TestVolume(const Index3& dimensions, const std::vector<T>& samples, int stride = 1)
    : Dimensions(dimensions)
    , Stride(static_cast<std::size_t>(stride))
    , Values(samples.size() * this->Stride, static_cast<T>(77))
  {
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
      this->Values[i * this->Stride + this->Stride - 1] = samples[i];
    }
  }

  template <typename Field>
  static TestVolume Of(const Index3& dimensions, const Field& field, int stride = 1)
  {
    return TestVolume(dimensions, AnalyticFields::Sample<T>(dimensions, field), stride);
  }

  T& At(const Index3& i)
  {
    return this->Values[Offset(i, this->Dimensions) * this->Stride + this->Stride - 1];
  }
  const T& At(const Index3& i) const
  {
    return this->Values[Offset(i, this->Dimensions) * this->Stride + this->Stride - 1];
  }

  VolumeView View() const
  {
    return { this->Values.data() + this->Stride - 1, ScalarTypeOf<T>(), this->Dimensions,
      static_cast<std::ptrdiff_t>(this->Stride) };
  }

  Index3 Dimensions;
  std::size_t Stride;
  std::vector<T> Values;
};

/// The types of samples, as a list for typed tests.
using SampleTypes = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t,
  std::int32_t, std::uint32_t, std::int64_t, std::uint64_t, float, double>;

/// Calls visit(T()) for every type T of samples.
template <typename Visit>
void ForEachType(const Visit& visit)
{
  visit(std::int8_t{});
  visit(std::uint8_t{});
  visit(std::int16_t{});
  visit(std::uint16_t{});
  visit(std::int32_t{});
  visit(std::uint32_t{});
  visit(std::int64_t{});
  visit(std::uint64_t{});
  visit(float{});
  visit(double{});
}

/// Calls visit(index) for every index of a lattice, x fastest.
template <typename Visit>
void ForEachPlace(const Index3& size, const Visit& visit)
{
  for (int z = 0; z < size[2]; ++z)
  {
    for (int y = 0; y < size[1]; ++y)
    {
      for (int x = 0; x < size[0]; ++x)
      {
        visit(Index3{ x, y, z });
      }
    }
  }
}

}

#endif
