// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshField_h
#define MeshField_h

#include "Field/TracedField.h"
#include "Mesh/CellHits.h"
#include "Mesh/CellTree.h"
#include "Mesh/MeshCaps.h"
#include "Mesh/MeshCells.h"
#include "Mesh/MeshSelection.h"
#include "Mesh/MeshView.h"
#include "Mesh/PointGradients.h"

#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A mesh of cells as a field: tetrahedra, in which the field is linear, and isoparametric
/// hexahedra, wedges and pyramids. The tree over its cells is built at once and serves every
/// isovalue. Its object space is that of its points; the mesh must outlive it and not change.
///
/// Central differences are, in a mesh, gradients that are interpolated between those at the points:
/// see PointGradients.h. Parametric coordinates of hits are VTK's. Cells may overlap, have gaps
/// between them, and touch without sharing points; those with a point or a value that is not finite
/// are left out. Half-spaces may have caps: see MeshCaps.h.
class MeshField final : public TracedField
{
public:
  MeshField(const MeshCells& cells, int threads);
  MeshField(const MeshView& view, int threads);
  ~MeshField() override;

  void Select(const TraceRequest& request, const Execution& execution,
    const MemoryBudget& budget = {}) override;
  const TraceRequest& GetRequest() const override { return this->Selection.Request; }
  bool MayHit() const override;

  Bounds GetBounds() const override { return this->Tree.GetBounds(); }
  double GetCellSize() const override;
  /// Whether all cells that are traced are finite.
  bool AreAllCellsFinite() const { return this->Tree.AreAllFinite(); }
  void AddRay(const Vector3& origin, const Vector3& direction, double begin, double end,
    RayPacket& packet) const override;
  void ClipRays(RayPacket& packet) const override;
  void MakeRays(const Camera& view, const PixelRectangle& pixels, const PixelDepths& depths,
    RayPacket& packet) const override;
  std::unique_ptr<Beam> MakeBeam() const override;
  bool UsesBeams() const override { return this->Selection.PacketKernels != nullptr; }
  void Begin(const RayPacket& lines, Beam* beam) const override;
  bool MayHitBetween(RayPacket& lines, Beam* beam) const override;
  using TracedField::Trace;
  void Trace(RayPacket& packet, RayHits& hits, Beam* beam) override;
  bool GainsFromDirections() const override { return false; }
  void FindTransmittance(
    RayPacket& packet, const Departure* departures, double* transmittance) override;
  void AddClouds(const Camera& view, const std::vector<ValueIntervals>& shown,
    const Kernels* kernels, std::vector<ViewedCloud>& clouds) const override;
  Vector3 GetPoint(const Hit& hit) const override;
  Vector3 GetPointInCells(const Hit& hit) const override;
  Vector3 GetGradient(const Hit& hit, NormalMode mode) const override;
  void GetPointsAndGradients(const Hit* hits, int count, NormalMode mode,
    double (*points)[RayPacket::Capacity], double (*gradients)[RayPacket::Capacity]) const override;
  FieldStatistics GetStatistics() const override;
  double GetGradientSeconds() const override { return this->GradientSeconds; }

private:
  class ThreadBeam;
  class SpareBeams;

  struct GradientsOfComponent;

  void FindSmoothGradients(const TraceRequest& request, int threads);
  std::vector<const PointGradients*> FindGradientsOfCloud(int components, int threads);
  MeshSurface SelectSurface(double isovalue) const;
  std::unique_ptr<ThreadBeam> TakeBeamOf(const RayPacket& packet) const;
  RaySet TraceTogether(
    const RayPacket& packet, const Departure* departures, ThreadBeam& thread) const;
  RaySet TraceAlone(const RayPacket& packet, const RaySet& rays, const Departure* departures,
    ThreadBeam& thread) const;
  StoppedRays FindStopped(RayPacket& packet, const Departure* departures) const;

  std::vector<Cap> FindFirstCaps(RayPacket& packet, CellHits& inCell) const;
  bool AddHits(const Hit* first, std::vector<Hit>& found, std::vector<Hit>& hits) const;

  double GetUnitOfGradients() const;
  const PointGradients* GetSmoothGradients(NormalMode mode) const;

  MeshCells Cells;
  CellTree Tree;
  /// Built when a cloud is selected first.
  std::unique_ptr<CellBoxes> Boxes;
  /// Null until they are requested first.
  std::unique_ptr<PointGradients> Smooth;
  /// Those of each component of a cloud of several.
  std::vector<std::unique_ptr<GradientsOfComponent>> SmoothOfComponents;
  double GradientSeconds = 0.0;
  MeshSelection Selection;
  std::unique_ptr<SpareBeams> Spare;
};

}

#endif
