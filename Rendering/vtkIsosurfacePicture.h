// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfacePicture
 * @brief   a picture of isosurfaces, with its depth, among the props of a renderer
 *
 * Shows what vtkIsosurfaceRayTraceMapper::RenderToImage or vtkIsosurfaceRayTraceCompositor has made
 * for the camera of the renderer. Other props are in front of or behind its opaque surfaces by
 * depth. This is how a picture of data that are distributed over many processes is drawn into the
 * window of one of them:
 *
 * @code
 * renderer->ResetCameraClippingRange(bounds); // of the whole data and of the other props
 * compositor->BroadcastCamera(renderer->GetActiveCamera());
 * compositor->RenderToImage(volume, renderer->GetActiveCamera(), lights, width, height, image);
 * picture->SetPicture(image); // in the process of the window
 * window->Render();
 * @endcode
 *
 * The picture covers the viewport of the renderer: it should have the same size, and is otherwise
 * stretched. It must have been made with the clipping range that the camera has when the picture is
 * drawn. Renderers do not change this range in Render(), but vtkRenderWindowInteractor does after
 * each interaction: make the picture after that (vtkCommand::StartEvent of the window).
 *
 * A picture whose pixels are all opaque or empty is drawn with the opaque geometry. Any other
 * picture is drawn after translucent geometry, as volumes are, over everything that is not nearer
 * than its opaque surfaces: it should show only what is in front of the opaque geometry.
 * RenderToImage ends its rays there if it is given the depths of the scene, in the process of the
 * window:
 *
 * @code
 * picture->VisibilityOff();
 * window->Render();
 * window->GetZbufferData(0, 0, width - 1, height - 1, depths); // a vtkFloatArray
 * picture->VisibilityOn();
 * compositor->RenderToImage(volume, camera, lights, width, height, image, depths);
 * @endcode
 *
 * A projection has no depth: it is drawn over everything else. If it was made with the depths, what
 * it shows ends at the opaque geometry.
 *
 * Translucent props between translucent surfaces look as if they were behind them: a pixel of the
 * picture has one colour for all of its surfaces.
 *
 * The prop has no bounds, and cannot be picked.
 *
 * The colours of these pictures are multiplied by their opacity, which file formats do not expect.
 * To write a picture to a file, convert it with UnpremultiplyColors or FlattenColors:
 *
 * @code
 * mapper->RenderToImage(volume, camera, lights, width, height, image);
 * vtkIsosurfacePicture::UnpremultiplyColors(image, transparent);
 * writer->SetInputData(transparent); // a vtkPNGWriter
 * @endcode
 *
 * @sa vtkIsosurfaceRayTraceMapper vtkIsosurfaceRayTraceCompositor
 */

#ifndef vtkIsosurfacePicture_h
#define vtkIsosurfacePicture_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingModule.h" // for export macro
#include "vtkProp.h"
#include "vtkSmartPointer.h" // for ivars

#include <memory> // for std::unique_ptr
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkImageData;
class vtkIsosurfaceRayTraceImageDisplay;

class VTKISOSURFACERAYTRACING_EXPORT vtkIsosurfacePicture : public vtkProp
{
public:
  static vtkIsosurfacePicture* New();
  vtkTypeMacro(vtkIsosurfacePicture, vtkProp);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/Get the picture: an image of one layer with the point data Colors and Depth of
   * vtkIsosurfaceRayTraceMapper::RenderToImage. Call Modified() of the picture after a change of
   * its arrays. Nothing is drawn if it is null or empty; that is the default.
   */
  void SetPicture(vtkImageData* picture);
  vtkImageData* GetPicture();
  ///@}

  ///@{
  /**
   * Converts a picture that RenderToImage has made to an image for a file: either with a
   * transparent background (red, green, blue and opacity; the colours are not multiplied by the
   * opacity), or over a background of one colour (red, green and blue from 0 to 1). The scalars are
   * of type unsigned char. Returns whether there is an image; if not, a warning says what the
   * picture lacks.
   */
  static bool UnpremultiplyColors(vtkImageData* picture, vtkImageData* image);
  static bool FlattenColors(vtkImageData* picture, const double background[3], vtkImageData* image);
  ///@}

  /**
   * Returns the time of the last change of the prop or of its picture.
   */
  vtkMTimeType GetMTime() override;

  /**
   * Copies another vtkIsosurfacePicture; the picture is shared.
   */
  void ShallowCopy(vtkProp* prop) override;

  ///@{
  /**
   * WARNING: INTERNAL METHOD - NOT INTENDED FOR GENERAL USE
   * Draw the picture, in the one of the two passes that suits it.
   */
  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderVolumetricGeometry(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  ///@}

protected:
  vtkIsosurfacePicture();
  ~vtkIsosurfacePicture() override;

private:
  vtkIsosurfacePicture(const vtkIsosurfacePicture&) = delete;
  void operator=(const vtkIsosurfacePicture&) = delete;

  bool Update();
  int Draw(vtkViewport* viewport);

  vtkSmartPointer<vtkImageData> Picture;
  /// What is known of the picture as it was at a time: whether it can be drawn, whether it is
  /// opaque or empty everywhere, and the depths, where nothing is opaque greater than 1.
  vtkMTimeType UpdateTime = 0;
  bool IsComplete = false;
  bool IsOpaque = false;
  std::vector<float> Depths;
  std::unique_ptr<vtkIsosurfaceRayTraceImageDisplay> Display;
};

VTK_ABI_NAMESPACE_END

#endif
