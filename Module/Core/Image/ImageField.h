// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ImageField_h
#define ImageField_h

#include "Field/TracedField.h"
#include "Image/ImageSettings.h"
#include "Image/Samples/VolumeView.h"
#include "Image/Tracers/ImageSelection.h"

#include <memory>

namespace vtkIsosurfaceRayTracing
{

class ImageStructures;
class ImageTracer;
class RangeStore;

/// An image, or a rectilinear grid, as a field: macrocells are built in one pass over the samples,
/// bricks as rays need them. It depends on the samples and the settings alone; the samples must
/// outlive it and not change. Its object space is index space, or with uneven planes the space they
/// stand in (see UnevenPlanes).
class ImageField final : public TracedField
{
public:
  /// Builds the macrocells, with the given number of threads.
  static std::unique_ptr<ImageField> New(
    const VolumeView& view, const ImageSettings& settings, int threads);

  /// Reads no samples yet: rays hit nothing where there are no macrocells.
  static std::unique_ptr<ImageField> NewUnread(
    const VolumeView& view, const ImageSettings& settings);
  ~ImageField() override;

  /// Builds the macrocells over the next slab of samples, some MiB in the order that they have in
  /// memory; or takes all macrocells from a store, which may be null. To be called until all
  /// samples are read, each time with the same store, and before Select.
  void ReadSlab(int threads, RangeStore* store = nullptr);

  /// How much is read, from 0 to 1: everything.
  double GetFractionRead() const;

  /// Sets the lattice planes; null, as at first, stands for whole numbers. The planes must outlive
  /// their use. To be called before Select.
  void SetPlanes(const UnevenPlanes* planes);

  /// Finds the macrocells of the isovalues unless they are the same as before.
  void Select(const TraceRequest& request, const Execution& execution,
    const MemoryBudget& budget = {}) override;
  const TraceRequest& GetRequest() const override { return this->Selection.Request; }
  bool MayHit() const override;

  Bounds GetBounds() const override;
  void ClipRays(RayPacket& packet) const override;
  void AddRay(const Vector3& origin, const Vector3& direction, double begin, double end,
    RayPacket& packet) const override;
  void MoveRays(const RayPacket& rays, const RaysInBox& parts, const Matrix4& ownFromRays,
    RayPacket& moved) const override;
  void MakeRays(const Camera& view, const PixelRectangle& pixels, const PixelDepths& depths,
    RayPacket& packet) const override;
  bool MayHitBetween(RayPacket& lines, Beam* beam) const override;
  void Prefetch() const override;
  using TracedField::Trace;
  void Trace(RayPacket& packet, RayHits& hits, Beam* beam) override;
  void FindTransmittance(
    RayPacket& packet, const Departure* departures, double* transmittance) override;
  Vector3 GetPoint(const Hit& hit) const override;
  Vector3 GetPointInCells(const Hit& hit) const override;
  Vector3 GetGradient(const Hit& hit, NormalMode mode) const override;
  void GetPointsAndGradients(const Hit* hits, int count, NormalMode mode,
    double (*points)[RayPacket::Capacity], double (*gradients)[RayPacket::Capacity]) const override;
  FieldStatistics GetStatistics() const override;

  /// The cells of the image.
  const CellLattice& GetLattice() const { return this->Selection.Lattice; }

private:
  explicit ImageField(std::unique_ptr<ImageStructures> structures);

  const Kernels* GetKernelsOfRays() const;

  std::unique_ptr<ImageStructures> Structures;
  ImageSelection Selection;
  /// Whether what follows from the request is there.
  bool IsSelectionComplete = false;
  /// Whether macrocells were built after the last selection.
  bool HasReadMore = false;
  std::unique_ptr<ImageTracer> Tracer;
};

}

#endif
