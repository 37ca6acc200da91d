// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FileMapping_h
#define FileMapping_h

#include "FileState.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace ImageFiles
{

/// The size of a file in bytes. Throws std::runtime_error if there is no file of this name.
std::int64_t GetSizeOfFile(const std::string& fileName);

/// Bytes of a file as memory: the system reads a page of them when it is first looked at, and may
/// drop it again. They are private: what is written to them does not go to the file.
class FileMapping
{
public:
  /// Throws std::runtime_error if the file ends before so many bytes, since looking at those beyond
  /// the end kills the process, or if the system does not map them.
  FileMapping(const std::string& fileName, std::int64_t offset, std::size_t size);
  ~FileMapping();
  FileMapping(const FileMapping&) = delete;
  FileMapping& operator=(const FileMapping&) = delete;

  void* GetBytes() const { return this->Bytes; }

  /// The file, by a name that any program knows it by, and the number of bytes before those that
  /// are mapped.
  const std::string& GetFileName() const { return this->FileName; }
  std::int64_t GetOffset() const { return this->Offset; }
  const FileState& GetState() const { return this->State; }

  /// Whether the bytes are known to be those that the file had when it was mapped: neither the file
  /// nor its name nor the bytes have changed.
  bool IsUnchanged() const;

private:
  std::string FileName;
  std::int64_t Offset;
  /// When it was mapped.
  FileState State;
  /// Pages, of which the bytes begin in the first.
  void* Pages = nullptr;
  std::size_t SizeOfPages = 0;
  void* Bytes = nullptr;
};

}

#endif
