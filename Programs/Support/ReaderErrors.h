// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ReaderErrors_h
#define ReaderErrors_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkOutputWindow;
VTK_ABI_NAMESPACE_END

namespace Programs
{

/// Prints and counts the errors of a reader: many report one and read on, but incomplete data are
/// not accepted.
class ReaderErrors
{
public:
  explicit ReaderErrors(vtkAlgorithm* reader);
  ~ReaderErrors();
  ReaderErrors(const ReaderErrors&) = delete;
  ReaderErrors& operator=(const ReaderErrors&) = delete;

  int GetCount() const { return this->Count; }

private:
  static void Add(vtkObject*, unsigned long, void* count, void* text);

  int Count = 0;
  vtkAlgorithm* Reader;
  /// The one that is replaced meanwhile.
  vtkSmartPointer<vtkOutputWindow> Window;
  vtkNew<vtkCallbackCommand> Observer;
  /// For the executive, which would only repeat that the reader failed.
  vtkNew<vtkCallbackCommand> Silence;
};

}

#endif
