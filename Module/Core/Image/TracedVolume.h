// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TracedVolume_h
#define TracedVolume_h

#include "Image/Samples/VolumeView.h"
#include "Kernels/InstructionSets.h"
#include "Kernels/Kernels.h"
#include "Rays/Hit.h"
#include "Rays/Ray.h"
#include "Rays/Visibility.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

enum class BrickLayout
{
  Unbricked,
  Apron,
  TwoLevel
};

enum class NormalMode
{
  InterpolantGradient,
  CentralDifferences
};

/// What is built over the samples of a volume, and how.
struct VolumeSettings
{
  /// The branching of the macrocell levels, finest first.
  std::vector<int> MacrocellBranching = { 8, 8 };
  BrickLayout Layout = BrickLayout::Apron;
  int BrickSize = 8;
  /// For BrickLayout::TwoLevel, in bricks.
  int BrickGroupSize = 4;

  bool operator==(const VolumeSettings& other) const
  {
    return this->MacrocellBranching == other.MacrocellBranching && this->Layout == other.Layout &&
      this->BrickSize == other.BrickSize && this->BrickGroupSize == other.BrickGroupSize;
  }
};

/// How the place where a ray meets the surface in a cell is found.
enum class RootSolver
{
  Robust,
  Analytic,
  Marmitt,
  Linear
};

/// What is between the samples.
enum class Interpolant
{
  Trilinear,
  /// The value of the nearest sample; see BoxFaces.h.
  Nearest,
  /// See TricubicCell.h.
  Tricubic
};

/// An isosurface to trace. Opacity is in (0, 1]; what is not seen at all is not traced.
struct Isosurface
{
  double Isovalue;
  double Opacity;
};

/// Which value along a ray is looked for.
enum class Extremum
{
  Largest,
  Smallest
};

/// What to look for along rays, and how.
struct TraceRequest
{
  TraceRequest() = default;
  TraceRequest(std::vector<Isosurface> surfaces, RootSolver solver = RootSolver::Robust,
    int interpolations = 3)
    : Surfaces(std::move(surfaces))
    , Solver(solver)
    , Interpolations(interpolations)
  {
  }

  /// In ascending order of their isovalues.
  std::vector<Isosurface> Surfaces;
  /// What the surfaces are of. A projection is always of the trilinear one.
  Interpolant Field = Interpolant::Trilinear;
  /// For Interpolant::Trilinear.
  RootSolver Solver = RootSolver::Robust;
  /// For RootSolver::Marmitt.
  int Interpolations = 3;
  /// If there is one, no surfaces are traced: a ray has one hit, the first of the places where the
  /// interpolant has its extreme value along all that is seen of the ray.
  std::optional<Extremum> Projection;
  /// What of the volume is seen at all.
  Visibility Visible;
  /// Where the samples stand; null if at whole numbers. Rays must be made with the same.
  const UnevenPlanes* Planes = nullptr;
  /// What rays are traced with where beams of them will do (see PacketTracer.h). With null, each
  /// ray goes by itself, cell after cell; the hits are the same.
  const Kernels* BeamKernels = &GetBestKernels();
  /// How much memory bricks and masks of cells may take, in bytes. Where it is not enough, those
  /// that were not used lately make room, and rays do without: the hits are the same.
  std::size_t MaximumMemory = std::numeric_limits<std::size_t>::max();

  bool IsNothing() const { return this->Surfaces.empty() && !this->Projection; }
};

/// The hits of a number of rays: ray i has those from First[i] to First[i + 1], front to back.
struct RayHits
{
  std::vector<Hit> Hits;
  std::vector<std::size_t> First;

  void Clear()
  {
    this->Hits.clear();
    this->First.assign(1, 0);
  }

  /// Adds those of further rays.
  void Append(const RayHits& others)
  {
    const std::size_t before = this->Hits.size();
    this->Hits.insert(this->Hits.end(), others.Hits.begin(), others.Hits.end());
    for (std::size_t ray = 1; ray < others.First.size(); ++ray)
    {
      this->First.push_back(before + others.First[ray]);
    }
  }
};

/// A ray is followed no further once the surfaces it passed let through less than this: a quarter
/// of a step of an 8-bit colour.
constexpr double NegligibleTransmittance = 1.0 / 1024.0;

/// A volume made ready for rays: macrocells at once, bricks as rays come. It depends on the samples
/// and the settings alone; the samples must outlive it and not change.
class TracedVolume
{
public:
  /// Builds the macrocells, with the given number of threads.
  static std::unique_ptr<TracedVolume> New(
    const VolumeView& view, const VolumeSettings& settings, int threads);
  virtual ~TracedVolume() = default;

  /// Chooses what to trace from now on: finds the macrocells of the isovalues unless they are the
  /// same as before.
  virtual void Select(const TraceRequest& wanted, int threads) = 0;

  /// Whether rays between lines that pass through one place, or are parallel, may hit a surface:
  /// those whose directions are means of the lines' own. The lines have an origin and a direction,
  /// and nothing else.
  virtual bool MayHitBetween(RayPacket& lines) const = 0;

  /// Finds the hits of rays with the surfaces, each ray up to the first opaque one or to where
  /// nothing of it is left to see. A ray that does not exist has no hits. Any number of threads may
  /// trace at once; what a ray hits does not depend on the others. Rays are cut to what is seen.
  virtual void Trace(RayPacket& rays, RayHits& hits) = 0;
  /// The same for any number of rays.
  void Trace(const std::vector<std::optional<Ray>>& rays, RayHits& hits);

  /// The gradient of the samples at a hit, in the space that rays go through; in a flat cell, as
  /// long as it likes.
  virtual Vector3 GetGradient(const Hit& hit, NormalMode mode) const = 0;

  /// The same for up to as many hits as a group of rays has, with kernels.
  virtual void GetGradients(const Hit* hits, int count, NormalMode mode, const Kernels& kernels,
    double (*gradients)[RayPacket::Capacity]) const = 0;

  virtual const Index3& GetDimensions() const = 0;
  /// In bytes.
  virtual std::size_t GetMacrocellMemory() const = 0;
  virtual std::size_t GetBrickMemory() const = 0;
  virtual std::size_t GetNumberOfBricks() const = 0;
  virtual std::size_t GetMaximumNumberOfBricks() const = 0;
  /// The time spent making bricks so far, summed over the threads.
  virtual std::int64_t GetBrickNanoseconds() const = 0;
};

}

#endif
