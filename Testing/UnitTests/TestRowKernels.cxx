// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The kernels that read samples from rows must find the right values, whatever the type, and touch
// nothing beside them: the samples end at a page of memory that cannot be read.

#include "AllKernels.h"
#include "Image/ImageField.h"
#include "Image/Samples/VolumeView.h"
#include "Math/TrilinearCell.h"
#include "RandomNumbers.h"
#include "RandomPlanes.h"
#include "SameBits.h"
#include "TestRequest.h"
#include "TestVolume.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

class RowKernels : public WithKernels
{
};
INSTANTIATE_TEST_SUITE_P(All, RowKernels, AllKernels(), NameOfKernels);

/// Samples of any bits between two pages that cannot be read, close to one of them.
template <typename T>
class GuardedSamples
{
public:
  GuardedSamples(std::size_t count, bool areAtTheEnd, RandomNumbers& random)
    : Page(static_cast<std::size_t>(sysconf(_SC_PAGESIZE)))
    , Size((count * sizeof(T) + this->Page - 1) / this->Page * this->Page)
  {
    void* memory =
      mmap(nullptr, this->Size + 2 * this->Page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
    {
      throw std::runtime_error("no memory");
    }
    this->Memory = static_cast<std::byte*>(memory);
    std::byte* inside = this->Memory + this->Page;
    mprotect(inside, this->Size, PROT_READ | PROT_WRITE);
    std::byte* first = areAtTheEnd ? inside + this->Size - count * sizeof(T) : inside;
    this->First = reinterpret_cast<T*>(first);
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::uint64_t bits = random.Bits();
      std::memcpy(&this->First[i], &bits, sizeof(T));
    }
  }

  ~GuardedSamples() { munmap(this->Memory, this->Size + 2 * this->Page); }

  GuardedSamples(const GuardedSamples&) = delete;
  GuardedSamples& operator=(const GuardedSamples&) = delete;

  const T* Get() const { return this->First; }

private:
  std::size_t Page;
  std::size_t Size;
  std::byte* Memory = nullptr;
  T* First = nullptr;
};

int AnyCell(RandomNumbers& random, int samples)
{
  return random.Integer(0, samples - 2);
}

//------------------------------------------------------------------------------
template <typename T>
void CheckCorners(const Kernels& kernels, RandomNumbers& random)
{
  const Index3 size = { random.Integer(2, 9), random.Integer(2, 9), random.Integer(2, 9) };
  const int step = random.Integer(0, 2) ? 1 : random.Integer(2, 4);
  const std::ptrdiff_t strides[3] = { step, step * size[0], step * size[0] * size[1] };
  const GuardedSamples<T> samples(step * (Count(size) - 1) + 1, random.Integer(0, 1) != 0, random);
  Candidates candidates = {};
  candidates.Count = random.Integer(0, Candidates::Batch + 16);
  for (int i = 0; i < candidates.Count; ++i)
  {
    candidates.First[i] = samples.Get() + AnyCell(random, size[0]) * strides[0] +
      AnyCell(random, size[1]) * strides[1] + AnyCell(random, size[2]) * strides[2];
  }
  kernels.LoadCorners[static_cast<std::size_t>(ScalarTypeOf<T>())](strides, candidates);
  for (int i = 0; i < candidates.Count; ++i)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      const T* sample = static_cast<const T*>(candidates.First[i]) + corner % 2 * strides[0] +
        corner / 2 % 2 * strides[1] + corner / 4 * strides[2];
      ASSERT_TRUE(AreSameNumbers(candidates.Corners[corner][i], static_cast<double>(*sample)))
        << sizeof(T) << " bytes, candidate " << i << ", corner " << corner;
    }
  }
}

TEST_P(RowKernels, LoadTheCornersOfCells)
{
  RandomNumbers random(871);
  for (int i = 0; i < 300; ++i)
  {
    ForEachType(
      [this, &random](auto type) { CheckCorners<decltype(type)>(this->TheKernels, random); });
    ASSERT_FALSE(HasFatalFailure());
  }
}

//------------------------------------------------------------------------------
// The results are tested in TestClassification.cxx.
template <typename T>
void ClassifyRandomCells(const Kernels& kernels, RandomNumbers& random)
{
  const Index3 size = { random.Integer(2, 9), random.Integer(2, 9), random.Integer(2, 9) };
  const int step = random.Integer(0, 2) ? 1 : random.Integer(2, 4);
  const std::ptrdiff_t strides[3] = { step, step * size[0], step * size[0] * size[1] };
  const GuardedSamples<T> samples(step * (Count(size) - 1) + 1, random.Integer(0, 1) != 0, random);
  Passages passages;
  passages.Count = 1;
  passages.BlockCount = 1;
  passages.HasEnds = random.Integer(0, 1) != 0;
  passages.AreUneven = false;
  passages.Segments[0] = { { 0.5F, 0.5F, 0.0F, 0.0F }, { -8.0F, 8.0F }, 0, 0 };
  passages.Hits[0] = false;
  std::fill_n(passages.First[0], 3, 0);
  PassedCells cells;
  cells.Count = random.Integer(1, PassedCells::Capacity - 16);
  for (int i = 0; i < cells.Count + 16; ++i)
  {
    cells.Codes[i] = i < cells.Count ? 0U : cells.Codes[0];
    cells.First[i] = i < cells.Count ? samples.Get() + AnyCell(random, size[0]) * strides[0] +
        AnyCell(random, size[1]) * strides[1] + AnyCell(random, size[2]) * strides[2]
                                     : cells.First[0];
  }
  Candidates candidates;
  candidates.Count = 0;
  RaySet hits[2] = {};
  kernels.ClassifyCells[static_cast<std::size_t>(ScalarTypeOf<T>())](
    cells, random.Integer(0, 2), strides, { 1.0, 1.0 }, passages, candidates, hits);
  ASSERT_LE(candidates.Count, cells.Count);
}

TEST_P(RowKernels, ClassifyCellsReadsOnlyTheCells)
{
  RandomNumbers random(873);
  for (int i = 0; i < 300; ++i)
  {
    ForEachType([this, &random](auto type)
      { ClassifyRandomCells<decltype(type)>(this->TheKernels, random); });
    ASSERT_FALSE(HasFatalFailure());
  }
}

//------------------------------------------------------------------------------
template <typename T>
void CheckGradients(const Kernels& kernels, RandomNumbers& random)
{
  // Most have inner cells.
  const Index3 size = { random.Integer(3, 9), random.Integer(3, 9), random.Integer(3, 9) };
  const int step = random.Integer(0, 2) ? 1 : random.Integer(2, 4);
  const GuardedSamples<T> samples(step * (Count(size) - 1) + 1, random.Integer(0, 1) != 0, random);
  const VolumeView view = { samples.Get(), ScalarTypeOf<T>(), size, step };
  const auto volume = ImageField::New(view, {}, 1);
  std::vector<Hit> hits(static_cast<std::size_t>(random.Integer(1, RayPacket::Capacity)));
  for (Hit& hit : hits)
  {
    hit.Cell = volume->GetLattice().GetNumber(
      { AnyCell(random, size[0]), AnyCell(random, size[1]), AnyCell(random, size[2]) });
    for (double& coordinate : hit.Parametric)
    {
      coordinate = random.Integer(0, 5) ? random.Uniform(0.0, 1.0) : random.Integer(0, 1) + 0.0;
    }
  }
  const UnevenPlanes planes = RandomPlanes(random, size, { 3.0, true });
  const bool areUneven = random.Integer(0, 1) != 0;
  for (const NormalMode mode : { NormalMode::CentralDifferences, NormalMode::InterpolantGradient })
  {
    TestRequest request;
    request.Planes = areUneven ? &planes : nullptr;
    request.Normals = mode;
    request.PacketKernels = &kernels;
    Select(*volume, request, 1);
    double points[3][RayPacket::Capacity];
    double gradients[3][RayPacket::Capacity];
    volume->GetPointsAndGradients(
      hits.data(), static_cast<int>(hits.size()), volume->GetRequest().Normals, points, gradients);
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
      const Vector3 expected = volume->GetGradient(hits[i], mode);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        ASSERT_TRUE(AreSameNumbers(gradients[axis][i], expected[axis]))
          << sizeof(T) << " bytes, hit " << i << ", axis " << axis;
      }
    }
  }
}

TEST_P(RowKernels, GradientsMatchSingleHits)
{
  RandomNumbers random(872);
  for (int i = 0; i < 200; ++i)
  {
    ForEachType(
      [this, &random](auto type) { CheckGradients<decltype(type)>(this->TheKernels, random); });
    ASSERT_FALSE(HasFatalFailure());
  }
}

}
}
