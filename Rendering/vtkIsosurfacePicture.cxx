// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfacePicture.h"

#include "vtkIsosurfaceRayTraceImageDisplay.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPointData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include "Picture/Compositor.h"

#include <algorithm>
#include <array>
#include <new>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

vtkUnsignedCharArray* GetColors(vtkImageData* picture)
{
  return vtkUnsignedCharArray::SafeDownCast(picture->GetPointData()->GetArray("Colors"));
}

vtkFloatArray* GetDepths(vtkImageData* picture)
{
  return vtkFloatArray::SafeDownCast(picture->GetPointData()->GetArray("Depth"));
}

/// Whether a picture has all that RenderToImage writes of colours and depths.
bool HasArrays(vtkImageData* picture)
{
  const vtkUnsignedCharArray* colors = GetColors(picture);
  const vtkFloatArray* depths = GetDepths(picture);
  const vtkIdType pixels = picture->GetNumberOfPoints();
  return picture->GetDimensions()[2] == 1 && colors && depths &&
    colors->GetNumberOfComponents() == 4 && colors->GetNumberOfTuples() == pixels &&
    depths->GetNumberOfComponents() == 1 && depths->GetNumberOfTuples() == pixels;
}

/// Makes an image of the colours of a picture: convert(color, pixel) writes one of some components.
template <typename Convert>
bool ConvertColors(
  vtkImageData* picture, int components, const Convert& convert, vtkImageData* image)
{
  vtkUnsignedCharArray* colors = picture && image ? GetColors(picture) : nullptr;
  if (!colors || colors->GetNumberOfComponents() != 4 ||
    colors->GetNumberOfTuples() != picture->GetNumberOfPoints())
  {
    vtkGenericWarningMacro(
      "The picture has no point data Colors (4 components of unsigned char). Give one of "
      "RenderToImage, and an image for the result.");
    return false;
  }
  vtkNew<vtkUnsignedCharArray> converted;
  converted->SetName("Colors");
  converted->SetNumberOfComponents(components);
  try
  {
    converted->SetNumberOfTuples(colors->GetNumberOfTuples());
  }
  catch (const std::bad_alloc&)
  {
    vtkGenericWarningMacro("There is not enough memory for a copy of the picture.");
    return false;
  }
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    convert(colors->GetPointer(4 * i), converted->GetPointer(components * i));
  }
  if (image != picture)
  {
    image->Initialize();
    image->CopyStructure(picture);
  }
  image->GetPointData()->Initialize();
  image->GetPointData()->SetScalars(converted);
  return true;
}

}

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfacePicture);

//------------------------------------------------------------------------------
vtkIsosurfacePicture::vtkIsosurfacePicture()
  : Display(std::make_unique<vtkIsosurfaceRayTraceImageDisplay>())
{
  this->PickableOff();
}

//------------------------------------------------------------------------------
vtkIsosurfacePicture::~vtkIsosurfacePicture() = default;

//------------------------------------------------------------------------------
void vtkIsosurfacePicture::SetPicture(vtkImageData* picture)
{
  if (this->Picture != picture)
  {
    this->Picture = picture;
    this->UpdateTime = 0;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkImageData* vtkIsosurfacePicture::GetPicture()
{
  return this->Picture;
}

//------------------------------------------------------------------------------
bool vtkIsosurfacePicture::UnpremultiplyColors(vtkImageData* picture, vtkImageData* image)
{
  return ConvertColors(
    picture, 4,
    [](const unsigned char* color, unsigned char* pixel)
    {
      const int opacity = color[3];
      for (int i = 0; i < 3; ++i)
      {
        // Rounded to the nearest.
        const int whole = opacity > 0 ? (2 * 255 * color[i] + opacity) / (2 * opacity) : 0;
        pixel[i] = static_cast<unsigned char>(std::min(255, whole));
      }
      pixel[3] = color[3];
    },
    image);
}

//------------------------------------------------------------------------------
bool vtkIsosurfacePicture::FlattenColors(
  vtkImageData* picture, const double background[3], vtkImageData* image)
{
  return ConvertColors(
    picture, 3,
    [background](const unsigned char* color, unsigned char* pixel)
    {
      for (int i = 0; i < 3; ++i)
      {
        const double behind = (255 - color[3]) * std::clamp(background[i], 0.0, 1.0);
        pixel[i] =
          static_cast<unsigned char>(std::min(255, color[i] + static_cast<int>(behind + 0.5)));
      }
    },
    image);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkIsosurfacePicture::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Picture ? std::max(own, this->Picture->GetMTime()) : own;
}

//------------------------------------------------------------------------------
void vtkIsosurfacePicture::ShallowCopy(vtkProp* prop)
{
  if (auto* other = vtkIsosurfacePicture::SafeDownCast(prop))
  {
    this->SetPicture(other->GetPicture());
  }
  this->Superclass::ShallowCopy(prop);
}

//------------------------------------------------------------------------------
/// Finds what must be known of the picture. Returns whether there is one that can be drawn.
bool vtkIsosurfacePicture::Update()
{
  if (!this->Picture || this->Picture->GetNumberOfPoints() == 0)
  {
    return false;
  }
  if (this->UpdateTime >= this->Picture->GetMTime())
  {
    return this->IsComplete;
  }
  this->UpdateTime = this->Picture->GetMTime();
  this->IsComplete = HasArrays(this->Picture);
  if (!this->IsComplete)
  {
    vtkErrorMacro("The picture needs a single layer and the point data Colors (4 components of "
                  "unsigned char) and Depth (float). Give it one of RenderToImage.");
    return false;
  }
  const vtkFloatArray* depths = GetDepths(this->Picture);
  const unsigned char* colors = GetColors(this->Picture)->GetPointer(0);
  const vtkIdType pixels = this->Picture->GetNumberOfPoints();
  try
  {
    this->Depths.resize(static_cast<std::size_t>(pixels));
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("There is not enough memory for the depths of the picture. Make it smaller.");
    this->IsComplete = false;
    return false;
  }
  this->IsOpaque = true;
  // Its depths are those of the values, which hide nothing.
  const bool isProjection = this->Picture->GetPointData()->HasArray("Value") != 0;
  for (vtkIdType i = 0; i < pixels; ++i)
  {
    const float depth = isProjection ? 1.0F : depths->GetValue(i);
    const unsigned char opacity = colors[4 * i + 3];
    this->Depths[static_cast<std::size_t>(i)] = depth < 1.0F ? depth : vtkirt::PixelWithoutDepth;
    this->IsOpaque = this->IsOpaque && (opacity == 0 || (opacity == 255 && depth < 1.0F));
  }
  return true;
}

//------------------------------------------------------------------------------
int vtkIsosurfacePicture::RenderOpaqueGeometry(vtkViewport* viewport)
{
  return this->Update() && this->IsOpaque ? this->Draw(viewport) : 0;
}

//------------------------------------------------------------------------------
int vtkIsosurfacePicture::RenderVolumetricGeometry(vtkViewport* viewport)
{
  return this->Update() && !this->IsOpaque ? this->Draw(viewport) : 0;
}

//------------------------------------------------------------------------------
int vtkIsosurfacePicture::Draw(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  auto* window =
    renderer ? vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()) : nullptr;
  if (!window)
  {
    return 0;
  }
  const std::array<int, 4> place = vtkIsosurfaceRayTraceImageDisplay::GetViewport(window);
  const int* size = this->Picture->GetDimensions();
  this->Display->Display(window,
    { place[0], place[1], place[2], place[3], size[0], size[1],
      GetColors(this->Picture)->GetPointer(0), this->Depths.data(), this->IsOpaque, false },
    nullptr);
  return 1;
}

//------------------------------------------------------------------------------
void vtkIsosurfacePicture::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Display->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkIsosurfacePicture::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Picture: " << this->Picture.Get() << "\n";
}

VTK_ABI_NAMESPACE_END
