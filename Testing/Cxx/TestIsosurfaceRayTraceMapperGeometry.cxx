// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Where the image lies in the world: pairs of scenes that must look the same.

#include "AnalyticFields.h"
#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkMatrix4x4.h>
#include <vtkTransform.h>

#include <functional>

using namespace MapperTesting;

namespace
{

/// Something without any symmetry, as a function of the world.
double Lump(const AnalyticFields::Point& p)
{
  const AnalyticFields::Sphere large = { { 0.1, -0.05, -0.15 }, 0.55 };
  const AnalyticFields::Sphere small = { { 0.5, 0.3, 0.45 }, 0.3 };
  const AnalyticFields::Sphere tiny = { { -0.4, -0.5, 0.4 }, 0.25 };
  return std::max({ large(p), small(p), tiny(p) });
}

/// Samples a field of the world at the points of the image.
void Sample(vtkImageData* image, vtkVolume* volume)
{
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double point[4];
    image->GetPoint(i, point);
    point[3] = 1.0;
    volume->GetMatrix()->MultiplyPoint(point, point);
    scalars->SetValue(i, Lump({ point[0], point[1], point[2] }));
  }
  image->GetPointData()->SetScalars(scalars);
}

/// How an image and a volume are laid out, each so that it covers the lump finely.
struct Layout
{
  std::string Name;
  std::function<void(vtkImageData*, vtkVolume*)> Apply;
};

void Cover(vtkImageData* image, const int first[3])
{
  // From -1 to 1 along every axis.
  const int cells[3] = { 70, 64, 80 };
  int extent[6];
  double spacing[3];
  double origin[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    extent[2 * axis] = first[axis];
    extent[2 * axis + 1] = first[axis] + cells[axis];
    spacing[axis] = 2.0 / cells[axis];
    origin[axis] = -1.0 - first[axis] * spacing[axis];
  }
  image->SetExtent(extent);
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
}

std::vector<Layout> GetLayouts()
{
  const auto plain = [](vtkImageData* image)
  {
    const int zero[3] = { 0, 0, 0 };
    Cover(image, zero);
  };
  return {
    { "anisotropic spacing", [=](vtkImageData* image, vtkVolume*) { plain(image); } },
    { "an extent that begins elsewhere",
      [](vtkImageData* image, vtkVolume*)
      {
        const int first[3] = { -30, 17, 1000 };
        Cover(image, first);
      } },
    { "a direction matrix",
      [=](vtkImageData* image, vtkVolume*)
      {
        plain(image);
        // A rotation by the angle whose cosine is 0.6, about z; the corner moves along.
        image->SetDirectionMatrix(0.6, -0.8, 0.0, 0.8, 0.6, 0.0, 0.0, 0.0, 1.0);
        image->SetOrigin(-0.6 + 0.8, -0.8 - 0.6, -1.0);
      } },
    { "a direction matrix that mirrors and swaps",
      [=](vtkImageData* image, vtkVolume*)
      {
        plain(image);
        image->SetDirectionMatrix(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0);
        image->SetOrigin(1.0, -1.0, 1.0);
      } },
    { "a position, a scale and an orientation of the volume",
      [=](vtkImageData* image, vtkVolume* volume)
      {
        plain(image);
        volume->SetOrientation(20.0, -35.0, 50.0);
        volume->SetScale(1.1, 0.95, 1.2);
        volume->SetPosition(0.05, -0.02, 0.03);
      } },
    { "a user matrix",
      [=](vtkImageData* image, vtkVolume* volume)
      {
        plain(image);
        vtkNew<vtkTransform> transform;
        transform->RotateWXYZ(40.0, 1.0, 2.0, 3.0);
        transform->Scale(-1.0, 1.0, 1.0);
        vtkNew<vtkMatrix4x4> matrix;
        matrix->DeepCopy(transform->GetMatrix());
        matrix->SetElement(3, 3, 1.0 + 1e-15); // as rounding leaves it
        volume->SetUserMatrix(matrix);
      } },
  };
}

Picture Draw(vtkImageData* image, const std::function<void(Scene&)>& apply)
{
  Scene scene(image);
  apply(scene);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(2.0, -4.0, 1.6);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  scene.Renderer->ResetCameraClippingRange(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  return RenderAndCapture(scene.Window);
}

}

int TestIsosurfaceRayTraceMapperGeometry(int argc, char* argv[])
{
  Checks check;
  const auto reference = NewCube(81, Lump);
  const Picture expected = Draw(reference, [](Scene&) {});
  for (const Layout& layout : GetLayouts())
  {
    vtkNew<vtkImageData> image;
    const Picture picture = Draw(image,
      [&](Scene& scene)
      {
        layout.Apply(image, scene.Volume);
        Sample(image, scene.Volume);
      });
    // The same lump on another lattice: the same but for a few pixels of the rims and creases.
    const double difference = GetDifference(picture, expected, 12);
    std::cout << layout.Name << ": " << 100.0 * difference << " % of the pixels differ\n";
    check.That(difference < 0.02, layout.Name + " shows the same lump");
  }

  // A million spacings from the origin of the world, in world units of a thousandth.
  const auto far = NewCube(81, Lump);
  const double spacing = 1e-3;
  far->SetSpacing(spacing, spacing, spacing);
  far->SetOrigin(1e3, -2e3, 3e3);
  Scene scene(far);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  const double scale = spacing * 40.0;
  const double center[3] = { 1e3 + scale, -2e3 + scale, 3e3 + scale };
  camera->SetFocalPoint(center);
  camera->SetPosition(center[0] + 2.0 * scale, center[1] - 4.0 * scale, center[2] + 1.6 * scale);
  camera->SetClippingRange(scale * 2.5, scale * 7.0);
  check.That(GetDifference(RenderAndCapture(scene.Window), expected, 12) < 0.005,
    "far from the origin the lump looks the same");

  // One sample thick along each axis in turn is too thin; two are enough.
  vtkNew<vtkImageData> thin;
  thin->SetDimensions(81, 2, 81);
  thin->SetSpacing(0.025, 0.2, 0.025);
  thin->SetOrigin(-1.0, -0.1, -1.0);
  Scene slab(thin);
  Sample(thin, slab.Volume);
  slab.LookFrom(1.0, -2.0, 0.8);
  check.That(IsBaseline(argc, argv, slab.Window), "the picture is the baseline");
  return check.Result();
}
