// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTracePolyhedron.h"

#include "vtkIdList.h"
#include "vtkPoints.h"
#include "vtkPolygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

// Operators of a std::array are not found by themselves.
using vtkirt::operator+;
using vtkirt::operator-;
using vtkirt::operator*;

namespace
{

vtkirt::Vector3 FindMean(vtkPoints* points, vtkIdList* ids)
{
  vtkirt::Vector3 mean = { 0.0, 0.0, 0.0 };
  for (const vtkIdType id : *ids)
  {
    vtkirt::Vector3 point;
    points->GetPoint(id, point.data());
    mean = mean + point * (1.0 / static_cast<double>(ids->GetNumberOfIds()));
  }
  return mean;
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTracePolyhedron::vtkIsosurfaceRayTracePolyhedron() = default;

//------------------------------------------------------------------------------
vtkIsosurfaceRayTracePolyhedron::~vtkIsosurfaceRayTracePolyhedron() = default;

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTracePolyhedron::Divide(
  vtkPoints* points, vtkIdList* ofCell, vtkIdList* faces, vtkIdList* ids)
{
  this->Triangles.clear();
  this->Outlines.clear();
  this->Edges.clear();
  this->Faces.clear();
  const Vector3 center = FindMean(points, ofCell);
  const vtkIdType* face = faces->GetPointer(1);
  for (vtkIdType left = faces->GetId(0); left > 0; --left)
  {
    const auto count = static_cast<std::size_t>(*face);
    this->LoadFace(points, face + 1, count);
    this->CutFace(center);
    this->AddOutline();
    face += 1 + count;
  }
  this->TurnFaces();
  ids->Reset();
  double inside = 0.0;
  double outside = 0.0;
  for (const Triangle& triangle : this->Triangles)
  {
    ids->InsertNextId(Center);
    for (const vtkIdType corner : triangle.Corners)
    {
      ids->InsertNextId(corner);
    }
    const double sign = this->Outlines[triangle.Face].Sign;
    (sign * triangle.Volume < 0.0 ? outside : inside) += std::abs(triangle.Volume);
  }
  this->Volume = inside + outside;
  // Where edges with points on them are bent a little, or rounded, some triangles are seen from
  // outside. Neighbours have the same: so their tetrahedra still fit together, as others do not.
  constexpr double few = 1e-2;
  return std::min(inside, outside) <= few * this->Volume;
}

//------------------------------------------------------------------------------
/// From the first point on, towards the first one of its neighbours.
void vtkIsosurfaceRayTracePolyhedron::LoadFace(
  vtkPoints* points, const vtkIdType* ids, std::size_t count)
{
  this->Face.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    points->GetPoint(ids[i], this->Face[i].Place.data());
    this->Face[i].Id = ids[i];
  }
  const auto isBefore = [](const Corner& one, const Corner& other)
  { return one.Place < other.Place; };
  std::rotate(this->Face.begin(), std::min_element(this->Face.begin(), this->Face.end(), isBefore),
    this->Face.end());
  if (isBefore(this->Face.back(), this->Face[1]))
  {
    std::reverse(this->Face.begin() + 1, this->Face.end());
  }
}

//------------------------------------------------------------------------------
/// Whether all triangles between the first point of the face and its edges run the same way.
bool vtkIsosurfaceRayTracePolyhedron::IsSeenFromFirst() const
{
  const auto getNormal = [this](std::size_t i)
  {
    const Vector3& first = this->Face[0].Place;
    return vtkirt::Cross(this->Face[i].Place - first, this->Face[i + 1].Place - first);
  };
  const std::size_t last = this->Face.size() - 1;
  Vector3 sum = { 0.0, 0.0, 0.0 };
  for (std::size_t i = 1; i < last; ++i)
  {
    sum = sum + getNormal(i);
  }
  std::size_t i = 1;
  while (i < last && vtkirt::Dot(getNormal(i), sum) >= 0.0)
  {
    ++i;
  }
  return i >= last;
}

//------------------------------------------------------------------------------
/// Cuts the face into triangles: from its first point, too, where VTK cuts none, as where it has no
/// area.
void vtkIsosurfaceRayTracePolyhedron::CutFace(const Vector3& center)
{
  if (this->Face.size() > 3 && !this->IsSeenFromFirst() && this->CutEars(center))
  {
    return;
  }
  for (std::size_t i = 1; i + 1 < this->Face.size(); ++i)
  {
    this->AddTriangle(center, 0, i, i + 1);
  }
}

//------------------------------------------------------------------------------
/// Cuts it as VTK does. Returns whether that cuts it.
bool vtkIsosurfaceRayTracePolyhedron::CutEars(const Vector3& center)
{
  const auto count = static_cast<vtkIdType>(this->Face.size());
  this->Polygon->GetPointIds()->SetNumberOfIds(count);
  this->Polygon->GetPoints()->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const Corner& corner = this->Face[static_cast<std::size_t>(i)];
    this->Polygon->GetPointIds()->SetId(i, corner.Id);
    this->Polygon->GetPoints()->SetPoint(i, corner.Place.data());
  }
  if (this->Polygon->EarCutTriangulation(this->Cut) == 0)
  {
    return false;
  }
  for (vtkIdType i = 0; i + 3 <= this->Cut->GetNumberOfIds(); i += 3)
  {
    // In the order of their numbers corners run as the outline does.
    vtkIdType* corners = this->Cut->GetPointer(i);
    std::sort(corners, corners + 3);
    const auto get = [corners](int k) { return static_cast<std::size_t>(corners[k]); };
    this->AddTriangle(center, get(0), get(1), get(2));
  }
  return true;
}

//------------------------------------------------------------------------------
/// Adds a triangle of the face, given the numbers of its corners, in the order of the outline.
void vtkIsosurfaceRayTracePolyhedron::AddTriangle(
  const Vector3& center, std::size_t a, std::size_t b, std::size_t c)
{
  const Corner* corners = this->Face.data();
  const Vector3 normal =
    vtkirt::Cross(corners[b].Place - corners[a].Place, corners[c].Place - corners[a].Place);
  this->Triangles.push_back({ { corners[a].Id, corners[b].Id, corners[c].Id },
    vtkirt::Dot(normal, corners[a].Place - center) / 6.0, this->Outlines.size() });
}

//------------------------------------------------------------------------------
/// Adds that of the face, and its edges.
void vtkIsosurfaceRayTracePolyhedron::AddOutline()
{
  const std::size_t first = this->Edges.size();
  const std::size_t count = this->Face.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const vtkIdType begin = this->Face[i].Id;
    const auto [less, greater] = std::minmax({ begin, this->Face[(i + 1) % count].Id });
    this->Edges.push_back({ less, greater, first + i });
    this->Faces.push_back({ begin, this->Outlines.size() });
  }
  this->Outlines.push_back({ first, first + count - 1 });
}

//------------------------------------------------------------------------------
/// Finds which edges are the same.
void vtkIsosurfaceRayTracePolyhedron::SortEdges()
{
  std::sort(this->Edges.begin(), this->Edges.end());
  this->NextOfEdge.resize(this->Edges.size());
  for (auto begin = this->Edges.begin(); begin != this->Edges.end();)
  {
    auto last = begin;
    for (; last + 1 != this->Edges.end() && last[1].IsSame(*begin); ++last)
    {
      this->NextOfEdge[last->Number] = last[1].Number;
    }
    this->NextOfEdge[last->Number] = begin->Number;
    begin = last + 1;
  }
}

//------------------------------------------------------------------------------
/// Turns faces the same way as the first one: across an edge in common they run against each other.
/// (Those in files run as they like.) Their outlines tell: where faces have several edges in
/// common, they may be cut along the same line within.
void vtkIsosurfaceRayTracePolyhedron::TurnFaces()
{
  this->SortEdges();
  this->AreKnown.assign(this->Outlines.size(), false);
  this->Waiting.assign(std::min<std::size_t>(1, this->Outlines.size()), 0);
  while (!this->Waiting.empty())
  {
    const std::size_t number = this->Waiting.back();
    const Outline& outline = this->Outlines[number];
    this->AreKnown[number] = true;
    this->Waiting.pop_back();
    for (std::size_t own = outline.FirstEdge; own <= outline.LastEdge; ++own)
    {
      // Those that are the same follow each other in a circle.
      for (std::size_t edge = this->NextOfEdge[own]; edge != own; edge = this->NextOfEdge[edge])
      {
        const std::size_t other = this->Faces[edge].Face;
        if (!this->AreKnown[other])
        {
          this->AreKnown[other] = true;
          this->TurnAgainst(own, edge);
          this->Waiting.push_back(other);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Turns the face of the second edge, if both run along the edge.
void vtkIsosurfaceRayTracePolyhedron::TurnAgainst(std::size_t one, std::size_t edge)
{
  const double sign = this->Outlines[this->Faces[one].Face].Sign;
  const bool areSame = this->Faces[one].Begin == this->Faces[edge].Begin;
  this->Outlines[this->Faces[edge].Face].Sign = areSame ? -sign : sign;
}

VTK_ABI_NAMESPACE_END
