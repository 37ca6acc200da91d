// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Pictures.h"

#include "Png.h"
#include "ReadData.h"
#include "vtkIsosurfaceRayTraceMapper.h"
#include "vtkIsosurfaceRayTraceMeshMapper.h"

#include <vtkAbstractVolumeMapper.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkContourGrid.h>
#include <vtkContourValues.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>
#include <vtkTextProperty.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace Compare
{
namespace
{

constexpr int Pixels = 512;
constexpr std::array<double, 3> Bone = { 0.96, 0.90, 0.80 };

/// Renders props with a camera.
class Studio
{
public:
  explicit Studio(vtkCamera* camera)
  {
    vtkNew<vtkCamera> copy; // The renderer moves the clipping planes.
    copy->DeepCopy(camera);
    this->Renderer->SetActiveCamera(copy);
    this->Renderer->SetBackground(0.16, 0.18, 0.22);
    this->Window->SetOffScreenRendering(true);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Pixels, Pixels);
    this->Window->AddRenderer(this->Renderer);
  }

  std::string Draw(vtkProp* prop)
  {
    this->Renderer->AddViewProp(prop);
    this->Renderer->ResetCameraClippingRange();
    return EncodePng(this->Window);
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

//------------------------------------------------------------------------------
template <typename Filter>
void Extract(Filter* filter, vtkDataSet* data, double isovalue, vtkPolyDataMapper* mapper)
{
  filter->SetInputData(data);
  filter->SetValue(0, isovalue);
  filter->ComputeScalarsOff();
  mapper->SetInputConnection(filter->GetOutputPort());
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAbstractVolumeMapper> NewMapper(vtkDataSet* data)
{
  if (vtkImageData::SafeDownCast(data))
  {
    return vtkSmartPointer<vtkIsosurfaceRayTraceMapper>::New();
  }
  return vtkSmartPointer<vtkIsosurfaceRayTraceMeshMapper>::New();
}

}

//------------------------------------------------------------------------------
std::string GetExtractionName(vtkDataSet* data)
{
  return vtkImageData::SafeDownCast(data) ? "vtkFlyingEdges3D" : "vtkContourGrid";
}

//------------------------------------------------------------------------------
std::string DrawTriangles(vtkDataSet* data, double isovalue, vtkCamera* camera)
{
  vtkNew<vtkPolyDataMapper> mapper;
  if (auto* mesh = vtkPointSet::SafeDownCast(data))
  {
    Extract(vtkNew<vtkContourGrid>().Get(), MakeUnstructured(mesh), isovalue, mapper);
  }
  else
  {
    Extract(vtkNew<vtkFlyingEdges3D>().Get(), data, isovalue, mapper);
  }
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(Bone[0], Bone[1], Bone[2]);
  return Studio(camera).Draw(actor);
}

//------------------------------------------------------------------------------
std::string DrawRayTraced(vtkDataSet* data, double isovalue, vtkCamera* camera)
{
  const vtkSmartPointer<vtkAbstractVolumeMapper> mapper = NewMapper(data);
  mapper->SetInputDataObject(data);
  vtkNew<vtkVolume> prop;
  prop->SetMapper(mapper);
  vtkVolumeProperty* surface = prop->GetProperty();
  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(isovalue, Bone[0], Bone[1], Bone[2]);
  vtkNew<vtkPiecewiseFunction> opaque;
  opaque->AddPoint(isovalue, 1.0);
  surface->GetIsoSurfaceValues()->SetValue(0, isovalue);
  surface->SetColor(color);
  surface->SetScalarOpacity(opaque);
  surface->ShadeOn();
  // The defaults of vtkProperty.
  surface->SetAmbient(0.0);
  surface->SetDiffuse(1.0);
  surface->SetSpecular(0.0);
  return Studio(camera).Draw(prop);
}

//------------------------------------------------------------------------------
std::string DrawErrors(vtkPolyData* mesh, vtkIdType vertices, vtkCamera* camera)
{
  // Interpolated over a triangle, the colours of its vertices would hide that of its centroid.
  vtkNew<vtkDoubleArray> distances;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfPolys(); ++cell)
  {
    distances->InsertNextValue(
      mesh->GetPointData()->GetScalars()->GetComponent(vertices + cell / 3, 0));
  }
  vtkNew<vtkPolyData> coloured;
  coloured->CopyStructure(mesh);
  coloured->GetCellData()->SetScalars(distances);
  // Darker and redder with distance.
  vtkNew<vtkColorTransferFunction> ramp;
  ramp->AddRGBPoint(0.0, 1.0, 1.0, 1.0);
  ramp->AddRGBPoint(1.0, 1.0, 0.85, 0.45);
  ramp->AddRGBPoint(2.0, 0.9, 0.35, 0.1);
  ramp->AddRGBPoint(3.0, 0.45, 0.0, 0.15);
  vtkNew<vtkLookupTable> colors; // The scalar bar knows no other logarithms.
  colors->SetScaleToLog10();
  colors->SetTableRange(1e-3, 1.0);
  constexpr int shades = 256;
  colors->SetNumberOfTableValues(shades);
  for (int i = 0; i < shades; ++i)
  {
    const double* color = ramp->GetColor(3.0 * i / (shades - 1));
    colors->SetTableValue(i, color[0], color[1], color[2]);
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(coloured);
  mapper->SetLookupTable(colors);
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colors);
  bar->SetTitle("cells");
  bar->SetNumberOfLabels(4);
  bar->UnconstrainedFontSizeOn();
  bar->GetLabelTextProperty()->SetFontSize(12);
  bar->GetTitleTextProperty()->SetFontSize(13);
  bar->SetPosition(0.02, 0.05);
  bar->SetWidth(0.12);
  bar->SetHeight(0.4);
  Studio studio(camera);
  studio.Renderer->AddViewProp(bar);
  return studio.Draw(actor);
}

//------------------------------------------------------------------------------
std::string DrawDifference(vtkImageData* difference, double unit)
{
  vtkDataArray* depths = difference->GetPointData()->GetArray("DepthDifference");
  vtkDataArray* coverage = difference->GetPointData()->GetArray("Coverage");
  vtkNew<vtkImageData> picture;
  picture->SetDimensions(difference->GetDimensions());
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  vtkDataArray* colors = picture->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    const int covered = static_cast<int>(coverage->GetComponent(i, 0));
    if (covered == 1)
    {
      // The square root shows small differences too.
      const double share = std::min(std::abs(depths->GetComponent(i, 0)) / unit, 1.0);
      const double strength = std::sqrt(share);
      const double faded = 140.0 * (1.0 - strength);
      const double strong = 140.0 + 115.0 * strength;
      const bool isBehind = depths->GetComponent(i, 0) > 0.0;
      colors->SetTuple3(i, isBehind ? strong : faded, faded, isBehind ? faded : strong);
    }
    else if (covered == 0)
    {
      colors->SetTuple3(i, 41.0, 46.0, 56.0);
    }
    else
    {
      colors->SetTuple3(i, 255.0, 220.0, 0.0);
    }
  }
  return EncodePng(picture);
}

//------------------------------------------------------------------------------
std::string GetOpenGLRenderer()
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(true);
  window->Render();
  std::istringstream capabilities(window->ReportCapabilities());
  const std::string label = "OpenGL renderer string:";
  std::string line;
  while (std::getline(capabilities, line))
  {
    if (line.find(label) == 0)
    {
      return line.substr(std::min(line.size(), label.size() + 2));
    }
  }
  return "unknown";
}

}
