// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Projector_h
#define Projector_h

#include "Image/Cells/CellSegment.h"
#include "Image/Cells/LargestValue.h"
#include "Image/Lattice/Ray.h"
#include "Image/Macrocells/MacrocellHierarchy.h"
#include "Image/Traversal/CellTraversal.h"
#include "Rays/TraceRequest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Calls visit(piece) for the pieces of a ray, in order, that lie in regions that are visible.
template <typename Visit>
void ForEachVisiblePiece(const Ray& ray, const CroppingRegions& regions, const Visit& visit)
{
  if (regions.Visible == CroppingRegions::All)
  {
    visit(ray);
    return;
  }
  std::vector<double> cuts = { ray.Begin, ray.End };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double plane : regions.Planes[axis])
    {
      const double t = (plane - ray.Origin[axis]) / ray.Direction[axis];
      if (t > ray.Begin && t < ray.End)
      {
        cuts.push_back(t);
      }
    }
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 1; i < cuts.size(); ++i)
  {
    const double middle = 0.5 * (cuts[i - 1] + cuts[i]);
    if (regions.Contain(
          { ray.Coordinate(0, middle), ray.Coordinate(1, middle), ray.Coordinate(2, middle) }))
    {
      Ray piece = ray;
      piece.Begin = cuts[i - 1];
      piece.End = cuts[i];
      visit(piece);
    }
  }
}

/// What is known of the extreme value of a ray.
struct Projection
{
  /// The largest value that was found, directed (see Projector); only values above it matter.
  double Best = -std::numeric_limits<double>::infinity();
  /// Where it is; without a surface as long as there is none.
  Hit Found = GetNoHit();
  /// The number of planes between the first cell of the volume, seen along the ray, and that of the
  /// hit, up to a constant.
  int Place = 0;

  static Hit GetNoHit()
  {
    Hit hit;
    hit.Surface = Hit::NoSurface;
    return hit;
  }

  bool Exists() const { return this->Found.Surface != Hit::NoSurface; }
};

/// Finds the extreme values of rays: in every cell that may exceed the largest value so far, the
/// largest value of the cubic. Macrocells that cannot exceed it are skipped, on all levels. The
/// smallest value is minus the largest of the negated samples, to the last bit.
///
/// The value of a cell depends on ray and cell alone and never exceeds the corners, so the result
/// depends neither on which cells are skipped nor on what is known beforehand.
template <typename T, typename Layout, Extremum Kind>
class Projector
{
public:
  static constexpr bool IsLargest = Kind == Extremum::Largest;

  /// All must outlive the projector, which is for one thread.
  Projector(const MacrocellHierarchy<T>& hierarchy, Layout& bricks, const CellLattice& lattice,
    const Visibility& visible)
    : Hierarchy(hierarchy)
    , Reader(bricks)
    , Visible(visible)
    , Lattice(lattice)
    , Planes(lattice.GetPlanes())
  {
  }

  static double Directed(double value) { return IsLargest ? value : -value; }

  // The interface of MacrocellTraversal.
  const MacrocellLattice& GetLattice() const { return this->Hierarchy.GetLattice(); }
  bool IsActive(std::size_t level, const Index3& macrocell) const
  {
    return this->GetMost(level, macrocell) > this->Best;
  }

  /// The largest value in a macrocell, directed.
  double GetMost(std::size_t level, const Index3& macrocell) const
  {
    const ValueRange<T>& range = this->Hierarchy.GetRange(level, macrocell);
    return Directed(static_cast<double>(IsLargest ? range.Max : range.Min));
  }

  /// Projects a ray that is cut to what is visible, cell by cell. This is the reference.
  Projection Project(const Ray& ray)
  {
    Projection projection;
    ForEachVisiblePiece(ray, this->Visible.Regions,
      [this, &projection](const Ray& piece)
      {
        this->Guess(piece, projection);
        this->Best = projection.Best;
        MacrocellTraversal<Projector> traversal(piece, *this);
        CellRegion region;
        while (traversal.Next(region))
        {
          VisitCells(piece, region,
            [this, &piece, &projection](const Index3& cell)
            {
              this->Visit(piece, cell, projection);
              this->Best = projection.Best;
              return false;
            });
        }
      });
    if (projection.Exists())
    {
      this->Last = this->Lattice.GetPoint(projection.Found);
    }
    return projection;
  }

  /// Starts where another ray had its extreme value: the nearer that is to the value of this ray,
  /// the more can be skipped. What is found is not the result yet, which may lie before it with an
  /// equal value. The next guess starts from it.
  void Guess(const Ray& ray, Projection& projection)
  {
    const double t =
      Dot(this->Last - ray.Origin, ray.Direction) / Dot(ray.Direction, ray.Direction);
    if (!std::isfinite(t))
    {
      return;
    }
    Index3 cell;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double coordinate = ray.Coordinate(axis, t);
      cell[axis] = this->Planes ? this->Planes->FindCell(axis, coordinate)
                                : static_cast<int>(std::clamp(std::floor(coordinate), 0.0,
                                    static_cast<double>(this->Lattice.GetCells()[axis] - 1)));
    }
    Projection guess;
    guess.Best = projection.Best;
    if (this->Visit(ray, cell, guess))
    {
      projection.Best = std::nextafter(guess.Best, -std::numeric_limits<double>::infinity());
      this->Last = this->Lattice.GetPoint(guess.Found);
    }
  }

  /// Takes the largest value of a cell, if it exceeds the largest so far, or equals it and lies
  /// before it. Returns whether it does.
  bool Visit(const Ray& ray, const Index3& cell, Projection& projection)
  {
    // At each plane that a ray crosses, one coordinate changes by one.
    const int place = ray.Step[0] * cell[0] + ray.Step[1] * cell[1] + ray.Step[2] * cell[2];
    const bool isBefore = projection.Exists() && place < projection.Place;
    const auto isBetter = [&projection, isBefore](double value)
    { return value > projection.Best || (isBefore && value == projection.Best); };

    Value corners[8];
    this->Reader.Load(cell, corners);
    Value outermost = corners[0];
    for (const Value corner : corners)
    {
      outermost = IsLargest ? std::max(outermost, corner) : std::min(outermost, corner);
    }
    const double largest = Directed(static_cast<double>(outermost));
    CellSegment segment;
    if (!isBetter(largest) || !IsFinite(corners) ||
      this->Visible.IsHidden(this->Lattice.GetNumber(cell)) || !SegmentInCell(ray, cell, segment))
    {
      return false;
    }
    CellCorners values;
    std::transform(corners, corners + 8, values.begin(),
      [](Value value) { return Directed(static_cast<double>(value)); });
    const SegmentValue found = FindLargest(values, largest, segment);
    if (!isBetter(found.Value))
    {
      return false;
    }
    projection.Best = found.Value;
    projection.Place = place;
    projection.Found = MakeHit(ray, this->Lattice, cell, segment, found.Fraction, 0, false);
    projection.Found.Value = Directed(found.Value);
    return true;
  }

private:
  using Value = typename Layout::Value;

  const MacrocellHierarchy<T>& Hierarchy;
  typename Layout::Reader Reader;
  const Visibility& Visible;
  const CellLattice& Lattice;
  const UnevenPlanes* Planes;
  /// Of the ray that is traced cell by cell: macrocells with no larger value are skipped.
  double Best = 0.0;
  /// Where the ray before had its extreme value.
  Vector3 Last = { 0.0, 0.0, 0.0 };
};

}

#endif
