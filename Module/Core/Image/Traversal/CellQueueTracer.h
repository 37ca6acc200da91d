// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellQueueTracer_h
#define CellQueueTracer_h

#include "Image/Traversal/PacketTracer.h"

#include <array>
#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// Queues the cells that the rays of a packet may pass, slice by slice, with the addresses of their
/// corners, for kernels that classify many of them at once.
class CellQueueTracer : public PacketTracer
{
public:
  /// What the corners of cells are read from.
  class CornerSource
  {
  public:
    virtual ~CornerSource() = default;
    /// The address of the first corner of the first cell of a block; null unless all its corners
    /// are kept in rows.
    virtual const void* FindCorner(const Index3& block) = 0;
    /// The strides from there to the next corner along each axis, in bytes.
    virtual std::array<std::ptrdiff_t, 3> GetSteps() const = 0;
    /// Copies the corners of cells, wherever they are kept; valid until the next copy.
    virtual void Copy(PassedCells& cells, int axis, const Passages& passages) = 0;
    ///@{
    /// The number of the ScalarType and the strides of the corners in rows, or of copies, as
    /// kernels take them.
    virtual std::size_t GetType(bool areCopied) const = 0;
    virtual const std::ptrdiff_t* GetStrides(bool areCopied) const = 0;
    ///@}
  };

protected:
  using PacketTracer::PacketTracer;

  /// Takes all rays of a packet that exist to their ends.
  void TraceQueued(const RayPacket& packet, Cells& cells, CornerSource& corners, Order order);

  /// Takes the queued cells, which are left to it afterwards. The lanes of a vector behind the last
  /// repeat the first.
  virtual void TakeQueue(const Frustum& frustum) = 0;
  /// Keeps those of some passages whose rest is needed. Returns how many there are.
  virtual int KeepNeeded(const Frustum& frustum, int* passages, int count) const = 0;
  /// Keeps the passages that are not over. (Whether a ray needs more is unpredictable: counting is
  /// faster than branching.)
  template <typename IsOver>
  static int KeepOthers(const IsOver& isOver, int* passages, int count)
  {
    int kept = 0;
    for (int i = 0; i < count; ++i)
    {
      passages[kept] = passages[i];
      kept += isOver(passages[i]) ? 0 : 1;
    }
    return kept;
  }
  /// Called behind the last cell of a slice of blocks.
  virtual void EndQueuedSlice(const Frustum& frustum) = 0;

  void AddBlock(const Frustum& frustum, const Index3& block) override;

  /// Fills the lanes of a vector behind the last cell.
  static void Fill(PassedCells& cells);

  /// Reads the corners of candidates, and fills the lanes of a vector behind the last.
  void LoadCorners(bool areCopied, Candidates& candidates) const;

  CornerSource* Corners = nullptr;
  PassedCells Queue;
  /// Whether the corners of all passages are kept in rows.
  bool AllInRows = true;

private:
  void BeginFrustum(const Frustum& frustum) override;
  void EndSlice(const Frustum& frustum) override;
  void TakePassages(const Frustum& frustum);
  void AddCellsOfSlice(int axis, int passage, int slice);
  void EndQueue(const Frustum& frustum);

  std::array<std::ptrdiff_t, 3> CornerSteps = {};
  /// From the first corner of a slice of cells to that of each of its cells.
  std::array<std::ptrdiff_t, 64> StepsInSlice = {};
};

}

#endif
