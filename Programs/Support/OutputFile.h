// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef OutputFile_h
#define OutputFile_h

#include <cstddef>
#include <cstdio>
#include <deque>
#include <string>
#include <vector>

namespace Programs
{

/// A file that is whole or absent: it is written under another name beside its own, which it takes
/// when it is finished. Nothing is left of a file that is not, not even when a signal (Ctrl-C) ends
/// the program. A device or a pipe is written directly. All functions throw std::runtime_error with
/// the name of the file and the reason of the system. For one thread.
class OutputFile
{
public:
  /// Of more files that are open, and folders that were made, a signal leaves what is unfinished.
  static constexpr int MostAtATime = 16;

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

/// A folder for output, which is made if there is none, with those that it is in. Those that were
/// made and have nothing in them are removed in the end, or when a signal ends the program.
class OutputFolder
{
public:
  /// Before the files in it. Throws std::runtime_error if it cannot be made.
  explicit OutputFolder(const std::string& name);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

private:
  /// The outermost first.
  std::deque<std::string> Made;
};

/// Writes a whole file.
void WriteFile(const std::string& text, const std::string& fileName);

/// Tells before long work whether a file can be written; an existing one stays as it is.
void CheckOutput(const std::string& fileName);

/// Throws std::runtime_error if one of the files would replace another.
void CheckOutputsDiffer(const std::vector<std::string>& fileNames);

/// Whether a name is that of a device, a pipe or the like, which is written to but not replaced.
bool IsDevice(const std::string& fileName);

/// What is printed may be lost in a buffer: call this at the end of a program.
void FlushStandardOutput();

}

#endif
