// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ArrayChoice_h
#define ArrayChoice_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractVolumeMapper;
class vtkDataArray;
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace Programs
{

/// Which array of data is meant, of points or of cells: what the option --array of all programs
/// chooses.
class ArrayChoice
{
public:
  /// The array of this name in the first block that has it, that of points if cells have one, too.
  /// Without a name, the active scalars of the first block that has an array, or else its first
  /// array. Throws std::runtime_error if there is none; it lists those that there are.
  ArrayChoice(const std::vector<vtkDataSet*>& blocks, const std::string& name);

  /// Empty for active scalars without a name.
  const std::string& GetName() const { return this->Name; }
  bool IsOfCells() const { return this->OfCells; }

  /// Null if the block has none.
  vtkDataArray* FindIn(vtkDataSet* block) const;

  /// Has a mapper take this array.
  void SelectFor(vtkAbstractVolumeMapper* mapper) const;

private:
  std::string Name;
  bool OfCells = false;
};

/// The choice for the data of a file, which errors name.
ArrayChoice ChooseArray(vtkDataSet* data, const std::string& name, const std::string& fileName);

/// The names of all arrays of points and of cells, but for the marks of ghosts: " a b", or " none".
std::string ListArrays(const std::vector<vtkDataSet*>& blocks);

}

#endif
