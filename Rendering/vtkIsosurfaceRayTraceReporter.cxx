// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceReporter.h"

#include "vtkIsosurfaceRayTraceUse.h"

#include "vtkAbstractVolumeMapper.h"

#include <new>
#include <stdexcept>

VTK_ABI_NAMESPACE_BEGIN

namespace
{

/// Forgets what was reported, if that is of very many volumes, most of which may be gone.
template <typename Reports>
void Forget(Reports& reports)
{
  constexpr std::size_t many = 1000;
  if (reports.size() > many)
  {
    reports.clear();
  }
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceReporter::Scope::Scope(vtkIsosurfaceRayTraceReporter& reporter,
  const vtkIsosurfaceRayTraceUse& use, const vtkVolume* volume, const vtkRenderer* renderer)
  : Reporter(use.IsAllowed() ? &reporter : nullptr)
{
  if (this->Reporter)
  {
    this->Before = std::exchange(reporter.Reported, { volume, renderer });
  }
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceReporter::Scope::~Scope()
{
  if (this->Reporter)
  {
    this->Reporter->Reported = this->Before;
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceReporter::ReportOnce(const std::string& problem)
{
  Forget(this->ProblemsOf);
  // Before observers of the error come back here.
  const bool isNew = std::exchange(this->ProblemsOf[this->Reported], problem) != problem;
  if (isNew && !problem.empty())
  {
    vtkErrorWithObjectMacro(this->Mapper, << problem);
  }
  return !problem.empty();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceReporter::WarnOnce(const std::string& problem, Kind kind)
{
  Forget(this->WarningsOf);
  std::string& last = this->WarningsOf[this->Reported.first][static_cast<std::size_t>(kind)];
  const bool isNew = std::exchange(last, problem) != problem;
  if (isNew && !problem.empty())
  {
    vtkWarningWithObjectMacro(this->Mapper, << problem);
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceReporter::ReportException(const std::exception& exception) const
{
  const bool isOfMemory = dynamic_cast<const std::bad_alloc*>(&exception) ||
    dynamic_cast<const std::length_error*>(&exception);
  vtkErrorWithObjectMacro(
    this->Mapper, << (isOfMemory ? "There is not enough memory. " + std::string(this->MemoryRemedy)
                                 : std::string(exception.what())));
}

VTK_ABI_NAMESPACE_END
