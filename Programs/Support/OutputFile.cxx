// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "OutputFile.h"

#include <vtksys/SystemInformation.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <system_error>

namespace Programs
{
namespace
{

namespace fs = std::filesystem;

[[noreturn]] void Throw(const std::string& name)
{
  throw std::runtime_error(name + " cannot be written: " + std::strerror(errno));
}

//------------------------------------------------------------------------------
/// The files and folders to remove if a signal ends the program: folders before what is in them.
std::array<std::atomic<const char*>, OutputFile::MostAtATime> ToRemove = {};
static_assert(
  std::atomic<const char*>::is_always_lock_free, "or a signal handler must not read it");

extern "C" void RemoveUnfinished(int signal)
{
  for (auto name = ToRemove.rbegin(); name != ToRemove.rend(); ++name)
  {
    if (name->load())
    {
      std::remove(name->load());
    }
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

//------------------------------------------------------------------------------
/// Puts a name (or nullptr) into the place of another.
void ReplaceToRemove(const char* old, const char* name)
{
  const auto place = std::find(ToRemove.begin(), ToRemove.end(), old);
  if (place != ToRemove.end())
  {
    place->store(name);
  }
}

//------------------------------------------------------------------------------
void RemoveAtSignals(const char* name)
{
  ReplaceToRemove(nullptr, name);
  for (const int signal : {
         SIGINT,
         SIGTERM,
#ifdef SIGHUP
         SIGHUP,
#endif
       })
  {
    if (std::signal(signal, RemoveUnfinished) == SIG_IGN)
    {
      std::signal(signal, SIG_IGN); // nohup
    }
  }
}

//------------------------------------------------------------------------------
/// Follows symbolic links, so that the file is replaced and not the link.
std::string FindTarget(const std::string& name)
{
  std::error_code error;
  const fs::path target = fs::canonical(name, error);
  return error ? name : target.string();
}
}

//------------------------------------------------------------------------------
bool IsDevice(const std::string& fileName)
{
  std::error_code error;
  return fs::is_other(fileName, error);
}

//------------------------------------------------------------------------------
OutputFile::OutputFile(const std::string& name)
  : Name(name)
  , Target(FindTarget(name))
  , Unfinished(this->Target)
{
  if (!IsDevice(this->Target))
  {
    using vtksys::SystemTools;
    if (SystemTools::FileIsDirectory(this->Target))
    {
      errno = EISDIR;
      Throw(this->Name);
    }
    // Taking its name would replace a file that is protected.
    if (SystemTools::FileExists(this->Target) &&
      !SystemTools::TestFileAccess(this->Target, vtksys::TEST_FILE_WRITE))
    {
      Throw(this->Name);
    }
    vtksys::SystemInformation system;
    this->Unfinished += "." + std::to_string(system.GetProcessId()) + ".part";
    RemoveAtSignals(this->Unfinished.c_str());
  }
  this->File = std::fopen(this->Unfinished.c_str(), "wb");
  if (!this->File)
  {
    ReplaceToRemove(this->Unfinished.c_str(), nullptr);
    Throw(this->Name);
  }
}

//------------------------------------------------------------------------------
OutputFile::~OutputFile()
{
  if (this->File)
  {
    std::fclose(this->File);
  }
  if (!this->IsFinished && this->Unfinished != this->Target)
  {
    std::remove(this->Unfinished.c_str());
    ReplaceToRemove(this->Unfinished.c_str(), nullptr);
  }
}

//------------------------------------------------------------------------------
void OutputFile::Write(const void* bytes, std::size_t count)
{
  // A full disk is told now, not when the file is finished.
  if (std::fwrite(bytes, 1, count, this->File) != count || std::fflush(this->File) != 0)
  {
    Throw(this->Name);
  }
}

//------------------------------------------------------------------------------
void OutputFile::Finish()
{
  std::FILE* file = this->File;
  this->File = nullptr;
  if (std::fclose(file) != 0)
  {
    Throw(this->Name);
  }
  if (this->Unfinished != this->Target)
  {
    std::error_code error;
    fs::rename(this->Unfinished, this->Target, error);
    if (error)
    {
      throw std::runtime_error(this->Name + " cannot be written: " + error.message());
    }
    ReplaceToRemove(this->Unfinished.c_str(), nullptr);
  }
  this->IsFinished = true;
}

//------------------------------------------------------------------------------
OutputFolder::OutputFolder(const std::string& name)
{
  std::error_code error;
  for (fs::path path = fs::absolute(name); !fs::exists(path, error) && path.has_relative_path();
       path = path.parent_path())
  {
    this->Made.push_front(path.string());
  }
  if (!vtksys::SystemTools::MakeDirectory(name))
  {
    throw std::runtime_error("the folder " + name + " cannot be created");
  }
  for (const std::string& folder : this->Made)
  {
    RemoveAtSignals(folder.c_str());
  }
}

//------------------------------------------------------------------------------
OutputFolder::~OutputFolder()
{
  for (auto folder = this->Made.rbegin(); folder != this->Made.rend(); ++folder)
  {
    ReplaceToRemove(folder->c_str(), nullptr);
    std::remove(folder->c_str()); // It stays if there is something in it.
  }
}

//------------------------------------------------------------------------------
void WriteFile(const std::string& text, const std::string& fileName)
{
  OutputFile file(fileName);
  file.Write(text.data(), text.size());
  file.Finish();
}

//------------------------------------------------------------------------------
void CheckOutput(const std::string& fileName)
{
  const OutputFile file(fileName);
}

//------------------------------------------------------------------------------
void CheckOutputsDiffer(const std::vector<std::string>& fileNames)
{
  std::set<fs::path> targets;
  for (const std::string& fileName : fileNames)
  {
    if (!IsDevice(fileName) && !targets.insert(fs::weakly_canonical(fileName)).second)
    {
      throw std::runtime_error(fileName + " is to be written twice: give another name");
    }
  }
}

//------------------------------------------------------------------------------
void FlushStandardOutput()
{
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
  {
    Throw("the standard output");
  }
}

}
