// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// A volume in blocks has exactly the picture of the whole volume.

#include "AnalyticFields.h"
#include "Checks.h"
#include "Pictures.h"
#include "RandomRays.h"
#include "Selection.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfacePicker.h"

#include <vtkCellData.h>
#include <vtkDataObject.h>
#include <vtkExtractVOI.h>
#include <vtkFloatArray.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkShortArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <functional>
#include <set>

using namespace MapperTesting;

namespace
{

constexpr int Size = 120;
constexpr int Samples = 30;
/// Of the image, which need not begin at zero.
constexpr std::array<int, 3> FirstIndex = { 4, -7, 0 };

/// An image that has surface in every block.
vtkSmartPointer<vtkImageData> NewWhole()
{
  auto image = NewCube(Samples, AnalyticFields::Ripples);
  vtkNew<vtkFloatArray> ofCells;
  ofCells->SetName("of cells");
  vtkNew<vtkFloatArray> height;
  height->SetName("height");
  for (vtkIdType i = 0; i < image->GetNumberOfCells(); ++i)
  {
    double bounds[6];
    image->GetCellBounds(i, bounds);
    ofCells->InsertNextValue(
      static_cast<float>(AnalyticFields::Ripples({ 0.5 * (bounds[0] + bounds[1]),
        0.5 * (bounds[2] + bounds[3]), 0.5 * (bounds[4] + bounds[5]) })));
  }
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    height->InsertNextValue(static_cast<float>(image->GetPoint(i)[2]));
  }
  image->GetCellData()->AddArray(ofCells);
  image->GetPointData()->AddArray(height);
  image->SetExtent(FirstIndex[0], FirstIndex[0] + Samples - 1, FirstIndex[1],
    FirstIndex[1] + Samples - 1, FirstIndex[2], FirstIndex[2] + Samples - 1);
  return image;
}

/// A part of an image, given in points counted from its first, both ends included.
vtkSmartPointer<vtkImageData> NewPart(vtkImageData* whole, const std::array<int, 6>& points)
{
  vtkNew<vtkExtractVOI> extract;
  extract->SetInputData(whole);
  const int* extent = whole->GetExtent();
  extract->SetVOI(extent[0] + points[0], extent[0] + points[1], extent[2] + points[2],
    extent[2] + points[3], extent[4] + points[4], extent[4] + points[5]);
  extract->Update();
  auto part = vtkSmartPointer<vtkImageData>::New();
  part->ShallowCopy(extract->GetOutput());
  // The extent says where the part is. (For images that are turned, VTK 9.7 moves the origin too.)
  part->SetOrigin(whole->GetOrigin());
  return part;
}

/// Cuts an image into eight blocks that share the points between them, x fastest. With a layer of
/// ghosts each reaches a cell further, which is marked as another's.
std::vector<vtkSmartPointer<vtkImageData>> Cut(vtkImageData* whole, int ghosts = 0)
{
  const std::array<int, 3> cuts = { 11, 17, 8 };
  std::vector<vtkSmartPointer<vtkImageData>> blocks;
  for (int i = 0; i < 8; ++i)
  {
    std::array<int, 6> own;
    std::array<int, 6> points;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const bool isUpper = (i >> axis & 1) != 0;
      own[2 * axis] = isUpper ? cuts[axis] : 0;
      own[2 * axis + 1] = isUpper ? Samples - 1 : cuts[axis];
      points[2 * axis] = std::max(own[2 * axis] - ghosts, 0);
      points[2 * axis + 1] = std::min(own[2 * axis + 1] + ghosts, Samples - 1);
    }
    const auto block = NewPart(whole, points);
    if (ghosts > 0)
    {
      // Duplicates get wrong values: they must not count where the original is.
      vtkUnsignedCharArray* ofPoints = block->AllocatePointGhostArray();
      vtkUnsignedCharArray* ofCells = block->AllocateCellGhostArray();
      const int* size = block->GetDimensions();
      for (vtkIdType k = 0; k < block->GetNumberOfPoints(); ++k)
      {
        const std::array<vtkIdType, 3> index = { k % size[0], k / size[0] % size[1],
          k / size[0] / size[1] };
        bool isGhost = false;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const vtkIdType at = points[2 * axis] + index[axis];
          isGhost = isGhost || at < own[2 * axis] || at > own[2 * axis + 1];
        }
        if (isGhost)
        {
          ofPoints->SetValue(k, vtkDataSetAttributes::DUPLICATEPOINT);
          block->GetPointData()->GetArray("field")->SetComponent(k, 0, 99.0);
        }
      }
      for (vtkIdType k = 0; k < block->GetNumberOfCells(); ++k)
      {
        const std::array<vtkIdType, 3> index = { k % (size[0] - 1),
          k / (size[0] - 1) % (size[1] - 1), k / (size[0] - 1) / (size[1] - 1) };
        bool isGhost = false;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const vtkIdType at = points[2 * axis] + index[axis];
          isGhost = isGhost || at < own[2 * axis] || at >= own[2 * axis + 1];
        }
        if (isGhost)
        {
          ofCells->SetValue(k, vtkDataSetAttributes::DUPLICATECELL);
          block->GetCellData()->GetArray("of cells")->SetComponent(k, 0, -99.0);
        }
      }
    }
    blocks.push_back(block);
  }
  return blocks;
}

vtkSmartPointer<vtkMultiBlockDataSet> NewMultiBlock(
  const std::vector<vtkSmartPointer<vtkImageData>>& blocks)
{
  auto composite = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    composite->SetBlock(static_cast<unsigned int>(i), blocks[i]);
  }
  return composite;
}

/// With a camera that does not depend on the data.
struct Look : Scene
{
  explicit Look(vtkDataObject* data)
    : Scene(data, Size, Size)
  {
    this->SetSurface(0.2, { 0.9, 0.8, 0.7 }, 1.0);
    const double spacing = 2.0 / (Samples - 1);
    const double center[3] = { spacing * FirstIndex[0], spacing * FirstIndex[1],
      spacing * FirstIndex[2] };
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetFocalPoint(center);
    camera->SetPosition(center[0] + 2.6, center[1] - 5.2, center[2] + 2.3);
    camera->SetClippingRange(1.0, 12.0);
  }
};

Picture Draw(vtkDataObject* data, const std::function<void(Scene&)>& furnish = {})
{
  Look scene(data);
  if (furnish)
  {
    furnish(scene);
  }
  return RenderAndCapture(scene.Window);
}

//------------------------------------------------------------------------------
void CheckComposites(Checks& check)
{
  const auto whole = NewWhole();
  const Picture expected = Draw(whole);
  check.That(
    GetDifference(expected, Picture(expected.size(), 0), 60) > 0.2, "there is something to see");
  const auto blocks = Cut(whole);

  const auto multi = NewMultiBlock(blocks);
  check.Equal(GetDifference(Draw(multi), expected, 0), 0.0, "the difference of blocks");

  // Nested, in another order, with blocks that are null, empty or without the array.
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, blocks[7]);
  inner->SetBlock(3, blocks[2]);
  inner->SetBlock(4, vtkNew<vtkImageData>());
  const auto bare = vtkSmartPointer<vtkImageData>::New();
  bare->CopyStructure(blocks[4]);
  inner->SetBlock(5, bare);
  vtkNew<vtkMultiBlockDataSet> nested;
  nested->SetBlock(0, blocks[0]);
  nested->SetBlock(2, inner);
  for (const unsigned int i : { 1U, 3U, 4U, 5U, 6U })
  {
    nested->SetBlock(3 + i, blocks[i]);
  }
  check.Equal(GetDifference(Draw(nested), expected, 0), 0.0, "the difference of nested blocks");

  vtkNew<vtkPartitionedDataSet> parts;
  vtkNew<vtkPartitionedDataSet> others;
  for (unsigned int i = 0; i < 8; ++i)
  {
    (i < 5 ? parts : others)->SetPartition(i < 5 ? i : i - 5, blocks[i]);
  }
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartitionedDataSet(0, parts);
  collection->SetPartitionedDataSet(1, others);
  check.Equal(GetDifference(Draw(collection), expected, 0), 0.0, "the difference of a collection");
  const Picture half = Draw(parts);
  check.That(GetDifference(half, expected, 8) > 0.1, "five parts are not eight");

  // Every kind of picture of them.
  const std::vector<std::function<void(Scene&)>> looks = {
    [](Scene& scene) { scene.Mapper->SetNormalModeToInterpolantGradient(); },
    [](Scene& scene)
    {
      scene.SetSurface(0.2, { 0.9, 0.5, 0.3 }, 0.4);
      scene.AddSurface(-0.4, { 0.3, 0.5, 0.9 }, 0.6);
    },
    [](Scene& scene)
    {
      scene.Mapper->ShadowsOn();
      scene.Volume->RotateZ(30.0);
    },
    [](Scene& scene)
    {
      scene.Mapper->SetScalarModeToUseCellFieldData();
      scene.Mapper->SelectScalarArray("of cells");
    },
    [](Scene& scene)
    {
      scene.Mapper->SetColorArrayName("height");
      scene.Property()->GetRGBTransferFunction()->AddRGBPoint(-1.0, 0.0, 0.0, 1.0);
      scene.Property()->GetRGBTransferFunction()->AddRGBPoint(1.0, 1.0, 0.0, 0.0);
    },
    [](Scene& scene)
    {
      vtkNew<vtkPlane> plane;
      plane->SetNormal(0.3, 1.0, 0.2);
      plane->SetOrigin(scene.Mapper->GetCenter());
      scene.Mapper->AddClippingPlane(plane);
      const double* b = scene.Mapper->GetBounds();
      scene.Mapper->SetCroppingRegionPlanes(b[0] + 0.3, b[1] - 0.8, b[2], b[3], b[4] + 0.5, b[5]);
      scene.Mapper->CroppingOn();
    },
  };
  const auto withGhosts = NewMultiBlock(Cut(whole, 1));
  check.Equal(GetDifference(Draw(withGhosts), expected, 0), 0.0, "the difference with ghosts");
  for (std::size_t i = 0; i < looks.size(); ++i)
  {
    const Picture look = Draw(whole, looks[i]);
    check.That(GetDifference(look, expected, 8) > 0.01, "look " + std::to_string(i) + " is one");
    check.Equal(GetDifference(Draw(multi, looks[i]), look, 0), 0.0,
      "the difference of blocks in look " + std::to_string(i));
    check.Equal(GetDifference(Draw(withGhosts, looks[i]), look, 0), 0.0,
      "the difference of blocks with ghosts in look " + std::to_string(i));
  }
}

//------------------------------------------------------------------------------
/// Blocks may differ by their origins, and lie in a rotated lattice.
void CheckOrigins(Checks& check)
{
  for (const bool isTurned : { false, true })
  {
    const auto whole = NewWhole();
    if (isTurned)
    {
      whole->SetDirectionMatrix(0.8, -0.6, 0.0, 0.6, 0.8, 0.0, 0.0, 0.0, -1.0);
    }
    const Picture expected = Draw(whole, [](Scene& scene) { scene.LookFrom(1.0, -2.0, 0.8); });
    std::vector<vtkSmartPointer<vtkImageData>> blocks = Cut(whole);
    for (const auto& block : blocks)
    {
      const int* extent = block->GetExtent();
      double origin[3];
      block->TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], origin);
      block->SetOrigin(origin);
      block->SetExtent(
        0, extent[1] - extent[0], 0, extent[3] - extent[2], 0, extent[5] - extent[4]);
    }
    std::swap(blocks[0], blocks[5]);
    const Picture picture =
      Draw(NewMultiBlock(blocks), [](Scene& scene) { scene.LookFrom(1.0, -2.0, 0.8); });
    // The coordinates of points are rounded.
    check.That(GetDifference(picture, expected, 1) < 1e-3, "blocks with origins of their own");
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Cast(Scene& scene)
{
  AnalyticFields::Point center;
  scene.Renderer->GetActiveCamera()->GetFocalPoint(center.data());
  return RandomRays(center, 1.0, 4000).Cast(scene.Mapper, scene.Volume);
}

/// Nothing is drawn where blocks are missing, and the border of those that are there is shaded as
/// that of a volume.
void CheckMissingBlocks(Checks& check)
{
  const auto whole = NewWhole();
  const auto blocks = Cut(whole);
  // Two that share an edge.
  Look both(NewMultiBlock({ blocks[1], blocks[2] }));
  both.SetSurface(0.2, { 1.0, 1.0, 1.0 }, 0.01);
  const auto hits = Cast(both);
  vtkIdType count = 0;
  double worst = 0.0;
  int otherNormals = 0;
  for (const std::size_t i : { 1, 2 })
  {
    Look alone(blocks[i]);
    alone.SetSurface(0.2, { 1.0, 1.0, 1.0 }, 0.01);
    const auto own = Cast(alone);
    count += own->GetNumberOfPoints();
    vtkIdType at = 0;
    for (vtkIdType k = 0; k < own->GetNumberOfPoints(); ++k)
    {
      // The same hit among those of both: by ray, and along it.
      const auto get = [](vtkPolyData* data, const char* name, vtkIdType row, int component)
      { return data->GetPointData()->GetArray(name)->GetComponent(row, component); };
      while (at < hits->GetNumberOfPoints() &&
        (get(hits, "RayId", at, 0) < get(own, "RayId", k, 0) ||
          (get(hits, "RayId", at, 0) == get(own, "RayId", k, 0) &&
            get(hits, "T", at, 0) < get(own, "T", k, 0) - 1e-9)))
      {
        ++at;
      }
      if (at == hits->GetNumberOfPoints())
      {
        worst = 1.0;
        break;
      }
      double turned = 0.0;
      for (int component = 0; component < 3; ++component)
      {
        worst =
          std::max(worst, std::abs(hits->GetPoint(at)[component] - own->GetPoint(k)[component]));
        turned = std::max(turned,
          std::abs(get(hits, "Normals", at, component) - get(own, "Normals", k, component)));
      }
      otherNormals += turned > 1e-12 ? 1 : 0;
      check.That(turned < 0.05, "a normal is all but the same");
      vtkIdType inBlock = -1;
      unsigned int flatIndex = 0;
      vtkDataSet* block = both.Mapper->FindBlock(
        static_cast<vtkIdType>(get(hits, "CellId", at, 0)), inBlock, flatIndex);
      check.That(block == blocks[i] && inBlock == get(own, "CellId", k, 0) && flatIndex == i,
        "cell and block of a hit");
    }
  }
  check.That(count > 500, "hundreds of hits in two blocks");
  check.Equal(hits->GetNumberOfPoints(), count, "the number of hits in two blocks");
  check.Near(worst, 0.0, 1e-12, "the worst position of a hit in two blocks");
  std::cout << otherNormals << " of " << count << " normals differ\n";
  // Samples beside both blocks cannot extrapolate both of them exactly.
  check.That(otherNormals < count / 20, "normals are the same but at the edge of two blocks");
}

//------------------------------------------------------------------------------
void CheckPicking(Checks& check)
{
  const auto blocks = Cut(NewWhole(), 1);
  const auto composite = NewMultiBlock(blocks);
  Look scene(composite);
  scene.Volume->RotateX(20.0);
  scene.Window->Render();
  vtkNew<vtkImageData> picture;
  scene.Mapper->RenderToImage(
    scene.Volume, scene.Renderer->GetActiveCamera(), nullptr, Size, Size, picture);
  vtkNew<vtkIsosurfacePicker> picker;
  std::set<vtkIdType> flatIndices;
  double worst = 0.0;
  int wrong = 0;
  for (int i = 0; i < Size * Size; i += 11)
  {
    const int picked = picker->Pick(i % Size, i / Size, 0.0, scene.Renderer);
    const auto cell =
      static_cast<vtkIdType>(picture->GetPointData()->GetArray("CellId")->GetComponent(i, 0));
    if (cell < 0 || picked == 0)
    {
      wrong += picked != 0 || cell >= 0 ? 1 : 0;
      continue;
    }
    double position[3];
    picture->GetPointData()->GetArray("Position")->GetTuple(i, position);
    const vtkIdType flatIndex = picker->GetFlatBlockIndex();
    const bool isSame = std::equal(position, position + 3, picker->GetPickPosition()) &&
      picker->GetCompositeDataSet() == composite.Get() && flatIndex >= 1 && flatIndex <= 8 &&
      picker->GetDataSet() == blocks[static_cast<std::size_t>(flatIndex - 1)];
    wrong += isSame ? 0 : 1;
    flatIndices.insert(flatIndex);
    vtkDataSet* block = picker->GetDataSet();
    wrong += block->GetCellGhostArray()->GetValue(picker->GetCellId()) != 0 ? 1 : 0;
    double bounds[6];
    block->GetCellBounds(picker->GetCellId(), bounds);
    double point[4] = { 0.0, 0.0, 0.0, 1.0 };
    for (int axis = 0; axis < 3; ++axis)
    {
      point[axis] =
        bounds[2 * axis] + picker->GetPCoords()[axis] * (bounds[2 * axis + 1] - bounds[2 * axis]);
    }
    scene.Volume->GetMatrix()->MultiplyPoint(point, point);
    worst = std::max(worst, std::sqrt(vtkMath::Distance2BetweenPoints(point, position)));
  }
  check.Equal(wrong, 0, "the number of pixels picked wrong");
  check.That(flatIndices.size() > 4, "several blocks are picked");
  check.Near(worst, 0.0, 1e-12, "the worst position of what is picked");

  std::set<IdInBlock> visible;
  for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); ++i)
  {
    const auto cell =
      static_cast<vtkIdType>(picture->GetPointData()->GetArray("CellId")->GetComponent(i, 0));
    vtkIdType inBlock = -1;
    unsigned int flatIndex = 0;
    if (cell >= 0)
    {
      scene.Mapper->FindBlock(cell, inBlock, flatIndex);
      visible.emplace(static_cast<int>(flatIndex), inBlock);
    }
  }
  for (const int association :
    { vtkDataObject::FIELD_ASSOCIATION_CELLS, vtkDataObject::FIELD_ASSOCIATION_POINTS })
  {
    const std::set<IdInBlock> ids = SelectInBlocks(scene.Renderer, scene.Volume, association);
    if (association == vtkDataObject::FIELD_ASSOCIATION_CELLS)
    {
      check.That(ids == visible, "the cells selected are those visible");
      continue;
    }
    int far = 0;
    for (const auto& [flatIndex, id] : ids)
    {
      AnalyticFields::Point point;
      blocks[static_cast<std::size_t>(flatIndex - 1)]->GetPoint(id, point.data());
      // Three to four units of value for one of length; and half a cell of it.
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        point[axis] -= 2.0 / (Samples - 1) * FirstIndex[axis];
      }
      far += std::abs(AnalyticFields::Ripples(point) - 0.2) > 0.5 ? 1 : 0;
    }
    check.That(ids.size() > 100 && far == 0, "the points selected are near the surface");
  }
}

//------------------------------------------------------------------------------
/// Coloured by another array, with scalars by name, each pixel has the colour of the point that is
/// picked there.
void CheckColoredPicking(Checks& check)
{
  const auto blocks = Cut(NewWhole(), 1);
  for (const auto& block : blocks)
  {
    block->GetPointData()->SetActiveScalars("height");
  }
  Look scene(NewMultiBlock(blocks));
  scene.Mapper->SetScalarModeToUsePointFieldData();
  scene.Mapper->SelectScalarArray("field");
  scene.Mapper->SetColorArrayName("height");
  scene.Property()->ShadeOff();
  vtkColorTransferFunction* function = scene.Property()->GetRGBTransferFunction();
  function->RemoveAllPoints();
  function->AddRGBPoint(-1.0, 0.0, 0.1, 1.0);
  function->AddRGBPoint(1.0, 1.0, 0.3, 0.0);
  const Picture window = RenderAndCapture(scene.Window);
  vtkNew<vtkIsosurfacePicker> picker;
  int wrong = 0;
  std::set<vtkIdType> flatIndices;
  for (int i = 0; i < Size * Size; i += 7)
  {
    if (picker->Pick(i % Size, i / Size, 0.0, scene.Renderer) == 0)
    {
      continue;
    }
    flatIndices.insert(picker->GetFlatBlockIndex());
    double color[3];
    // The height falls short of z by where the image begins, which is at zero.
    function->GetColor(picker->GetPickPosition()[2], color);
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      wrong +=
        std::abs(255.0 * color[channel] - window[3 * static_cast<std::size_t>(i) + channel]) > 1.5;
    }
    const double value = picker->GetDataSet()->GetPointData()->GetArray("field")->GetComponent(
      picker->GetPointId(), 0);
    wrong += picker->GetIsovalue() != 0.2 || std::abs(value - 0.2) > 1.0 ? 1 : 0;
  }
  check.Equal(wrong, 0, "the number of pixels of another colour than where they are");
  check.That(flatIndices.size() > 4, "several blocks are picked in colours");
}

//------------------------------------------------------------------------------
/// Blocks are joined when they change, and only then.
void CheckChanges(Checks& check)
{
  const auto blocks = Cut(NewWhole());
  const auto composite = NewMultiBlock(blocks);
  Look scene(composite);
  const Picture before = RenderAndCapture(scene.Window);
  scene.Volume->RotateZ(10.0);
  scene.Window->Render();
  check.Equal(scene.Mapper->GetMacrocellBuildTime(), 0.0, "the time to build what is built");
  scene.Volume->RotateZ(-10.0);
  vtkDataArray* scalars = blocks[0]->GetPointData()->GetScalars();
  scalars->Fill(-9.0);
  scalars->Modified();
  const Picture after = RenderAndCapture(scene.Window);
  check.That(GetDifference(before, after, 8) > 0.01, "a changed block is visible");
  composite->SetBlock(5, nullptr);
  check.That(GetDifference(RenderAndCapture(scene.Window), after, 8) > 0.01,
    "a removed block is no longer visible");

  // Blocks of different types: all values are kept.
  const auto typed = Cut(NewWhole());
  for (std::size_t i = 0; i < 8; ++i)
  {
    vtkNew<vtkShortArray> shorts;
    vtkNew<vtkFloatArray> floats;
    vtkDataArray* values = i % 2 == 0 ? static_cast<vtkDataArray*>(shorts) : floats;
    values->SetName("field");
    vtkDataArray* from = typed[i]->GetPointData()->GetScalars();
    for (vtkIdType k = 0; k < from->GetNumberOfTuples(); ++k)
    {
      values->InsertNextTuple1(std::round(1000.0 * from->GetComponent(k, 0)));
    }
    typed[i]->GetPointData()->SetScalars(values);
  }
  const auto rounded = NewWhole();
  vtkDataArray* values = rounded->GetPointData()->GetScalars();
  for (vtkIdType k = 0; k < values->GetNumberOfTuples(); ++k)
  {
    values->SetComponent(k, 0, std::round(1000.0 * values->GetComponent(k, 0)));
  }
  const auto furnish = [](Scene& look) { look.SetSurface(200.0, { 0.9, 0.8, 0.7 }, 1.0); };
  check.Equal(GetDifference(Draw(NewMultiBlock(typed), furnish), Draw(rounded, furnish), 0), 0.0,
    "the difference of blocks of two types");
}

//------------------------------------------------------------------------------
/// What is wrong with a block is one warning; the others are drawn. Where none is left, it is an
/// error.
void CheckProblems(Checks& check)
{
  const auto expect = [&check](vtkDataObject* data, unsigned long event, const std::string& text)
  {
    Look scene(data);
    vtkNew<EventCounter> errors;
    vtkNew<EventCounter> warnings;
    scene.Mapper->AddObserver(vtkCommand::ErrorEvent, errors);
    scene.Mapper->AddObserver(vtkCommand::WarningEvent, warnings);
    scene.Window->Render();
    const Picture picture = RenderAndCapture(scene.Window);
    check.Equal(
      errors->Count, event == vtkCommand::ErrorEvent ? 1 : 0, "the number of errors for " + text);
    check.Equal(warnings->Count, event == vtkCommand::WarningEvent ? 1 : 0,
      "the number of warnings for " + text);
    const std::string said = event == vtkCommand::ErrorEvent ? errors->Text : warnings->Text;
    check.That(said.find(text) != std::string::npos, "it says " + text);
    return picture;
  };
  const auto without = [](std::vector<vtkSmartPointer<vtkImageData>> blocks, std::size_t number)
  {
    blocks[number] = nullptr;
    return Draw(NewMultiBlock(blocks));
  };
  auto blocks = Cut(NewWhole());
  blocks[2]->GetPointData()->SetScalars(vtkNew<vtkDoubleArray>());
  blocks[2]->GetPointData()->GetScalars()->SetNumberOfTuples(5);
  check.Equal(GetDifference(expect(NewMultiBlock(blocks), vtkCommand::WarningEvent,
                              "Block 3 of the composite input is left out. It has scalars unlike"),
                without(blocks, 2), 0),
    0.0, "the difference without a block of unlike scalars");
  blocks = Cut(NewWhole());
  const double* origin = blocks[6]->GetOrigin();
  blocks[6]->SetOrigin(origin[0], std::nan(""), origin[2]);
  auto named = NewMultiBlock(blocks);
  named->GetMetaData(6U)->Set(vtkCompositeDataSet::NAME(), "wing");
  check.Equal(GetDifference(expect(named, vtkCommand::WarningEvent,
                              "Block 7 (wing) of the composite input is left out. The origin"),
                without(blocks, 6), 0),
    0.0, "the difference without a block that lies nowhere");
  const auto polygons = NewMultiBlock(Cut(NewWhole()));
  vtkNew<vtkPolyData> lines;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  lines->SetPoints(points);
  polygons->SetBlock(8, lines);
  polygons->SetBlock(9, lines);
  check.Equal(GetDifference(expect(polygons, vtkCommand::WarningEvent,
                              "Block 9 of the composite input is left out. It is a vtkPolyData"),
                Draw(NewWhole()), 0),
    0.0, "the difference beside polygons");
  expect(polygons, vtkCommand::WarningEvent, "(1 other block is left out, too.)");
  vtkNew<vtkMultiBlockDataSet> empty;
  expect(empty, vtkCommand::ErrorEvent, "no block with a volume");
  empty->SetBlock(0, vtkNew<vtkImageData>());
  expect(empty, vtkCommand::ErrorEvent, "no block with a volume");
  empty->SetBlock(1, lines);
  expect(empty, vtkCommand::ErrorEvent, "is a vtkPolyData");

  // One block is the input itself, also a rectilinear grid.
  const auto whole = NewWhole();
  check.Equal(GetDifference(Draw(NewMultiBlock({ whole })), Draw(whole), 0), 0.0,
    "the difference of one block");
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(Samples, Samples, Samples);
  vtkNew<vtkDoubleArray> coordinates[3];
  for (int i = 0; i < Samples; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      coordinates[axis]->InsertNextValue(
        2.0 / (Samples - 1) * (i + FirstIndex[static_cast<std::size_t>(axis)]) - 1.0);
    }
  }
  grid->SetXCoordinates(coordinates[0]);
  grid->SetYCoordinates(coordinates[1]);
  grid->SetZCoordinates(coordinates[2]);
  grid->GetPointData()->SetScalars(whole->GetPointData()->GetScalars());
  vtkNew<vtkMultiBlockDataSet> one;
  one->SetBlock(2, grid);
  check.That(GetDifference(Draw(one), Draw(whole), 1) < 1e-3, "a block that is a rectilinear grid");
}

}

int TestIsosurfaceRayTraceMapperBlocks(int argc, char* argv[])
{
  Checks check;
  CheckComposites(check);
  CheckOrigins(check);
  CheckMissingBlocks(check);
  CheckPicking(check);
  CheckColoredPicking(check);
  CheckChanges(check);
  CheckProblems(check);

  // The blocks that have the corner next to the eye are missing.
  auto blocks = Cut(NewWhole());
  blocks.erase(blocks.begin() + 5);
  blocks.erase(blocks.begin() + 1);
  Look scene(NewMultiBlock(blocks));
  scene.Window->SetSize(240, 240);
  scene.Renderer->GetActiveCamera()->Zoom(0.7);
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
