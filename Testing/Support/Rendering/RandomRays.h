// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RandomRays_h
#define RandomRays_h

#include "AnalyticFields.h"
#include "vtkIsosurfaceRayTraceMapper.h"

#include <vtkDoubleArray.h>
#include <vtkMath.h>
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkVolume.h>

namespace MapperTesting
{

/// Rays that come from all sides and pass the cube around a center.
struct RandomRays
{
  RandomRays(const AnalyticFields::Point& center, double halfEdge, int count)
  {
    vtkNew<vtkMinimalStandardRandomSequence> random;
    random->SetSeed(5);
    const auto next = [&random]() { return random->GetNextRangeValue(-1.0, 1.0); };
    this->Origins->SetDataTypeToDouble();
    this->Directions->SetNumberOfComponents(3);
    for (int i = 0; i < count; ++i)
    {
      double direction[3] = { next(), next(), next() };
      vtkMath::Normalize(direction);
      double origin[3];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        origin[axis] = center[axis] + halfEdge * (next() - 5.0 * direction[axis]);
      }
      this->Origins->InsertNextPoint(origin);
      this->Directions->InsertNextTuple(direction);
    }
  }

  /// The hits, from the output of vtkIsosurfaceRayTraceMapper::CastRays.
  vtkSmartPointer<vtkPolyData> Cast(vtkIsosurfaceRayTraceMapper* mapper, vtkVolume* volume) const
  {
    auto hits = vtkSmartPointer<vtkPolyData>::New();
    mapper->CastRays(volume, this->Origins, this->Directions, hits);
    return hits;
  }

  vtkNew<vtkPoints> Origins;
  vtkNew<vtkDoubleArray> Directions;
};

}

#endif
