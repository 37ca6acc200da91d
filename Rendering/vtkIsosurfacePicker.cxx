// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfacePicker.h"

#include "vtkIsosurfaceRayTraceEngine.h"
#include "vtkIsosurfaceRayTraceGeometry.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkLODProp3D.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkProp3D.h"
#include "vtkSmartPointer.h"
#include "vtkTransform.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <limits>

VTK_ABI_NAMESPACE_BEGIN

namespace
{

/// The point of a cell that is nearest to a position.
vtkIdType FindNearestPoint(vtkDataSet* grid, vtkIdType cell, const double position[3])
{
  vtkNew<vtkIdList> ids;
  grid->GetCellPoints(cell, ids);
  vtkIdType nearest = -1;
  double least = VTK_DOUBLE_MAX;
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
  {
    const double square = vtkMath::Distance2BetweenPoints(grid->GetPoint(ids->GetId(i)), position);
    if (square < least)
    {
      least = square;
      nearest = ids->GetId(i);
    }
  }
  return nearest;
}

/// The volume that a prop is, or, for levels of detail, one like the level that is picked. Null if
/// it is neither.
vtkSmartPointer<vtkVolume> FindVolume(vtkProp3D* prop, vtkAbstractVolumeMapper* mapper)
{
  auto* levels = vtkLODProp3D::SafeDownCast(prop);
  if (!levels)
  {
    return vtkVolume::SafeDownCast(prop);
  }
  vtkVolumeProperty* property = nullptr;
  levels->GetLODProperty(levels->GetPickLODID(), &property);
  auto volume = vtkSmartPointer<vtkVolume>::New();
  volume->SetMapper(mapper);
  volume->SetProperty(property);
  volume->SetUserMatrix(levels->GetMatrix());
  volume->ComputeMatrix();
  return volume;
}

/// The pixel at a coordinate; one that no window has if the coordinate is beyond all of them.
int ToPixel(double coordinate)
{
  return std::abs(coordinate) < 0x1p30 ? static_cast<int>(std::floor(coordinate)) : -1;
}

}

//------------------------------------------------------------------------------
/// See vtkIsosurfaceRayTraceMapper::PickPixel.
struct vtkIsosurfacePicker::SurfaceHit
{
  double Position[3];
  double Parametric[3];
  vtkIdType Cell;
  double Isovalue;
  double Normal[3];
};

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfacePicker);

//------------------------------------------------------------------------------
vtkIsosurfacePicker::vtkIsosurfacePicker()
{
  this->Isovalue = std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
vtkIsosurfacePicker::~vtkIsosurfacePicker() = default;

//------------------------------------------------------------------------------
void vtkIsosurfacePicker::Initialize()
{
  this->Superclass::Initialize();
  this->Isovalue = std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
void vtkIsosurfacePicker::ResetPickInfo()
{
  this->Superclass::ResetPickInfo();
  this->Isovalue = std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
int vtkIsosurfacePicker::Pick(
  double selectionX, double selectionY, double selectionZ, vtkRenderer* renderer)
{
  this->IsPixel = true;
  this->Pixel[0] = ToPixel(selectionX);
  this->Pixel[1] = ToPixel(selectionY);
  // The bounds and clipping planes that the superclass tests first must be met by the ray of the
  // picture, which goes through the centre of the pixel.
  const int picked = this->Superclass::Pick(
    std::floor(selectionX) + 0.5, std::floor(selectionY) + 0.5, selectionZ, renderer);
  this->SelectionPoint[0] = selectionX;
  this->SelectionPoint[1] = selectionY;
  this->IsPixel = false;
  return picked;
}

//------------------------------------------------------------------------------
double vtkIsosurfacePicker::IntersectWithLine(const double p1[3], const double p2[3], double tol,
  vtkAssemblyPath* path, vtkProp3D* prop, vtkAbstractMapper3D* mapper)
{
  const double before = this->GlobalTMin;
  // A part of an assembly is drawn with the matrix of its path.
  const bool isPart = path->GetNumberOfItems() > 1;
  if (isPart)
  {
    prop->PokeMatrix(path->GetLastNode()->GetMatrix());
  }
  const double t = this->Superclass::IntersectWithLine(p1, p2, tol, path, prop, mapper);
  if (isPart)
  {
    prop->PokeMatrix(nullptr);
  }
  if (t < before && std::isfinite(this->Isovalue) && this->Mapper == mapper)
  {
    // A round trip through the coordinates of the data would change the last bits.
    std::copy_n(this->SurfacePosition, 3, this->PickPosition);
    std::copy_n(this->SurfaceNormal, 3, this->PickNormal);
  }
  return t;
}

//------------------------------------------------------------------------------
double vtkIsosurfacePicker::IntersectVolumeWithLine(const double p1[3], const double p2[3],
  double t1, double t2, vtkProp3D* prop, vtkAbstractVolumeMapper* mapper)
{
  auto* engine = vtkIsosurfaceRayTraceEngine::Of(mapper);
  const vtkSmartPointer<vtkVolume> volume = engine ? FindVolume(prop, mapper) : nullptr;
  if (!volume)
  {
    return this->Superclass::IntersectVolumeWithLine(p1, p2, t1, t2, prop, mapper);
  }
  SurfaceHit hit;
  if (!this->FindHit(*engine, volume, p1, p2, hit))
  {
    return VTK_DOUBLE_MAX;
  }
  double inData[3];
  this->Transform->GetLinearInverse()->TransformPoint(hit.Position, inData);
  double along[3];
  double way[3];
  vtkMath::Subtract(p2, p1, along);
  vtkMath::Subtract(inData, p1, way);
  const double t = vtkMath::Dot(way, along) / vtkMath::Dot(along, along);
  if (t < this->GlobalTMin)
  {
    this->SetPickInfo(mapper, hit, inData);
  }
  return t;
}

//------------------------------------------------------------------------------
/// Finds the first hit at the pixel, or along the line from p1 to p2 in the coordinates of the
/// data.
bool vtkIsosurfacePicker::FindHit(vtkIsosurfaceRayTraceEngine& engine, vtkVolume* volume,
  const double p1[3], const double p2[3], SurfaceHit& hit)
{
  if (this->IsPixel)
  {
    return engine.PickPixel(this->Renderer, volume, this->Pixel[0], this->Pixel[1], hit.Position,
             hit.Parametric, hit.Cell, hit.Isovalue, hit.Normal) != 0;
  }
  double from[3];
  double to[3];
  double t;
  this->Transform->TransformPoint(p1, from);
  this->Transform->TransformPoint(p2, to);
  return engine.IntersectWithLine(volume, from, to, t, hit.Position, hit.Parametric, hit.Cell,
           hit.Isovalue, hit.Normal) != 0;
}

//------------------------------------------------------------------------------
/// Makes a hit what was picked; position is that in the coordinates of the data.
void vtkIsosurfacePicker::SetPickInfo(
  vtkAbstractVolumeMapper* mapper, const SurfaceHit& hit, const double position[3])
{
  this->ResetPickInfo();
  vtkIdType cell;
  unsigned int flatIndex = 0;
  auto* engine = vtkIsosurfaceRayTraceEngine::Of(mapper);
  const int connection = engine->FindConnection(hit.Cell);
  vtkDataSet* grid = engine->FindBlock(hit.Cell, cell, flatIndex);
  this->Mapper = mapper;
  this->CompositeDataSet =
    vtkCompositeDataSet::SafeDownCast(mapper->GetInputDataObject(0, connection));
  this->FlatBlockIndex = this->CompositeDataSet ? static_cast<vtkIdType>(flatIndex) : -1;
  this->DataSet = grid;
  this->Isovalue = hit.Isovalue;
  std::copy_n(hit.Position, 3, this->SurfacePosition);
  std::copy_n(hit.Normal, 3, this->SurfaceNormal);
  std::copy_n(position, 3, this->MapperPosition);
  this->Transform->GetLinearInverse()->TransformNormal(hit.Normal, this->MapperNormal);
  if (vtkPointSet::SafeDownCast(grid))
  {
    double inGrid[4] = { position[0], position[1], position[2], 1.0 };
    if (vtkVolume* own = engine->GetConnectionVolume(connection))
    {
      vtkNew<vtkMatrix4x4> inverse;
      vtkMatrix4x4::Invert(own->GetMatrix(), inverse);
      inverse->MultiplyPoint(inGrid, inGrid);
    }
    this->PointId = FindNearestPoint(grid, cell, inGrid);
  }
  else
  {
    // From the cell of the grid to an index in its extent.
    const int* extent = grid->GetInformation()->Get(vtkDataObject::DATA_EXTENT());
    const auto dimensions = vtkIsosurfaceRayTraceGeometry::GetDimensions(grid);
    const vtkIdType columns = dimensions[0] - 1;
    const vtkIdType rows = dimensions[1] - 1;
    const double index[3] = { extent[0] + cell % columns + hit.Parametric[0],
      extent[2] + cell / columns % rows + hit.Parametric[1],
      extent[4] + cell / columns / rows + hit.Parametric[2] };
    this->SetImageDataPickInfo(index, extent);
  }
  this->CellId = cell;
  std::copy_n(hit.Parametric, 3, this->PCoords);
}

//------------------------------------------------------------------------------
void vtkIsosurfacePicker::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Isovalue: " << this->Isovalue << "\n";
}

VTK_ABI_NAMESPACE_END
