// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef HardCases_RandomScenes_h
#define HardCases_RandomScenes_h

#include "Scenes.h"

// Scenes, requests and ways to trace, each drawn from all that there are.

namespace HardCases
{

/// A field of some kind, of values that the type can hold, and rays of many kinds.
struct RandomScene
{
  explicit RandomScene(RandomNumbers& random);

  /// A value of a sample, one beside it, or any between samples.
  double DrawIsovalue(RandomNumbers& random) const;

  /// One to three different isovalues.
  std::vector<Isosurface> DrawSurfaces(RandomNumbers& random, double opacity) const;

  /// Anything that can be requested, for surfaces or a projection. The cells that it hides are
  /// those of the scene.
  TraceRequest DrawRequest(RandomNumbers& random) const;

  ScalarType Type;
  Field Samples;
  std::vector<Line> Lines;
  std::vector<unsigned char> HiddenCells;
};

/// How a scene is traced; no bit of the result may depend on it.
struct RandomWay
{
  explicit RandomWay(RandomNumbers& random);

  std::string ToText() const;

  ImageSettings Settings;
  vtkIsosurfaceRayTracing::Execution How;
  vtkIsosurfaceRayTracing::MemoryBudget Budget;
};

}

#endif
