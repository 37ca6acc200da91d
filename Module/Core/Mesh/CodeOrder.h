// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CodeOrder_h
#define CodeOrder_h

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Puts the numbers from 0 on in the order of their codes.
class CodeOrder
{
public:
  /// There may be up to 2^32 - 1 numbers. Each of them is to be coded or left out, by any thread.
  explicit CodeOrder(std::size_t count)
    : Count(count)
    , Keys(new std::uint64_t[count])
  {
  }

  /// Codes are less than 2^32 - 1.
  void SetCode(std::uint32_t number, std::uint32_t code)
  {
    this->Keys[number] = std::uint64_t{ code } << CodeShift | number;
  }
  void LeaveOut(std::uint32_t number) { this->Keys[number] = None; }

  /// The numbers that are coded, in order: those with the same code in the order of numbers. Can be
  /// called once.
  std::vector<std::uint32_t> Find(int threads);

private:
  static constexpr unsigned int CodeShift = 32;
  /// Behind all keys.
  static constexpr std::uint64_t None = std::numeric_limits<std::uint64_t>::max();

  void SortByDigit(unsigned int shift, int threads, std::uint64_t* sorted) const;

  std::size_t Count;
  /// Codes and numbers; not initialized, so that the threads that set them are the first to touch
  /// them.
  std::unique_ptr<std::uint64_t[]> Keys;
};

}

#endif
