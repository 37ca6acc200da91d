// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Projector_h
#define Projector_h

#include "Image/Cells/CellSegment.h"
#include "Image/Cells/LargestValue.h"
#include "Image/Lattice/Ray.h"
#include "Image/Macrocells/MacrocellHierarchy.h"
#include "Image/Traversal/CellTraversal.h"
#include "Rays/RayHits.h"
#include "Rays/RayPacket.h"
#include "Rays/TraceRequest.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

  /// Appends the hits of rays that are cut to what is visible, at most one each.
  void Project(const RayPacket& rays, RayHits& hits)
  {
    for (int i = 0; i < rays.Count; ++i)
    {
      if (Has(rays.Exists, i))
      {
        Ray ray = GetRay(rays, i);
        ray.Planes = this->Planes;
        this->Project(ray, hits);
      }
      hits.EndRay();
    }
  }

  // The interface of MacrocellTraversal.
  const MacrocellLattice& GetLattice() const { return this->Hierarchy.GetLattice(); }
  bool IsActive(std::size_t level, const Index3& macrocell) const
  {
    const ValueRange<T>& range = this->Hierarchy.GetRange(level, macrocell);
    return Directed(static_cast<double>(IsLargest ? range.Max : range.Min)) > this->Best;
  }

private:
  using Value = typename Layout::Value;
  static constexpr bool IsLargest = Kind == Extremum::Largest;

  static double Directed(double value) { return IsLargest ? value : -value; }

  void Project(const Ray& ray, RayHits& hits)
  {
    this->Best = -std::numeric_limits<double>::infinity();
    Hit hit;
    hit.Surface = Hit::NoSurface;
    ForEachVisiblePiece(ray, this->Visible.Regions,
      [this, &hit](const Ray& piece)
      {
        this->Guess(piece);
        MacrocellTraversal<Projector> traversal(piece, *this);
        CellRegion region;
        while (traversal.Next(region))
        {
          VisitCells(piece, region,
            [this, &piece, &hit](const Index3& cell)
            {
              this->Visit(piece, cell, hit);
              return false;
            });
        }
      });
    if (hit.Surface != Hit::NoSurface)
    {
      hits.Hits.push_back(hit);
      this->Last = this->Lattice.GetPoint(hit);
    }
  }

  /// Starts where the ray before had its extreme value: the nearer that is to the value of this
  /// ray, the more can be skipped. What is found is not the result yet, which may lie before it
  /// with an equal value.
  void Guess(const Ray& ray)
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
    Hit hit;
    if (this->Visit(ray, cell, hit))
    {
      this->Best = std::nextafter(this->Best, -std::numeric_limits<double>::infinity());
    }
  }

  /// Takes the largest value of a cell, if it exceeds the largest so far. Returns whether it does.
  bool Visit(const Ray& ray, const Index3& cell, Hit& hit)
  {
    Value corners[8];
    this->Reader.Load(cell, corners);
    Value outermost = corners[0];
    for (const Value corner : corners)
    {
      outermost = IsLargest ? std::max(outermost, corner) : std::min(outermost, corner);
    }
    const double largest = Directed(static_cast<double>(outermost));
    CellSegment segment;
    if (!(largest > this->Best) || !IsFinite(corners) ||
      this->Visible.IsHidden(this->Lattice.GetNumber(cell)) || !SegmentInCell(ray, cell, segment))
    {
      return false;
    }
    CellCorners values;
    std::transform(corners, corners + 8, values.begin(),
      [](Value value) { return Directed(static_cast<double>(value)); });
    const SegmentValue found = FindLargest(values, largest, segment);
    if (!(found.Value > this->Best))
    {
      return false;
    }
    this->Best = found.Value;
    hit = MakeHit(ray, this->Lattice, cell, segment, found.Fraction, 0, false);
    hit.Value = Directed(this->Best);
    return true;
  }

  const MacrocellHierarchy<T>& Hierarchy;
  typename Layout::Reader Reader;
  const Visibility& Visible;
  const CellLattice& Lattice;
  const UnevenPlanes* Planes;
  /// Only values above this matter.
  double Best = 0.0;
  /// Where the ray before had its extreme value.
  Vector3 Last = { 0.0, 0.0, 0.0 };
};

}

#endif
