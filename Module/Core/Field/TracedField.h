// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TracedField_h
#define TracedField_h

#include "Field/CloudSource.h"
#include "Field/Departure.h"
#include "Field/Execution.h"
#include "Math/Bounds.h"
#include "Math/Vector.h"
#include "Rays/Camera.h"
#include "Rays/Hit.h"
#include "Rays/PixelRectangle.h"
#include "Rays/RayHits.h"
#include "Rays/RayPacket.h"
#include "Rays/RaysInBox.h"
#include "Rays/TraceRequest.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// What a field has built over its data, and keeps of them.
struct FieldStatistics
{
  /// What is built once, over all data (macrocells), in bytes.
  std::size_t HierarchyMemory = 0;
  /// What is built on demand while rays are traced (bricks, masks of cells), in bytes.
  std::size_t CacheMemory = 0;
  std::size_t NumberOfBricks = 0;
  std::size_t MaximumNumberOfBricks = 0;

  void operator+=(const FieldStatistics& other)
  {
    this->HierarchyMemory += other.HierarchyMemory;
    this->CacheMemory += other.CacheMemory;
    this->NumberOfBricks += other.NumberOfBricks;
    this->MaximumNumberOfBricks += other.MaximumNumberOfBricks;
  }
};

/// The rays through a block of pixels, and their hits.
struct TracedPacket
{
  /// Those at its corners, of which only the origins and the directions are set.
  RayPacket Corners;
  RayPacket Rays;
  RayHits Hits;
};

/// Scalar data that rays are traced through: an image, a rectilinear grid, a mesh of cells.
/// Everything above it (pictures, shadows, picking, rays without a picture) knows data by this
/// class alone.
///
/// A field lives in an object space of its own, an affine image of the world in which its
/// arithmetic is exact (for images, index space). Rays, points, gradients and bounds are in object
/// space. The T of a hit is that of the ray as it was given, and the same in all affine spaces:
/// hits of several fields are put in order by T.
///
/// Between calls of Select any number of threads may trace. What a ray hits does not depend on the
/// other rays of its packet, on the threads or the kernels.
class TracedField
{
public:
  /// What a thread keeps from packet to packet: what was found for one packet of a beam, a set of
  /// rays through one point or of parallel ones, serves the others. It decides about speed alone.
  class Beam
  {
  public:
    virtual ~Beam() = default;
  };

  virtual ~TracedField() = default;

  /// The box that all hits are in.
  virtual Bounds GetBounds() const = 0;

  /// Selects what to trace from now on, and begins a frame: what the last frame did not use may be
  /// evicted from the cache. Rays must be made after it.
  virtual void Select(
    const TraceRequest& request, const Execution& execution, const MemoryBudget& budget = {}) = 0;

  /// What was selected.
  virtual const TraceRequest& GetRequest() const = 0;

  /// Whether rays may hit anything of what was selected.
  virtual bool MayHit() const { return true; }

  /// Appends the part of a ray in the field (begin <= t <= end) to a packet that has room for it.
  /// If there is none, or the ray is no ray (not finite, without direction), it does not exist
  /// there.
  virtual void AddRay(const Vector3& origin, const Vector3& direction, double begin, double end,
    RayPacket& packet) const = 0;

  /// Cuts the rays of a packet to the field, exactly as AddRay does. Of those that exist origins,
  /// directions, begins and ends are given.
  virtual void ClipRays(RayPacket& packet) const;

  /// Moves parts of rays, which are in another space, to the object space of the field, in which
  /// they make a packet with the same places. The matrix is affine.
  virtual void MoveRays(const RayPacket& rays, const RaysInBox& parts, const Matrix4& ownFromRays,
    RayPacket& moved) const;

  /// Makes a packet of a ray for every pixel of a rectangle of the viewport, row by row. Each ends
  /// at the depth of its pixel, in [0, 1]; with null, at the far plane.
  virtual void MakeRays(const Camera& view, const PixelRectangle& pixels, const PixelDepths& depths,
    RayPacket& packet) const;

  /// Makes a beam for one thread, to be begun; null if the field does not use any.
  virtual std::unique_ptr<Beam> MakeBeam() const { return nullptr; }
  virtual bool UsesBeams() const { return false; }

  /// Begins with the rays between four lines that pass through one point, or are parallel: those
  /// whose directions are means of the lines' own. The lines are a packet of which only the origins
  /// and the directions are set. To be called again after Select.
  virtual void Begin(const RayPacket& /*lines*/, Beam* /*beam*/) const {}

  /// Whether rays between such lines may hit anything. The beam may be null; if not they must be in
  /// it.
  virtual bool MayHitBetween(RayPacket& /*lines*/, Beam* /*beam*/) const { return true; }

  /// Finds the hits of each ray, in order, up to the first opaque one or to where no transmittance
  /// is left. A ray that does not exist has no hits. The beam may be null; if not the rays must be
  /// between its lines, but for rounding.
  virtual void Trace(RayPacket& packet, RayHits& hits, Beam* beam) = 0;
  void Trace(RayPacket& packet, RayHits& hits) { this->Trace(packet, hits, nullptr); }

  /// Asks for the memory that Trace reads first.
  virtual void Prefetch() const {}

  /// The number of neighbouring packets that are best traced together, up to 8.
  virtual int GetPacketsAtOnce() const { return 1; }

  /// Finds the hits of several packets of a beam, which must be begun.
  virtual void TracePackets(TracedPacket* packets, int count, Beam* beam);

  /// Whether rays are traced faster if those of a packet have similar directions, even if it takes
  /// some time to find such rays.
  virtual bool GainsFromDirections() const { return true; }

  /// Finds the transmittance along each ray: the product of those of the surfaces it crosses,
  /// without the crossing that it starts from. There is a departure for each ray. The packet is
  /// used up.
  virtual void FindTransmittance(
    RayPacket& packet, const Departure* departures, double* transmittance);

  /// Appends what a thread finds the cells with that are drawn as a cloud, given the camera in the
  /// object space of the field, and the values that show anything: cells without them may be passed
  /// over. They are those of the traced component, or of each component of the data, all of which
  /// are found then. A field that cannot be drawn so appends nothing. The kernels may be null.
  virtual void AddClouds(const Camera& /*view*/, const std::vector<ValueIntervals>& /*shown*/,
    const Kernels* /*kernels*/, std::vector<ViewedCloud>& /*clouds*/) const
  {
  }

  /// What a cell of average size is long, about, in object space.
  virtual double GetCellSize() const { return 1.0; }

  /// The point of a hit.
  virtual Vector3 GetPoint(const Hit& hit) const = 0;

  /// The point of a hit counted in cells: coordinates that change by about one from a cell to the
  /// next.
  virtual Vector3 GetPointInCells(const Hit& hit) const = 0;

  /// The gradient of the field at a hit, or for a cap the normal of its plane. Where it is
  /// infinite, or values are so large or small that they are scaled, any multiple of its direction.
  virtual Vector3 GetGradient(const Hit& hit, NormalMode mode) const = 0;

  /// The points of hits, and their gradients: of up to as many as a packet has rays.
  virtual void GetPointsAndGradients(const Hit* hits, int count, NormalMode mode,
    double (*points)[RayPacket::Capacity], double (*gradients)[RayPacket::Capacity]) const = 0;

  virtual FieldStatistics GetStatistics() const = 0;

  /// The time that the last selection took to find gradients of all data.
  virtual double GetGradientSeconds() const { return 0.0; }

  /// The value of a hit: its isovalue, or the extreme value of a projection.
  double GetValue(const Hit& hit) const
  {
    const TraceRequest& request = this->GetRequest();
    return request.Projection ? hit.Value
                              : request.Surfaces[static_cast<std::size_t>(hit.Surface)].Isovalue;
  }
};

}

#endif
