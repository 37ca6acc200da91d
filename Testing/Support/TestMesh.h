// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TestMesh_h
#define TestMesh_h

#include "Math/Vector.h"
#include "Mesh/MeshView.h"
#include "RandomNumbers.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A mesh that owns its arrays.
struct TestMesh
{
  std::vector<double> Points;
  std::vector<double> Values;
  /// The values of several components at all points, if there are several, instead.
  std::vector<double> Components;
  std::vector<unsigned char> Shapes;
  std::vector<std::int64_t> Offsets = { 0 };
  std::vector<std::int64_t> Connectivity;

  std::int64_t AddPoint(const Vector3& point, double value)
  {
    this->Points.insert(this->Points.end(), point.begin(), point.end());
    this->Values.push_back(value);
    return static_cast<std::int64_t>(this->Values.size()) - 1;
  }

  void AddCell(CellShape shape, std::initializer_list<std::int64_t> ids)
  {
    this->Shapes.push_back(static_cast<unsigned char>(shape));
    this->Connectivity.insert(this->Connectivity.end(), ids);
    this->Offsets.push_back(static_cast<std::int64_t>(this->Connectivity.size()));
  }

  Vector3 GetPoint(std::int64_t id) const
  {
    const double* point = this->Points.data() + 3 * id;
    return { point[0], point[1], point[2] };
  }

  /// Of the given component, if there are several.
  MeshView View(std::size_t component = 0) const
  {
    MeshView view;
    view.Points = this->Points.data();
    view.PointType = ScalarType::Float64;
    view.NumberOfPoints = static_cast<std::int64_t>(this->Values.size());
    view.Values = this->Values.data();
    view.ValueType = ScalarType::Float64;
    if (!this->Components.empty())
    {
      view.Components = this->Components.data();
      view.NumberOfComponents = static_cast<int>(this->Components.size() / this->Values.size());
      view.Values = this->Components.data() + component;
      view.ValueStride = view.NumberOfComponents;
    }
    view.Shapes = this->Shapes.data();
    view.Offsets = this->Offsets.data();
    view.Connectivity = this->Connectivity.data();
    view.NumberOfCells = static_cast<std::int64_t>(this->Shapes.size());
    return view;
  }
};

/// How the cubes between the points of a lattice are cut into cells.
enum class Cutting
{
  Tetrahedra,
  Hexahedra,
  Wedges,
  Pyramids,
  Mixed
};
inline constexpr Cutting AllCuttings[] = { Cutting::Tetrahedra, Cutting::Hexahedra, Cutting::Wedges,
  Cutting::Pyramids, Cutting::Mixed };

/// Adds the cells of a cube with corners x + 2 y + 4 z. Cubes with an odd sum of indices are cut so
/// that their faces agree with those of their neighbours.
inline void AddCube(
  TestMesh& mesh, const std::int64_t (&c)[8], Cutting cutting, bool isOdd, double centerValue)
{
  switch (cutting)
  {
    case Cutting::Tetrahedra:
    {
      constexpr int even[5][4] = { { 1, 0, 3, 5 }, { 2, 0, 3, 6 }, { 4, 0, 5, 6 }, { 7, 3, 5, 6 },
        { 0, 3, 5, 6 } };
      constexpr int odd[5][4] = { { 0, 1, 2, 4 }, { 3, 1, 2, 7 }, { 5, 1, 4, 7 }, { 6, 2, 4, 7 },
        { 1, 2, 4, 7 } };
      for (const auto& t : isOdd ? odd : even)
      {
        mesh.AddCell(CellShape::Tetrahedron, { c[t[0]], c[t[1]], c[t[2]], c[t[3]] });
      }
      return;
    }
    case Cutting::Wedges:
      mesh.AddCell(CellShape::Wedge, { c[0], c[1], c[2], c[4], c[5], c[6] });
      mesh.AddCell(CellShape::Wedge, { c[1], c[3], c[2], c[5], c[7], c[6] });
      return;
    case Cutting::Pyramids:
    {
      Vector3 center = {};
      for (const std::int64_t id : c)
      {
        center = center + mesh.GetPoint(id) * 0.125;
      }
      const std::int64_t apex = mesh.AddPoint(center, centerValue);
      constexpr int faces[6][4] = { { 0, 2, 6, 4 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 }, { 2, 3, 7, 6 },
        { 0, 1, 3, 2 }, { 4, 5, 7, 6 } };
      for (const auto& f : faces)
      {
        mesh.AddCell(CellShape::Pyramid, { c[f[0]], c[f[1]], c[f[2]], c[f[3]], apex });
      }
      return;
    }
    default:
      mesh.AddCell(CellShape::Hexahedron, { c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6] });
  }
}

/// A mesh of the unit cubes in a box of so many, with points moved by up to jitter along each axis,
/// and values by a function of the index of a point. Mixed has hexahedra and pyramids.
template <typename Function>
TestMesh MakeMesh(
  RandomNumbers& random, const Index3& cubes, Cutting cutting, double jitter, const Function& value)
{
  TestMesh mesh;
  const Index3 n = { cubes[0] + 1, cubes[1] + 1, cubes[2] + 1 };
  for (int z = 0; z < n[2]; ++z)
  {
    for (int y = 0; y < n[1]; ++y)
    {
      for (int x = 0; x < n[0]; ++x)
      {
        const Vector3 moved =
          random.PointInBox({ -jitter, -jitter, -jitter }, { jitter, jitter, jitter });
        mesh.AddPoint(Vector3{ x + 0.0, y + 0.0, z + 0.0 } + moved, value(Index3{ x, y, z }));
      }
    }
  }
  for (int z = 0; z < cubes[2]; ++z)
  {
    for (int y = 0; y < cubes[1]; ++y)
    {
      for (int x = 0; x < cubes[0]; ++x)
      {
        std::int64_t corners[8];
        for (int i = 0; i < 8; ++i)
        {
          corners[i] =
            (x + (i & 1)) + std::int64_t{ n[0] } * ((y + (i >> 1 & 1)) + n[1] * (z + (i >> 2)));
        }
        constexpr Cutting slabs[] = { Cutting::Hexahedra, Cutting::Pyramids };
        AddCube(mesh, corners, cutting == Cutting::Mixed ? slabs[x % 2] : cutting,
          (x + y + z) % 2 != 0, value(Index3{ x, y, z }));
      }
    }
  }
  return mesh;
}

}

#endif
