// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceEnumerators.h"

#include "vtkIsosurfaceRayTraceMapper.h"
#include "vtkIsosurfaceRayTraceScalars.h"

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

template <typename Enumerator>
constexpr bool AreEqual(int ofMapper, Enumerator ofCore)
{
  return ofMapper == static_cast<int>(ofCore);
}

using Mapper = vtkIsosurfaceRayTraceMapper;

static_assert(AreEqual(Mapper::TRILINEAR, vtkirt::Interpolant::Trilinear));
static_assert(AreEqual(Mapper::NEAREST, vtkirt::Interpolant::Nearest));
static_assert(AreEqual(Mapper::CUBIC, vtkirt::Interpolant::Tricubic));

static_assert(AreEqual(Mapper::ROBUST, vtkirt::RootSolver::Robust));
static_assert(AreEqual(Mapper::ANALYTIC, vtkirt::RootSolver::Analytic));
static_assert(AreEqual(Mapper::MARMITT, vtkirt::RootSolver::Marmitt));
static_assert(AreEqual(Mapper::LINEAR, vtkirt::RootSolver::Linear));

static_assert(AreEqual(Mapper::INTERPOLANT_GRADIENT, vtkirt::NormalMode::InterpolantGradient));
static_assert(AreEqual(Mapper::CENTRAL_DIFFERENCES, vtkirt::NormalMode::CentralDifferences));

static_assert(AreEqual(Mapper::NO_BRICKS, vtkirt::BrickLayout::Unbricked));
static_assert(AreEqual(Mapper::APRON_BRICKS, vtkirt::BrickLayout::Apron));
static_assert(AreEqual(Mapper::TWO_LEVEL_BRICKS, vtkirt::BrickLayout::TwoLevel));

}

namespace vtkIsosurfaceRayTraceEnumerators
{

//------------------------------------------------------------------------------
vtkirt::Interpolant ToInterpolant(int interpolationMode)
{
  return static_cast<vtkirt::Interpolant>(interpolationMode);
}

//------------------------------------------------------------------------------
vtkirt::RootSolver ToRootSolver(int rootSolver)
{
  return static_cast<vtkirt::RootSolver>(rootSolver);
}

//------------------------------------------------------------------------------
vtkirt::NormalMode ToNormalMode(int normalMode)
{
  return static_cast<vtkirt::NormalMode>(normalMode);
}

//------------------------------------------------------------------------------
vtkirt::BrickLayout ToBrickLayout(int brickLayout)
{
  return static_cast<vtkirt::BrickLayout>(brickLayout);
}

//------------------------------------------------------------------------------
std::optional<vtkirt::Extremum> FindProjection(int blendMode)
{
  switch (blendMode)
  {
    case vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND:
      return vtkirt::Extremum::Largest;
    case vtkVolumeMapper::MINIMUM_INTENSITY_BLEND:
      return vtkirt::Extremum::Smallest;
    default:
      return std::nullopt;
  }
}

//------------------------------------------------------------------------------
std::optional<int> FindComponent(int vectorMode, int vectorComponent)
{
  switch (vectorMode)
  {
    case Mapper::MAGNITUDE:
      return vtkIsosurfaceRayTraceScalars::Magnitude;
    case Mapper::COMPONENT:
      return vectorComponent;
    default:
      return std::nullopt;
  }
}

}

VTK_ABI_NAMESPACE_END
