// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FilePages_h
#define FilePages_h

#include "Image/Samples/VolumeView.h"

namespace vtkIsosurfaceRayTracing
{

enum class Reading
{
  InOrder,
  /// A few samples here, a few there. Else the system reads with each page those around it, up to
  /// megabytes, and where memory is short drops pages for them that rays will come back to.
  Scattered
};

/// Tells the system how bytes of a mapped file will be read, whose pages it reads when they are
/// first looked at. It may ignore that.
void ExpectReading(Reading reading, const void* begin, const void* end);

/// Has the system read pieces of a mapped file soon, at once and in order, instead of page by page
/// when they are looked at. It may ignore that.
class PagesAhead
{
public:
  PagesAhead() = default;
  ~PagesAhead() { this->Ask(); }
  PagesAhead(const PagesAhead&) = delete;
  PagesAhead& operator=(const PagesAhead&) = delete;

  /// Adds bytes that lie behind those before. Where a few pages are between them, these are read
  /// too.
  void Add(const void* begin, const void* end);

private:
  void Ask();

  const char* Begin = nullptr;
  const char* End = nullptr;
};

/// Tells of all samples, if they are in a file, how they will be read.
template <typename T>
void ExpectReading(Reading reading, const Samples<T>& samples)
{
  if (samples.AreInFile())
  {
    const Index3& dimensions = samples.GetDimensions();
    const Index3 last = { dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1 };
    ExpectReading(reading, samples.At({ 0, 0, 0 }), samples.At(last) + 1);
  }
}

}

#endif
