// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CoarseLevel_h
#define CoarseLevel_h

#include "Image/ImageField.h"
#include "Image/Lattice/UnevenPlanes.h"
#include "Image/Samples/VolumeView.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// About two million samples of a larger image, every few along each axis, as a field that stands
/// in for the image where there is no time to read it: most of its slices are not looked at.
///
/// Slices are read from the coarsest distance between them to the finest, and the field is one of
/// those that are read: the whole of the image is there after the first few.
class CoarseLevel
{
public:
  /// Whether an image has so many samples that a part of them can stand in for it.
  static bool IsOf(const Index3& dimensions);

  /// Of the samples of an image and its hidden cells (see Visibility), which must outlive it. There
  /// may be none of these, and no planes: then samples are evenly spaced.
  CoarseLevel(
    const VolumeView& image, const UnevenPlanes* planes, const unsigned char* hiddenCells);

  /// Reads the next slices, until about 16 MiB of the image are passed over, and makes the field of
  /// all that are read. To be called until everything is.
  void ReadSlices(int threads);

  /// How much is read, from 0 to 1: everything.
  double GetFractionRead() const;

  /// Null before anything is read; another one after each reading.
  ImageField* GetField() const { return this->Field.get(); }

  /// One for every cell of the field, not zero where the cell of the image at its centre is hidden;
  /// null if all are visible.
  const unsigned char* GetHiddenCells() const;

  /// What lengths in the object space of the image become in that of the field, along each axis.
  const Vector3& GetScale() const { return this->Scale; }

  /// The cell of the image where a hit of the field is, and the place in it.
  Index3 FindCell(const Hit& hit, Vector3& parametric) const;

private:
  /// Planes of samples of the image, by their numbers in it and their coordinates.
  struct TakenPlanes
  {
    std::vector<int> Numbers;
    std::vector<double> Coordinates;
  };

  void ReadAhead(std::size_t end) const;
  void ReadSlice(int number);
  void HideCells();
  void MakeField(int threads);

  VolumeView Image;
  const unsigned char* HiddenOfImage;
  /// Along z, those that will be taken.
  std::array<TakenPlanes, 3> Taken;
  /// The order in which slices are read; how many are; and which, in the order of the image.
  std::vector<int> Order;
  std::size_t NumberOfSlicesRead = 0;
  TakenPlanes Slices;
  std::vector<std::byte> Samples;

  Vector3 Scale;
  std::optional<UnevenPlanes> Planes;
  std::vector<unsigned char> HiddenCells;
  std::unique_ptr<ImageField> Field;
};

}

#endif
