// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceOutput.h"

#include "vtkIsosurfaceRayTraceHits.h"
#include "vtkIsosurfaceRayTraceInput.h"
#include "vtkIsosurfaceRayTracePicture.h"
#include "vtkIsosurfaceRayTraceRequest.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkGenericCell.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Description = vtkIsosurfaceRayTraceHits::Description;

/// Adds an array with a tuple for every point.
void AddArray(
  vtkDataArray* array, const char* name, int components, vtkIdType tuples, vtkDataSet* output)
{
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  output->GetPointData()->AddArray(array);
}

/// The output of CastRays.
class HitArrays
{
public:
  HitArrays(vtkIdType count, vtkPolyData* output)
  {
    this->Points->SetDataTypeToDouble();
    this->Points->SetNumberOfPoints(count);
    AddArray(this->RayIds, "RayId", 1, count, output);
    AddArray(this->Ts, "T", 1, count, output);
    AddArray(this->CellIds, "CellId", 1, count, output);
    AddArray(this->Parametric, "ParametricCoordinates", 3, count, output);
    AddArray(this->Isovalues, "Isovalue", 1, count, output);
    AddArray(this->Normals, "Normals", 3, count, output);
    output->GetPointData()->SetActiveNormals("Normals");
    output->SetPoints(this->Points);
  }

  void SetRay(vtkIdType row, std::size_t ray)
  {
    this->RayIds->SetValue(row, static_cast<vtkIdType>(ray));
  }
  void Set(vtkIdType row, double t, const Description& hit)
  {
    this->Points->SetPoint(row, hit.Position.data());
    this->Ts->SetValue(row, t);
    this->CellIds->SetValue(row, hit.CellId);
    this->Parametric->SetTypedTuple(row, hit.Parametric.data());
    this->Isovalues->SetValue(row, hit.Value);
    this->Normals->SetTypedTuple(row, hit.Normal.data());
  }

private:
  vtkNew<vtkPoints> Points;
  vtkNew<vtkIdTypeArray> RayIds;
  vtkNew<vtkDoubleArray> Ts;
  vtkNew<vtkIdTypeArray> CellIds;
  vtkNew<vtkDoubleArray> Parametric;
  vtkNew<vtkDoubleArray> Isovalues;
  vtkNew<vtkDoubleArray> Normals;
};

/// The output of RenderToImage; initially that of a picture without hits.
class PixelArrays
{
public:
  PixelArrays(vtkIdType count, bool isProjection, vtkDataSet* output)
  {
    const auto add = [count, output](
                       vtkDataArray* array, const char* name, int components, double none)
    {
      AddArray(array, name, components, count, output);
      array->Fill(none);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    add(this->Colors, "Colors", 4, 0.0);
    add(this->Depths, "Depth", 1, 1.0);
    add(this->Normals, "Normals", 3, nan);
    add(this->Positions, "Position", 3, nan);
    add(this->CellIds, "CellId", 1, -1.0);
    if (isProjection)
    {
      add(this->Values, "Value", 1, nan);
    }
    else
    {
      add(this->IsovalueIds, "IsovalueId", 1, -1.0);
    }
    output->GetPointData()->SetActiveScalars("Colors");
  }

  void SetColors(vtkIdType first, const unsigned char* colors, std::size_t count)
  {
    std::copy_n(colors, 4 * count, this->Colors->GetPointer(4 * first));
  }
  void Set(vtkIdType pixel, float depth, const Description& hit)
  {
    this->Depths->SetValue(pixel, depth);
    this->Normals->SetTypedTuple(pixel, hit.Normal.data());
    this->Positions->SetTypedTuple(pixel, hit.Position.data());
    this->CellIds->SetValue(pixel, hit.CellId);
  }
  void SetValue(vtkIdType pixel, double value) { this->Values->SetValue(pixel, value); }
  void SetIsovalueId(vtkIdType pixel, int id) { this->IsovalueIds->SetValue(pixel, id); }

private:
  vtkNew<vtkUnsignedCharArray> Colors;
  vtkNew<vtkFloatArray> Depths;
  vtkNew<vtkDoubleArray> Normals;
  vtkNew<vtkDoubleArray> Positions;
  vtkNew<vtkIdTypeArray> CellIds;
  vtkNew<vtkIntArray> IsovalueIds;
  vtkNew<vtkDoubleArray> Values;
};

/// The output of RenderToFragments.
class FragmentColumns
{
public:
  FragmentColumns(vtkIdType count, bool haveValues, vtkTable* output)
  {
    const auto add = [count, output](vtkDataArray* column, const char* name, int components)
    {
      column->SetName(name);
      column->SetNumberOfComponents(components);
      column->SetNumberOfTuples(count);
      output->AddColumn(column);
    };
    add(this->Pixels, "Pixel", 1);
    add(this->Ts, "T", 1);
    add(this->Colors, "Color", 3);
    add(this->Opacities, "Opacity", 1);
    add(this->Depths, "Depth", 1);
    if (haveValues)
    {
      add(this->Values, "Value", 1);
    }
  }

  void Set(vtkIdType row, vtkIdType pixel, const vtkirt::Fragment& fragment)
  {
    this->Pixels->SetValue(row, pixel);
    this->Ts->SetValue(row, fragment.T);
    this->Colors->SetTypedTuple(row, fragment.Color.data());
    this->Opacities->SetValue(row, fragment.Opacity);
    this->Depths->SetValue(row, fragment.Opacity >= 1.0 ? std::min(fragment.Depth, 1.0F) : 1.0F);
  }
  void SetValue(vtkIdType row, double value, float depth)
  {
    this->Values->SetValue(row, value);
    this->Depths->SetValue(row, depth);
  }

private:
  vtkNew<vtkIdTypeArray> Pixels;
  vtkNew<vtkDoubleArray> Ts;
  vtkNew<vtkDoubleArray> Colors;
  vtkNew<vtkDoubleArray> Opacities;
  vtkNew<vtkFloatArray> Depths;
  vtkNew<vtkDoubleArray> Values;
};

/// The depth of a value of a projection, which has none in a window.
float GetDepthOfValue(const vtkIsosurfaceRayTracePicture& picture, const vtkirt::Hit& hit)
{
  return std::clamp(picture.GetDepth(hit), 0.0F, 1.0F);
}

/// Calls visit(to, from, count) for each row of the pixels that were rendered, with the number of
/// its first in a picture of a width and in that of the scene, and how many they are.
template <typename Visit>
void ForEachRow(
  const vtkIsosurfaceRayTracePicture& picture, int width, int threads, const Visit& visit)
{
  const vtkirt::PixelRectangle& pixels = picture.Scene.Pixels;
  const auto count = static_cast<std::size_t>(pixels.Width);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (int y = 0; y < pixels.Height; ++y)
  {
    visit(pixels.X + static_cast<vtkIdType>(pixels.Y + y) * width,
      static_cast<std::size_t>(y) * count, count);
  }
}

}

namespace vtkIsosurfaceRayTraceOutput
{

//------------------------------------------------------------------------------
void WriteHits(
  const vtkIsosurfaceRayTraceRequest& request, const vtkirt::RayHits& hits, vtkPolyData* output)
{
  const vtkIsosurfaceRayTraceHits traced(request);
  HitArrays arrays(static_cast<vtkIdType>(hits.Hits.size()), output);
  for (std::size_t ray = 0; ray + 1 < hits.First.size(); ++ray)
  {
    for (std::size_t i = hits.First[ray]; i < hits.First[ray + 1]; ++i)
    {
      arrays.SetRay(static_cast<vtkIdType>(i), ray);
    }
  }
  vtkIsosurfaceRayTraceHits::ForEachShare(hits.Hits.size(), request.Execution.Threads,
    [&](std::size_t begin, std::size_t count)
    {
      vtkNew<vtkGenericCell> any;
      traced.DescribeEach(&hits.Hits[begin], count,
        [&](std::size_t i, Description& described)
        {
          const vtkirt::Hit& hit = hits.Hits[begin + i];
          traced.MoveToWholeCell(hit, any, described.Parametric);
          arrays.Set(static_cast<vtkIdType>(begin + i), hit.T, described);
        });
    });
}

//------------------------------------------------------------------------------
void WriteImage(const vtkIsosurfaceRayTraceRequest& request,
  const vtkIsosurfaceRayTracePicture& picture, int width, int height, vtkImageData* output)
{
  const bool isProjection = request.IsProjection();
  const vtkIsosurfaceRayTraceHits traced(request);
  output->Initialize();
  output->SetDimensions(width, height, 1);
  PixelArrays arrays(output->GetNumberOfPoints(), isProjection, output);
  ForEachRow(picture, width, request.Execution.Threads,
    [&](vtkIdType to, std::size_t from, std::size_t count)
    {
      // A cloud, or the mean of several frames, has a colour where the first frame has no hit.
      arrays.SetColors(to, &picture.Frame.Colors[4 * from], count);
      const vtkirt::Hit* const hits = &picture.Frame.Hits[from];
      traced.DescribeEach(hits, count,
        [&](std::size_t i, const Description& hit)
        {
          const vtkIdType pixel = to + static_cast<vtkIdType>(i);
          // A projection hides nothing in a window, and so has no depth there; but each value has a
          // position.
          const float depth = isProjection ? GetDepthOfValue(picture, hits[i])
                                           : std::min(picture.Frame.Depths[from + i], 1.0F);
          arrays.Set(pixel, depth, hit);
          if (isProjection)
          {
            arrays.SetValue(pixel, hit.Value);
          }
          else
          {
            arrays.SetIsovalueId(pixel, request.GetVolume(hits[i]).FindIsovalue(hit.Value));
          }
        });
    });
}

//------------------------------------------------------------------------------
void WriteColors(
  const vtkIsosurfaceRayTracePicture& picture, int width, int height, vtkImageData* output)
{
  output->Initialize();
  output->SetDimensions(width, height, 1);
  vtkNew<vtkUnsignedCharArray> colors;
  vtkNew<vtkFloatArray> depths;
  AddArray(colors, "Colors", 4, output->GetNumberOfPoints(), output);
  AddArray(depths, "Depth", 1, output->GetNumberOfPoints(), output);
  colors->Fill(0.0);
  depths->Fill(1.0);
  ForEachRow(picture, width, 1, // It copies, as fast as memory is.
    [&](vtkIdType to, std::size_t from, std::size_t count)
    {
      std::copy_n(&picture.Frame.Colors[4 * from], 4 * count, colors->GetPointer(4 * to));
      std::transform(&picture.Frame.Depths[from], &picture.Frame.Depths[from] + count,
        depths->GetPointer(to), [](float depth) { return std::min(depth, 1.0F); });
    });
  output->GetPointData()->SetActiveScalars("Colors");
}

//------------------------------------------------------------------------------
void WriteFragments(const vtkIsosurfaceRayTraceRequest& request,
  const vtkIsosurfaceRayTracePicture& picture, int width, vtkTable* output)
{
  const vtkirt::PixelRectangle& pixels = picture.Scene.Pixels;
  const std::vector<vtkirt::FragmentOfPixel>& fragments = picture.Frame.Fragments;
  // Where the fragments of each pixel begin.
  std::vector<vtkIdType> rows(vtkirt::Count({ pixels.Width, pixels.Height, 1 }) + 1);
  for (const vtkirt::FragmentOfPixel& fragment : fragments)
  {
    ++rows[fragment.Pixel + 1];
  }
  std::partial_sum(rows.begin(), rows.end(), rows.begin());
  output->Initialize();
  // The hit that was kept is that of the fragment if there is one field.
  const bool haveValues = request.IsProjection() && request.Volumes.size() == 1;
  FragmentColumns columns(static_cast<vtkIdType>(fragments.size()), haveValues, output);
  for (const vtkirt::FragmentOfPixel& fragment : fragments)
  {
    const auto inRow = static_cast<int>(fragment.Pixel % static_cast<std::size_t>(pixels.Width));
    const auto row = static_cast<int>(fragment.Pixel / static_cast<std::size_t>(pixels.Width));
    const vtkIdType to = rows[fragment.Pixel]++;
    columns.Set(
      to, pixels.X + inRow + static_cast<vtkIdType>(pixels.Y + row) * width, fragment.Own);
    if (haveValues)
    {
      const vtkirt::Hit& hit = picture.Frame.Hits[fragment.Pixel];
      columns.SetValue(to, hit.Value, GetDepthOfValue(picture, hit));
    }
  }
}

}

VTK_ABI_NAMESPACE_END
