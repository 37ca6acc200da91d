// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Finds hits of rays, and their properties in VTK's terms.

#ifndef vtkIsosurfaceRayTraceHits_h
#define vtkIsosurfaceRayTraceHits_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                       // for vtkIdType

#include "Field/TracedField.h"

#include <algorithm> // for std::min
#include <cstddef>   // for std::size_t
#include <vector>    // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCamera;
class vtkGenericCell;
struct vtkIsosurfaceRayTraceRequest;

class vtkIsosurfaceRayTraceHits
{
public:
  struct Description
  {
    vtkIdType CellId;
    /// In what is traced of the cell: some are divided.
    vtkIsosurfaceRayTracing::Vector3 Parametric;
    /// In world coordinates.
    vtkIsosurfaceRayTracing::Vector3 Position;
    /// In world coordinates, towards smaller values, of length one.
    vtkIsosurfaceRayTracing::Vector3 Normal;
    /// The isovalue of the surface, or the value of a projection.
    double Value;
  };

  /// The request must outlive this.
  explicit vtkIsosurfaceRayTraceHits(const vtkIsosurfaceRayTraceRequest& request);

  /// The hits of rays given in world coordinates, up to tEnd times their direction.
  vtkIsosurfaceRayTracing::RayHits Cast(
    const std::vector<vtkIsosurfaceRayTracing::Vector3>& origins,
    const std::vector<vtkIsosurfaceRayTracing::Vector3>& directions, double tEnd,
    int threads) const;

  /// With the parametric coordinates in the cell of the data.
  Description Describe(const vtkIsosurfaceRayTracing::Hit& hit) const;

  /// Makes the parametric coordinates of a hit those in the cell of the data, given any cell to
  /// use.
  void MoveToWholeCell(const vtkIsosurfaceRayTracing::Hit& hit, vtkGenericCell* any,
    vtkIsosurfaceRayTracing::Vector3& parametric) const;

  /// Calls visit(begin, count) for shares of a number of hits, in parallel.
  template <typename Visit>
  static void ForEachShare(std::size_t count, int threads, const Visit& visit)
  {
    constexpr std::size_t share = 1024;
    const auto shares = static_cast<std::ptrdiff_t>((count + share - 1) / share);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
    for (std::ptrdiff_t i = 0; i < shares; ++i)
    {
      const std::size_t begin = share * static_cast<std::size_t>(i);
      visit(begin, std::min(share, count - begin));
    }
  }

  /// Calls visit(i, description) for each of some hits where there is a surface.
  template <typename Visit>
  void DescribeEach(
    const vtkIsosurfaceRayTracing::Hit* hits, std::size_t count, const Visit& visit) const
  {
    Batch batch;
    Description descriptions[Batch::Capacity];
    const auto describe = [&]
    {
      this->Describe(batch, descriptions);
      for (std::size_t i = 0; i < batch.Count; ++i)
      {
        visit(batch.Numbers[i], descriptions[i]);
      }
      batch.Count = 0;
    };
    for (std::size_t i = 0; i < count; ++i)
    {
      if (hits[i].Surface == vtkIsosurfaceRayTracing::Hit::NoSurface)
      {
        continue;
      }
      if (!batch.HasRoomFor(hits[i]))
      {
        describe();
      }
      batch.Add(i, hits[i]);
    }
    if (batch.Count > 0)
    {
      describe();
    }
  }

  /// The positions and normals of hits in view coordinates, three numbers for every hit; zeros
  /// where there is none.
  void GetGeometry(const std::vector<vtkIsosurfaceRayTracing::Hit>& hits, vtkCamera* camera,
    int threads, std::vector<float>& positions, std::vector<float>& normals) const;

private:
  /// Hits of one volume, and their numbers among others.
  struct Batch
  {
    static constexpr std::size_t Capacity = vtkIsosurfaceRayTracing::RayPacket::Capacity;

    bool HasRoomFor(const vtkIsosurfaceRayTracing::Hit& hit) const
    {
      return this->Count == 0 || (this->Count < Capacity && this->Hits[0].Field == hit.Field);
    }

    void Add(std::size_t number, const vtkIsosurfaceRayTracing::Hit& hit)
    {
      this->Numbers[this->Count] = number;
      this->Hits[this->Count++] = hit;
    }

    std::size_t Count = 0;
    std::size_t Numbers[Capacity];
    vtkIsosurfaceRayTracing::Hit Hits[Capacity];
  };

  void Describe(const Batch& batch, Description* descriptions) const;

  const vtkIsosurfaceRayTraceRequest& Request;
  /// For each volume, the matrix that carries gradients to the world.
  std::vector<vtkIsosurfaceRayTracing::Matrix4> WorldFromGradient;
};

VTK_ABI_NAMESPACE_END

#endif
