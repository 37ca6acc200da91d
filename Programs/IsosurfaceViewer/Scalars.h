// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Scalars_h
#define Scalars_h

#include "Support/ArrayChoice.h"
#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkType.h>

#include <array>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractVolumeMapper;
class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace Viewer
{

/// The array whose isosurfaces are shown: of an image, a grid or a mesh, or of all of them in
/// composite data. Of vectors it is the magnitude.
class Scalars
{
public:
  /// The array of this name, of points or cells; if it is empty, the active scalars, or else the
  /// first array. Throws std::runtime_error if there is none, or if it has no two values.
  Scalars(vtkDataObject* data, const std::string& name);

  const std::string& GetName() const { return this->Choice.GetName(); }
  double GetLowest() const { return this->Range[0]; }
  double GetHighest() const { return this->Range[1]; }
  bool AreVectors() const { return this->Vectors; }

  /// How many values are in each of the parts of the range, which are of the same width.
  const std::vector<double>& GetHistogram() const { return this->Histogram; }

  /// The value between the two classes of values that differ most (N. Otsu, 1979).
  double FindThreshold() const;

  /// The value at parametric coordinates in a cell of a block; of an array of cells, that of the
  /// cell.
  double GetValue(vtkDataSet* block, vtkIdType cell, const double parametric[3]) const;

  /// Has a mapper take this array.
  void SelectFor(vtkAbstractVolumeMapper* mapper) const { this->Choice.SelectFor(mapper); }

private:
  Scalars(const std::vector<vtkDataSet*>& blocks, const std::string& name);
  void Count(vtkDataArray* array);

  Programs::ArrayChoice Choice;
  bool Vectors = false;
  std::array<double, 2> Range;
  std::vector<double> Histogram;
};

}

#endif
