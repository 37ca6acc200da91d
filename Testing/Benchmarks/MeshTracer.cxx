// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "MeshTracer.h"

#include "Mesh/MeshField.h"
#include "Picture/PixelBlockRenderer.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkRenderer.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

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
  view.Shapes = grid->GetCellTypesArray()->GetPointer(0);
  view.Offsets = cells->GetOffsetsArray()->GetVoidPointer(0);
  view.Connectivity = cells->GetConnectivityArray()->GetVoidPointer(0);
  view.IdType = cells->IsStorage64Bit() ? vtkirt::ScalarType::Int64 : vtkirt::ScalarType::Int32;
  const std::string problem =
    vtkirt::FindProblem(view, cells->GetConnectivityArray()->GetNumberOfValues(), 1);
  if (!problem.empty())
  {
    throw std::runtime_error(problem);
  }
}

/// Calls visit(renderer or packet of the thread, tile) for all tiles, on so many threads.
template <typename MakeState, typename Visit>
void ForEachTile(
  const vtkirt::Scene& scene, int threads, const MakeState& makeState, const Visit& visit)
{
  const int columns = (scene.Pixels.Width + scene.TileWidth - 1) / scene.TileWidth;
  const int rows = (scene.Pixels.Height + scene.TileHeight - 1) / scene.TileHeight;
#pragma omp parallel num_threads(threads)
  {
    auto state = makeState();
#pragma omp for schedule(dynamic)
    for (int tile = 0; tile < columns * rows; ++tile)
    {
      const int x = tile % columns * scene.TileWidth;
      const int y = tile / columns * scene.TileHeight;
      visit(*state,
        vtkirt::PixelRectangle{ x, y, std::min(scene.TileWidth, scene.Pixels.Width - x),
          std::min(scene.TileHeight, scene.Pixels.Height - y) });
    }
  }
}

void MakeRaysOfTile(
  const vtkirt::Scene& scene, const vtkirt::PixelRectangle& tile, vtkirt::RayPacket& packet)
{
  const vtkirt::PixelRectangle pixels = { scene.Pixels.X + tile.X, scene.Pixels.Y + tile.Y,
    tile.Width, tile.Height };
  scene.Fields.front().Field->MakeRays(scene.Fields.front().View, pixels, {}, packet);
}

}

//------------------------------------------------------------------------------
MeshTracer::MeshTracer(vtkPointSet* grid, vtkDataArray* values, int threads)
  : Points(MakeReal(grid->GetPoints()->GetData()))
  , Values(MakeReal(values))
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
  this->Field = std::make_unique<vtkirt::MeshField>(view, threads);
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
  scene.Pixels = { pixels.X, pixels.Y, pixels.Width, pixels.Height };
  return scene;
}

//------------------------------------------------------------------------------
void MeshTracer::Trace(const vtkirt::Scene& scene, int threads)
{
  // Neither is used by tracing.
  const std::vector<vtkirt::Shader> shaders;
  vtkirt::Frame frame;
  ForEachTile(
    scene, threads,
    [&]() { return std::make_unique<vtkirt::PixelBlockRenderer>(scene, shaders, frame); },
    [](vtkirt::PixelBlockRenderer& renderer, const vtkirt::PixelRectangle& tile)
    { renderer.Trace(tile); });
}

//------------------------------------------------------------------------------
void MeshTracer::MakeRays(const vtkirt::Scene& scene, int threads)
{
  ForEachTile(
    scene, threads, []() { return std::make_unique<vtkirt::RayPacket>(); },
    [&scene](vtkirt::RayPacket& packet, const vtkirt::PixelRectangle& tile)
    { MakeRaysOfTile(scene, tile, packet); });
}

//------------------------------------------------------------------------------
std::vector<float> MeshTracer::FindDepths(const vtkirt::Scene& scene, const PictureRays& rays) const
{
  std::vector<float> depths(
    static_cast<std::size_t>(scene.Pixels.Width) * static_cast<std::size_t>(scene.Pixels.Height),
    std::numeric_limits<float>::infinity());
  vtkirt::RayHits hits;
  ForEachTile(
    scene, 1, []() { return std::make_unique<vtkirt::RayPacket>(); },
    [&](vtkirt::RayPacket& packet, const vtkirt::PixelRectangle& tile)
    {
      MakeRaysOfTile(scene, tile, packet);
      this->Field->Trace(packet, hits);
      for (std::size_t ray = 0; ray + 1 < hits.First.size(); ++ray)
      {
        if (hits.First[ray] < hits.First[ray + 1])
        {
          const vtkirt::Vector3 point = this->Field->GetPoint(hits.Hits[hits.First[ray]]);
          Triple fromEye;
          vtkMath::Subtract(point.data(), rays.GetOrigin().data(), fromEye.data());
          const int x = tile.X + static_cast<int>(ray) % tile.Width;
          const int y = tile.Y + static_cast<int>(ray) / tile.Width;
          depths[static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.Pixels.Width) +
            static_cast<std::size_t>(x)] =
            static_cast<float>(vtkMath::Dot(fromEye.data(), rays.GetForward().data()));
        }
      }
    });
  return depths;
}

//------------------------------------------------------------------------------
double MeshTracer::GetMemory() const
{
  return static_cast<double>(this->Field->GetStatistics().HierarchyMemory);
}

}
