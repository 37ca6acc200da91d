// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/MeshField.h"

#include "Field/HitCollector.h"
#include "Mesh/CellHits.h"
#include "Mesh/ShapeFunctions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

struct Slab
{
  double Begin;
  double End;
};

/// The part of a ray between two planes across an axis. A ray parallel to them has all of it, or
/// nothing.
Slab CutToSlab(double origin, double direction, double inverse, double lower, double upper)
{
  if (direction == 0.0)
  {
    return origin >= lower && origin <= upper ? Slab{ -Infinity, Infinity } : Slab{ 1.0, 0.0 };
  }
  const double a = (lower - origin) * inverse;
  const double b = (upper - origin) * inverse;
  return { std::min(a, b), std::max(a, b) };
}

/// At one point a ray enters the surface with the smaller isovalue first, and leaves it last.
bool IsBefore(const Hit& a, const Hit& b)
{
  return a.T != b.T ? a.T < b.T
                    : (a.Entering ? a.Surface : -a.Surface) < (b.Entering ? b.Surface : -b.Surface);
}

/// Whether hits are at one place, but for rounding: on the face, the edge or the vertex of several
/// cells.
bool AreTogether(const Hit& a, const Hit& b)
{
  return std::abs(a.T - b.T) <= 1e-13 * (std::abs(a.T) + std::abs(b.T));
}

/// Hits of one surface that are at one place are not in the order of T, but take turns: a ray that
/// enters leaves next. Goes through the hits from one end. Starts tells whether a ray may be taken
/// to start outside.
template <typename Iterator>
void TakeTurns(Iterator first, Iterator last, bool starts)
{
  for (Iterator hit = first; hit != last; ++hit)
  {
    const auto isSame = [hit](const Hit& other) { return other.Surface == hit->Surface; };
    const auto before =
      std::find_if(std::make_reverse_iterator(hit), std::make_reverse_iterator(first), isSame);
    const bool isFirst = before == std::make_reverse_iterator(first);
    const bool isInTurn = isFirst ? !starts || hit->Entering : before->Entering != hit->Entering;
    if (isInTurn)
    {
      continue;
    }
    const auto other = std::find_if(hit, last,
      [hit, &isSame](const Hit& next)
      { return isSame(next) && (next.Entering != hit->Entering || !AreTogether(*hit, next)); });
    if (other != last && AreTogether(*hit, *other))
    {
      std::swap(*hit, *other);
    }
  }
}

}

//------------------------------------------------------------------------------
/// A surface of the request, as MeshField traces it.
struct MeshField::Surface
{
  double Isovalue;
  /// The power of two that values are multiplied by before the isovalue is subtracted.
  double Scale;
};

//------------------------------------------------------------------------------
/// Traces one ray.
class MeshField::RayTracer
{
public:
  RayTracer(const MeshField& field, const RayPacket& packet, int ray)
    : Field(&field)
    , Origin{ packet.Origin[0][ray], packet.Origin[1][ray], packet.Origin[2][ray] }
    , Direction(packet.GetDirection(ray))
    , Inverse{ packet.Inverse[0][ray], packet.Inverse[1][ray], packet.Inverse[2][ray] }
    , Begin(packet.Begin[ray])
    , End(packet.End[ray])
    , Base(packet.Base[ray])
    , InCell(RayFrame(this->Origin, this->Direction))
  {
  }

  /// Finds all visible hits up to the first opaque one, and perhaps some beyond it, in order.
  void FindHits(std::vector<Hit>& hits)
  {
    const int levels = this->Field->Tree.GetNumberOfLevels();
    if (levels > 0)
    {
      this->Visit(levels - 1, 0, hits);
    }
    std::sort(hits.begin(), hits.end(), &IsBefore);
    TakeTurns(hits.begin(), hits.end(), true);
    TakeTurns(hits.rbegin(), hits.rend(), false);
  }

private:
  struct Child
  {
    double Begin;
    int Number;
  };

  void Visit(int level, std::size_t number, std::vector<Hit>& hits)
  {
    const CellTree::Node& node = this->Field->Tree.GetNode(level, number);
    Child children[CellTree::Width];
    int count = 0;
    for (int i = 0; i < CellTree::Width; ++i)
    {
      const double begin = this->IsActive(node, i) ? this->FindBegin(node, i) : Infinity;
      if (begin < Infinity)
      {
        children[count++] = { begin, i };
      }
    }
    std::sort(
      children, children + count, [](const Child& a, const Child& b) { return a.Begin < b.Begin; });
    for (int i = 0; i < count && children[i].Begin <= this->End; ++i)
    {
      const std::size_t child =
        number * CellTree::Width + static_cast<std::size_t>(children[i].Number);
      if (level > 0)
      {
        this->Visit(level - 1, child, hits);
      }
      else
      {
        this->VisitBlock(child, hits);
      }
    }
  }

  bool IsActive(const CellTree::Node& node, int child) const
  {
    return std::any_of(this->Field->Surfaces.begin(), this->Field->Surfaces.end(),
      [&node, child](const Surface& surface)
      {
        return static_cast<double>(node.Low[child]) < surface.Isovalue &&
          surface.Isovalue <= static_cast<double>(node.High[child]);
      });
  }

  /// Where the ray enters the box of a child, or infinity.
  double FindBegin(const CellTree::Node& node, int child) const
  {
    Slab inside = { this->Begin, this->End };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const Slab slab = CutToSlab(this->Origin[axis], this->Direction[axis], this->Inverse[axis],
        static_cast<double>(node.Lower[axis][child]), static_cast<double>(node.Upper[axis][child]));
      inside = { std::max(inside.Begin, slab.Begin), std::min(inside.End, slab.End) };
    }
    return inside.Begin <= inside.End ? inside.Begin : Infinity;
  }

  void VisitBlock(std::size_t block, std::vector<Hit>& hits)
  {
    const std::vector<std::uint32_t>& order = this->Field->Tree.GetOrder();
    const std::size_t first = block * CellTree::Width;
    const std::size_t last = std::min(first + CellTree::Width, order.size());
    for (std::size_t i = first; i < last; ++i)
    {
      this->VisitCell(order[i], hits);
    }
  }

  void VisitCell(std::int64_t number, std::vector<Hit>& hits)
  {
    MeshCell cell;
    this->Field->Cells.Load(number, cell);
    const auto [low, high] = std::minmax_element(cell.Values, cell.Values + cell.Count);
    bool isEntered = false;
    for (std::size_t surface = 0; surface < this->Field->Surfaces.size(); ++surface)
    {
      const double isovalue = this->Field->Surfaces[surface].Isovalue;
      if (!(*low < isovalue && isovalue <= *high))
      {
        continue;
      }
      if (!isEntered && !this->InCell.Enter(cell))
      {
        return;
      }
      isEntered = true;
      double differences[MaximumCorners];
      for (int i = 0; i < cell.Count; ++i)
      {
        differences[i] = Difference(cell.Values[i], isovalue, this->Field->Surfaces[surface].Scale);
      }
      for (const CellHit& found : this->InCell.Find(differences))
      {
        this->Add(found, number, static_cast<int>(surface), hits);
      }
    }
  }

  void Add(const CellHit& found, std::int64_t cell, int surface, std::vector<Hit>& hits)
  {
    if (!(found.T >= this->Begin && found.T <= this->End))
    {
      return;
    }
    const Hit hit = { this->Base + found.T, cell, surface, found.Parametric, found.Entering };
    const Visibility& visible = this->Field->Request.Visible;
    if (!visible.IsConvex() && !visible.Shows(hit, this->Field->GetPoint(hit)))
    {
      return;
    }
    hits.push_back(hit);
    if (this->Field->Request.GetOpacity(hit) >= 1.0)
    {
      this->End = found.T;
    }
  }

  const MeshField* Field;
  Vector3 Origin;
  Vector3 Direction;
  Vector3 Inverse;
  double Begin;
  /// That of the ray, or the first opaque hit so far.
  double End;
  double Base;
  CellHits InCell;
};

//------------------------------------------------------------------------------
MeshField::MeshField(const MeshView& view, int threads)
  : Cells(view)
  , Tree(this->Cells, threads)
{
}

//------------------------------------------------------------------------------
MeshField::~MeshField() = default;

//------------------------------------------------------------------------------
void MeshField::Select(
  const TraceRequest& request, const Execution& execution, const MemoryBudget& /*budget*/)
{
  if (request.Normals == NormalMode::CentralDifferences && !request.Surfaces.empty() &&
    !this->Smooth.AreThere())
  {
    this->Smooth = PointGradients(this->Cells, this->GetUnitOfGradients(), execution.Threads);
  }
  this->Request = request;
  this->Surfaces.clear();
  for (const Isosurface& surface : request.Surfaces)
  {
    this->Surfaces.push_back({ surface.Isovalue,
      GetValueScale(this->Tree.GetLow(), this->Tree.GetHigh(), surface.Isovalue) });
  }
}

//------------------------------------------------------------------------------
void MeshField::AddRay(const Vector3& origin, const Vector3& direction, double begin, double end,
  RayPacket& packet) const
{
  const int ray = packet.Count++;
  const Bounds& box = this->Tree.GetBounds();
  Slab inside = { begin, end };
  double size = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!std::isfinite(origin[axis]) || !std::isfinite(direction[axis]))
    {
      return;
    }
    packet.Direction[axis][ray] = direction[axis];
    packet.Inverse[axis][ray] = 1.0 / direction[axis];
    const Slab slab = CutToSlab(
      origin[axis], direction[axis], packet.Inverse[axis][ray], box.Lower[axis], box.Upper[axis]);
    inside = { std::max(inside.Begin, slab.Begin), std::min(inside.End, slab.End) };
    size = std::max(size, std::abs(direction[axis]));
  }
  // A ray in a face of the box, or along it, is in or out by rounding. It has no length to lose.
  const double slack = 0x1p-40 * (std::abs(inside.Begin) + std::abs(inside.End));
  if (!std::isfinite(1.0 / size) || !(inside.Begin <= inside.End + slack))
  {
    return;
  }
  // The new origin is near the mesh: its coordinates have as many digits as those of the points.
  packet.Base[ray] = inside.Begin;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    packet.Origin[axis][ray] = std::fma(inside.Begin, direction[axis], origin[axis]);
  }
  packet.Begin[ray] = begin - inside.Begin;
  packet.End[ray] = end - inside.Begin;
  Add(ray, packet.Exists);
}

//------------------------------------------------------------------------------
void MeshField::Trace(RayPacket& packet, RayHits& hits)
{
  hits.Clear();
  for (const HalfSpace& half : this->Request.Visible.HalfSpaces)
  {
    CutRays(half, packet);
  }
  std::vector<Hit> found;
  for (int i = 0; i < packet.Count; ++i)
  {
    found.clear();
    if (Has(packet.Exists, i))
    {
      RayTracer(*this, packet, i).FindHits(found);
    }
    HitCollector collector(*this, hits.Hits);
    std::any_of(found.begin(), found.end(),
      [&collector](const Hit& hit) { return collector.AddVisible(hit); });
    hits.EndRay();
  }
}

//------------------------------------------------------------------------------
Vector3 MeshField::GetPoint(const Hit& hit) const
{
  MeshCell cell;
  this->Cells.Load(hit.Cell, cell);
  return vtkIsosurfaceRayTracing::GetPoint(cell, hit.Parametric);
}

//------------------------------------------------------------------------------
Vector3 MeshField::GetPointInCells(const Hit& hit) const
{
  MeshCell cell;
  this->Cells.Load(hit.Cell, cell);
  double longest = 0.0;
  for (int i = 1; i < cell.Count; ++i)
  {
    longest = std::max(longest, Length(cell.Points[i] - cell.Points[0]));
  }
  return vtkIsosurfaceRayTracing::GetPoint(cell, hit.Parametric) *
    (longest > 0.0 ? 1.0 / longest : 1.0);
}

//------------------------------------------------------------------------------
/// The power of two that makes a rise of all values along the whole mesh about 1.
double MeshField::GetUnitOfGradients() const
{
  const Bounds& box = this->Tree.GetBounds();
  const double length = Length(box.Upper * 0.5 - box.Lower * 0.5);
  const double rise = 0.5 * this->Tree.GetHigh() - 0.5 * this->Tree.GetLow();
  return length > 0.0 && rise > 0.0
    ? std::ldexp(1.0, std::clamp(std::ilogb(length) - std::ilogb(rise), -1000, 1000))
    : 1.0;
}

//------------------------------------------------------------------------------
Vector3 MeshField::GetGradient(
  const MeshCell& cell, const Vector3& parametric, NormalMode mode) const
{
  if (mode == NormalMode::CentralDifferences && this->Smooth.AreThere())
  {
    const Vector3 smooth = this->Smooth.Get(cell, parametric);
    if (smooth != Vector3{})
    {
      return smooth;
    }
  }
  return vtkIsosurfaceRayTracing::GetGradient(cell, parametric);
}

//------------------------------------------------------------------------------
Vector3 MeshField::GetGradient(const Hit& hit, NormalMode mode) const
{
  MeshCell cell;
  this->Cells.Load(hit.Cell, cell);
  return this->GetGradient(cell, hit.Parametric, mode);
}

//------------------------------------------------------------------------------
void MeshField::GetPointsAndGradients(const Hit* hits, int count,
  double (*points)[RayPacket::Capacity], double (*gradients)[RayPacket::Capacity]) const
{
  for (int i = 0; i < count; ++i)
  {
    MeshCell cell;
    this->Cells.Load(hits[i].Cell, cell);
    const Vector3 point = vtkIsosurfaceRayTracing::GetPoint(cell, hits[i].Parametric);
    const Vector3 gradient = this->GetGradient(cell, hits[i].Parametric, this->Request.Normals);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      points[axis][i] = point[axis];
      gradients[axis][i] = gradient[axis];
    }
  }
}

//------------------------------------------------------------------------------
FieldStatistics MeshField::GetStatistics() const
{
  FieldStatistics statistics;
  statistics.HierarchyMemory = this->Tree.GetMemory() + this->Smooth.GetMemory();
  return statistics;
}

}
