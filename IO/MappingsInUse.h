// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MappingsInUse_h
#define MappingsInUse_h

#include "FileMapping.h"

#include <map>
#include <memory>
#include <mutex>

namespace ImageFiles
{

/// The mappings that arrays use. When the last copy of an array gives its memory back, all that VTK
/// tells is the address.
class MappingsInUse
{
public:
  static void* Keep(std::unique_ptr<FileMapping> mapping);

  /// The mapping whose bytes begin at an address; null if there is none. It lives as long as the
  /// array.
  static const FileMapping* Find(const void* bytes);

  static void GiveBack(void* bytes);

private:
  static MappingsInUse& GetAll();

  std::mutex Mutex;
  std::map<const void*, std::unique_ptr<FileMapping>> OfAddress;
};

}

#endif
