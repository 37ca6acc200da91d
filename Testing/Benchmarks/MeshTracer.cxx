// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "MeshTracer.h"

#include "CloudReference.h"
#include "Mesh/MeshCells.h"
#include "Mesh/MeshField.h"
#include "Picture/RenderTiles.h"
#include "Samples.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkIsosurfaceRayTraceMeshMapper.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkRenderer.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVersionMacros.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace Benchmark
{
namespace
{

namespace vtkirt = vtkIsosurfaceRayTracing;

/// The array, or a copy of it, in a type that the field reads.
vtkSmartPointer<vtkDataArray> MakeReal(vtkDataArray* array)
{
  if (array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE)
  {
    return array;
  }
  auto copy = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(VTK_DOUBLE));
  copy->DeepCopy(array);
  return copy;
}

vtkirt::ScalarType GetRealType(vtkDataArray* array)
{
  return array->GetDataType() == VTK_FLOAT ? vtkirt::ScalarType::Float32
                                           : vtkirt::ScalarType::Float64;
}

void SetCells(vtkUnstructuredGrid* grid, vtkirt::MeshView& view)
{
  vtkCellArray* cells = grid->GetCells();
  view.NumberOfCells = grid->GetNumberOfCells();
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  vtkDataArray* types = grid->GetCellTypes();
#else
  vtkDataArray* types = grid->GetCellTypesArray();
#endif
  view.Shapes = static_cast<const unsigned char*>(types->GetVoidPointer(0));
  vtkDataArray* connectivity = cells->GetConnectivityArray();
  view.Offsets = cells->GetOffsetsArray()->GetVoidPointer(0);
  view.Connectivity = connectivity->GetVoidPointer(0);
  // IsStorage64Bit is false for the cells of one size that VTK 9.6 has.
  view.IdType =
    connectivity->GetDataTypeSize() == 8 ? vtkirt::ScalarType::Int64 : vtkirt::ScalarType::Int32;
  const std::string problem = vtkirt::FindProblem(view, connectivity->GetNumberOfValues(), 1);
  if (!problem.empty())
  {
    throw std::runtime_error(problem);
  }
}

}

//------------------------------------------------------------------------------
MeshTracer::MeshTracer(vtkPointSet* grid, vtkDataArray* values, int threads)
  : Points(MakeReal(grid->GetPoints()->GetData()))
  , Values(MakeReal(values))
  , Picture(std::make_unique<vtkirt::Frame>())
{
  vtkirt::MeshView view;
  view.Points = this->Points->GetVoidPointer(0);
  view.PointType = GetRealType(this->Points);
  view.NumberOfPoints = grid->GetNumberOfPoints();
  view.Values = this->Values->GetVoidPointer(0);
  view.ValueType = GetRealType(this->Values);
  view.ValueStride = this->Values->GetNumberOfComponents();
  if (auto* structured = vtkStructuredGrid::SafeDownCast(grid))
  {
    structured->GetDimensions(view.Dimensions.data());
  }
  else
  {
    SetCells(vtkUnstructuredGrid::SafeDownCast(grid), view);
  }
  this->Cells = std::make_unique<vtkirt::MeshCells>(view, threads);
  this->Field = std::make_unique<vtkirt::MeshField>(*this->Cells, threads);
}

//------------------------------------------------------------------------------
MeshTracer::~MeshTracer() = default;

//------------------------------------------------------------------------------
void MeshTracer::Select(double isovalue)
{
  vtkirt::TraceRequest request(std::vector<vtkirt::Isosurface>{ { isovalue, 1.0 } });
  request.Normals = vtkirt::NormalMode::InterpolantGradient;
  this->Field->Select(request, {});
}

//------------------------------------------------------------------------------
vtkirt::Scene MeshTracer::MakeScene(const View& view, const PictureRays& rays, int size) const
{
  const vtkirt::Bounds box = this->Field->GetBounds();
  const Bounds bounds = { box.Lower[0], box.Upper[0], box.Lower[1], box.Upper[1], box.Lower[2],
    box.Upper[2] };
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkCamera> camera;
  renderer->SetActiveCamera(camera);
  view.Apply(camera);
  renderer->ResetCameraClippingRange(bounds.data());
  vtkirt::Matrix4 clipFromWorld;
  vtkirt::Matrix4 worldFromClip;
  const vtkirt::Matrix4 identity = { 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0,
    0.0, 0.0, 0.0, 1.0 };
  std::copy_n(camera->GetCompositeProjectionTransformMatrix(1.0, -1.0, 1.0)->GetData(), 16,
    clipFromWorld.data());
  vtkMatrix4x4::Invert(clipFromWorld.data(), worldFromClip.data());
  const PixelRectangle pixels = rays.GetPixels(bounds);
  vtkirt::Scene scene;
  scene.Fields.resize(1);
  scene.Fields.front().Field = this->Field.get();
  scene.Fields.front().View = { clipFromWorld, worldFromClip, identity, 1.0 * size, 1.0 * size };
  scene.Fields.front().Colors = { { 1.0, 1.0, 1.0 } };
  scene.Pixels = { pixels.X, pixels.Y, pixels.Width, pixels.Height };
  vtkNew<vtkIsosurfaceRayTraceMeshMapper> mapper;
  scene.TileWidth = mapper->GetTileSize()[0];
  scene.TileHeight = mapper->GetTileSize()[1];
  return scene;
}

//------------------------------------------------------------------------------
vtkirt::Scene MeshTracer::MakeCloudScene(
  const View& view, const PictureRays& rays, int size, const vtkirt::CloudMedium& medium) const
{
  vtkirt::TraceRequest request;
  request.HasCloud = true;
  this->Field->Select(request, {});
  vtkirt::Scene scene = this->MakeScene(view, rays, size);
  scene.Fields.front().Cloud = &medium;
  scene.Fields.front().Colors.clear();
  scene.TileWidth = vtkirt::CloudTile::Edge;
  scene.TileHeight = vtkirt::CloudTile::Edge;
  return scene;
}

//------------------------------------------------------------------------------
std::vector<std::array<std::array<double, 4>, 4>> MeshTracer::Subdivide() const
{
  return vtkirt::Subdivide(*this->Cells);
}

//------------------------------------------------------------------------------
double MeshTracer::Trace(const vtkirt::Scene& scene, int threads)
{
  vtkirt::Execution execution;
  execution.Threads = threads;
  vtkirt::FrameTimes times;
  const auto draw = [&]()
  { vtkirt::RenderTiles(scene, execution, *this->Picture, times, [](double) { return true; }); };
  const double seconds = MeasureOn(threads, draw);
  return seconds * times.Trace / (times.Trace + times.Shade);
}

//------------------------------------------------------------------------------
double MeshTracer::MakeRays(const vtkirt::Scene& scene, int threads)
{
  constexpr int width = 16;
  constexpr int height = vtkirt::RayPacket::Capacity / width;
  const vtkirt::PixelRectangle& pixels = scene.Pixels;
  const vtkirt::SceneField& field = scene.Fields.front();
  const int columns = (pixels.Width + width - 1) / width;
  const int rows = (pixels.Height + height - 1) / height;
  return MeasureOn(threads,
    [&]()
    {
#pragma omp parallel num_threads(threads)
      {
        const auto packet = std::make_unique<vtkirt::RayPacket>();
#pragma omp for schedule(dynamic)
        for (int i = 0; i < columns * rows; ++i)
        {
          const int x = i % columns * width;
          const int y = i / columns * height;
          const vtkirt::PixelRectangle block = { pixels.X + x, pixels.Y + y,
            std::min(width, pixels.Width - x), std::min(height, pixels.Height - y) };
          field.Field->MakeRays(field.View, block, {}, *packet);
        }
      }
    });
}

//------------------------------------------------------------------------------
std::vector<float> MeshTracer::FindDepths(vtkirt::Scene scene, const PictureRays& rays) const
{
  scene.KeepHits = true;
  vtkirt::Frame frame;
  vtkirt::FrameTimes times;
  vtkirt::RenderTiles(scene, {}, frame, times, [](double) { return true; });
  std::vector<float> depths;
  for (const vtkirt::Hit& hit : frame.Hits)
  {
    float depth = std::numeric_limits<float>::infinity();
    if (hit.Surface != vtkirt::Hit::NoSurface)
    {
      Triple fromEye;
      vtkMath::Subtract(this->Field->GetPoint(hit).data(), rays.GetOrigin().data(), fromEye.data());
      depth = static_cast<float>(vtkMath::Dot(fromEye.data(), rays.GetForward().data()));
    }
    depths.push_back(depth);
  }
  return depths;
}

//------------------------------------------------------------------------------
double MeshTracer::GetMemory() const
{
  const auto statistics = this->Field->GetStatistics();
  return static_cast<double>(statistics.HierarchyMemory + statistics.CacheMemory);
}

}
