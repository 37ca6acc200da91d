// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Cells/TrilinearRoots.h"

#include "Field/RootSet.h"
#include "Image/Cells/Solvers/AnalyticSolver.h"
#include "Image/Cells/Solvers/LinearSolver.h"
#include "Image/Cells/Solvers/MarmittSolver.h"
#include "Image/Cells/Solvers/RobustSolver.h"

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
CellCorners TakeOff(const CellCorners& corners, const ScaledIsovalue& isovalue)
{
  CellCorners differences;
  FindDifferences(corners.data(), isovalue.Isovalue, isovalue.Scale, differences.data());
  return differences;
}

//------------------------------------------------------------------------------
void AddTrilinearRoots(const CellCorners& differences, const CellSegment& segment,
  const TraceRequest& request, int surface, bool firstOnly, RootSet& roots)
{
  const auto add = [&roots, surface, firstOnly](double fraction, bool entering)
  {
    roots.Add({ fraction, surface, entering });
    return firstOnly;
  };
  switch (request.Solver)
  {
    case RootSolver::Robust:
      Robust::ForEachRoot(differences, segment, add);
      break;
    case RootSolver::Analytic:
      Analytic::ForEachRoot(differences, segment, add);
      break;
    case RootSolver::Marmitt:
      Marmitt::ForEachRoot(differences, segment, request.Interpolations, add);
      break;
    case RootSolver::Linear:
      Linear::ForEachRoot(differences, segment, add);
      break;
  }
}

}
