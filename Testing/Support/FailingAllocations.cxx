// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FailingAllocations.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>
#include <new>

namespace
{

/// The allocation with this number fails; none if it is not positive.
std::atomic<long> AllocationsLeft{ 0 };
std::atomic<long> LiveAllocations{ 0 };

/// The addresses of a loaded library.
struct Library
{
  std::uintptr_t Begin = 0;
  std::uintptr_t End = 0;

  bool Has(const void* address) const
  {
    const auto number = reinterpret_cast<std::uintptr_t>(address);
    return number >= this->Begin && number < this->End;
  }
};

/// Empty if there is none.
Library FindLibrary(const std::string& name)
{
  struct Search
  {
    std::string Name;
    Library Found;
  } search = { name, {} };
  const auto visit = [](dl_phdr_info* info, std::size_t /*size*/, void* data)
  {
    auto& wanted = *static_cast<Search*>(data);
    const std::string path = info->dlpi_name;
    if (path.compare(path.rfind('/') + 1, wanted.Name.size(), wanted.Name) != 0)
    {
      return 0;
    }
    const auto* last = info->dlpi_phdr + info->dlpi_phnum;
    for (const auto* segment = info->dlpi_phdr; segment != last; ++segment)
    {
      if (segment->p_type == PT_LOAD)
      {
        const std::uintptr_t end = info->dlpi_addr + segment->p_vaddr + segment->p_memsz;
        wanted.Found.End = std::max(wanted.Found.End, end);
      }
    }
    wanted.Found.Begin = info->dlpi_addr;
    return 1;
  };
  dl_iterate_phdr(visit, &search);
  return search.Found;
}

/// Empty if all code is selected.
Library Selected;
Library Standard;

/// Whether code belongs to the C++ standard library, or is made from its templates. That may be in
/// any library: the loader takes one of its copies for all.
bool IsStandard(const void* address)
{
  Dl_info info = {};
  return Standard.Has(address) ||
    (dladdr(address, &info) != 0 && info.dli_sname &&
      (std::strncmp(info.dli_sname, "_ZNSt", 5) == 0 ||
        std::strncmp(info.dli_sname, "_ZSt", 4) == 0));
}

bool IsSelected(const void* caller)
{
  if (Selected.End == 0)
  {
    return true;
  }
  if (!IsStandard(caller))
  {
    return Selected.Has(caller);
  }
  std::array<void*, 32> frames = {};
  const int count = backtrace(frames.data(), static_cast<int>(frames.size()));
  const auto last = frames.begin() + count;
  const auto user = std::find_if_not(std::find(frames.begin(), last, caller), last, IsStandard);
  return user != last && Selected.Has(*user);
}

void* Allocate(std::size_t size, std::size_t alignment, const void* caller)
{
  if (AllocationsLeft.load(std::memory_order_relaxed) > 0 && IsSelected(caller) &&
    AllocationsLeft.fetch_sub(1) == 1)
  {
    throw std::bad_alloc();
  }
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, std::max(rounded, alignment));
  if (!memory)
  {
    throw std::bad_alloc();
  }
  ++LiveAllocations;
  return memory;
}

void Free(void* memory)
{
  LiveAllocations -= memory ? 1 : 0;
  std::free(memory);
}

}

namespace FailingAllocations
{

bool SelectLibrary(const std::string& name)
{
  Standard = FindLibrary("libstdc++");
  Selected = FindLibrary(name);
  std::array<void*, 1> frame = {};
  backtrace(frame.data(), 1); // The first call allocates.
  return Standard.End != 0 && Selected.End != 0;
}

void FailAt(long number)
{
  AllocationsLeft = number;
}

bool HasFailed()
{
  return AllocationsLeft.exchange(0) <= 0;
}

long CountLive()
{
  return LiveAllocations;
}

}

// The other forms call these. (With sanitizers they do not, but keep to themselves.)
void* operator new(std::size_t size)
{
  return Allocate(size, alignof(std::max_align_t), __builtin_return_address(0));
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
  return Allocate(size, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept
{
  try
  {
    return Allocate(size, alignof(std::max_align_t), __builtin_return_address(0));
  }
  catch (const std::bad_alloc&)
  {
    return nullptr;
  }
}
void* operator new(
  std::size_t size, std::align_val_t alignment, const std::nothrow_t& /*tag*/) noexcept
{
  try
  {
    return Allocate(size, static_cast<std::size_t>(alignment), __builtin_return_address(0));
  }
  catch (const std::bad_alloc&)
  {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept
{
  Free(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept
{
  Free(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept
{
  Free(memory);
}
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept
{
  Free(memory);
}
