// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The blocks of an AMR data set, as patches of a hierarchy.

#ifndef vtkIsosurfaceRayTraceAmrBlocks_h
#define vtkIsosurfaceRayTraceAmrBlocks_h

#include "vtkIsosurfaceRayTraceLeaves.h"     // for ivars
#include "vtkIsosurfaceRayTraceReadArrays.h" // for ivars
#include "vtkIsosurfaceRayTraceScalars.h"    // for arguments
#include "vtkIsosurfaceRayTracingCompat.h"   // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"                 // for ivars

#include "Amr/AmrHierarchy.h"
#include "Image/ImageSettings.h"

#include <cstddef> // for std::size_t
#include <memory>  // for std::unique_ptr
#include <string>  // for std::string
#include <vector>  // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkDataArray;
class vtkVolumeMapper;

class vtkIsosurfaceRayTraceAmrBlocks
{
public:
  using Leaf = vtkIsosurfaceRayTraceLeaf;

  /// Of blocks that have no problem but those of their places; there must be one. The mapper that
  /// crops may be null.
  vtkIsosurfaceRayTraceAmrBlocks(const std::vector<Leaf>& leaves,
    const vtkIsosurfaceRayTraceScalars& scalars,
    const vtkIsosurfaceRayTracing::ImageSettings& settings, vtkVolumeMapper* cropping, int threads);
  ~vtkIsosurfaceRayTraceAmrBlocks();
  vtkIsosurfaceRayTraceAmrBlocks(const vtkIsosurfaceRayTraceAmrBlocks&) = delete;
  void operator=(const vtkIsosurfaceRayTraceAmrBlocks&) = delete;

  /// Whether it is what would be made of blocks that have not been modified since, but for how they
  /// are displayed.
  bool IsOf(const std::vector<Leaf>& leaves, const vtkIsosurfaceRayTraceScalars& scalars,
    const vtkIsosurfaceRayTracing::ImageSettings& settings, vtkVolumeMapper* cropping) const;

  /// Takes the same blocks, which may be displayed in another way. Regions are to be made again.
  void SetLeaves(const std::vector<Leaf>& leaves);

  /// Tells what is wrong with blocks that have no patch.
  void AddLeftOut(vtkIsosurfaceRayTraceLeftOut& leftOut) const;

  const vtkIsosurfaceRayTracing::AmrHierarchy& GetHierarchy() const { return *this->Hierarchy; }

  /// Of the fields of regions.
  const vtkIsosurfaceRayTracing::ImageSettings& GetSettings() const { return this->Settings; }
  vtkVolumeMapper* GetCropping() const { return this->Cropping; }

  /// The block of a patch.
  const Leaf& GetLeaf(std::size_t patch) const { return this->Leaves[this->LeafOfPatch[patch]]; }

  /// Whether all cells of a patch are hidden.
  bool IsAllHidden(std::size_t patch) const;

  /// Whether the arrays of a patch are where they were, and as long.
  bool IsIntact(std::size_t patch) const;

private:
  void SetSamples(const Leaf& leaf, const vtkIsosurfaceRayTraceScalars& scalars, int threads,
    vtkIsosurfaceRayTracing::AmrPatch& patch);
  void SetKinds();

  /// All blocks, why they have no patch (empty if they have), and which of them patches are of.
  std::vector<Leaf> Leaves;
  std::vector<std::string> Problems;
  std::vector<std::size_t> LeafOfPatch;
  /// What the samples were selected by, and the settings of fields.
  int Component;
  bool HasOtherComponents;
  vtkIsosurfaceRayTracing::ImageSettings Settings;
  vtkVolumeMapper* Cropping;
  /// Of each patch: its scalars; copies of those that are not plain arrays in memory; flags of its
  /// cells, if there are any.
  std::vector<vtkIsosurfaceRayTraceReadArray> Read;
  std::vector<vtkSmartPointer<vtkDataArray>> PlainScalars;
  std::vector<std::vector<unsigned char>> GhostCells;
  std::vector<std::vector<unsigned char>> HiddenCells;
  std::unique_ptr<vtkIsosurfaceRayTracing::AmrHierarchy> Hierarchy;
};

VTK_ABI_NAMESPACE_END

#endif
