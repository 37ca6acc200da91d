// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What a mapper tells its user: errors and warnings, each once, not in every frame.

#ifndef vtkIsosurfaceRayTraceReporter_h
#define vtkIsosurfaceRayTraceReporter_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include <array>     // for std::array
#include <exception> // for std::exception
#include <map>       // for std::map
#include <string>    // for std::string
#include <utility>   // for std::pair

VTK_ABI_NAMESPACE_BEGIN

class vtkAbstractVolumeMapper;
class vtkIsosurfaceRayTraceUse;
class vtkRenderer;
class vtkVolume;

class vtkIsosurfaceRayTraceReporter
{
public:
  class Scope;

  /// What warnings are of: blocks that are left out, what went wrong when the input was built, and
  /// hints.
  enum class Kind
  {
    LeftOut,
    Input,
    Hint
  };

  /// Of a mapper. What to do where there is not enough memory, as sentences, must outlive it.
  vtkIsosurfaceRayTraceReporter(vtkAbstractVolumeMapper* mapper, const char* memoryRemedy)
    : Mapper(mapper)
    , MemoryRemedy(memoryRemedy)
  {
  }

  /// Reports a problem, if there is one and it was not reported before. Returns whether there is.
  bool ReportOnce(const std::string& problem);
  /// Warns of something, unless that was the last warning of its kind.
  void WarnOnce(const std::string& problem, Kind kind);
  /// That of memory which is refused says what to do.
  void ReportException(const std::exception& exception) const;

private:
  using VolumeInRenderer = std::pair<const vtkVolume*, const vtkRenderer*>;

  vtkAbstractVolumeMapper* Mapper;
  const char* MemoryRemedy;
  /// The last warnings of each volume, and the last problem of each in each renderer, or without
  /// one. They may be gone.
  std::map<const vtkVolume*, std::array<std::string, 3>> WarningsOf;
  std::map<VolumeInRenderer, std::string> ProblemsOf;
  VolumeInRenderer Reported;
};

/// While a use that is allowed lives, what is reported is of a volume in a renderer, which may be
/// null. Uses of observers are within others.
class vtkIsosurfaceRayTraceReporter::Scope
{
public:
  Scope(vtkIsosurfaceRayTraceReporter& reporter, const vtkIsosurfaceRayTraceUse& use,
    const vtkVolume* volume, const vtkRenderer* renderer);
  ~Scope();
  Scope(const Scope&) = delete;
  void operator=(const Scope&) = delete;

private:
  vtkIsosurfaceRayTraceReporter* Reporter;
  VolumeInRenderer Before;
};

VTK_ABI_NAMESPACE_END

#endif
