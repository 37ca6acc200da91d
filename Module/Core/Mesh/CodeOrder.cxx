// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/CodeOrder.h"

#include "Math/ThreadsOfLoop.h"

#include <algorithm>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr unsigned int BitsOfDigit = 11;
constexpr std::size_t Digits = std::size_t{ 1 } << BitsOfDigit;

}

//------------------------------------------------------------------------------
std::vector<std::uint32_t> CodeOrder::Find(int threads)
{
  std::unique_ptr<std::uint64_t[]> sorted(new std::uint64_t[this->Count]);
  for (unsigned int shift = CodeShift; shift < 64; shift += BitsOfDigit)
  {
    this->SortByDigit(shift, threads, sorted.get());
    this->Keys.swap(sorted);
  }
  const std::uint64_t* keys = this->Keys.get();
  const auto count = std::lower_bound(keys, keys + this->Count, None) - keys;
  std::vector<std::uint32_t> order(static_cast<std::size_t>(count));
#pragma omp parallel for schedule(static) num_threads(GetThreadsOfLoop(order.size(), 1.0, threads))
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    order[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(keys[i]);
  }
  return order;
}

//------------------------------------------------------------------------------
/// Keys with the same digit stay in order.
void CodeOrder::SortByDigit(unsigned int shift, int threads, std::uint64_t* sorted) const
{
  // Of each part of the keys, how many have each digit; then where the next of these goes.
  // Not so many that summing these up takes longer than sorting.
  const std::size_t parts =
    std::min(static_cast<std::size_t>(threads), 1 + this->Count / (4 * Digits));
  const int worth = parts > 1 ? threads : 1;
  std::vector<std::size_t> places(parts * Digits);
  const auto forPart = [&](int number, const auto& function)
  {
    const auto part = static_cast<std::size_t>(number);
    std::size_t* ofPart = &places[part * Digits];
    const std::uint64_t* end = this->Keys.get() + this->Count * (part + 1) / parts;
    for (const std::uint64_t* key = this->Keys.get() + this->Count * part / parts; key < end; ++key)
    {
      function(*key, ofPart[(*key >> shift) % Digits]);
    }
  };
#pragma omp parallel for schedule(static) num_threads(worth)
  for (int part = 0; part < static_cast<int>(parts); ++part)
  {
    forPart(part, [](std::uint64_t, std::size_t& place) { ++place; });
  }
  std::size_t place = 0;
  for (std::size_t digit = 0; digit < Digits; ++digit)
  {
    for (std::size_t i = digit; i < places.size(); i += Digits)
    {
      place += std::exchange(places[i], place);
    }
  }
#pragma omp parallel for schedule(static) num_threads(worth)
  for (int part = 0; part < static_cast<int>(parts); ++part)
  {
    forPart(part, [sorted](std::uint64_t key, std::size_t& next) { sorted[next++] = key; });
  }
}

}
