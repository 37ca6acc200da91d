// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfacePicker
 * @brief   pick the isosurface that a mapper of this module draws
 *
 * VTK's own pickers treat a volume as a cloud, and pick where its opacity passes a threshold. This
 * picker picks the isosurface: for a pixel of the window, Pick returns what the mapper draws there,
 * to the last bit. Pick3DRay and Pick3DPoint return what IntersectWithLine of
 * vtkIsosurfaceRayTraceMapper returns. Clipping planes, cropping, the matrix of the volume and the
 * choice of scalars are respected as in the picture.
 *
 * The results of a pick are:
 * - GetPickPosition: the position on the surface
 * - GetPickNormal: the normal of the surface, towards smaller values, by the mapper's NormalMode;
 *   for a cap (see the mapper's CapClippingPlanes), the normal of its plane
 * - GetIsovalue: the isovalue of the surface
 * - GetCellId, GetPCoords, GetCellIJK and GetPointId: those of the image, or of the mesh, which has
 *   no GetCellIJK
 * - GetCompositeDataSet, GetFlatBlockIndex and GetDataSet: the block of composite input, within
 *   which cells and points are numbered
 *
 * Other props are picked as by vtkVolumePicker, at the centre of the pixel. The nearest of all
 * props is picked.
 *
 * @sa vtkIsosurfaceRayTraceMapper vtkIsosurfaceRayTraceMeshMapper vtkVolumePicker vtkCellPicker
 */

#ifndef vtkIsosurfacePicker_h
#define vtkIsosurfacePicker_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingModule.h" // for export macro
#include "vtkVolumePicker.h"

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTraceEngine;
class vtkVolume;

class VTKISOSURFACERAYTRACING_EXPORT vtkIsosurfacePicker : public vtkVolumePicker
{
public:
  static vtkIsosurfacePicker* New();
  vtkTypeMacro(vtkIsosurfacePicker, vtkVolumePicker);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Get the isovalue of the surface that was picked; NaN if no surface was picked.
   */
  vtkGetMacro(Isovalue, double);

  using vtkVolumePicker::Pick;

  /**
   * Picks at a pixel of the window, counted from the lower left. Returns 1 if something was picked.
   */
  int Pick(double selectionX, double selectionY, double selectionZ, vtkRenderer* renderer) override;

protected:
  vtkIsosurfacePicker();
  ~vtkIsosurfacePicker() override;

  void Initialize() override;
  void ResetPickInfo() override;
  double IntersectWithLine(const double p1[3], const double p2[3], double tol,
    vtkAssemblyPath* path, vtkProp3D* prop, vtkAbstractMapper3D* mapper) override;
  double IntersectVolumeWithLine(const double p1[3], const double p2[3], double t1, double t2,
    vtkProp3D* prop, vtkAbstractVolumeMapper* mapper) override;

private:
  vtkIsosurfacePicker(const vtkIsosurfacePicker&) = delete;
  void operator=(const vtkIsosurfacePicker&) = delete;

  struct SurfaceHit;

  bool FindHit(vtkIsosurfaceRayTraceEngine& engine, vtkVolume* volume, const double p1[3],
    const double p2[3], SurfaceHit& hit);
  void SetPickInfo(
    vtkAbstractVolumeMapper* mapper, const SurfaceHit& hit, const double position[3]);

  double Isovalue;
  /// Of the last surface found, in world coordinates.
  double SurfacePosition[3];
  double SurfaceNormal[3];
  /// The pixel to pick at; none for Pick3DRay and Pick3DPoint.
  bool IsPixel = false;
  int Pixel[2];
};

VTK_ABI_NAMESPACE_END

#endif
