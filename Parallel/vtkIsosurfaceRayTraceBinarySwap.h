// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Composites what the rays of many processes met by binary swap: see
// vtkIsosurfaceRayTraceCompositor.

#ifndef vtkIsosurfaceRayTraceBinarySwap_h
#define vtkIsosurfaceRayTraceBinarySwap_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkMultiProcessController.h"
#include "vtkType.h"

#include "Picture/Compositor.h"

#include <algorithm>   // for std::merge
#include <cstddef>     // for std::size_t
#include <iterator>    // for std::back_inserter
#include <type_traits> // for std::is_trivially_copyable_v
#include <vector>      // for std::vector

VTK_ABI_NAMESPACE_BEGIN

/// The records of a process that are in some rows of the picture, by pixel and in their order.
template <typename Record>
class vtkIsosurfaceRayTraceBinarySwap
{
public:
  static_assert(std::is_trivially_copyable_v<Record>, "Records are sent as bytes.");

  /// Those of the whole picture.
  vtkIsosurfaceRayTraceBinarySwap(std::vector<Record> records, int width, int height)
    : Records(std::move(records))
    , Width(width)
    , EndRow(height)
  {
  }

  /// The records of two groups of processes or of volumes, by pixel and in their order. Of those
  /// equal in order, those of the first come first.
  static std::vector<Record> Merge(
    const std::vector<Record>& first, const std::vector<Record>& second)
  {
    std::vector<Record> all;
    all.reserve(first.size() + second.size());
    std::merge(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(all),
      [](const Record& a, const Record& b) { return a.GetOrder() < b.GetOrder(); });
    // What one process with all data would not see is dropped.
    std::size_t kept = 0;
    double transmittance = 1.0;
    for (const Record& record : all)
    {
      const bool isSamePixel = kept > 0 && all[kept - 1].Pixel == record.Pixel;
      transmittance = isSamePixel ? transmittance : 1.0;
      if (transmittance >= vtkIsosurfaceRayTracing::NegligibleTransmittance)
      {
        all[kept++] = record;
        transmittance *= 1.0 - record.GetOpacity();
      }
    }
    all.resize(kept);
    return all;
  }

  /// Swaps with the other processes until each has some rows of what all have together; some
  /// processes may have none. All must call it.
  void Run(vtkMultiProcessController* controller)
  {
    this->Controller = controller;
    const int processes = controller->GetNumberOfProcesses();
    const int own = controller->GetLocalProcessId();
    int places = 1;
    while (2 * places <= processes)
    {
      places *= 2;
    }
    // So many places have two processes, which follow each other; the second gives all it has.
    const int pairs = processes - places;
    if (own < 2 * pairs && own % 2 == 1)
    {
      this->Send(this->Records, own - 1);
      this->Records.clear();
      this->EndRow = 0;
      return;
    }
    if (own < 2 * pairs)
    {
      this->Records = Merge(this->Records, this->Receive(own + 1));
    }
    const int place = own < 2 * pairs ? own / 2 : own - pairs;
    for (int step = 1; step < places; step *= 2)
    {
      const int other = place ^ step;
      this->Swap(other < pairs ? 2 * other : other + pairs, other > place);
    }
  }

  const std::vector<Record>& GetRecords() const { return this->Records; }
  int GetFirstRow() const { return this->FirstRow; }
  int GetEndRow() const { return this->EndRow; }
  vtkTypeInt64 GetBytesSent() const { return this->BytesSent; }

private:
  /// Keeps the lower or the upper half of the rows, and gives the other to another process.
  void Swap(int process, bool keepsLower)
  {
    const int middle = this->FirstRow + (this->EndRow - this->FirstRow) / 2;
    const auto border = std::lower_bound(this->Records.begin(), this->Records.end(), middle,
      [this](const Record& record, int row)
      { return record.Pixel < static_cast<std::int64_t>(row) * this->Width; });
    const std::vector<Record> lower(this->Records.begin(), border);
    const std::vector<Record> upper(border, this->Records.end());
    (keepsLower ? this->EndRow : this->FirstRow) = middle;
    // The one below sends first, so that no two wait for each other.
    if (keepsLower)
    {
      this->Send(upper, process);
      this->Records = Merge(lower, this->Receive(process));
    }
    else
    {
      const std::vector<Record> received = this->Receive(process);
      this->Send(lower, process);
      this->Records = Merge(received, upper);
    }
  }

  void Send(const std::vector<Record>& records, int process)
  {
    const auto count = static_cast<vtkTypeInt64>(records.size());
    const vtkTypeInt64 bytes = count * static_cast<vtkTypeInt64>(sizeof(Record));
    this->Controller->Send(&count, 1, process, Tag);
    this->Controller->Send(
      reinterpret_cast<const unsigned char*>(records.data()), bytes, process, Tag);
    this->BytesSent += bytes + static_cast<vtkTypeInt64>(sizeof(count));
  }

  std::vector<Record> Receive(int process)
  {
    vtkTypeInt64 count = 0;
    this->Controller->Receive(&count, 1, process, Tag);
    std::vector<Record> records(static_cast<std::size_t>(count));
    this->Controller->Receive(reinterpret_cast<unsigned char*>(records.data()),
      count * static_cast<vtkTypeInt64>(sizeof(Record)), process, Tag);
    return records;
  }

  static constexpr int Tag = 27182;

  std::vector<Record> Records;
  int Width;
  int FirstRow = 0;
  int EndRow;
  vtkMultiProcessController* Controller = nullptr;
  vtkTypeInt64 BytesSent = 0;
};

VTK_ABI_NAMESPACE_END

#endif
