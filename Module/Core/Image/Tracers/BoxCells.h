// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BoxCells_h
#define BoxCells_h

#include "Image/Cells/BoxFaces.h"
#include "Image/Macrocells/CellMasks.h"
#include "Image/Tracers/ImageSelection.h"
#include "Image/Traversal/PacketTracer.h"
#include "Math/ValueRange.h"

#include <algorithm>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The cells of an image, by the boxes around the samples.
template <typename T, typename Layout>
class BoxCells final : public PacketTracer::Cells
{
public:
  /// All must outlive the cells.
  BoxCells(const ImageSelection& selection, CellMasks<T>& masks, Layout& bricks)
    : Selection(selection)
    , Masks(masks)
    , TheReader(bricks)
  {
  }

  typename Layout::Reader& GetReader() { return this->TheReader; }

  const BlockMask& GetMask(const Index3& block, BlockMask& own) override
  {
    return this->Masks.Get(block, own);
  }

  void Prefetch(const Index3& block) override
  {
    this->Masks.Prefetch(block);
    this->TheReader.Prefetch(BlockMask::GetFirstCell(block));
  }

  /// Appends the hits of a ray with the faces in a cell, in order.
  void FindFaces(const Ray& ray, const Index3& cell, std::vector<FaceHit>& faces)
  {
    Value corners[8];
    this->TheReader.Load(cell, corners);
    this->FindFaces(ray, cell, corners, faces);
  }

  /// The same for any cell of an active macrocell, found without masks: surfaces pass few of them.
  void FindFacesIfAny(const Ray& ray, const Index3& cell, std::vector<FaceHit>& faces)
  {
    Value corners[8];
    this->TheReader.Load(cell, corners);
    if (this->HasFaces(corners))
    {
      this->FindFaces(ray, cell, corners, faces);
    }
  }

private:
  using Value = typename Layout::Value;

  void FindFaces(
    const Ray& ray, const Index3& cell, const Value corners[8], std::vector<FaceHit>& faces) const
  {
    CellCorners values;
    std::copy(corners, corners + 8, values.begin());
    FindFaceHits(
      ray, cell, values, this->Selection.Lattice, this->Selection.Request.Surfaces, faces);
  }

  /// Whether a face between the boxes of a cell's corners is a surface.
  bool HasFaces(const Value corners[8]) const
  {
    ValueRange<Value> range;
    for (int corner = 0; corner < 8; ++corner)
    {
      range.Include(corners[corner], corners[corner]);
    }
    const std::vector<Isosurface>& surfaces = this->Selection.Request.Surfaces;
    return std::any_of(surfaces.begin(), surfaces.end(),
      [&range](const Isosurface& surface) { return range.Straddles(surface.Isovalue); });
  }

  const ImageSelection& Selection;
  CellMasks<T>& Masks;
  typename Layout::Reader TheReader;
};

}

#endif
