// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The picture is the same, bit for bit, however the work is divided and the samples are laid out.

#include "AnalyticFields.h"
#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <functional>

using namespace MapperTesting;

int TestIsosurfaceRayTraceMapperDeterminism(int, char*[])
{
  Checks check;
  const auto image = NewCube(43,
    [](const AnalyticFields::Point& p)
    {
      return std::sin(9.0 * p[0]) * std::cos(7.0 * p[1]) +
        std::sin(8.0 * p[1]) * std::cos(6.0 * p[2]) + 0.3 * std::sin(31.0 * p[0] + 17.0 * p[2]);
    });
  const auto draw = [image](const std::function<void(vtkIsosurfaceRayTraceMapper*)>& apply)
  {
    Scene scene(image);
    scene.SetSurface(0.3, { 0.9, 0.5, 0.3 }, 0.4);
    scene.AddSurface(0.8, { 0.3, 0.5, 0.9 }, 1.0);
    apply(scene.Mapper);
    return RenderAndCapture(scene.Window);
  };
  const Picture expected = draw([](vtkIsosurfaceRayTraceMapper*) {});
  const auto compare =
    [&](const std::string& name, const std::function<void(vtkIsosurfaceRayTraceMapper*)>& apply)
  { check.Equal(GetDifference(draw(apply), expected, 0), 0.0, "the difference with " + name); };

  for (const int threads : { 1, 2, 3, 8 })
  {
    compare(std::to_string(threads) + " threads",
      [threads](vtkIsosurfaceRayTraceMapper* mapper) { mapper->SetNumberOfThreads(threads); });
  }
  for (const int tile : { 1, 7, 64, 4096 })
  {
    compare("tiles of " + std::to_string(tile),
      [tile](vtkIsosurfaceRayTraceMapper* mapper) { mapper->SetTileSize(tile, tile); });
  }
  for (int layout = vtkIsosurfaceRayTraceMapper::NO_BRICKS;
       layout <= vtkIsosurfaceRayTraceMapper::TWO_LEVEL_BRICKS; ++layout)
  {
    for (const int size : { 2, 5, 8, 64 })
    {
      compare("layout " + std::to_string(layout) + " of size " + std::to_string(size),
        [layout, size](vtkIsosurfaceRayTraceMapper* mapper)
        {
          mapper->SetBrickLayout(layout);
          mapper->SetBrickSize(size);
          mapper->SetBrickGroupSize(3);
        });
    }
  }
  for (const int levels : { 0, 1, 3, 8 })
  {
    for (const int branching : { 2, 3, 64 })
    {
      compare(std::to_string(levels) + " levels of branching " + std::to_string(branching),
        [levels, branching](vtkIsosurfaceRayTraceMapper* mapper)
        {
          mapper->SetNumberOfMacrocellLevels(levels);
          for (int level = 0; level < levels; ++level)
          {
            mapper->SetMacrocellBranching(level, branching);
          }
        });
    }
  }
  return check.Result();
}
