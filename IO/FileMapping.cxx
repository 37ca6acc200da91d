// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "FileMapping.h"

#include "OwnPages.h"

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#ifndef _WIN32
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace ImageFiles
{
namespace
{

[[noreturn]] void Throw(const std::string& fileName, const std::string& problem)
{
  throw std::runtime_error(fileName + " cannot be mapped: " + problem);
}

}

#ifndef _WIN32

namespace
{

class OpenFile
{
public:
  explicit OpenFile(const std::string& fileName)
    : FileName(fileName)
    , Descriptor(open(fileName.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK))
  {
    if (this->Descriptor < 0)
    {
      Throw(fileName, std::generic_category().message(errno));
    }
  }
  ~OpenFile() { close(this->Descriptor); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int Get() const { return this->Descriptor; }

  FileState GetState() const
  {
    const std::optional<FileState> state = FindFileState(this->Descriptor);
    if (!state)
    {
      Throw(this->FileName, "it is not a file");
    }
    return *state;
  }

private:
  std::string FileName;
  int Descriptor;
};

}

//------------------------------------------------------------------------------
std::int64_t GetSizeOfFile(const std::string& fileName)
{
  return OpenFile(fileName).GetState().Size;
}

//------------------------------------------------------------------------------
FileMapping::FileMapping(const std::string& fileName, std::int64_t offset, std::size_t size)
  : Offset(offset)
{
  const OpenFile file(fileName);
  std::error_code error;
  this->FileName = std::filesystem::canonical(fileName, error).string();
  this->State = file.GetState();
  const std::int64_t sizeOfFile = this->State.Size;
  if (offset < 0 || offset > sizeOfFile || size > static_cast<std::uint64_t>(sizeOfFile - offset))
  {
    Throw(fileName, "it has become shorter since its header was read");
  }
  const std::int64_t inPage = offset % sysconf(_SC_PAGESIZE);
  this->SizeOfPages = size + static_cast<std::size_t>(inPage);
  // Without reserve: else systems refuse more than they have memory for, as if all were written to.
  this->Pages = mmap(nullptr, this->SizeOfPages, PROT_READ | PROT_WRITE,
    MAP_PRIVATE | MAP_NORESERVE, file.Get(), offset - inPage);
  if (this->Pages == MAP_FAILED)
  {
    Throw(fileName,
      std::generic_category().message(errno) +
        ". Give the process more address space (ulimit -v), or let the system overcommit memory "
        "(vm.overcommit_memory).");
  }
  this->Bytes = static_cast<char*>(this->Pages) + inPage;
}

//------------------------------------------------------------------------------
bool FileMapping::IsUnchanged() const
{
  const std::optional<FileState> state = FindFileState(this->FileName);
  return state && *state == this->State && AreAllOfFile(this->Pages, this->SizeOfPages);
}

//------------------------------------------------------------------------------
FileMapping::~FileMapping()
{
  munmap(this->Pages, this->SizeOfPages);
}

#else

//------------------------------------------------------------------------------
std::int64_t GetSizeOfFile(const std::string& fileName)
{
  Throw(fileName, "there is no code for this system yet");
}

//------------------------------------------------------------------------------
FileMapping::FileMapping(const std::string& fileName, std::int64_t, std::size_t)
{
  Throw(fileName, "there is no code for this system yet");
}

//------------------------------------------------------------------------------
bool FileMapping::IsUnchanged() const
{
  return false;
}

//------------------------------------------------------------------------------
FileMapping::~FileMapping() = default;

#endif

}
