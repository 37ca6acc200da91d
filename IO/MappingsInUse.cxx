// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "MappingsInUse.h"

#include <utility>

namespace ImageFiles
{

//------------------------------------------------------------------------------
void* MappingsInUse::Keep(std::unique_ptr<FileMapping> mapping)
{
  void* bytes = mapping->GetBytes();
  const std::lock_guard<std::mutex> lock(GetAll().Mutex);
  GetAll().OfAddress[bytes] = std::move(mapping);
  return bytes;
}

//------------------------------------------------------------------------------
const FileMapping* MappingsInUse::Find(const void* bytes)
{
  const std::lock_guard<std::mutex> lock(GetAll().Mutex);
  const auto found = GetAll().OfAddress.find(bytes);
  return found != GetAll().OfAddress.end() ? found->second.get() : nullptr;
}

//------------------------------------------------------------------------------
void MappingsInUse::GiveBack(void* bytes)
{
  const std::lock_guard<std::mutex> lock(GetAll().Mutex);
  GetAll().OfAddress.erase(bytes);
}

//------------------------------------------------------------------------------
MappingsInUse& MappingsInUse::GetAll()
{
  // Never destroyed: arrays may be given back after all static objects.
  static auto* all = new MappingsInUse;
  return *all;
}

}
