// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TypedImageStructures_h
#define TypedImageStructures_h

#include "Image/ImageStructures.h"
#include "Image/Macrocells/ActiveRows.h"
#include "Image/Macrocells/CellMasks.h"
#include "Image/Macrocells/MacrocellHierarchy.h"
#include "Image/Samples/ApronBricks.h"
#include "Image/Samples/FilePages.h"
#include "Image/Samples/TwoLevelBricks.h"
#include "Image/Samples/Unbricked.h"
#include "Image/Tracers/NearestTracer.h"
#include "Image/Tracers/ProjectionTracer.h"
#include "Image/Tracers/TricubicTracer.h"
#include "Image/Tracers/TrilinearTracer.h"
#include "Math/PrefetchLines.h"

#include <optional>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

// Kernels, which do not know ScalarType, have their functions in its order.
static_assert(Kernels::ScalarTypes == NumberOfScalarTypes);

template <typename T, typename Layout>
class TypedImageStructures final : public ImageStructures
{
public:
  template <typename... LayoutArguments>
  TypedImageStructures(
    const Samples<T>& samples, const std::vector<int>& branching, LayoutArguments... arguments)
    : TheSamples(samples)
    , Hierarchy(samples, branching)
    , Masks(samples)
    , Bricks(samples, arguments...)
  {
  }

  const MacrocellLattice& GetLattice() const override { return this->Hierarchy.GetLattice(); }

  void ReadSlab(int threads, RangeStore* store) override
  {
    this->Hierarchy.ReadSlab(threads, store);
  }
  double GetFractionRead() const override { return this->Hierarchy.GetFractionRead(); }

  SampleRange GetRange() const override
  {
    const ValueRange<T>& range = this->Hierarchy.GetRange();
    return { static_cast<double>(range.Min), static_cast<double>(range.Max) };
  }

  /// Samples that have been asked for are not asked for again: of those that the system has, that
  /// would take time for nothing.
  void ReadAhead(const ActiveMacrocells& active) override
  {
    if (!this->TheSamples.AreInFile() || active.GetLattice().Levels.empty())
    {
      return;
    }
    ActiveRows rows(active);
    if (this->AskedFor)
    {
      rows.Remove(*this->AskedFor);
      this->AskedFor->Include(rows);
    }
    else
    {
      this->AskedFor = rows;
    }
    PagesAhead pages;
    for (int z = 0; z < this->TheSamples.GetDimensions()[2]; ++z)
    {
      int y = 0;
      for (const ActiveRows::Row& row : rows.GetSlice(z))
      {
        if (!row.IsEmpty())
        {
          pages.Add(
            this->TheSamples.At({ row.First, y, z }), this->TheSamples.At({ row.Last, y, z }) + 1);
        }
        ++y;
      }
    }
  }

  std::unique_ptr<ImageTracer> NewTracer(const ImageSelection& selection) override
  {
    this->Masks.Select({}); // those of the tracer before
    if (selection.Request.Projection)
    {
      return *selection.Request.Projection == Extremum::Largest
        ? this->NewProjection<Extremum::Largest>(selection)
        : this->NewProjection<Extremum::Smallest>(selection);
    }
    switch (selection.Request.Interpolation)
    {
      case Interpolant::Nearest:
        return std::make_unique<NearestTracer<T, Layout>>(
          selection, this->TheSamples, this->Hierarchy, this->Masks, this->Bricks);
      case Interpolant::Tricubic:
        return std::make_unique<TricubicTracer<T>>(
          selection, this->TheSamples, this->Hierarchy, this->Masks);
      case Interpolant::Trilinear:
        break;
    }
    return std::make_unique<TrilinearTracer<T, Layout>>(
      selection, this->TheSamples, this->Hierarchy, this->Masks, this->Bricks);
  }

  /// Divides the memory between bricks and masks, by what they take for one block.
  void BeginFrame(std::size_t maximumMemory) override
  {
    constexpr std::size_t brick = BlockMask::Edge * BlockMask::Edge * BlockMask::Edge * sizeof(T);
    const std::size_t forMasks = maximumMemory / (brick + sizeof(BlockMask)) * sizeof(BlockMask);
    this->Masks.BeginFrame(forMasks);
    this->Bricks.BeginFrame(maximumMemory - forMasks);
  }

  void Prefetch() const override { PrefetchLines(this, sizeof(*this)); }

  FieldStatistics GetStatistics() const override
  {
    return { this->Hierarchy.GetMemory(), this->Bricks.GetMemory() + this->Masks.GetMemory(),
      this->Bricks.GetNumberOfBricks(), this->Bricks.GetMaximumNumberOfBricks() };
  }

private:
  template <Extremum Kind>
  std::unique_ptr<ImageTracer> NewProjection(const ImageSelection& selection)
  {
    return std::make_unique<ProjectionTracer<T, Layout, Kind>>(
      selection, this->TheSamples, this->Hierarchy, this->Masks, this->Bricks);
  }

  Samples<T> TheSamples;
  std::optional<ActiveRows> AskedFor;
  MacrocellHierarchy<T> Hierarchy;
  CellMasks<T> Masks;
  Layout Bricks;
};

//------------------------------------------------------------------------------
template <typename T>
std::unique_ptr<ImageStructures> NewImageStructures(
  const Samples<T>& samples, const ImageSettings& settings)
{
  const std::vector<int>& branching = settings.MacrocellBranching;
  switch (settings.Layout)
  {
    case BrickLayout::Unbricked:
      return std::make_unique<TypedImageStructures<T, Unbricked<T>>>(samples, branching);
    case BrickLayout::TwoLevel:
      return std::make_unique<TypedImageStructures<T, TwoLevelBricks<T>>>(
        samples, branching, settings.BrickSize, settings.BrickGroupSize);
    case BrickLayout::Apron:
      break;
  }
  return std::make_unique<TypedImageStructures<T, ApronBricks<T>>>(
    samples, branching, settings.BrickSize);
}

}

#endif
