// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FileState_h
#define FileState_h

#include <cstdint>
#include <optional>
#include <string>

namespace ImageFiles
{

/// What tells a file from those that had its name before, or will have it. Times are in nanoseconds
/// since 1970. That of the last change of anything, which no program sets, tells files that were
/// renamed, or given the time of another, from what they were.
struct FileState
{
  std::int64_t Size;
  /// Of the file in its file system.
  std::int64_t Number;
  std::int64_t Modified;
  std::int64_t Changed;

  bool operator==(const FileState& other) const
  {
    return this->Size == other.Size && this->Number == other.Number &&
      this->Modified == other.Modified && this->Changed == other.Changed;
  }

  /// Whether a change of the file from now on would change its times. The clocks of file systems
  /// have steps, of up to two seconds.
  bool IsSettled() const;
};

/// None if there is no file of this name, only a folder, a pipe and so on.
std::optional<FileState> FindFileState(const std::string& fileName);

/// The same of a file that is open.
std::optional<FileState> FindFileState(int descriptor);

}

#endif
