// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef OutputFile_h
#define OutputFile_h

#include <cstddef>
#include <cstdio>
#include <string>

namespace Programs
{

/// A file that is whole or absent: it is written under another name beside its own, which it takes
/// when it is finished. Nothing is left of a file that is not, not even when a signal (Ctrl-C) ends
/// the program. A device or a pipe is written directly. All functions throw std::runtime_error with
/// the name of the file and the reason of the system. For one thread.
class OutputFile
{
public:
  /// Of more files that are open, a signal leaves what is unfinished.
  static constexpr int MostAtATime = 4;

  explicit OutputFile(const std::string& name);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void Write(const void* bytes, std::size_t count);
  void Finish();

private:
  std::string Name;
  /// The file behind symbolic links, and its name while it is written.
  std::string Target;
  std::string Unfinished;
  std::FILE* File = nullptr;
  bool IsFinished = false;
};

/// Writes a whole file.
void WriteFile(const std::string& text, const std::string& fileName);

/// Tells before long work whether a file can be written; an existing one stays as it is.
void CheckOutput(const std::string& fileName);

/// Whether a name is that of a device, a pipe or the like, which is written to but not replaced.
bool IsDevice(const std::string& fileName);

/// What is printed may be lost in a buffer: call this at the end of a program.
void FlushStandardOutput();

}

#endif
