// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/CoarseLevel.h"

#include "Image/Samples/FilePages.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// In samples.
constexpr double LargestSize = 1 << 21;

/// How many samples of an image there are to one of its coarse level, along each axis.
int FindStep(const Index3& dimensions)
{
  const auto count = static_cast<double>(Count(dimensions));
  return std::max(1, static_cast<int>(std::ceil(std::cbrt(count / LargestSize))));
}

/// So many of the numbers from 0 to the last, evenly, with both ends.
std::vector<int> TakeEvenly(int count, int last)
{
  std::vector<int> taken;
  for (std::int64_t i = 0; i < count; ++i)
  {
    taken.push_back(static_cast<int>((i * last + (count - 1) / 2) / (count - 1)));
  }
  return taken;
}

/// The numbers of slices, with both ends first, then from the coarsest distance to the finest.
std::vector<int> OrderSlices(int count)
{
  std::vector<int> order = { 0, count - 1 };
  int distance = 1;
  while (2 * distance < count)
  {
    distance *= 2;
  }
  for (; distance > 0; distance /= 2)
  {
    for (int i = distance; i < count - 1; i += 2 * distance)
    {
      order.push_back(i);
    }
  }
  return order;
}

std::size_t GetSizeOf(ScalarType type)
{
  return DispatchScalarType(type, [](auto value) { return sizeof(value); });
}

}

//------------------------------------------------------------------------------
bool CoarseLevel::IsOf(const Index3& dimensions)
{
  return FindStep(dimensions) > 1;
}

//------------------------------------------------------------------------------
CoarseLevel::CoarseLevel(
  const VolumeView& image, const UnevenPlanes* planes, const unsigned char* hiddenCells)
  : Image(image)
  , HiddenOfImage(hiddenCells)
{
  const int step = FindStep(image.Dimensions);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    TakenPlanes& taken = this->Taken[axis];
    const int last = image.Dimensions[axis] - 1;
    taken.Numbers = TakeEvenly(std::max(2, last / step + 1), last);
    for (const int plane : taken.Numbers)
    {
      taken.Coordinates.push_back(planes ? planes->Get(axis, plane) : plane);
    }
  }
  this->Order = OrderSlices(static_cast<int>(this->Taken[2].Numbers.size()));
}

//------------------------------------------------------------------------------
const unsigned char* CoarseLevel::GetHiddenCells() const
{
  return this->HiddenCells.empty() ? nullptr : this->HiddenCells.data();
}

//------------------------------------------------------------------------------
double CoarseLevel::GetFractionRead() const
{
  return static_cast<double>(this->NumberOfSlicesRead) / static_cast<double>(this->Order.size());
}

//------------------------------------------------------------------------------
void CoarseLevel::ReadSlices(int threads)
{
  constexpr std::size_t most = std::size_t{ 16 } << 20;
  const Index3& dimensions = this->Image.Dimensions;
  const std::size_t bytesOfSlice = Count({ dimensions[0], dimensions[1], 1 }) *
    static_cast<std::size_t>(this->Image.Stride) * GetSizeOf(this->Image.Type);
  const std::size_t count = std::max(std::size_t{ 2 }, most / bytesOfSlice);
  const std::size_t end = std::min(this->Order.size(), this->NumberOfSlicesRead + count);
  this->ReadAhead(end);
  for (; this->NumberOfSlicesRead < end; ++this->NumberOfSlicesRead)
  {
    this->ReadSlice(this->Order[this->NumberOfSlicesRead]);
  }
  this->MakeField(threads);
}

//------------------------------------------------------------------------------
/// Has the system read the next slices, if they are in a file.
void CoarseLevel::ReadAhead(std::size_t end) const
{
  if (!this->Image.AreInFile)
  {
    return;
  }
  DispatchScalarType(this->Image,
    [this, end](const auto& samples)
    {
      const Index3& dimensions = samples.GetDimensions();
      for (std::size_t i = this->NumberOfSlicesRead; i < end; ++i)
      {
        const int z = this->Taken[2].Numbers[static_cast<std::size_t>(this->Order[i])];
        PagesAhead().Add(
          samples.At({ 0, 0, z }), samples.At({ dimensions[0] - 1, dimensions[1] - 1, z }) + 1);
      }
    });
}

//------------------------------------------------------------------------------
/// Inserts a slice among those that are read.
void CoarseLevel::ReadSlice(int number)
{
  const int z = this->Taken[2].Numbers[static_cast<std::size_t>(number)];
  std::vector<int>& slices = this->Slices.Numbers;
  const auto position = std::lower_bound(slices.begin(), slices.end(), z) - slices.begin();
  slices.insert(slices.begin() + position, z);
  this->Slices.Coordinates.insert(this->Slices.Coordinates.begin() + position,
    this->Taken[2].Coordinates[static_cast<std::size_t>(number)]);
  DispatchScalarType(this->Image,
    [this, position, z](const auto& samples)
    {
      using Value = typename std::decay_t<decltype(samples)>::Value;
      const std::vector<int>& columns = this->Taken[0].Numbers;
      const std::vector<int>& rows = this->Taken[1].Numbers;
      const std::size_t bytes = columns.size() * rows.size() * sizeof(Value);
      const std::size_t begin = static_cast<std::size_t>(position) * bytes;
      this->Samples.insert(
        this->Samples.begin() + static_cast<std::ptrdiff_t>(begin), bytes, std::byte{});
      auto* next = reinterpret_cast<Value*>(this->Samples.data() + begin);
      for (const int y : rows)
      {
        for (const int x : columns)
        {
          *next++ = *samples.At({ x, y, z });
        }
      }
    });
}

//------------------------------------------------------------------------------
void CoarseLevel::MakeField(int threads)
{
  this->Field.reset(); // Its memory first.
  std::array<const TakenPlanes*, 3> taken = { &this->Taken[0], &this->Taken[1], &this->Slices };
  VolumeView view;
  view.Samples = this->Samples.data();
  view.Type = this->Image.Type;
  std::array<std::vector<double>, 3> coordinates;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    coordinates[axis] = taken[axis]->Coordinates;
    view.Dimensions[axis] = static_cast<int>(coordinates[axis].size());
    const double last = view.Dimensions[axis] - 1;
    this->Scale[axis] = last / (this->Image.Dimensions[axis] - 1);
    for (double& coordinate : coordinates[axis])
    {
      coordinate = std::min(coordinate * this->Scale[axis], last);
    }
    coordinates[axis].back() = last;
  }
  this->Planes.emplace(std::move(coordinates));
  this->HideCells();
  ImageSettings settings;
  settings.Layout = BrickLayout::Unbricked;
  this->Field = ImageField::New(view, settings, threads);
  this->Field->SetPlanes(&*this->Planes);
}

//------------------------------------------------------------------------------
void CoarseLevel::HideCells()
{
  this->HiddenCells.clear();
  if (!this->HiddenOfImage)
  {
    return;
  }
  const auto findMiddles = [](const std::vector<int>& planes)
  {
    std::vector<int> middles;
    for (std::size_t i = 1; i < planes.size(); ++i)
    {
      middles.push_back((planes[i - 1] + planes[i] - 1) / 2);
    }
    return middles;
  };
  const Index3& dimensions = this->Image.Dimensions;
  const Index3 cells = { dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1 };
  const std::vector<int> columns = findMiddles(this->Taken[0].Numbers);
  const std::vector<int> rows = findMiddles(this->Taken[1].Numbers);
  for (const int z : findMiddles(this->Slices.Numbers))
  {
    for (const int y : rows)
    {
      for (const int x : columns)
      {
        this->HiddenCells.push_back(this->HiddenOfImage[Offset({ x, y, z }, cells)]);
      }
    }
  }
}

//------------------------------------------------------------------------------
Index3 CoarseLevel::FindCell(const Hit& hit, Vector3& parametric) const
{
  const std::array<const TakenPlanes*, 3> taken = { &this->Taken[0], &this->Taken[1],
    &this->Slices };
  Index3 cell = this->Field->GetLattice().GetCell(hit);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto planes = taken[axis]->Numbers.begin() + cell[axis];
    const double place = planes[0] + hit.Parametric[axis] * (planes[1] - planes[0]);
    cell[axis] = std::clamp(static_cast<int>(place), planes[0], planes[1] - 1);
    parametric[axis] = place - cell[axis];
  }
  return cell;
}

}
