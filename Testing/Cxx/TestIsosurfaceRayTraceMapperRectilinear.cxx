// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Rectilinear grids: their surfaces are those of VTK's own interpolant, whatever the spacing of
// their planes, and everything that holds for images holds for them.

#include "AnalyticFields.h"
#include "Checks.h"
#include "DepthPicture.h"
#include "Pictures.h"
#include "RandomRays.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfacePicker.h"
#include "vtkIsosurfaceVolume.h"

#include <vtkCellData.h>
#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkHardwareSelector.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkLight.h>
#include <vtkMath.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkRectilinearSynchronizedTemplates.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVoxel.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <set>

using namespace MapperTesting;

namespace
{

constexpr int Size = 120;
using Coordinates = std::vector<double>;
using Field = std::function<double(const AnalyticFields::Point&)>;

Coordinates Even(int count, double low = -1.0, double high = 1.0)
{
  Coordinates coordinates;
  for (int i = 0; i < count; ++i)
  {
    coordinates.push_back(low + (high - low) * i / (count - 1));
  }
  return coordinates;
}

/// From -1 to 1, with steps that differ from each other by up to so many times.
Coordinates Uneven(int count, double ratio)
{
  Coordinates coordinates = { 0.0 };
  for (int i = 1; i < count; ++i)
  {
    coordinates.push_back(coordinates.back() + std::pow(ratio, 0.5 + 0.5 * std::sin(2.3 * i)));
  }
  const double length = coordinates.back();
  for (double& coordinate : coordinates)
  {
    coordinate = 2.0 * coordinate / length - 1.0;
  }
  return coordinates;
}

/// From -1 to 1, with steps that grow.
Coordinates Growing(int count)
{
  Coordinates coordinates = Even(count, 0.0, 1.0);
  std::for_each(coordinates.begin(), coordinates.end(),
    [](double& coordinate) { coordinate = 2.0 * coordinate * coordinate - 1.0; });
  return coordinates;
}

std::array<Coordinates, 3> UnevenAxes()
{
  return { Uneven(31, 5.0), Uneven(27, 20.0), Uneven(40, 8.0) };
}

Coordinates Reversed(Coordinates coordinates)
{
  std::reverse(coordinates.begin(), coordinates.end());
  return coordinates;
}

/// A ball of which the value falls with the square of the distance, a bit dented.
double Dent(const AnalyticFields::Point& p)
{
  return 0.64 - p[0] * p[0] - p[1] * p[1] - p[2] * p[2] + 0.3 * p[0] * p[1];
}

Field Scaled(const Field& field, double scale)
{
  return [field, scale](const AnalyticFields::Point& p) {
    return field({ p[0] / scale, p[1] / scale, p[2] / scale });
  };
}

//------------------------------------------------------------------------------
/// A grid with even planes is the image it could be.
void CheckEvenGrids(Checks& check)
{
  const auto image = NewCube(33, Dent);
  for (const bool isTranslucent : { false, true })
  {
    const auto draw = [isTranslucent](vtkDataObject* data)
    {
      Scene scene(data);
      scene.SetSurface(0.0, { 0.9, 0.8, 0.7 }, isTranslucent ? 0.5 : 1.0);
      scene.AddSurface(0.3, { 0.3, 0.8, 0.7 }, 1.0);
      return RenderAndCapture(scene.Window);
    };
    const Picture expected = draw(image);
    const Coordinates even = Even(33);
    check.Equal(GetDifference(draw(NewGrid({ even, even, even }, Dent)), expected, 0), 0.0,
      "the difference between a grid and an image");
    check.Equal(
      GetDifference(draw(NewGrid({ Reversed(even), even, Reversed(even) }, Dent)), expected, 1),
      0.0, "the difference with coordinates that fall");
    // Rounding leaves these slightly uneven.
    const Coordinates odd = Even(34);
    const auto image34 = NewCube(34, Dent);
    check.That(
      GetDifference(draw(NewGrid({ odd, odd, odd }, Dent, VTK_FLOAT)), draw(image34), 1) < 1e-3,
      "coordinates of single precision");
  }

  // Cells, of which the samples are those of the centres.
  Scene cells(NewGrid({ Even(33), Even(33), Even(33) }, Dent));
  cells.Mapper->SetScalarModeToUseCellFieldData();
  cells.Mapper->SelectScalarArray("field");
  const Picture ofGrid = RenderAndCapture(cells.Window);
  vtkNew<vtkImageData> same;
  same->SetDimensions(33, 33, 33);
  same->SetSpacing(0.0625, 0.0625, 0.0625);
  same->SetOrigin(-1.0, -1.0, -1.0);
  same->GetCellData()->AddArray(
    vtkDataSet::SafeDownCast(cells.Mapper->GetInputDataObject(0, 0))->GetCellData()->GetArray(0));
  cells.Mapper->SetInputDataObject(0, same);
  check.Equal(GetDifference(RenderAndCapture(cells.Window), ofGrid, 0), 0.0,
    "the difference of cells between a grid and an image");
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Cast(Scene& scene, double scale = 1.0)
{
  return RandomRays({ 0.0, 0.0, 0.0 }, scale, 4000).Cast(scene.Mapper, scene.Volume);
}

/// Every hit is where VTK's cells have the isovalue, and has the ids and coordinates of VTK.
void CheckInterpolant(
  Checks& check, vtkRectilinearGrid* grid, double scale, double tolerance, const std::string& name)
{
  const bool ascends =
    grid->GetXCoordinates()->GetComponent(0, 0) < grid->GetXCoordinates()->GetComponent(1, 0);
  vtkDataArray* scalars = grid->GetPointData()->GetScalars();
  Scene scene(grid);
  scene.SetSurface(0.1, { 1.0, 1.0, 1.0 }, 0.1);
  const auto hits = Cast(scene, scale);
  vtkNew<vtkIdList> ids;
  double worstValue = 0.0;
  double worstPosition = 0.0;
  int otherCells = 0;
  for (vtkIdType i = 0; i < hits->GetNumberOfPoints(); ++i)
  {
    double x[3];
    double parametric[3];
    hits->GetPoint(i, x);
    hits->GetPointData()->GetArray("ParametricCoordinates")->GetTuple(i, parametric);
    const vtkIdType cell =
      vtkIdTypeArray::SafeDownCast(hits->GetPointData()->GetArray("CellId"))->GetValue(i);
    grid->GetCellPoints(cell, ids);
    double weights[8];
    vtkVoxel::InterpolationFunctions(parametric, weights);
    double value = 0.0;
    double position[3] = { 0.0, 0.0, 0.0 };
    for (int corner = 0; corner < 8; ++corner)
    {
      value += weights[corner] * scalars->GetComponent(ids->GetId(corner), 0);
      const double* point = grid->GetPoint(ids->GetId(corner));
      for (int axis = 0; axis < 3; ++axis)
      {
        position[axis] += weights[corner] * point[axis];
      }
    }
    worstValue = std::max(worstValue, std::abs(value - 0.1));
    worstPosition =
      std::max(worstPosition, std::sqrt(vtkMath::Distance2BetweenPoints(position, x)) / scale);
    if (ascends)
    {
      // VTK finds the cell by itself, and the same value in it.
      int sub;
      double pcoords[3];
      const vtkIdType found = grid->FindCell(x, nullptr, 0, 0.0, sub, pcoords, weights);
      otherCells += found != cell ? 1 : 0;
      if (found < 0)
      {
        continue;
      }
      grid->GetCellPoints(found, ids);
      value = 0.0;
      for (int corner = 0; corner < 8; ++corner)
      {
        value += weights[corner] * scalars->GetComponent(ids->GetId(corner), 0);
      }
      worstValue = std::max(worstValue, std::abs(value - 0.1));
    }
  }
  check.That(hits->GetNumberOfPoints() > 2000, "thousands of hits " + name);
  check.Near(worstValue, 0.0, tolerance, "the worst value of a hit " + name);
  check.Near(worstPosition, 0.0, tolerance, "the worst position of a hit " + name);
  check.That(otherCells <= 2, "the cells are those that VTK finds " + name);
}

void CheckInterpolants(Checks& check)
{
  const std::array<Coordinates, 3> axes = UnevenAxes();
  CheckInterpolant(check, NewGrid(axes, Dent), 1.0, 1e-12, "of doubles");
  CheckInterpolant(check, NewGrid(axes, Dent, VTK_FLOAT), 1.0, 1e-12, "of floats");
  CheckInterpolant(check, NewGrid({ Reversed(axes[0]), axes[1], Reversed(axes[2]) }, Dent), 1.0,
    1e-12, "with coordinates that fall");
  std::array<Coordinates, 3> whole;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (int i = -6; i <= 6; ++i)
    {
      whole[axis].push_back(i * std::abs(i) + 3 * i);
    }
  }
  CheckInterpolant(
    check, NewGrid(whole, Scaled(Dent, 54.0), VTK_INT), 54.0, 1e-12, "of whole numbers");
  const auto tiny = [&axes](double scale)
  {
    std::array<Coordinates, 3> scaled = axes;
    for (Coordinates& coordinates : scaled)
    {
      std::for_each(coordinates.begin(), coordinates.end(),
        [scale](double& coordinate) { coordinate *= scale; });
    }
    return NewGrid(scaled, Scaled(Dent, scale));
  };
  CheckInterpolant(check, tiny(1e-9), 1e-9, 1e-12, "of tiny numbers");
  CheckInterpolant(check, tiny(1e9), 1e9, 1e-12, "of large numbers");
}

//------------------------------------------------------------------------------
/// The hits of samples at the centres of cells are where these have the isovalue.
void CheckCells(Checks& check)
{
  // Interpolated exactly: the hits lie in the plane.
  const Field slope = [](const AnalyticFields::Point& p)
  { return 0.3 * p[0] - 0.5 * p[1] + 0.2 * p[2]; };
  const auto grid = NewGrid(UnevenAxes(), slope);
  Scene scene(grid);
  scene.SetSurface(0.1, { 1.0, 1.0, 1.0 }, 1.0);
  scene.Mapper->SetScalarModeToUseCellFieldData();
  scene.Mapper->SelectScalarArray("field");
  const auto hits = Cast(scene);
  double worst = 0.0;
  for (vtkIdType i = 0; i < hits->GetNumberOfPoints(); ++i)
  {
    AnalyticFields::Point x;
    hits->GetPoint(i, x.data());
    worst = std::max(worst, std::abs(slope(x) - 0.1));
    const vtkIdType cell =
      vtkIdTypeArray::SafeDownCast(hits->GetPointData()->GetArray("CellId"))->GetValue(i);
    double bounds[6];
    grid->GetCellBounds(cell, bounds);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double inCell =
        hits->GetPointData()->GetArray("ParametricCoordinates")->GetComponent(i, axis);
      const double coordinate =
        bounds[2 * axis] + inCell * (bounds[2 * axis + 1] - bounds[2 * axis]);
      worst = std::max(worst, std::abs(coordinate - x[static_cast<std::size_t>(axis)]));
      check.That(inCell >= 0.0 && inCell <= 1.0, "coordinates are in the cell");
    }
  }
  check.That(hits->GetNumberOfPoints() > 500, "hundreds of hits of cells");
  check.Near(worst, 0.0, 1e-12, "the worst hit of cells");
}

//------------------------------------------------------------------------------
/// The vertices of VTK's own surface lie on ours.
void CheckAgainstPolygons(Checks& check)
{
  const auto grid = NewGrid(UnevenAxes(), Dent);
  vtkNew<vtkRectilinearSynchronizedTemplates> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, 0.1);
  contour->ComputeNormalsOn();
  contour->Update();
  vtkPolyData* surface = contour->GetOutput();
  Scene scene(grid);
  scene.SetSurface(0.1, { 1.0, 1.0, 1.0 }, 1.0);
  double worst = 0.0;
  double worstCosine = 1.0;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    double vertex[3];
    double normal[3];
    surface->GetPoint(i, vertex);
    surface->GetPointData()->GetNormals()->GetTuple(i, normal);
    double from[3];
    double to[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      from[axis] = vertex[axis] + 0.05 * normal[axis];
      to[axis] = vertex[axis] - 0.05 * normal[axis];
    }
    double t;
    double x[3];
    double parametric[3];
    double isovalue;
    double ours[3];
    vtkIdType cell;
    if (scene.Mapper->IntersectWithLine(
          scene.Volume, from, to, t, x, parametric, cell, isovalue, ours) == 0)
    {
      worst = 1.0;
      continue;
    }
    worst = std::max(worst, std::sqrt(vtkMath::Distance2BetweenPoints(vertex, x)));
    // The exact normal of the field.
    const double exact[3] = { 2.0 * vertex[0] - 0.3 * vertex[1], 2.0 * vertex[1] - 0.3 * vertex[0],
      2.0 * vertex[2] };
    worstCosine = std::min(worstCosine, vtkMath::Dot(ours, exact) / vtkMath::Norm(exact));
  }
  check.That(surface->GetNumberOfPoints() > 1000, "VTK's surface has vertices");
  check.Near(worst, 0.0, 1e-6, "the distance of VTK's vertices");
  // Of a quadric, smooth normals are exact at samples, and as good as exact between.
  check.Near(worstCosine, 1.0, 1e-3, "the cosine to the exact normal");
}

/// Of the 27 of cropping.
constexpr int SomeRegions = 0x5ab3c17;

//------------------------------------------------------------------------------
/// Hits that are before a plane, and those of them that are in regions.
void CheckRegions(Checks& check, Scene& scene, vtkPlane* plane)
{
  for (const int regions : { SomeRegions, VTK_CROP_SUBVOLUME })
  {
    scene.Mapper->CroppingOff();
    scene.Mapper->SetCroppingRegionFlags(regions);
    scene.SetSurface(0.1, { 0.9, 0.6, 0.3 }, 0.01);
    const auto all = Cast(scene);
    scene.Mapper->CroppingOn();
    const auto visible = Cast(scene);
    vtkNew<vtkMatrix4x4> toData;
    vtkMatrix4x4::Invert(scene.Volume->GetMatrix(), toData);
    const auto isVisible = [&](const double x[3])
    {
      double p[4] = { x[0], x[1], x[2], 1.0 };
      toData->MultiplyPoint(p, p);
      const double* between = scene.Mapper->GetCroppingRegionPlanes();
      int region = 0;
      for (int axis = 0, stride = 1; axis < 3; ++axis, stride *= 3)
      {
        region +=
          stride * (p[axis] < between[2 * axis] ? 0 : (p[axis] > between[2 * axis + 1] ? 2 : 1));
      }
      return (regions >> region & 1) != 0;
    };
    vtkIdType expected = 0;
    for (vtkIdType i = 0; i < all->GetNumberOfPoints(); ++i)
    {
      check.That(plane->EvaluateFunction(all->GetPoint(i)) > -1e-12, "hits are before the plane");
      expected += isVisible(all->GetPoint(i)) ? 1 : 0;
    }
    check.Equal(visible->GetNumberOfPoints(), expected, "the number of hits in regions");
    check.That(expected > 100 && expected < all->GetNumberOfPoints() - 100, "some are cropped");
  }
}

//------------------------------------------------------------------------------
/// What is picked at a pixel is what its ray has hit.
void CheckPicks(Checks& check, Scene& scene, vtkRectilinearGrid* grid, vtkImageData* picture)
{
  vtkNew<vtkIsosurfacePicker> picker;
  int hits = 0;
  int wrong = 0;
  double worst = 0.0;
  for (int i = 0; i < Size * Size; i += 7)
  {
    const int picked = picker->Pick(i % Size, i / Size, 0.0, scene.Renderer);
    const auto cell =
      static_cast<vtkIdType>(picture->GetPointData()->GetArray("CellId")->GetComponent(i, 0));
    if (cell < 0)
    {
      wrong += picked;
      continue;
    }
    ++hits;
    double position[3];
    picture->GetPointData()->GetArray("Position")->GetTuple(i, position);
    const bool isSame = picked != 0 && picker->GetCellId() == cell &&
      std::equal(position, position + 3, picker->GetPickPosition()) && picker->GetDataSet() == grid;
    wrong += isSame ? 0 : 1;
    double bounds[6];
    grid->GetCellBounds(picker->GetCellId(), bounds);
    const int* ijk = picker->GetCellIJK();
    double point[4] = { 0.0, 0.0, 0.0, 1.0 };
    for (int axis = 0; axis < 3; ++axis)
    {
      vtkDataArray* coordinates = axis == 0
        ? grid->GetXCoordinates()
        : (axis == 1 ? grid->GetYCoordinates() : grid->GetZCoordinates());
      check.Equal(bounds[2 * axis], coordinates->GetComponent(ijk[axis], 0), "the cell's corner");
      point[axis] =
        bounds[2 * axis] + picker->GetPCoords()[axis] * (bounds[2 * axis + 1] - bounds[2 * axis]);
    }
    scene.Volume->GetMatrix()->MultiplyPoint(point, point);
    worst = std::max(worst, std::sqrt(vtkMath::Distance2BetweenPoints(point, position)));
  }
  check.That(hits > 150, "hundreds of pixels are hit");
  check.Equal(wrong, 0, "the number of pixels picked wrong");
  check.Near(worst, 0.0, 1e-12, "cell and coordinates of what is picked");
}

//------------------------------------------------------------------------------
/// The cells that a selection of the whole window has are those that pixels show.
void CheckSelection(Checks& check, Scene& scene, vtkImageData* picture)
{
  std::set<vtkIdType> visible;
  for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); ++i)
  {
    visible.insert(
      static_cast<vtkIdType>(picture->GetPointData()->GetArray("CellId")->GetComponent(i, 0)));
  }
  visible.erase(-1);
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(0, 0, Size - 1, Size - 1);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
  const auto selection = vtk::TakeSmartPointer(selector->Select());
  auto* list = selection && selection->GetNumberOfNodes() == 1
    ? vtkIdTypeArray::SafeDownCast(selection->GetNode(0)->GetSelectionList())
    : nullptr;
  check.That(list &&
      std::set<vtkIdType>(list->GetPointer(0), list->GetPointer(0) + list->GetNumberOfTuples()) ==
        visible,
    "the cells selected are those visible");
}

//------------------------------------------------------------------------------
/// Clipping, cropping and picking together.
void CheckCuttingAndPicking(Checks& check)
{
  const auto grid = NewGrid(UnevenAxes(), Dent);
  Scene scene(grid, Size, Size);
  scene.Volume->SetPosition(0.1, -0.2, 0.05);
  scene.Volume->RotateX(30.0);
  vtkNew<vtkPlane> plane;
  plane->SetNormal(0.2, 0.3, -1.0);
  plane->SetOrigin(0.0, 0.0, 0.3);
  scene.Mapper->AddClippingPlane(plane);
  scene.Mapper->SetCroppingRegionPlanes(-0.3, 0.25, -0.9, 0.1, -0.5, 0.4);
  CheckRegions(check, scene, plane);

  scene.Mapper->SetCroppingRegionFlags(SomeRegions);
  scene.SetSurface(0.1, { 0.9, 0.6, 0.3 }, 1.0);
  scene.LookFrom(1.0, -2.0, 0.8);
  scene.Window->Render();
  const auto picture = scene.RenderToImage();
  CheckPicks(check, scene, grid, picture);
  CheckSelection(check, scene, picture);
}

//------------------------------------------------------------------------------
/// On uneven planes a quadric has all but the picture that it has on even ones: its shading, its
/// shadows, its depth.
void CheckLook(Checks& check)
{
  std::vector<double> depths[2];
  const auto draw = [&depths](vtkDataObject* data, bool shadows, int number, bool isSun)
  {
    Scene scene(data);
    scene.SetSurface(0.1, { 0.9, 0.8, 0.7 }, 1.0);
    scene.AddSurface(-0.9, { 0.9, 0.8, 0.7 }, 1.0);
    vtkNew<vtkLight> light;
    light->SetPosition(2.0, -3.0, 1.0);
    light->SetPositional(1);
    light->SetConeAngle(90.0);
    if (isSun)
    {
      // Its rays go along an axis, and never leave the slab of cells that they begin in.
      light->SetPositional(0);
      light->SetPosition(0.0, -5.0, 0.0);
    }
    scene.Renderer->AddLight(light);
    scene.Mapper->SetShadows(shadows);
    scene.Mapper->SetCroppingRegionPlanes(-1.0, 1.0, -0.75, 1.0, -1.0, 1.0);
    scene.Mapper->SetCropping(1);
    const Picture picture = RenderAndCapture(scene.Window);
    const DepthPicture depth(scene.Window, scene.Renderer);
    depths[number].clear();
    for (int i = 0; i < depth.GetWidth() * depth.GetHeight(); ++i)
    {
      depths[number].push_back(depth.GetDepth(i % depth.GetWidth(), i / depth.GetWidth()));
    }
    return picture;
  };
  const auto image = NewCube(81, Dent);
  const auto grid = NewGrid({ Growing(121), Reversed(Growing(131)), Growing(141) }, Dent);
  for (const bool isSun : { false, true })
  {
    for (const bool shadows : { false, true })
    {
      const double difference =
        GetDifference(draw(grid, shadows, 0, isSun), draw(image, shadows, 1, isSun), 4);
      std::size_t otherDepths = 0;
      for (std::size_t i = 0; i < depths[0].size(); ++i)
      {
        otherDepths += std::abs(depths[0][i] - depths[1][i]) > 1e-3 ? 1 : 0;
      }
      check.That(otherDepths < depths[0].size() / 100, "a surface has the same depth");
      std::cout << "On uneven planes " << 100.0 * difference << " % of the pixels differ\n";
      check.That(difference < 0.01, "a surface looks the same on uneven planes");
    }
    check.That(GetDifference(draw(grid, false, 0, isSun), draw(grid, true, 1, isSun), 8) > 0.01,
      "there is a shadow");
  }
}

/// Render passes of VTK get the same positions.
void CheckRenderPass(Checks& check)
{
  const auto draw = [](vtkDataObject* data, bool occluded)
  {
    Scene scene(data);
    vtkNew<vtkIsosurfaceVolume> volume;
    volume->SetMapper(scene.Mapper);
    volume->SetProperty(scene.Property());
    scene.Renderer->RemoveVolume(scene.Volume);
    scene.Renderer->AddVolume(volume);
    scene.Renderer->SetUseSSAO(occluded);
    scene.Renderer->SetSSAORadius(0.8);
    return RenderAndCapture(scene.Window);
  };
  const auto image = NewCube(61, AnalyticFields::Gyroid{ 1.3 });
  const auto grid =
    NewGrid({ Growing(121), Reversed(Growing(131)), Growing(141) }, AnalyticFields::Gyroid{ 1.3 });
  const Picture expected = draw(image, true);
  check.That(GetDifference(expected, draw(image, false), 8) > 0.2, "there is ambient occlusion");
  const double difference = GetDifference(draw(grid, true), expected, 8);
  std::cout << "With ambient occlusion " << 100.0 * difference << " % of the pixels differ\n";
  check.That(difference < 0.02, "ambient occlusion is the same on uneven planes");
}

//------------------------------------------------------------------------------
void CheckHiddenCells(Checks& check)
{
  const auto grid = NewGrid(UnevenAxes(), Dent);
  Scene scene(grid);
  scene.SetSurface(0.1, { 1.0, 1.0, 1.0 }, 0.01);
  const auto before = Cast(scene);
  vtkUnsignedCharArray* ghosts = grid->AllocateCellGhostArray();
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); i += 3)
  {
    ghosts->SetValue(i, vtkDataSetAttributes::HIDDENCELL);
  }
  grid->Modified();
  const auto after = Cast(scene);
  vtkIdType expected = 0;
  for (vtkIdType i = 0; i < before->GetNumberOfPoints(); ++i)
  {
    expected += before->GetPointData()->GetArray("CellId")->GetComponent(i, 0) -
          3 * std::floor(before->GetPointData()->GetArray("CellId")->GetComponent(i, 0) / 3) !=
        0.0
      ? 1
      : 0;
  }
  check.Equal(after->GetNumberOfPoints(), expected, "the number of hits in cells not hidden");
}

/// An array of the grid, and an image with a lattice of its own, are evaluated at the position.
void CheckColors(Checks& check)
{
  const auto height = [](const AnalyticFields::Point& p) { return 0.5 + 0.3 * p[2] + 0.15 * p[0]; };
  const auto grid = NewGrid(UnevenAxes(), Dent);
  const auto other = NewGrid(UnevenAxes(), height);
  vtkDataArray* heights = other->GetPointData()->GetScalars();
  heights->SetName("height");
  grid->GetPointData()->AddArray(heights);
  const auto image = NewCube(9, height);
  Scene scene(grid);
  scene.Property()->ShadeOff();
  scene.Property()->GetRGBTransferFunction()->RemoveAllPoints();
  scene.Property()->GetRGBTransferFunction()->AddRGBPoint(0.0, 0.0, 1.0, 0.0);
  scene.Property()->GetRGBTransferFunction()->AddRGBPoint(1.0, 1.0, 0.0, 0.0);
  for (const bool isOther : { false, true })
  {
    scene.Mapper->SetColorInputData(isOther ? image.Get() : nullptr);
    scene.Mapper->SetColorArrayName(isOther ? "" : "height");
    vtkNew<vtkImageData> picture;
    scene.Mapper->RenderToImage(
      scene.Volume, scene.Renderer->GetActiveCamera(), nullptr, Size, Size, picture);
    double worst = 0.0;
    int hits = 0;
    for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); ++i)
    {
      if (picture->GetPointData()->GetArray("CellId")->GetComponent(i, 0) >= 0.0)
      {
        ++hits;
        AnalyticFields::Point x;
        picture->GetPointData()->GetArray("Position")->GetTuple(i, x.data());
        const double red = picture->GetPointData()->GetArray("Colors")->GetComponent(i, 0);
        worst = std::max(worst, std::abs(red - 255.0 * height(x)));
      }
    }
    check.That(hits > 1000, "thousands of pixels are coloured");
    check.Near(worst, 0.0, 0.51, "the difference of colours");
  }
}

//------------------------------------------------------------------------------
/// Where a line hits a wall.
struct WallHit
{
  double X[3] = { 0.0, 0.0, 0.0 };
  double Normal[3] = { 0.0, 0.0, 0.0 };
  vtkIdType Cell = -1;
};

WallHit HitWall(Checks& check, Scene& scene, const double (&from)[3], const double (&to)[3])
{
  WallHit hit;
  double t;
  double parametric[3];
  double isovalue;
  check.Equal(scene.Mapper->IntersectWithLine(
                scene.Volume, from, to, t, hit.X, parametric, hit.Cell, isovalue, hit.Normal),
    1, "the wall is hit");
  return hit;
}

/// Where coordinates repeat and values differ, VTK draws a wall; so do we.
void CheckWalls(Checks& check)
{
  const auto grid =
    NewGrid({ Coordinates{ 0.0, 1.0, 2.0, 2.0, 3.0, 4.0 }, Even(5), Even(5) }, Dent);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    grid->GetPointData()->GetScalars()->SetComponent(i, 0, i % 6 < 3 ? -1.0 : 1.0);
  }
  vtkNew<vtkRectilinearSynchronizedTemplates> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, 0.0);
  contour->Update();
  double bounds[6];
  contour->GetOutput()->GetBounds(bounds);
  Scene scene(grid);
  const double from[3] = { -1.0, 0.12, 0.23 };
  const double to[3] = { 7.0, 0.22, 0.13 };
  const WallHit hit = HitWall(check, scene, from, to);
  check.That(bounds[0] == 2.0 && bounds[1] == 2.0, "VTK's wall stands at 2");
  check.Near(hit.X[0], 2.0, 1e-15, "the position of the wall");
  check.Near(hit.Normal[0], -1.0, 1e-15, "the normal of the wall");
  check.Equal(hit.Cell % 5, vtkIdType{ 2 }, "the flat cell");
}

/// The same where the first and the last coordinates repeat, whatever they are rounded to.
void CheckWallsAtTheBorder(Checks& check)
{
  Scene scene(NewGrid(UnevenAxes(), Dent));
  for (int inner = 2; inner < 40; ++inner)
  {
    Coordinates places = Even(inner, 0.1, 0.7);
    places.insert(places.begin(), places.front());
    places.push_back(places.back());
    const auto grid = NewGrid({ places, Even(3), Even(3) }, Dent);
    const vtkIdType last = inner + 1;
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    {
      const vtkIdType column = i % (last + 1);
      const bool isOutside = column == 0 || column == last;
      grid->GetPointData()->GetScalars()->SetComponent(i, 0, isOutside ? -1.0 : 1.0);
    }
    scene.Mapper->SetInputDataObject(grid);
    for (const bool isUp : { true, false })
    {
      const double from[3] = { isUp ? -1.0 : 2.0, 0.12, 0.23 };
      const double to[3] = { isUp ? 2.0 : -1.0, 0.22, 0.13 };
      const WallHit hit = HitWall(check, scene, from, to);
      check.Near(
        hit.X[0], isUp ? places.front() : places.back(), 1e-15, "the position of the wall");
      check.Near(hit.Normal[0], isUp ? -1.0 : 1.0, 1e-15, "the normal of the wall");
      check.Equal(hit.Cell % last, isUp ? 0 : last - 1, "the flat cell");
    }
  }
}

/// Coordinates may change; what is built stays.
void CheckNewCoordinates(Checks& check)
{
  const auto grid = NewGrid(UnevenAxes(), Dent);
  Scene scene(grid);
  const auto before = Cast(scene);
  for (vtkIdType i = 0; i < grid->GetXCoordinates()->GetNumberOfTuples(); ++i)
  {
    grid->GetXCoordinates()->SetComponent(i, 0, 0.5 * grid->GetXCoordinates()->GetComponent(i, 0));
  }
  grid->Modified();
  const auto after = Cast(scene);
  check.That(before->GetNumberOfPoints() > 0 && after->GetNumberOfPoints() > 0, "rays hit");
  check.Near(after->GetBounds()[1], 0.5 * before->GetBounds()[1], 0.02, "the bounds of the hits");
}

//------------------------------------------------------------------------------
void CheckErrors(Checks& check)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Coordinates even = Even(5);
  const auto expect = [&check](vtkRectilinearGrid* grid, const std::string& text)
  {
    Scene scene(grid);
    vtkNew<EventCounter> errors;
    scene.Mapper->AddObserver(vtkCommand::ErrorEvent, errors);
    const double from[3] = { -2.0, -2.0, -2.0 };
    const double to[3] = { 2.0, 2.0, 2.0 };
    double t;
    double x[3];
    double isovalue;
    vtkIdType cell;
    for (int i = 0; i < 2; ++i)
    {
      check.Equal(
        scene.Mapper->IntersectWithLine(scene.Volume, from, to, t, x, x, cell, isovalue, x), 0,
        "the number of hits without a volume");
    }
    check.Equal(errors->Count, 1, "the number of errors for " + text);
    check.That(errors->Text.find(text) != std::string::npos, "it says " + text);
  };
  expect(NewGrid({ even, { -1.0, -0.5, nan, 0.5, 1.0 }, even }, Dent), "y coordinates");
  expect(NewGrid({ even, even, { -1.0, -0.5, 0.0, 0.5, infinity } }, Dent), "z coordinates");
  expect(NewGrid({ Coordinates{ -1.0, 0.5, 0.0, 0.7, 1.0 }, even, even }, Dent),
    "not in order: 0.5 (number 1) is followed by 0");
  expect(NewGrid({ Coordinates{ 1.0, 1.0, 1.0 }, even, even }, Dent),
    "the last must differ from the first");
  expect(NewGrid({ even, even, { 0.0 } }, Dent), "5 x 5 x 1 points");
  const auto few = NewGrid({ even, even, even }, Dent);
  few->SetXCoordinates(NewCoordinates(Even(4), VTK_DOUBLE));
  expect(few, "4 x coordinates for 5 points");
}

}

int TestIsosurfaceRayTraceMapperRectilinear(int argc, char* argv[])
{
  Checks check;
  CheckEvenGrids(check);
  CheckInterpolants(check);
  CheckCells(check);
  CheckAgainstPolygons(check);
  CheckCuttingAndPicking(check);
  CheckLook(check);
  CheckRenderPass(check);
  CheckHiddenCells(check);
  CheckColors(check);
  CheckWalls(check);
  CheckWallsAtTheBorder(check);
  CheckNewCoordinates(check);
  CheckErrors(check);

  // A gyroid on planes that stand closer and closer towards the eye; exact normals show its cells.
  const auto grid =
    NewGrid({ Reversed(Growing(28)), Growing(30), Growing(24) }, AnalyticFields::Gyroid{ 1.1 });
  Scene scene(grid, 240, 240);
  scene.Mapper->SetNormalModeToInterpolantGradient();
  vtkNew<vtkPlane> plane;
  plane->SetNormal(0.3, 0.5, -1.0);
  plane->SetOrigin(0.0, 0.0, 0.6);
  scene.Mapper->AddClippingPlane(plane);
  scene.Mapper->SetCroppingRegionPlanes(0.2, 1.0, -1.0, -0.3, 0.0, 1.0);
  scene.Mapper->SetCroppingRegionFlags(0x7ffffff & ~(1 << 13));
  scene.Mapper->CroppingOn();
  scene.Renderer->GetActiveCamera()->Zoom(0.75);
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
