// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TraceRequest_h
#define TraceRequest_h

#include "Rays/Visibility.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// An isosurface to trace. Opacity is in (0, 1]; what is not visible at all is not traced.
struct Isosurface
{
  double Isovalue;
  double Opacity;

  bool operator==(const Isosurface& other) const
  {
    return this->Isovalue == other.Isovalue && this->Opacity == other.Opacity;
  }
};

/// The extreme value along a ray that a projection shows.
enum class Extremum
{
  Largest,
  Smallest
};

/// The interpolant between the samples.
enum class Interpolant
{
  Trilinear,
  /// The value of the nearest sample; see BoxFaces.h.
  Nearest,
  /// See TricubicCell.h.
  Tricubic
};

/// How the point where a ray meets a surface of the trilinear interpolant in a cell is found.
enum class RootSolver
{
  Robust,
  Analytic,
  Marmitt,
  Linear
};

enum class NormalMode
{
  InterpolantGradient,
  CentralDifferences
};

/// What to trace. How it is done is in Execution.
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
  /// Of each member of a FieldSet the opacity of all its surfaces, in (0, 1], in place of their
  /// own; or none. Empty: no member has one.
  std::vector<std::optional<double>> MemberOpacities;
  /// What the surfaces are of. A projection is always of the trilinear one.
  Interpolant Interpolation = Interpolant::Trilinear;
  /// For Interpolant::Trilinear.
  RootSolver Solver = RootSolver::Robust;
  /// For RootSolver::Marmitt.
  int Interpolations = 3;
  /// If there is one, no surfaces are traced: a ray has one hit, the first of the points where the
  /// interpolant has its extreme value along all that is visible of the ray.
  std::optional<Extremum> Projection;
  /// Whether the field is drawn as a cloud, too: see TracedField::AddClouds.
  bool HasCloud = false;
  /// How many components of the cloud, the last of those that it takes, have gradients that light
  /// it: none, one, or all.
  int LitComponents = 0;
  /// What of the field is visible at all.
  Visibility Visible;
  /// The gradients that hits and clouds are shaded by.
  NormalMode Normals = NormalMode::CentralDifferences;

  bool operator==(const TraceRequest& other) const
  {
    return this->Surfaces == other.Surfaces && this->MemberOpacities == other.MemberOpacities &&
      this->Interpolation == other.Interpolation && this->Solver == other.Solver &&
      this->Interpolations == other.Interpolations && this->Projection == other.Projection &&
      this->HasCloud == other.HasCloud && this->LitComponents == other.LitComponents &&
      this->Visible == other.Visible && this->Normals == other.Normals;
  }

  bool IsNothing() const { return this->Surfaces.empty() && !this->Projection && !this->HasCloud; }

  /// How much of the light a hit with a surface stops, and shows.
  double GetOpacity(const Hit& hit) const
  {
    const double opacity = this->Surfaces[static_cast<std::size_t>(hit.Surface)].Opacity;
    return this->MemberOpacities.empty()
      ? opacity
      : this->MemberOpacities[static_cast<std::size_t>(hit.Member)].value_or(opacity);
  }

  bool HasOnlyOpaqueSurfaces() const
  {
    const bool areOpaque = std::all_of(this->Surfaces.begin(), this->Surfaces.end(),
      [](const Isosurface& surface) { return surface.Opacity >= 1.0; });
    const bool areOpaqueOfMembers = this->MemberOpacities.empty()
      ? areOpaque
      : std::all_of(this->MemberOpacities.begin(), this->MemberOpacities.end(),
          [areOpaque](const std::optional<double>& opacity)
          { return opacity ? *opacity >= 1.0 : areOpaque; });
    return !this->Projection && areOpaqueOfMembers;
  }

  /// Whether any crossing of a surface stops the light.
  bool EndsRaysAtAnyHit() const
  {
    return this->HasOnlyOpaqueSurfaces() && this->Visible.IsConvex() && !this->Visible.HasCaps();
  }
};

}

#endif
