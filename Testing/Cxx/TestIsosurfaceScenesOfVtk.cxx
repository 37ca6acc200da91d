// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The scenes of VTK's tests of its GPU ray caster and of its pickers, by what they put together;
// their data are replaced by vtkRTAnalyticSource and a ball. Each shows what the polygons of
// vtkFlyingEdges3D show there.

#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfacePicker.h"
#include "vtkIsosurfaceVolume.h"

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkCellPicker.h>
#include <vtkExtractVOI.h>
#include <vtkFlyingEdges3D.h>
#include <vtkLight.h>
#include <vtkLightKit.h>
#include <vtkMath.h>
#include <vtkMatrix3x3.h>
#include <vtkOutlineSource.h>
#include <vtkPlane.h>
#include <vtkProperty.h>
#include <vtkRTAnalyticSource.h>
#include <vtkTransform.h>

using namespace MapperTesting;

namespace
{

vtkSmartPointer<vtkImageData> NewWaves(int reach)
{
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(-reach, reach, -reach, reach, -reach, reach);
  source->Update();
  return source->GetOutput();
}

/// The ball of TestGPURayCastCropping, in an image with a sample for each unit of length.
vtkSmartPointer<vtkImageData> NewBallOfSamples()
{
  auto image = NewBall(51, 0.8);
  image->SetSpacing(1.0, 1.0, 1.0);
  image->SetOrigin(0.0, 0.0, 0.0);
  return image;
}

vtkSmartPointer<vtkActor> NewColoredActor(vtkAlgorithm* source, const double color[3])
{
  auto actor = NewActor(source);
  actor->GetMapper()->ScalarVisibilityOff();
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
  return actor;
}

vtkSmartPointer<vtkFlyingEdges3D> NewContour(vtkImageData* image, double isovalue)
{
  auto contour = vtkSmartPointer<vtkFlyingEdges3D>::New();
  contour->SetInputData(image);
  contour->SetValue(0, isovalue);
  return contour;
}

/// Volumes, each with the actors that replace it.
struct Stage
{
  Stage()
  {
    this->Renderer->SetBackground(0.1, 0.2, 0.4);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(240, 180);
    this->Window->AddRenderer(this->Renderer);
  }

  /// A matt volume with an isosurface.
  vtkVolume* Add(vtkImageData* image, double isovalue, const std::array<double, 3>& color)
  {
    vtkNew<vtkIsosurfaceRayTraceMapper> mapper;
    mapper->SetInputData(image);
    auto volume = vtkSmartPointer<vtkIsosurfaceVolume>::New();
    volume->SetMapper(mapper);
    vtkVolumeProperty* property = volume->GetProperty();
    property->ShadeOn();
    property->SetAmbient(0.0);
    property->SetDiffuse(1.0);
    property->SetSpecular(0.0);
    this->Renderer->AddViewProp(volume);
    this->Volumes.push_back(volume);
    this->AddSurface(image, isovalue, color, 1.0);
    return volume;
  }

  /// Another isosurface of the last volume.
  void AddSurface(
    vtkImageData* image, double isovalue, const std::array<double, 3>& color, double opacity)
  {
    vtkVolumeProperty* property = this->Volumes.back()->GetProperty();
    vtkContourValues* isovalues = property->GetIsoSurfaceValues();
    isovalues->SetValue(isovalues->GetNumberOfContours(), isovalue);
    property->GetRGBTransferFunction()->AddRGBPoint(isovalue, color[0], color[1], color[2]);
    property->GetScalarOpacity()->AddPoint(isovalue, opacity);
    this->AddPolygons(NewContour(image, isovalue), color)->GetProperty()->SetOpacity(opacity);
  }

  /// Polygons instead of the last volume.
  vtkActor* AddPolygons(vtkAlgorithm* source, const std::array<double, 3>& color)
  {
    const auto actor = NewColoredActor(source, color.data());
    this->Actors.push_back({ this->Volumes.back(), actor });
    return actor;
  }

  /// Draws the volumes, then their polygons with the same matrices and clipping planes. Returns the
  /// share of pixels that differ.
  double Compare(const std::string& name)
  {
    const Picture traced = RenderAndCapture(this->Window);
    for (const auto& volume : this->Volumes)
    {
      this->Renderer->RemoveViewProp(volume);
    }
    const Picture empty = RenderAndCapture(this->Window);
    for (const auto& [volume, actor] : this->Actors)
    {
      actor->PokeMatrix(volume->GetMatrix());
      actor->GetMapper()->SetClippingPlanes(volume->GetMapper()->GetClippingPlanes());
      this->Renderer->AddViewProp(actor);
    }
    const Picture polygons = RenderAndCapture(this->Window);
    const double covered = GetDifference(polygons, empty, 4);
    const double difference = GetDifference(traced, polygons, 20);
    std::cout << name << ": they cover " << 100.0 * covered << " %, " << 100.0 * difference
              << " % of the pixels differ\n";
    return covered > 0.03 ? difference : 1.0;
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  std::vector<vtkSmartPointer<vtkVolume>> Volumes;
  std::vector<std::pair<vtkSmartPointer<vtkVolume>, vtkSmartPointer<vtkActor>>> Actors;
};

constexpr double Enough = 0.01;
constexpr std::array<double, 3> Brown = { 0.8, 0.6, 0.4 };

void Isosurface(Checks& check)
{
  const auto image = NewWaves(40);
  Stage stage;
  vtkVolume* volume = stage.Add(image, 220.0, { 0.0, 1.0, 0.0 });
  stage.Renderer->ResetCamera();
  vtkNew<EventCounter> errors;
  volume->GetMapper()->AddObserver(vtkCommand::ErrorEvent, errors);
  vtkContourValues* isovalues = volume->GetProperty()->GetIsoSurfaceValues();
  isovalues->SetNumberOfContours(0);
  stage.Window->Render();
  isovalues->SetValue(0, 220.0);
  stage.Window->Render();
  isovalues->SetNumberOfContours(0);
  stage.Window->Render();
  check.Equal(errors->Count, 0, "the number of errors with isovalues that come and go");
  isovalues->SetValue(0, 220.0);
  stage.AddSurface(image, 150.0, { 1.0, 1.0, 1.0 }, 0.2);
  stage.AddSurface(image, 190.0, { 0.0, 1.0, 1.0 }, 0.6);
  stage.Renderer->UseDepthPeelingOn();
  stage.Renderer->SetMaximumNumberOfPeels(40);
  stage.Renderer->SetOcclusionRatio(0.0);
  check.That(stage.Compare("TestGPURayCastIsosurface") < Enough, "isosurfaces");
}

/// What cropping leaves, as polygons of boxes of samples.
void AddRegions(vtkImageData* image, int flags, vtkAppendPolyData* append)
{
  constexpr int Planes[4] = { 0, 17, 33, 50 };
  for (int region = 0; region < 27; ++region)
  {
    if ((flags >> region & 1) == 0)
    {
      continue;
    }
    const int index[3] = { region % 3, region / 3 % 3, region / 9 };
    vtkNew<vtkExtractVOI> extract;
    extract->SetInputData(image);
    extract->SetVOI(Planes[index[0]], Planes[index[0] + 1], Planes[index[1]], Planes[index[1] + 1],
      Planes[index[2]], Planes[index[2] + 1]);
    extract->Update();
    const auto contour = NewContour(extract->GetOutput(), 0.0);
    contour->Update();
    append->AddInputData(contour->GetOutput());
  }
}

void Cropping(Checks& check)
{
  const auto image = NewBallOfSamples();
  Stage stage;
  const int flags[2][4] = { { VTK_CROP_SUBVOLUME, VTK_CROP_CROSS, VTK_CROP_INVERTED_CROSS, 24600 },
    { VTK_CROP_FENCE, VTK_CROP_INVERTED_FENCE, 1, 67117057 } };
  for (int row = 0; row < 2; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      vtkVolume* volume = stage.Add(image, 0.0, Brown);
      auto* mapper = vtkVolumeMapper::SafeDownCast(volume->GetMapper());
      mapper->CroppingOn();
      mapper->SetCroppingRegionPlanes(17.0, 33.0, 17.0, 33.0, 17.0, 33.0);
      mapper->SetCroppingRegionFlags(flags[row][column]);
      vtkNew<vtkTransform> transform;
      transform->PostMultiply();
      transform->Translate(-25.0, -25.0, -25.0);
      transform->RotateX(row == 0 ? column * 90 + 20 : 20);
      transform->RotateY(row == 0 ? 20 : column * 90 + 20);
      transform->Translate(column * 55 + 25, row * 55 + 25, 0.0);
      volume->SetUserTransform(transform);
      vtkNew<vtkAppendPolyData> append;
      AddRegions(image, flags[row][column], append);
      stage.Actors.pop_back(); // the whole ball
      stage.AddPolygons(append, Brown);
    }
  }
  stage.Renderer->ResetCamera();
  stage.Renderer->GetActiveCamera()->Zoom(1.5);
  check.That(stage.Compare("TestGPURayCastCropping") < Enough, "cropping");
}

void AddOutline(Stage& stage, vtkImageData* image)
{
  vtkNew<vtkOutlineSource> outline;
  outline->SetBounds(image->GetBounds());
  const double white[3] = { 1.0, 1.0, 1.0 };
  stage.Renderer->AddActor(NewColoredActor(outline, white));
}

vtkSmartPointer<vtkActor> AddSphere(
  Stage& stage, const std::array<double, 3>& center, double radius)
{
  auto actor = NewSphere(radius, center, 40);
  actor->GetProperty()->SetColor(0.9, 0.4, 0.1);
  stage.Renderer->AddActor(actor);
  return actor;
}

void AddPlane(vtkVolume* volume, const double origin[3], const std::array<double, 3>& normal)
{
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(origin[0], origin[1], origin[2]);
  plane->SetNormal(normal[0], normal[1], normal[2]);
  volume->GetMapper()->AddClippingPlane(plane);
}

void ClippingPolyData(Checks& check)
{
  const auto image = NewBallOfSamples();
  Stage stage;
  vtkVolume* volume = stage.Add(image, 0.0, Brown);
  const double center[3] = { 20.0, 20.0, 18.0 };
  AddSphere(stage, { center[0], center[1], center[2] }, 12.0);
  AddOutline(stage, image);
  AddPlane(volume, center, { 1.0, 0.0, 0.0 });
  AddPlane(volume, center, { 0.2, -0.2, 0.0 });
  stage.Renderer->ResetCamera();
  stage.Renderer->GetActiveCamera()->Azimuth(-30.0);
  stage.Renderer->GetActiveCamera()->Elevation(25.0);
  stage.Renderer->GetActiveCamera()->OrthogonalizeViewUp();
  check.That(stage.Compare("TestGPURayCastClippingPolyData") < Enough, "clipping with polygons");
}

void ClippingUserTransform(Checks& check)
{
  const auto image = NewWaves(30);
  Stage stage;
  vtkVolume* volume = stage.Add(image, 150.0, Brown);
  AddOutline(stage, image);
  vtkNew<vtkMatrix4x4> matrix;
  const double rows[16] = { 0, 0, -1, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 1 };
  matrix->DeepCopy(rows);
  volume->SetUserMatrix(matrix);
  const double front[3] = { 0.0, 0.0, -4.0 };
  const double rear[3] = { 0.0, 0.0, 4.0 };
  AddPlane(volume, front, { 0.0, 0.0, 1.0 });
  AddPlane(volume, rear, { 0.0, 0.0, -1.0 });
  vtkCamera* camera = stage.Renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetPosition(0.0, 0.0, -1000.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewUp(0.0, -1.0, 0.0);
  stage.Renderer->ResetCamera();
  check.That(stage.Compare("TestGPURayCastClippingUserTransform") < Enough, "a slab");
}

void CameraInside(Checks& check)
{
  const auto image = NewWaves(30);
  Stage stage;
  vtkVolume* volume = stage.Add(image, 150.0, Brown);
  vtkNew<vtkMatrix4x4> matrix;
  const double rows[16] = { 3.2, 0, 0, 200, 0, 3.2, 0, 100, 0, 0, 1.5, 40, 0, 0, 0, 1 };
  matrix->DeepCopy(rows);
  volume->PokeMatrix(matrix);
  stage.Renderer->ResetCamera();
  vtkCamera* camera = stage.Renderer->GetActiveCamera();
  camera->SetViewAngle(120.0);
  camera->SetPosition(256.0, 168.0, 38.7);
  camera->SetFocalPoint(178.0, 111.0, 52.0);
  camera->SetViewUp(-0.1, 0.9, 0.42);
  stage.Renderer->ResetCameraClippingRange();
  check.That(stage.Compare("TestGPURayCastCameraInsideNonUniformScaleTransform") < Enough,
    "a camera within, an uneven scale");
}

/// The camera among voxels that are tiny, of a volume that is cut.
void CameraInsideClipping(Checks& check)
{
  const auto image = NewWaves(30);
  image->SetSpacing(0.008, 0.008, 0.007);
  Stage stage;
  vtkVolume* volume = stage.Add(image, 150.0, Brown);
  const double origin[3] = { 0.02, 0.0, 0.0 };
  AddPlane(volume, origin, { 0.9, 0.2, -0.3 });
  vtkCamera* camera = stage.Renderer->GetActiveCamera();
  camera->SetViewAngle(100.0);
  camera->SetPosition(0.11, 0.0, 0.02);
  camera->SetFocalPoint(0.0, 0.03, 0.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  stage.Renderer->ResetCameraClippingRange();
  check.That(stage.Compare("TestGPURayCastCameraInsideClipping, ...SmallSpacing") < Enough,
    "a camera among tiny voxels");
}

void LightKit(Checks& check)
{
  Stage stage;
  stage.Add(NewBallOfSamples(), 0.0, Brown);
  vtkNew<vtkLightKit> kit;
  kit->AddLightsToRenderer(stage.Renderer);
  stage.Renderer->ResetCamera();
  check.That(stage.Compare("TestGPURayCastLightKit") < Enough, "a kit of lights");
}

struct Pick
{
  bool IsPicked;
  std::array<double, 3> Position;
  std::array<double, 3> Normal;
};

std::vector<Pick> PickAll(Stage& stage, vtkCellPicker* picker)
{
  std::vector<Pick> picks;
  for (int y = 4; y < 180; y += 9)
  {
    for (int x = 4; x < 240; x += 9)
    {
      Pick pick;
      // The middle of a pixel: of whole numbers, vtkCellPicker takes the corner.
      pick.IsPicked = picker->Pick(x + 0.5, y + 0.5, 0.0, stage.Renderer) != 0;
      picker->GetPickPosition(pick.Position.data());
      picker->GetPickNormal(pick.Normal.data());
      picks.push_back(pick);
    }
  }
  return picks;
}

/// A volume that is cropped and clipped, picked where VTK picks its polygons.
void VolumePicker(Checks& check)
{
  const auto image = NewBallOfSamples();
  Stage stage;
  vtkVolume* volume = stage.Add(image, 0.0, Brown);
  auto* mapper = vtkVolumeMapper::SafeDownCast(volume->GetMapper());
  mapper->CroppingOn();
  mapper->SetCroppingRegionPlanes(17.0, 33.0, 17.0, 33.0, 17.0, 33.0);
  mapper->SetCroppingRegionFlags(VTK_CROP_FENCE);
  vtkNew<vtkAppendPolyData> append;
  AddRegions(image, VTK_CROP_FENCE, append);
  stage.Actors.pop_back(); // the whole ball
  stage.AddPolygons(append, Brown);
  const double origin[3] = { 25.0, 25.0, 40.0 };
  AddPlane(volume, origin, { 0.2, 0.0, -1.0 });
  volume->RotateX(20.0);
  stage.Renderer->ResetCamera();
  stage.Renderer->GetActiveCamera()->Azimuth(20.0);
  stage.Renderer->GetActiveCamera()->Zoom(1.8);
  stage.Window->Render();
  vtkNew<vtkIsosurfacePicker> isosurfacePicker;
  const std::vector<Pick> traced = PickAll(stage, isosurfacePicker);
  check.That(stage.Compare("VolumePicker, VolumePickerCrop") < Enough, "what is picked");
  vtkNew<vtkCellPicker> cellPicker;
  cellPicker->SetTolerance(0.0);
  const std::vector<Pick> polygons = PickAll(stage, cellPicker);
  int picked = 0;
  int different = 0;
  for (std::size_t i = 0; i < traced.size(); ++i)
  {
    const bool isSame = traced[i].IsPicked == polygons[i].IsPicked &&
      (!traced[i].IsPicked ||
        (vtkMath::Distance2BetweenPoints(traced[i].Position.data(), polygons[i].Position.data()) <
            0.01 &&
          vtkMath::Dot(traced[i].Normal.data(), polygons[i].Normal.data()) > 0.99));
    picked += traced[i].IsPicked ? 1 : 0;
    different += isSame ? 0 : 1;
  }
  std::cout << "VolumePicker: " << picked << " picks, " << different << " unlike polygons\n";
  check.That(picked > 100 && different <= picked / 50, "picks are those of polygons");
}

void OrientedVolume(Checks& check)
{
  const auto image = NewWaves(20);
  vtkNew<vtkTransform> turn;
  turn->RotateZ(20.0);
  vtkNew<vtkMatrix3x3> directions;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      directions->SetElement(row, column, turn->GetMatrix()->GetElement(row, column));
    }
  }
  image->SetOrigin(200.0, 100.0, 40.0);
  image->SetSpacing(3.2, 3.2, 1.5);
  image->SetDirectionMatrix(directions);
  Stage stage;
  stage.Add(image, 150.0, Brown);
  stage.Renderer->ResetCamera();
  stage.Renderer->GetActiveCamera()->Zoom(1.6);
  check.That(stage.Compare("TestGPURayCastOrientedVolume") < Enough, "turned axes");
}

void PositionalLights(Checks& check)
{
  const auto image = NewBallOfSamples();
  Stage stage;
  stage.Add(image, 0.0, { 1.0, 1.0, 1.0 })->SetPosition(-30.0, 0.0, 0.0);
  AddSphere(stage, { 55.0, 25.0, 25.0 }, 20.0);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->PositionalOn();
  light->SetDiffuseColor(1.0, 0.0, 0.0);
  light->SetConeAngle(60.0);
  light->SetPosition(0.0, 0.0, 100.0);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  stage.Renderer->AutomaticLightCreationOff();
  stage.Renderer->AddLight(light);
  stage.Renderer->ResetCamera();
  check.That(stage.Compare("TestGPURayCastPositionalLights") < Enough, "a positional lamp");
}

void ModelTransform(Checks& check)
{
  const auto image = NewWaves(10);
  Stage stage;
  auto* mapper = vtkVolumeMapper::SafeDownCast(stage.Add(image, 150.0, Brown)->GetMapper());
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectScalarArray("RTData");
  vtkNew<vtkTransform> transform;
  transform->RotateY(60.0);
  stage.Renderer->GetActiveCamera()->SetModelTransformMatrix(transform->GetMatrix());
  stage.Window->Render();
  stage.Renderer->ResetCamera();
  check.That(stage.Compare("TestGPURayCastModelTransformMatrix") < Enough, "a model transform");
}

/// Spheres, of which the volume shows through, in and before it; with and without peeling volumes.
void DepthPeeling(Checks& check)
{
  const auto image = NewBallOfSamples();
  for (const double opacity : { 0.0, 0.4, 1.0 })
  {
    for (const bool peelsVolumes : { false, true })
    {
      Stage stage;
      stage.Add(image, 0.0, Brown);
      AddOutline(stage, image);
      AddSphere(stage, { 25.0, 25.0, 25.0 }, opacity < 1.0 ? 21.0 : 18.0)
        ->GetProperty()
        ->SetOpacity(opacity);
      AddSphere(stage, { 40.0, 40.0, 40.0 }, 17.0)->GetProperty()->SetOpacity(opacity);
      stage.Renderer->UseDepthPeelingOn();
      stage.Renderer->SetOcclusionRatio(0.0);
      stage.Renderer->SetMaximumNumberOfPeels(17);
      stage.Renderer->SetUseDepthPeelingForVolumes(peelsVolumes);
      stage.Renderer->ResetCamera();
      stage.Renderer->GetActiveCamera()->Azimuth(20.0);
      stage.Renderer->GetActiveCamera()->Zoom(1.5);
      check.That(stage.Compare("TestGPURayCastDepthPeelingTransparentPolyData") < Enough,
        "polygons that are peeled");
    }
  }
}

}

int TestIsosurfaceScenesOfVtk(int, char*[])
{
  Checks check;
  Isosurface(check);
  Cropping(check);
  ClippingPolyData(check);
  ClippingUserTransform(check);
  CameraInside(check);
  CameraInsideClipping(check);
  LightKit(check);
  VolumePicker(check);
  OrientedVolume(check);
  PositionalLights(check);
  ModelTransform(check);
  DepthPeeling(check);
  return check.Result();
}
