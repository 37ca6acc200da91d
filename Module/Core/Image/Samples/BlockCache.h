// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BlockCache_h
#define BlockCache_h

#include "Math/Compiler.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Data of the blocks of a lattice: a slot of the same size for each, filled at the first access.
/// Any number of threads may access it at once, and none ever waits.
///
/// The memory may be limited. Within a frame nothing is evicted: without room an access fails. The
/// next frame begins by evicting what the last one did not use.
class BlockCache
{
public:
  /// The alignment must divide the size of a slot.
  BlockCache(std::size_t blocks, std::size_t slotSize)
    : SlotSize(slotSize)
    , SlotsPerChunk(
        std::clamp<std::size_t>(ChunkSize / slotSize, 1, std::max<std::size_t>(blocks, 1)))
    , States(blocks)
    , Chunks((blocks + this->SlotsPerChunk - 1) / this->SlotsPerChunk)
  {
  }

  ~BlockCache()
  {
    for (std::atomic<std::byte*>& chunk : this->Chunks)
    {
      ::operator delete(chunk.load(std::memory_order_relaxed), Alignment);
    }
  }

  BlockCache(const BlockCache&) = delete;
  BlockCache& operator=(const BlockCache&) = delete;

  /// Begins a frame that may take a number of bytes. No other thread may access the cache.
  void BeginFrame(std::size_t maximumMemory)
  {
    const std::size_t slots = maximumMemory / this->SlotSize;
    const bool isLimited = slots < this->States.size();
    if (isLimited && this->LastUse.empty())
    {
      // Uses were not recorded until now.
      this->LastUse = std::vector<std::atomic<std::uint32_t>>(this->States.size());
    }
    if (isLimited && (this->IsExhausted.load() || this->Used > slots))
    {
      this->EvictUnused(slots);
    }
    this->IsExhausted.store(false);
    this->IsLimited = isLimited;
    this->MaximumSlots = std::min(slots, this->States.size());
    ++this->Frame;
  }

  /// Empties the cache, but keeps the memory for new blocks.
  void Clear()
  {
    if (this->Used > 0)
    {
      for (std::atomic<std::uint32_t>& state : this->States)
      {
        state.store(Missing, std::memory_order_relaxed);
      }
      this->Free.clear();
      this->NextFree.store(0);
      this->NextSlot.store(0);
      this->Used.store(0);
    }
  }

  /// The slot of a block. If it is missing, make(slot) fills it. Returns null if there is no room,
  /// or while another thread is making it.
  template <typename Make>
  const void* Get(std::size_t block, const Make& make)
  {
    std::atomic<std::uint32_t>& state = this->States[block];
    std::uint32_t slot = state.load(std::memory_order_acquire);
    if (slot >= FirstSlot)
    {
      this->CountUse(block);
      return this->At(slot - FirstSlot);
    }
    if (slot == BeingMade ||
      !state.compare_exchange_strong(slot, BeingMade, std::memory_order_acquire))
    {
      return nullptr;
    }
    void* memory = this->TakeSlot(slot);
    if (!memory)
    {
      state.store(Missing, std::memory_order_relaxed);
      return nullptr;
    }
    make(memory);
    this->CountUse(block);
    state.store(slot + FirstSlot, std::memory_order_release);
    return memory;
  }

  void Prefetch(std::size_t block) const { PrefetchLine(&this->States[block]); }

  /// The number of blocks that are kept.
  std::size_t GetNumberOfBlocks() const { return this->Used.load(); }
  std::size_t GetMaximumNumberOfBlocks() const { return this->States.size(); }

  /// In bytes; includes the memory of evicted blocks.
  std::size_t GetMemory() const
  {
    const std::size_t slots = std::min<std::size_t>(this->NextSlot.load(), this->MaximumSlots);
    return std::max(slots, this->Used.load()) * this->SlotSize +
      this->States.size() * sizeof(std::uint32_t) * (this->LastUse.empty() ? 1 : 2);
  }

private:
  static constexpr std::size_t ChunkSize = std::size_t{ 1 } << 18;
  static constexpr std::align_val_t Alignment{ 64 };

  // The state of a block, or else the number of its slot plus this.
  static constexpr std::uint32_t Missing = 0;
  static constexpr std::uint32_t BeingMade = 1;
  static constexpr std::uint32_t FirstSlot = 2;

  void* At(std::size_t slot) const
  {
    std::byte* chunk = this->Chunks[slot / this->SlotsPerChunk].load(std::memory_order_acquire);
    return chunk + slot % this->SlotsPerChunk * this->SlotSize;
  }

  void CountUse(std::size_t block)
  {
    if (this->IsLimited)
    {
      this->LastUse[block].store(this->Frame, std::memory_order_relaxed);
    }
  }

  /// A slot for a block, and its memory; null if there is none.
  void* TakeSlot(std::uint32_t& slot)
  {
    const std::size_t free = this->NextFree.load(std::memory_order_relaxed) < this->Free.size()
      ? this->NextFree.fetch_add(1, std::memory_order_relaxed)
      : this->Free.size();
    if (free < this->Free.size())
    {
      slot = this->Free[free];
    }
    else
    {
      slot = this->NextSlot.load(std::memory_order_relaxed);
      do
      {
        if (slot >= this->MaximumSlots)
        {
          this->IsExhausted.store(true, std::memory_order_relaxed);
          return nullptr;
        }
      } while (!this->NextSlot.compare_exchange_weak(slot, slot + 1, std::memory_order_relaxed));
      if (!this->RequireChunk(slot / this->SlotsPerChunk))
      {
        // The number is lost, which is harmless: there will be no memory for the next one either.
        this->IsExhausted.store(true, std::memory_order_relaxed);
        return nullptr;
      }
    }
    this->Used.fetch_add(1, std::memory_order_relaxed);
    return this->At(slot);
  }

  bool RequireChunk(std::size_t number)
  {
    std::atomic<std::byte*>& chunk = this->Chunks[number];
    if (chunk.load(std::memory_order_acquire))
    {
      return true;
    }
    void* made = ::operator new(this->SlotsPerChunk* this->SlotSize, Alignment, std::nothrow);
    std::byte* present = nullptr;
    if (made &&
      !chunk.compare_exchange_strong(
        present, static_cast<std::byte*>(made), std::memory_order_acq_rel))
    {
      ::operator delete(made, Alignment);
      return true;
    }
    return made != nullptr;
  }

  /// Evicts the blocks that the last frame did not use; and if those that it did use are more than
  /// the limit allows, as many of them as necessary.
  void EvictUnused(std::size_t slots)
  {
    std::vector<std::uint32_t> freed(this->Free.begin() +
        static_cast<std::ptrdiff_t>(std::min(this->NextFree.load(), this->Free.size())),
      this->Free.end());
    for (std::size_t block = 0; block < this->States.size(); ++block)
    {
      const std::uint32_t state = this->States[block].load(std::memory_order_relaxed);
      const bool mustGo = state >= FirstSlot &&
        (state - FirstSlot >= slots || this->LastUse[block].load() != this->Frame);
      if (mustGo)
      {
        this->States[block].store(Missing, std::memory_order_relaxed);
        this->Used.fetch_sub(1, std::memory_order_relaxed);
        freed.push_back(state - FirstSlot);
      }
    }
    // Memory beyond the limit goes back to the system.
    freed.erase(std::remove_if(freed.begin(), freed.end(),
                  [slots](std::uint32_t slot) { return slot >= slots; }),
      freed.end());
    this->Free = std::move(freed);
    this->NextFree.store(0);
    if (this->NextSlot.load() > slots)
    {
      this->NextSlot.store(static_cast<std::uint32_t>(slots));
      for (std::size_t chunk = (slots + this->SlotsPerChunk - 1) / this->SlotsPerChunk;
           chunk < this->Chunks.size(); ++chunk)
      {
        ::operator delete(this->Chunks[chunk].exchange(nullptr), Alignment);
      }
    }
  }

  std::size_t SlotSize;
  std::size_t SlotsPerChunk;
  std::vector<std::atomic<std::uint32_t>> States;
  std::vector<std::atomic<std::byte*>> Chunks;
  std::atomic<std::uint32_t> NextSlot{ 0 };
  std::atomic<std::size_t> Used{ 0 };

  /// Freed slots, and how many of them are in use again.
  std::vector<std::uint32_t> Free;
  std::atomic<std::size_t> NextFree{ 0 };

  /// The frame that last used a block; empty while there is no limit.
  std::vector<std::atomic<std::uint32_t>> LastUse;
  std::uint32_t Frame = 0;
  bool IsLimited = false;
  std::size_t MaximumSlots = std::numeric_limits<std::size_t>::max();
  std::atomic<bool> IsExhausted{ false };
};

}

#endif
