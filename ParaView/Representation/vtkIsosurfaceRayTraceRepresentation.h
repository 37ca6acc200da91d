// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceRepresentation
 * @brief   show isosurfaces in ParaView by vtkIsosurfaceRayTraceMapper
 *
 * Shows the isosurfaces of images, rectilinear grids, structured and unstructured grids, AMR and
 * composite data of them, ray traced where the data are: on the processes of the server, if there
 * is one.
 *
 * On several processes each traces its piece. One layer of ghost cells is requested (two where
 * samples further away are needed: tricubic interpolation, scalars of cells), so that surfaces and
 * normals go on from piece to piece. Pictures of opaque surfaces are composited by depth, whatever
 * the shape of the pieces; translucent ones in the order of the bounds of the pieces, without
 * ghosts. Where such bounds overlap there is no order: then vtkIsosurfaceRayTraceCompositor makes
 * one picture, pixel by pixel, which process 0 shows. It makes one of all representations of the
 * view, too, where they are in each other and translucent. Rays of shadows and of ambient occlusion
 * know the piece of their process alone, which one warning says.
 *
 * @sa vtkIsosurfaceRayTraceMapper vtkIsosurfaceVolume
 */

#ifndef vtkIsosurfaceRayTraceRepresentation_h
#define vtkIsosurfaceRayTraceRepresentation_h

#include "vtkIsosurfaceRayTraceBlockStyles.h"      // for ivars
#include "vtkIsosurfaceRayTraceSharedPicture.h"    // for ivars
#include "vtkIsosurfaceRayTracingCompat.h"         // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingParaViewModule.h" // for export macro
#include "vtkNew.h"                                // for ivars
#include "vtkPVDataRepresentation.h"
#include "vtkSmartPointer.h" // for ivars
#include "vtkTimeStamp.h"    // for ivars

#include <string> // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkColorTransferFunction;
class vtkCompositeDataDisplayAttributes;
class vtkDataObject;
class vtkIsosurfaceRayTraceMapper;
class vtkIsosurfaceRayTraceRefinement;
class vtkIsosurfaceVolume;
class vtkPVPlane;
class vtkPiecewiseFunction;
class vtkPlane;

class VTKISOSURFACERAYTRACINGPARAVIEW_EXPORT vtkIsosurfaceRayTraceRepresentation
  : public vtkPVDataRepresentation
{
public:
  static vtkIsosurfaceRayTraceRepresentation* New();
  vtkTypeMacro(vtkIsosurfaceRayTraceRepresentation, vtkPVDataRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int ProcessViewRequest(vtkInformationRequestKey*, vtkInformation*, vtkInformation*) override;

  ///@{
  /**
   * Set the array whose isosurfaces are shown (of index 0), and which of its components: the number
   * of components means the magnitude of the vector. Defaults: none, and component 0.
   */
  using Superclass::SetInputArrayToProcess;
  void SetInputArrayToProcess(
    int index, int port, int connection, int association, const char* name) override;
  void SetComponent(int component);
  ///@}

  ///@{
  /**
   * Set the isovalues.
   */
  void SetNumberOfIsovalues(int number);
  void SetIsovalue(int index, double value);
  ///@}

  ///@{
  /**
   * Set the colours: by the lookup table of an array of points or cells, or, without a name, one
   * colour. Where it is the contoured array, a surface has the colour of its isovalue.
   */
  void SetColorArray(int index, int port, int connection, int association, const char* name);
  void SetLookupTable(vtkColorTransferFunction* colors);
  void SetDiffuseColor(double red, double green, double blue);
  ///@}

  ///@{
  /**
   * Set the opacity of all surfaces, or whether each has that of its isovalue by the opacity
   * function of the lookup table (that of the contoured array: it has no effect while surfaces are
   * coloured otherwise). Defaults: 1 and off.
   */
  void SetOpacity(double opacity);
  void SetUseOpacityFunction(bool use);
  ///@}

  ///@{
  /**
   * Set which blocks of multiblock data and of collections of partitioned data sets are visible,
   * and their own colours and opacities, which all their surfaces have in place of those above: by
   * selectors, as of vtkDataAssembly. Defaults: all ("/"), and none.
   */
  void AddBlockSelector(const char* selector);
  void RemoveAllBlockSelectors();
  void SetBlockColor(const char* selector, double red, double green, double blue);
  void RemoveAllBlockColors();
  void SetBlockOpacity(const char* selector, double opacity);
  void RemoveAllBlockOpacities();
  ///@}

  ///@{
  /**
   * Set the material, by the names of vtkVolumeProperty.
   */
  void SetShade(bool shade);
  void SetAmbient(double ambient);
  void SetDiffuse(double diffuse);
  void SetSpecular(double specular);
  void SetSpecularPower(double power);
  ///@}

  ///@{
  /**
   * Settings of vtkIsosurfaceRayTraceMapper.
   */
  void SetInterpolationMode(int mode);
  void SetNormalMode(int mode);
  void SetShadows(bool on);
  void SetAmbientOcclusion(bool on);
  void SetProgressiveAccumulation(bool on);
  void SetCapClippingPlanes(bool on);
  ///@}

  /**
   * Set the plane that the surfaces are cut by; null cuts nothing. Default: null.
   */
  void SetClippingPlane(vtkPVPlane* plane);

  ///@{
  /**
   * Set the distance between neighbouring rays in pixels, in still pictures and while interacting:
   * vtkIsosurfaceRayTraceMapper::SetImageSampleDistance. Defaults: 1 and 2.
   */
  void SetImageSampleDistance(double distance);
  void SetInteractiveImageSampleDistance(double distance);
  ///@}

  ///@{
  /**
   * Set where the data are shown, by the names of vtkProp3D.
   */
  void SetVisibility(bool visible) override;
  void SetPosition(double x, double y, double z);
  void SetScale(double x, double y, double z);
  void SetOrientation(double x, double y, double z);
  void SetOrigin(double x, double y, double z);
  void SetPickable(bool pickable);
  ///@}

protected:
  vtkIsosurfaceRayTraceRepresentation();
  ~vtkIsosurfaceRayTraceRepresentation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkIsosurfaceRayTraceRepresentation(const vtkIsosurfaceRayTraceRepresentation&) = delete;
  void operator=(const vtkIsosurfaceRayTraceRepresentation&) = delete;

  void ReportMissingArray();
  int GetNumberOfGhostLevels();
  int GetContourAssociation();
  std::string GetContourArrayName();
  bool IsColoredByContourArray();
  bool IsOpaque();
  void DescribePiece(vtkInformation* in, vtkInformation* out);
  void PrepareToRender(vtkInformation* in);
  void ContinueRefinement();
  void SetInput(vtkDataObject* piece);
  void UpdateMapper();
  void UpdateColors();
  void UpdateClippingPlane();
  void WarnOfSecondaryRays();

  vtkNew<vtkIsosurfaceRayTraceMapper> Mapper;
  vtkNew<vtkIsosurfaceVolume> Volume;
  vtkSmartPointer<vtkDataObject> OwnPiece;
  vtkSmartPointer<vtkDataObject> Piece; // the same, or with blocks of other processes
  bool IsPieceNew = false;
  vtkIsosurfaceRayTraceBlockStyles BlockStyles;
  vtkTimeStamp BlockStylesTime;
  vtkNew<vtkCompositeDataDisplayAttributes> BlocksOfPiece; // by which its bounds are found
  vtkNew<vtkCompositeDataDisplayAttributes> BlocksOfMapper;
  double OwnBounds[6];
  vtkSmartPointer<vtkIsosurfaceRayTraceSharedPicture> SharedPicture; // with others of the view
  vtkIsosurfaceRayTraceSharedPicture::Member Shown;
  vtkNew<vtkIsosurfaceRayTraceRefinement> Refinement;
  unsigned long Observer = 0;
  int NumberOfComponents = 0; // of the array, in whichever process has it
  int Component = 0;
  int ColorAssociation = -1;
  std::string ColorArrayName;
  vtkSmartPointer<vtkColorTransferFunction> LookupTable;
  vtkNew<vtkColorTransferFunction> OneColor;
  vtkNew<vtkPiecewiseFunction> OneOpacity;
  bool UseOpacityFunction = false;
  vtkSmartPointer<vtkPVPlane> ClippingPlane;
  vtkNew<vtkPlane> PlaneOfMapper; // moved by the offset of the other
  double ImageSampleDistance = 1.0;
  double InteractiveImageSampleDistance = 2.0;
  bool HasWarnedOfSecondaryRays = false;
};

VTK_ABI_NAMESPACE_END

#endif
