// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The tricubic interpolant: along every ray the hits are where the field of vtkImageInterpolator
// crosses the isovalues; the properties of a pixel are those of the surface it shows; and surfaces
// and normals are nearer to the fields that were sampled than those of the trilinear interpolant.

#include "AnalyticFields.h"
#include "Checks.h"
#include "Pictures.h"
#include "SceneChecks.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfacePicker.h"

#include <vtkCellData.h>
#include <vtkExtractVOI.h>
#include <vtkImageInterpolator.h>
#include <vtkMath.h>
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <functional>

using namespace MapperTesting;

namespace
{

using AnalyticFields::Point;
using Field = std::function<double(const Point&)>;

constexpr int Size = 160;

struct CubicScene : Scene
{
  explicit CubicScene(vtkDataObject* data)
    : Scene(data, Size, Size)
  {
    this->Mapper->SetInterpolationModeToCubic();
  }
};

double Torus(const Point& p)
{
  return 0.22 - std::hypot(std::hypot(p[0], p[1]) - 0.55, p[2]);
}

/// The cubic field of an image, from VTK, which rounds positions to 2^-16 of a cell.
class CubicField
{
public:
  explicit CubicField(vtkImageData* image)
  {
    this->Interpolator->SetInterpolationModeToCubic();
    this->Interpolator->Initialize(image);
    this->Interpolator->Update();
  }

  double operator()(const Point& p) const
  {
    double value = 0.0;
    this->Interpolator->Interpolate(p.data(), &value);
    return value;
  }

  /// By differences of the field.
  Point GetGradient(const Point& p) const
  {
    constexpr double step = 2e-3;
    Point gradient;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Point below = p;
      Point above = p;
      below[axis] -= step;
      above[axis] += step;
      gradient[axis] = ((*this)(above) - (*this)(below)) / (2.0 * step);
    }
    return gradient;
  }

private:
  vtkNew<vtkImageInterpolator> Interpolator;
};

/// The image with one more sample on every side, extrapolated linearly.
vtkSmartPointer<vtkImageData> NewPadded(vtkImageData* image)
{
  const int* dimensions = image->GetDimensions();
  auto padded = vtkSmartPointer<vtkImageData>::New();
  padded->SetExtent(-1, dimensions[0], -1, dimensions[1], -1, dimensions[2]);
  padded->SetSpacing(image->GetSpacing());
  padded->SetOrigin(image->GetOrigin());
  padded->AllocateScalars(VTK_DOUBLE, 1);
  for (int z = -1; z <= dimensions[2]; ++z)
  {
    for (int y = -1; y <= dimensions[1]; ++y)
    {
      for (int x = -1; x <= dimensions[0]; ++x)
      {
        // Along each axis the sample is a + (a - b), or a itself.
        const int index[3] = { x, y, z };
        double value = 0.0;
        for (int corner = 0; corner < 8; ++corner)
        {
          int sample[3];
          double weight = 1.0;
          for (int axis = 0; axis < 3; ++axis)
          {
            const int last = dimensions[axis] - 1;
            const int nearest = std::clamp(index[axis], 0, last);
            const bool isOutside = nearest != index[axis];
            const bool isSecond = (corner >> axis & 1) != 0;
            weight *= isOutside ? (isSecond ? -1.0 : 2.0) : (isSecond ? 0.0 : 1.0);
            sample[axis] = isSecond && isOutside ? nearest + nearest - index[axis] : nearest;
          }
          value += weight * image->GetScalarComponentAsDouble(sample[0], sample[1], sample[2], 0);
        }
        padded->SetScalarComponentFromDouble(x, y, z, 0, value);
      }
    }
  }
  return padded;
}

//------------------------------------------------------------------------------
/// Hits of rays through noise, against the field at many points of each ray.
void CheckRays(Checks& check)
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  const auto uniform = [&random](double low, double high)
  { return random->GetNextRangeValue(low, high); };
  const auto image = NewCube(9, [&uniform](const Point&) { return uniform(-1.0, 1.0); });
  const CubicField field(NewPadded(image));
  // VTK's own border differs in the outermost cells only.
  const CubicField unpadded(image);
  check.Near(unpadded({ 0.31, -0.17, 0.44 }), field({ 0.31, -0.17, 0.44 }), 1e-12,
    "the field within, padded or not");

  Scene scene(image);
  const double isovalues[] = { -0.4, 0.0, 0.7, 1.05 };
  scene.SetSurface(isovalues[0], { 1.0, 1.0, 1.0 }, 1e-6);
  for (int i = 1; i < 4; ++i)
  {
    scene.AddSurface(isovalues[i], { 1.0, 1.0, 1.0 }, 1e-6);
  }
  vtkNew<vtkPoints> origins;
  origins->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> directions;
  directions->SetNumberOfComponents(3);
  constexpr int rays = 300;
  for (int i = 0; i < rays; ++i)
  {
    // From outside to outside. Some through points where cells meet.
    Point from = { uniform(-1.5, 1.5), uniform(-1.5, 1.5), -1.5 };
    Point to = { uniform(-1.0, 1.0), uniform(-1.0, 1.0), 1.5 };
    if (i % 3 == 0)
    {
      std::transform(
        from.begin(), from.end(), from.begin(), [](double x) { return std::round(4.0 * x) / 4.0; });
      std::transform(
        to.begin(), to.end(), to.begin(), [](double x) { return std::round(4.0 * x) / 4.0; });
    }
    const auto axis = static_cast<std::size_t>(i % 3);
    std::swap(from[axis], from[2]);
    std::swap(to[axis], to[2]);
    origins->InsertNextPoint(from.data());
    directions->InsertNextTuple3(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  }

  for (const bool isCubic : { true, false })
  {
    scene.Mapper->SetInterpolationMode(
      isCubic ? vtkIsosurfaceRayTraceMapper::CUBIC : vtkIsosurfaceRayTraceMapper::TRILINEAR);
    vtkNew<vtkPolyData> hits;
    check.That(scene.Mapper->CastRays(scene.Volume, origins, directions, hits), "rays are cast");
    std::vector<std::vector<std::vector<double>>> found(rays, std::vector<std::vector<double>>(4));
    const auto get = [&hits](const char* name) { return hits->GetPointData()->GetArray(name); };
    for (vtkIdType i = 0; i < hits->GetNumberOfPoints(); ++i)
    {
      const auto surface = static_cast<std::size_t>(
        std::find(isovalues, isovalues + 4, get("Isovalue")->GetTuple1(i)) - isovalues);
      found[static_cast<std::size_t>(get("RayId")->GetTuple1(i))][surface].push_back(
        get("T")->GetTuple1(i));
    }
    int points = 0;
    int wrong = 0;
    for (vtkIdType ray = 0; ray < rays; ++ray)
    {
      Point from;
      Point along;
      origins->GetPoint(ray, from.data());
      directions->GetTuple(ray, along.data());
      double value = 0.0;
      double first = VTK_DOUBLE_MAX;
      for (int step = 0; step <= 4000; ++step)
      {
        const double t = step / 4000.0;
        const Point p = { from[0] + t * along[0], from[1] + t * along[1], from[2] + t * along[2] };
        if (std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) }) > 1.0)
        {
          continue;
        }
        value = field(p);
        first = first == VTK_DOUBLE_MAX ? value : first;
        for (std::size_t i = 0; i < 4; ++i)
        {
          const std::vector<double>& own = found[static_cast<std::size_t>(ray)][i];
          const auto before = std::lower_bound(own.begin(), own.end(), t) - own.begin();
          const bool startsInside = first >= isovalues[i];
          if (std::abs(value - isovalues[i]) > 2e-4)
          {
            ++points;
            wrong += (value >= isovalues[i]) != (startsInside == (before % 2 == 0)) ? 1 : 0;
          }
        }
      }
    }
    std::cout << (isCubic ? "Cubic" : "Trilinear") << ": " << hits->GetNumberOfPoints()
              << " hits; at " << wrong << " of " << points
              << " points a ray is not on the side of vtkImageInterpolator's field\n";
    check.That(points > 1000000 && hits->GetNumberOfPoints() > 1000, "there is much to compare");
    check.That(isCubic ? wrong == 0 : wrong > 10000, "the hits are those of VTK's cubic field");
  }
}

//------------------------------------------------------------------------------
/// Points on the isosurface of VTK's field, normals perpendicular to it, the same from every
/// interface.
void CheckPixels(Checks& check)
{
  const auto image = NewCube(14, AnalyticFields::Ripples);
  const CubicField field(NewPadded(image));
  CubicScene scene(image);
  scene.Window->Render();
  const vtkSmartPointer<vtkImageData> picture = scene.RenderToImage();
  const auto get = [&picture](const char* name) { return picture->GetPointData()->GetArray(name); };
  vtkNew<vtkIsosurfacePicker> picker;
  int shown = 0;
  for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); i += 3)
  {
    Point position;
    Point normal;
    get("Position")->GetTuple(i, position.data());
    get("Normals")->GetTuple(i, normal.data());
    const auto x = static_cast<double>(i % Size);
    const auto y = static_cast<double>(i / Size);
    const bool isPicked = picker->Pick(x, y, 0.0, scene.Renderer) != 0;
    check.Equal(isPicked, !std::isnan(position[0]), "whether a pixel is picked");
    if (!isPicked)
    {
      continue;
    }
    ++shown;
    check.Near(field(position), 0.0, 2e-5, "the field at the position");
    const Point gradient = field.GetGradient(position);
    const double length = std::hypot(gradient[0], gradient[1], gradient[2]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      check.Near(normal[axis], -gradient[axis] / length, 5e-3, "the normal");
    }
    check.That(std::equal(position.begin(), position.end(), picker->GetPickPosition()) &&
        std::equal(normal.begin(), normal.end(), picker->GetPickNormal()),
      "the pick is the pixel");
    check.Equal(static_cast<double>(picker->GetCellId()), get("CellId")->GetTuple1(i), "the cell");
    double bounds[6];
    image->GetCellBounds(picker->GetCellId(), bounds);
    const double* pcoords = picker->GetPCoords();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      check.Near(bounds[2 * axis] + pcoords[axis] * (bounds[2 * axis + 1] - bounds[2 * axis]),
        position[axis], 1e-12, "the position in the cell");
    }
    Point inside;
    Point outside;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      inside[axis] = position[axis] - 1e-3 * normal[axis];
      outside[axis] = position[axis] + 1e-3 * normal[axis];
    }
    double t;
    double point[3];
    double own[3];
    double isovalue;
    double lineNormal[3];
    vtkIdType cell;
    check.Equal(scene.Mapper->IntersectWithLine(scene.Volume, outside.data(), inside.data(), t,
                  point, own, cell, isovalue, lineNormal),
      1, "whether a line through the position meets the surface");
    check.Near(t, 0.5, 1e-9, "the middle of the line");
    check.Equal(isovalue, 0.0, "the isovalue");
  }
  check.That(shown > 3000, "the surface is visible");
}

//------------------------------------------------------------------------------
/// How far surface and normals are from those of the field that was sampled.
struct Errors
{
  /// In cells, and in degrees; root mean squares over the pixels.
  double Crossing = 0.0;
  double Normal = 0.0;
  int Pixels = 0;
};

Errors GetErrors(const Field& field, int samples, double isovalue, int mode)
{
  CubicScene scene(NewCube(samples, field));
  scene.SetSurface(isovalue, { 1.0, 1.0, 1.0 }, 1.0);
  scene.Mapper->SetInterpolationMode(mode);
  const vtkSmartPointer<vtkImageData> picture = scene.RenderToImage();
  Errors errors;
  for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); ++i)
  {
    Point p;
    Point normal;
    picture->GetPointData()->GetArray("Position")->GetTuple(i, p.data());
    picture->GetPointData()->GetArray("Normals")->GetTuple(i, normal.data());
    if (std::isnan(p[0]))
    {
      continue;
    }
    Point gradient;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Point below = p;
      Point above = p;
      below[axis] -= 1e-6;
      above[axis] += 1e-6;
      gradient[axis] = (field(above) - field(below)) / 2e-6;
    }
    const double length = std::hypot(gradient[0], gradient[1], gradient[2]);
    const double cosine =
      -(gradient[0] * normal[0] + gradient[1] * normal[1] + gradient[2] * normal[2]) / length;
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / vtkMath::Pi();
    const double distance = (field(p) - isovalue) / length * 0.5 * (samples - 1);
    errors.Crossing += distance * distance;
    errors.Normal += angle * angle;
    ++errors.Pixels;
  }
  errors.Crossing = std::sqrt(errors.Crossing / errors.Pixels);
  errors.Normal = std::sqrt(errors.Normal / errors.Pixels);
  return errors;
}

void CheckErrors(Checks& check)
{
  struct Case
  {
    std::string Name;
    Field Function;
    int Samples;
    double Isovalue;
    /// How much nearer the position must be.
    double Factor;
  };
  const std::vector<Case> cases = {
    { "ball", AnalyticFields::Sphere{ { 0.0, 0.0, 0.0 }, 0.7 }, 12, 0.0, 20.0 },
    { "torus", Torus, 20, 0.0, 10.0 },
    { "Marschner-Lobb", AnalyticFields::MarschnerLobb(), 40, 0.5, 1.25 },
  };
  std::cout << "Root mean squares of the errors, trilinear -> cubic:\n";
  for (const Case& one : cases)
  {
    const Errors trilinear =
      GetErrors(one.Function, one.Samples, one.Isovalue, vtkIsosurfaceRayTraceMapper::TRILINEAR);
    const Errors cubic =
      GetErrors(one.Function, one.Samples, one.Isovalue, vtkIsosurfaceRayTraceMapper::CUBIC);
    std::cout << one.Name << ", " << one.Samples << "^3: position " << trilinear.Crossing << " -> "
              << cubic.Crossing << " cells, normal " << trilinear.Normal << " -> " << cubic.Normal
              << " degrees (" << cubic.Pixels << " pixels)\n";
    check.That(cubic.Pixels > 3000, one.Name + " is visible");
    check.That(one.Factor * cubic.Crossing < trilinear.Crossing,
      "the position of " + one.Name + " is better");
    check.That(cubic.Normal < trilinear.Normal, "the normal of " + one.Name + " is better");
  }
}

//------------------------------------------------------------------------------
/// A smooth surface does not occlude itself; another one occludes its light.
void CheckShadows(Checks& check)
{
  const Field torusAndBall = [](const Point& p)
  { return std::max(Torus(p), 0.2 - std::hypot(p[0] - 0.3, p[1] + 0.4, p[2] - 0.6)); };
  for (const bool isConvex : { true, false })
  {
    CubicScene scene(isConvex ? NewBall(17, 0.7) : NewCube(17, torusAndBall));
    CheckShadows(check, scene, isConvex);
  }
}

//------------------------------------------------------------------------------
/// A ball of squares, which the interpolant reproduces on planes however spaced.
void CheckUnevenSpacing(Checks& check)
{
  constexpr int planes = 14;
  std::vector<double> coordinates;
  for (int i = 0; i < planes; ++i)
  {
    coordinates.push_back(-1.0 + 2.0 * std::pow(i / (planes - 1.0), 1.4));
  }
  const auto grid = NewGrid({ coordinates, coordinates, coordinates },
    [](const Point& p) { return 0.5 - p[0] * p[0] - p[1] * p[1] - p[2] * p[2]; });
  CubicScene scene(grid);
  const vtkSmartPointer<vtkImageData> picture = scene.RenderToImage();
  int shown = 0;
  for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); ++i)
  {
    Point p;
    Point normal;
    picture->GetPointData()->GetArray("Position")->GetTuple(i, p.data());
    picture->GetPointData()->GetArray("Normals")->GetTuple(i, normal.data());
    if (std::isnan(p[0]))
    {
      continue;
    }
    ++shown;
    const double radius = std::hypot(p[0], p[1], p[2]);
    check.Near(radius, std::sqrt(0.5), 1e-9, "the radius");
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      check.Near(normal[axis], p[axis] / radius, 1e-9, "the normal with uneven spacing");
    }
  }
  check.That(shown > 3000, "the ball is visible");
}

//------------------------------------------------------------------------------
/// Two blocks and the image they are halves of; one of them alone; scalars of cells and of points.
void CheckInputs(Checks& check)
{
  const auto image = NewCube(20, AnalyticFields::Ripples);
  CubicScene whole(image);
  const Picture expected = RenderAndCapture(whole.Window);
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkSmartPointer<vtkImageData> lower;
  for (unsigned int i = 0; i < 2; ++i)
  {
    vtkNew<vtkExtractVOI> half;
    half->SetInputData(image);
    half->SetVOI(i == 0 ? 0 : 9, i == 0 ? 9 : 19, 0, 19, 0, 19);
    half->Update();
    blocks->SetBlock(i, half->GetOutput());
    lower = i == 0 ? half->GetOutput() : lower.Get();
  }
  CubicScene halves(blocks);
  check.Equal(GetDifference(RenderAndCapture(halves.Window), expected, 0), 0.0,
    "the difference between two blocks and the whole");

  // A block that is missing, and one that is not there, have the same border.
  vtkNew<vtkMultiBlockDataSet> corners;
  vtkNew<vtkExtractVOI> corner;
  corner->SetInputData(image);
  corner->SetVOI(12, 19, 0, 9, 0, 9);
  corner->Update();
  corners->SetBlock(0, lower);
  corners->SetBlock(1, corner->GetOutput());
  CubicScene gap(corners);
  CubicScene one(lower);
  vtkNew<vtkPlane> plane;
  plane->SetNormal(-1.0, 0.0, 0.0);
  plane->SetOrigin(-0.04, 0.0, 0.0);
  gap.Mapper->AddClippingPlane(plane);
  one.Renderer->SetActiveCamera(gap.Renderer->GetActiveCamera());
  check.That(GetDifference(RenderAndCapture(gap.Window), RenderAndCapture(one.Window), 1) < 0.001,
    "the border beside a missing block is that of the volume");

  // Samples at the centres of cells.
  vtkNew<vtkImageData> dual;
  const double spacing = image->GetSpacing()[0];
  dual->SetDimensions(21, 21, 21);
  dual->SetSpacing(spacing, spacing, spacing);
  dual->SetOrigin(-1.0 - 0.5 * spacing, -1.0 - 0.5 * spacing, -1.0 - 0.5 * spacing);
  dual->GetCellData()->SetScalars(image->GetPointData()->GetScalars());
  CubicScene cells(dual);
  cells.Renderer->SetActiveCamera(whole.Renderer->GetActiveCamera());
  check.That(
    GetDifference(RenderAndCapture(cells.Window), RenderAndCapture(whole.Window), 1) < 0.001,
    "samples of cells are samples");
}

}

int TestIsosurfaceRayTraceMapperCubic(int argc, char* argv[])
{
  Checks check;
  CheckRays(check);
  CheckPixels(check);
  CheckErrors(check);
  CheckShadows(check);
  CubicScene ripples(NewCube(33, AnalyticFields::Ripples));
  CheckDeterminism(check, ripples);
  CheckUnevenSpacing(check);
  CheckInputs(check);

  CubicScene scene(NewCube(12, AnalyticFields::Ripples));
  scene.SetSurface(0.2, { 0.9, 0.75, 0.5 }, 0.5);
  scene.AddSurface(0.8, { 0.3, 0.55, 0.85 }, 1.0);
  AddShadowsAndClipping(scene);
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
