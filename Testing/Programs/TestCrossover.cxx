// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The verdicts of vtkIsosurfaceCompare, on costs that can be summed in the head.

#include "IsosurfaceCompare/Crossover.h"

#include <cstdlib>
#include <iostream>
#include <string>

using namespace Compare;

namespace
{

bool Passed = true;

void Check(const Costs& triangles, const Costs& rays, const std::string& words)
{
  const std::string verdict = Describe(Judge(triangles, rays));
  if (verdict != words)
  {
    std::cerr << "FAILED: \"" << verdict << "\" should be \"" << words << "\"\n";
    Passed = false;
  }
}

}

int main()
{
  // 10, 11, 12, 13 against 2, 6, 10, 14.
  Check({ 10.0, 1.0 }, { 2.0, 4.0 }, "rays up to 3 pictures, triangles beyond");
  // 3, 4 against 2, 6.
  Check({ 3.0, 1.0 }, { 2.0, 4.0 }, "rays up to 1 picture, triangles beyond");
  // 2, 6, 10, 14 against 10, 11, 12, 13.
  Check({ 2.0, 4.0 }, { 10.0, 1.0 }, "triangles up to 3 pictures, rays beyond");
  Check({ 10.0, 4.0 }, { 2.0, 4.0 }, "rays, for any number of pictures");
  Check({ 10.0, 5.0 }, { 2.0, 4.0 }, "rays, for any number of pictures");
  Check({ 1.0, 1.0 }, { 2.0, 4.0 }, "triangles, for any number of pictures");
  Check({ 2.0, 1.0 }, { 2.0, 4.0 }, "triangles, for any number of pictures");

  // Extraction takes 9, drawing 1 of the 10; without drawing 9, 9, 9 against 2, 6, 10.
  const Crossover crossover = { { 2, 2, 2 }, 8.0, { 10.0, 1.0 }, { 2.0, 4.0 } };
  Check(crossover.GetFreeTriangles(), crossover.Rays, "rays up to 2 pictures, triangles beyond");

  return Passed ? EXIT_SUCCESS : EXIT_FAILURE;
}
