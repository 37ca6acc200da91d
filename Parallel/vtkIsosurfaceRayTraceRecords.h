// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What processes send each other of the pixels of a picture: made of what their mappers give, and
// turned into pixels.

#ifndef vtkIsosurfaceRayTraceRecords_h
#define vtkIsosurfaceRayTraceRecords_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Picture/Compositor.h"

#include <cstdint> // for std::uint32_t
#include <tuple>   // for std::tie
#include <vector>  // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkImageData;
class vtkTable;

namespace vtkIsosurfaceRayTraceRecords
{

/// What is sent of a pixel where all surfaces are opaque.
struct OpaquePixel
{
  double T;
  std::uint32_t Pixel;
  vtkIsosurfaceRayTracing::CompositedPixel Shown;

  double GetOpacity() const { return 1.0; }
  auto GetOrder() const { return std::tie(this->Pixel, this->T); }
};

/// What is sent of the extreme value of a pixel. The most extreme one comes first, and hides the
/// others; of equal ones the nearest does.
struct ProjectedPixel
{
  /// Of a maximum minus the value.
  double Rank;
  std::uint32_t Pixel;
  vtkIsosurfaceRayTracing::CompositedPixel Shown;

  double GetOpacity() const { return 1.0; }
  auto GetOrder() const { return std::tie(this->Pixel, this->Rank, this->Shown.Depth); }
};

/// What is sent of a fragment, translucent or not. Colours are not rounded on the way, so that it
/// does not matter which process composites them.
struct SentFragment
{
  double T;
  double Color[3];
  double Opacity;
  std::uint32_t Pixel;
  float Depth;

  double GetOpacity() const { return this->Opacity; }
  auto GetOrder() const { return std::tie(this->Pixel, this->T); }
};

/// Whether the fragments of RenderToFragments are opaque.
bool AreOpaque(vtkTable* fragments);

/// A record of each: OpaquePixel or SentFragment.
template <typename Record>
std::vector<Record> Make(vtkTable* fragments);

/// Those of the extreme values that a mapper has found, times a sign.
std::vector<ProjectedPixel> MakeOfValues(vtkTable* fragments, double sign);

/// Those of the pixels of a picture that show anything.
std::vector<OpaquePixel> MakeOfPicture(vtkImageData* picture);

///@{
/// Composites the records of one pixel, front to back. The fragments are memory for any use.
template <typename Record>
vtkIsosurfaceRayTracing::CompositedPixel Composite(
  const Record* first, const Record* /*end*/, std::vector<vtkIsosurfaceRayTracing::Fragment>&)
{
  return first->Shown;
}
vtkIsosurfaceRayTracing::CompositedPixel Composite(const SentFragment* first,
  const SentFragment* end, std::vector<vtkIsosurfaceRayTracing::Fragment>& fragments);
///@}

}

VTK_ABI_NAMESPACE_END

#endif
