// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceComparisonTopology.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace vtkIsosurfaceComparison
{
namespace
{

using Vector = std::array<double, 3>;

/// The values at the corners of a cell, less the isovalue: corner (x, y, z) is x + 2 y + 4 z.
using Corners = std::array<double, 8>;

/// For each corner the region it is in; what matters is who has the same.
using Regions = std::array<int, 8>;

/// Sets that grow together, of small numbers from 0 on.
template <int Count>
class Sets
{
public:
  Sets() { std::iota(this->Parents.begin(), this->Parents.end(), 0); }

  int Find(int i) const
  {
    while (this->Parents[i] != i)
    {
      i = this->Parents[i];
    }
    return i;
  }

  void Join(int i, int j) { this->Parents[this->Find(i)] = this->Find(j); }

private:
  std::array<int, Count> Parents;
};

//------------------------------------------------------------------------------
bool IsInside(double value)
{
  return value >= 0.0;
}

//------------------------------------------------------------------------------
/// Edge number e joins corner Begin to corner Begin + (1 << Axis).
struct Edge
{
  int Axis;
  int Begin;
  int End;
};

const std::array<Edge, 12>& GetEdges()
{
  static const std::array<Edge, 12> edges = []()
  {
    std::array<Edge, 12> result;
    int count = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int corner = 0; corner < 8; ++corner)
      {
        if ((corner >> axis & 1) == 0)
        {
          result[count++] = { axis, corner, corner + (1 << axis) };
        }
      }
    }
    return result;
  }();
  return edges;
}

//------------------------------------------------------------------------------
Sets<8> JoinAlongEdges(const Corners& corners)
{
  Sets<8> sets;
  for (const Edge& edge : GetEdges())
  {
    if (IsInside(corners[edge.Begin]) == IsInside(corners[edge.End]))
    {
      sets.Join(edge.Begin, edge.End);
    }
  }
  return sets;
}

//------------------------------------------------------------------------------
bool IsAmbiguous(const Corners& corners)
{
  const Sets<8> sets = JoinAlongEdges(corners);
  int regions = 0;
  for (int i = 0; i < 8; ++i)
  {
    regions += sets.Find(i) == i ? 1 : 0;
  }
  return regions > 2;
}

//------------------------------------------------------------------------------
/// The trilinear function as a polynomial: its value at x, y, z, and its derivatives.
class Trilinear
{
public:
  explicit Trilinear(const Corners& v)
    : X(v[1] - v[0])
    , Y(v[2] - v[0])
    , Z(v[4] - v[0])
    , XY(v[3] - v[2] - v[1] + v[0])
    , XZ(v[5] - v[4] - v[1] + v[0])
    , YZ(v[6] - v[4] - v[2] + v[0])
    , XYZ(v[7] - v[6] - v[5] - v[3] + v[4] + v[2] + v[1] - v[0])
    , Constant(v[0])
  {
  }

  double GetValue(const Vector& p) const
  {
    return this->Constant + p[0] * (this->X + p[1] * this->XY) +
      p[1] * (this->Y + p[2] * this->YZ) +
      p[2] * (this->Z + p[0] * this->XZ + p[0] * p[1] * this->XYZ);
  }

  Vector GetGradient(const Vector& p) const
  {
    return { this->X + p[1] * this->XY + p[2] * this->XZ + p[1] * p[2] * this->XYZ,
      this->Y + p[0] * this->XY + p[2] * this->YZ + p[0] * p[2] * this->XYZ,
      this->Z + p[0] * this->XZ + p[1] * this->YZ + p[0] * p[1] * this->XYZ };
  }

  /// The second derivatives by two different coordinates; those by one twice are 0.
  void GetHessian(const Vector& p, double hessian[3][3]) const
  {
    hessian[0][0] = hessian[1][1] = hessian[2][2] = 0.0;
    hessian[0][1] = hessian[1][0] = this->XY + p[2] * this->XYZ;
    hessian[0][2] = hessian[2][0] = this->XZ + p[1] * this->XYZ;
    hessian[1][2] = hessian[2][1] = this->YZ + p[0] * this->XYZ;
  }

  /// The points where the gradient vanishes, anywhere in space: at most two.
  std::vector<Vector> FindSaddles() const;

private:
  double X;
  double Y;
  double Z;
  double XY;
  double XZ;
  double YZ;
  double XYZ;
  double Constant;
};

//------------------------------------------------------------------------------
std::vector<Vector> Trilinear::FindSaddles() const
{
  const double largest =
    std::max({ std::abs(this->XY), std::abs(this->XZ), std::abs(this->YZ), std::abs(this->XYZ) });
  if (std::abs(this->XYZ) <= 1e-9 * largest)
  {
    // The gradient is linear.
    double hessian[3][3];
    this->GetHessian({ 0.0, 0.0, 0.0 }, hessian);
    const double determinant = vtkMath::Determinant3x3(hessian);
    if (determinant == 0.0)
    {
      return {};
    }
    double inverse[3][3];
    vtkMath::Invert3x3(hessian, inverse);
    const double gradient[3] = { -this->X, -this->Y, -this->Z };
    Vector saddle;
    vtkMath::Multiply3x3(inverse, gradient, saddle.data());
    return { saddle };
  }
  // With the origin moved to where the second derivatives vanish, the gradient is
  // (a + k y z, b + k x z, c + k x y).
  const double k = this->XYZ;
  const Vector origin = { -this->YZ / k, -this->XZ / k, -this->XY / k };
  const Vector gradient = this->GetGradient(origin);
  const double a = -gradient[0] / k;
  const double b = -gradient[1] / k;
  const double c = -gradient[2] / k;
  if (!(a * b * c > 0.0))
  {
    return {};
  }
  const double x = std::sqrt(b * c / a);
  const double y = c / x;
  const double z = b / x;
  return { { origin[0] + x, origin[1] + y, origin[2] + z },
    { origin[0] - x, origin[1] - y, origin[2] - z } };
}

//------------------------------------------------------------------------------
/// The corner that is reached from a point by going along x, y and z in turn, each time to where
/// the function is larger. It is linear along an axis, so it never falls on the way.
int Climb(const Trilinear& function, Vector point)
{
  int corner = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool forward = function.GetGradient(point)[axis] > 0.0;
    point[axis] = forward ? 1.0 : 0.0;
    corner += forward ? 1 << axis : 0;
  }
  return corner;
}

//------------------------------------------------------------------------------
/// Joins the corners inside that a face joins: at the saddle of the face it is inside (G. Nielson,
/// B. Hamann: The Asymptotic Decider. IEEE Visualization 1991).
void JoinAcrossFaces(const Corners& corners, Sets<8>& sets)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int right = 1 << (axis + 1) % 3;
    const int up = 1 << (axis + 2) % 3;
    for (const int begin : { 0, 1 << axis })
    {
      const int diagonals[2][2] = { { begin, begin + right + up }, { begin + right, begin + up } };
      for (int i = 0; i < 2; ++i)
      {
        const double a = corners[diagonals[i][0]];
        const double b = corners[diagonals[i][1]];
        const double c = corners[diagonals[1 - i][0]];
        const double d = corners[diagonals[1 - i][1]];
        const bool isCrossed = IsInside(a) && IsInside(b) && !IsInside(c) && !IsInside(d);
        // The value at the saddle is (a b - c d) / (a + b - c - d), whose divisor is positive.
        if (isCrossed && a * b >= c * d)
        {
          sets.Join(diagonals[i][0], diagonals[i][1]);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Joins the corners inside that a tunnel joins. Two regions where the function is large meet at a
/// saddle from which it rises in two opposite directions only.
void JoinThroughTunnels(const Corners& corners, Sets<8>& sets)
{
  constexpr double step = 1e-4;
  const Trilinear function(corners);
  for (const Vector& saddle : function.FindSaddles())
  {
    const bool isInCell =
      std::all_of(saddle.begin(), saddle.end(), [](double u) { return u > 0.0 && u < 1.0; });
    if (!isInCell || !IsInside(function.GetValue(saddle)))
    {
      continue;
    }
    double hessian[3][3];
    function.GetHessian(saddle, hessian);
    // The sum of the eigenvalues is 0: their product is positive if one is positive and two are
    // not.
    if (vtkMath::Determinant3x3(hessian) > 0.0)
    {
      double* rows[3] = { hessian[0], hessian[1], hessian[2] };
      Vector eigenvalues;
      double vectors[3][3];
      double* eigenvectors[3] = { vectors[0], vectors[1], vectors[2] };
      vtkMath::Jacobi(rows, eigenvalues.data(), eigenvectors); // The largest comes first.
      Vector forth = saddle;
      Vector back = saddle;
      for (std::size_t i = 0; i < 3; ++i)
      {
        forth[i] += step * vectors[i][0];
        back[i] -= step * vectors[i][0];
      }
      sets.Join(Climb(function, forth), Climb(function, back));
    }
  }
}

//------------------------------------------------------------------------------
/// Regions change only at critical points: of edges (which have none between their ends), of faces
/// and of the inside of the cell. What is joined outside is joined inside, for the negative.
Regions FindRegionsOfInterpolant(const Corners& corners)
{
  Corners negative;
  std::transform(corners.begin(), corners.end(), negative.begin(), std::negate<>());
  Sets<8> sets = JoinAlongEdges(corners);
  for (const Corners& signs : { corners, negative })
  {
    JoinAcrossFaces(signs, sets);
    JoinThroughTunnels(signs, sets);
  }
  Regions regions;
  for (int i = 0; i < 8; ++i)
  {
    regions[i] = sets.Find(i);
  }
  return regions;
}

//------------------------------------------------------------------------------
/// Where the triangles of a cell have their vertices, in coordinates of the cell.
using Triangles = std::vector<std::array<Vector, 3>>;

/// The edge on which a vertex is: the one that the isosurface crosses nearest to it.
int FindEdge(const Corners& corners, const Vector& vertex)
{
  int found = -1;
  double nearest = VTK_DOUBLE_MAX;
  for (int i = 0; i < 12; ++i)
  {
    const Edge& edge = GetEdges()[i];
    const double begin = corners[edge.Begin];
    const double end = corners[edge.End];
    if (IsInside(begin) != IsInside(end))
    {
      Vector crossing = { static_cast<double>(edge.Begin & 1),
        static_cast<double>(edge.Begin >> 1 & 1), static_cast<double>(edge.Begin >> 2) };
      crossing[edge.Axis] = begin / (begin - end);
      const double distance = vtkMath::Distance2BetweenPoints(crossing.data(), vertex.data());
      if (distance < nearest)
      {
        nearest = distance;
        found = i;
      }
    }
  }
  return found;
}

//------------------------------------------------------------------------------
/// Each connected piece of the mesh in the cell parts it in two, so a region is told by the side
/// of each piece it is on; and a side changes where an edge of the cell is cut by the piece.
Regions FindRegionsOfMesh(const Corners& corners, const Triangles& triangles)
{
  Sets<12> pieces;
  std::array<bool, 12> isCut = {};
  for (const auto& triangle : triangles)
  {
    const int first = FindEdge(corners, triangle[0]);
    for (const Vector& vertex : triangle)
    {
      const int edge = FindEdge(corners, vertex);
      pieces.Join(first, edge);
      isCut[edge] = true;
    }
  }
  // Along x to 1, along y to 2 and 3, along z to the rest.
  Regions sides = {};
  for (const Edge& edge : GetEdges())
  {
    const bool isOnTheWay = edge.End < (2 << edge.Axis);
    if (isOnTheWay)
    {
      const auto number = static_cast<int>(&edge - GetEdges().data());
      sides[edge.End] = sides[edge.Begin] ^ (isCut[number] ? 1 << pieces.Find(number) : 0);
    }
  }
  return sides;
}

//------------------------------------------------------------------------------
bool AreSame(const Regions& a, const Regions& b)
{
  for (int i = 0; i < 8; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      if ((a[i] == a[j]) != (b[i] == b[j]))
      {
        return false;
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
struct AmbiguousCell
{
  Corners Values;
  Triangles Mesh;
};

/// The cells of an image, numbered from the first of its extent.
class Cells
{
public:
  explicit Cells(vtkImageData* image)
    : Image(image)
    , Extent(image->GetExtent())
    , Dimensions(image->GetDimensions())
  {
  }

  vtkIdType GetId(const int ijk[3]) const
  {
    return ijk[0] +
      static_cast<vtkIdType>(this->Dimensions[0] - 1) *
      (ijk[1] + static_cast<vtkIdType>(this->Dimensions[1] - 1) * ijk[2]);
  }

  /// The cell in which a point is, and the point from its first corner.
  vtkIdType Locate(const double point[3], int ijk[3]) const
  {
    const Vector index = this->GetIndex(point);
    for (int i = 0; i < 3; ++i)
    {
      ijk[i] =
        std::clamp(static_cast<int>(std::floor(index[i])), 0, std::max(0, this->Dimensions[i] - 2));
    }
    return this->GetId(ijk);
  }

  Vector GetIndex(const double point[3]) const
  {
    Vector index;
    this->Image->TransformPhysicalPointToContinuousIndex(point, index.data());
    return { index[0] - this->Extent[0], index[1] - this->Extent[2], index[2] - this->Extent[4] };
  }

private:
  vtkImageData* Image;
  const int* Extent;
  const int* Dimensions;
};

//------------------------------------------------------------------------------
enum Sign : unsigned char
{
  Outside,
  Inside,
  Untold
};

std::vector<Sign> FindSigns(vtkDataArray* scalars, double isovalue)
{
  std::vector<Sign> signs(static_cast<std::size_t>(scalars->GetNumberOfTuples()));
  for (std::size_t i = 0; i < signs.size(); ++i)
  {
    const double value = scalars->GetComponent(static_cast<vtkIdType>(i), 0) - isovalue;
    signs[i] = value > 0.0 ? Inside : value < 0.0 ? Outside : Untold;
  }
  return signs;
}

/// Which of the patterns of the signs of eight corners are ambiguous.
std::array<bool, 256> FindAmbiguousPatterns()
{
  std::array<bool, 256> areAmbiguous;
  for (int pattern = 0; pattern < 256; ++pattern)
  {
    Corners corners;
    for (int corner = 0; corner < 8; ++corner)
    {
      corners[corner] = (pattern >> corner & 1) != 0 ? 1.0 : -1.0;
    }
    areAmbiguous[pattern] = IsAmbiguous(corners);
  }
  return areAmbiguous;
}

//------------------------------------------------------------------------------
std::unordered_map<vtkIdType, AmbiguousCell> FindAmbiguousCells(
  vtkImageData* image, double isovalue)
{
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  const std::vector<Sign> signs = FindSigns(scalars, isovalue);
  const std::array<bool, 256> areAmbiguous = FindAmbiguousPatterns();
  const int* dimensions = image->GetDimensions();
  const Cells cells(image);
  std::unordered_map<vtkIdType, AmbiguousCell> result;
  std::array<vtkIdType, 8> offsets;
  for (int corner = 0; corner < 8; ++corner)
  {
    offsets[corner] = (corner & 1) +
      static_cast<vtkIdType>(dimensions[0]) *
        ((corner >> 1 & 1) + static_cast<vtkIdType>(dimensions[1]) * (corner >> 2));
  }
  int ijk[3];
  for (ijk[2] = 0; ijk[2] < dimensions[2] - 1; ++ijk[2])
  {
    for (ijk[1] = 0; ijk[1] < dimensions[1] - 1; ++ijk[1])
    {
      for (ijk[0] = 0; ijk[0] < dimensions[0] - 1; ++ijk[0])
      {
        const vtkIdType first = ijk[0] +
          static_cast<vtkIdType>(dimensions[0]) *
            (ijk[1] + static_cast<vtkIdType>(dimensions[1]) * ijk[2]);
        int pattern = 0;
        bool isTold = true;
        for (int corner = 0; corner < 8; ++corner)
        {
          const Sign sign = signs[static_cast<std::size_t>(first + offsets[corner])];
          pattern += sign == Inside ? 1 << corner : 0;
          isTold = isTold && sign != Untold;
        }
        if (isTold && areAmbiguous[pattern])
        {
          AmbiguousCell& cell = result[cells.GetId(ijk)];
          for (int corner = 0; corner < 8; ++corner)
          {
            cell.Values[corner] = scalars->GetComponent(first + offsets[corner], 0) - isovalue;
          }
        }
      }
    }
  }
  return result;
}

//------------------------------------------------------------------------------
/// A triangle is in the cell where its middle is.
void HandOutTriangles(
  vtkImageData* image, vtkPolyData* mesh, std::unordered_map<vtkIdType, AmbiguousCell>& ambiguous)
{
  const Cells cells(image);
  const auto iterator = vtk::TakeSmartPointer(mesh->GetPolys()->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size;
    const vtkIdType* ids;
    iterator->GetCurrentCell(size, ids);
    double corners[3][3];
    double middle[3] = { 0.0, 0.0, 0.0 };
    for (int i = 0; i < 3; ++i)
    {
      mesh->GetPoint(ids[i], corners[i]);
      for (int axis = 0; axis < 3; ++axis)
      {
        middle[axis] += corners[i][axis] / 3.0;
      }
    }
    int ijk[3];
    const auto found = ambiguous.find(cells.Locate(middle, ijk));
    if (found != ambiguous.end())
    {
      std::array<Vector, 3> triangle;
      for (int i = 0; i < 3; ++i)
      {
        const Vector index = cells.GetIndex(corners[i]);
        triangle[i] = { index[0] - ijk[0], index[1] - ijk[1], index[2] - ijk[2] };
      }
      found->second.Mesh.push_back(triangle);
    }
  }
}

}

//------------------------------------------------------------------------------
TopologyCount CompareTopology(vtkImageData* image, double isovalue, vtkPolyData* mesh)
{
  auto ambiguous = FindAmbiguousCells(image, isovalue);
  HandOutTriangles(image, mesh, ambiguous);
  TopologyCount count;
  count.AmbiguousCells = static_cast<vtkIdType>(ambiguous.size());
  for (const auto& entry : ambiguous)
  {
    const AmbiguousCell& cell = entry.second;
    const bool same =
      AreSame(FindRegionsOfInterpolant(cell.Values), FindRegionsOfMesh(cell.Values, cell.Mesh));
    count.Differences += same ? 0 : 1;
  }
  return count;
}

}
