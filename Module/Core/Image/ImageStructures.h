// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ImageStructures_h
#define ImageStructures_h

#include "Field/TracedField.h"
#include "Image/ImageSettings.h"
#include "Image/Macrocells/RangeStore.h"
#include "Image/Samples/VolumeView.h"
#include "Image/Tracers/ImageTracer.h"

#include <cstddef>
#include <memory>

namespace vtkIsosurfaceRayTracing
{

/// Of the samples, as double.
struct SampleRange
{
  double Min;
  double Max;
};

/// What is built over the samples of an image: macrocells slab by slab, masks of cells and bricks
/// as rays need them. This is where the type of the samples and the layout of bricks are known.
class ImageStructures
{
public:
  virtual ~ImageStructures() = default;

  virtual const MacrocellLattice& GetLattice() const = 0;

  /// Of the samples that are read.
  virtual SampleRange GetRange() const = 0;

  /// See ImageField.
  virtual void ReadSlab(int threads, RangeStore* store) = 0;
  virtual double GetFractionRead() const = 0;

  /// Has the system read the samples in active macrocells, if they are in a file.
  virtual void ReadAhead(const ActiveMacrocells& active) = 0;

  /// Makes a tracer for the request that is selected. The structures and the selection must outlive
  /// it; one tracer is used at a time.
  virtual std::unique_ptr<ImageTracer> NewTracer(const ImageSelection& selection) = 0;

  /// Begins a frame, in which bricks and masks may take up to a number of bytes.
  virtual void BeginFrame(std::size_t maximumMemory) = 0;

  /// Asks for the memory of the structures, but not for what they refer to.
  virtual void Prefetch() const = 0;
  virtual FieldStatistics GetStatistics() const = 0;
};

/// Reads no samples yet. Each type of samples is compiled separately: see
/// TypedImageStructures.cxx.in.
template <typename T>
std::unique_ptr<ImageStructures> NewImageStructures(
  const Samples<T>& samples, const ImageSettings& settings);

}

#endif
