// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCellProjectionMapper
 * @brief   volume rendering of meshes by cell projection, on the CPU
 *
 * Draws a mesh by direct volume rendering, as a cloud: each point emits and absorbs light by the
 * colour and opacity transfer functions of the property. Isosurfaces may be in the cloud, opaque or
 * translucent (DrawIsosurfaces). Images, rectilinear grids and AMR data, alone or among blocks and
 * connections, have isosurfaces there, but no cloud: vtkAppendFilter makes a mesh of them.
 *
 * Every cell is projected to the pixels that it covers. In a tetrahedron the values are linear
 * along a ray, and so are the transfer functions between two of their nodes: the light of each such
 * step is integrated to about 1e-6, whatever the size of the cells is; there are no samples, and so
 * no sample distance. Functions that are not linear between their nodes (midpoint, sharpness,
 * colour spaces other than RGB) are approximated by nodes of their own, to 1e-4. A ray ends where
 * less than 1 / 32768 of the light behind is seen. Hexahedra, voxels, wedges and pyramids are
 * subdivided into tetrahedra: each face with four corners is cut along the diagonal from the first
 * of them (by x, then y, then z), whatever cell it is of, so that cells meet without gaps. (The
 * isosurfaces are those of the cells as vtkIsosurfaceRayTraceMeshMapper has them; with
 * TetrahedralizeOn, those of the same tetrahedra.)
 *
 * What is transparent costs little: cells without a value that has any opacity are passed over.
 *
 * Where a ray crosses a face is a function of the two alone: segments of neighbouring cells join
 * without gaps and without overlaps, and the picture is the same, bit for bit, for any number of
 * threads. Cells may overlap or have gaps between them. Where they overlap, in one mesh or in
 * several connections, the parts of a ray in them are not mixed, but drawn one after the other, in
 * the order in which they begin: the smaller the cells are, the nearer that is to a mixture. Clouds
 * in each other are mixed exactly if they are components of one mesh (vtkResampleWithDataSet puts
 * the values of one mesh on another).
 *
 * With the blend mode MAXIMUM_INTENSITY_BLEND a ray shows the colour and the opacity of the largest
 * value along it, before the isosurfaces.
 *
 * As in the other mappers for unstructured grids, the opacity function is the attenuation for one
 * ScalarOpacityUnitDistance, which is a length in the world: through a thickness d of the opacity a
 * the transmittance is exp(-a d / unit). The opacity a may be more than 1.
 *
 * With vtkVolumeProperty::ShadeOn (default: off) the light that the cloud gives is that which it
 * reflects, as an isosurface through each of its points would: by the lights, and the ambient,
 * diffuse, specular and specular power of the property. The normal is that of the gradient:
 * - NormalMode CENTRAL_DIFFERENCES (the default): linear between those at points, each of which is
 *   the mean of the cells around, weighted by volumes. In composite data, and in pieces of many
 *   processes, a layer of ghost cells makes it that of the whole, as for isosurfaces.
 * - INTERPOLANT_GRADIENT: that of each tetrahedron, constant in it.
 * Where the gradient is zero, there is ambient light alone. As in vtkFixedPointVolumeRayCastMapper
 * the side that is towards the viewer is lit, whichever it is, or, with
 * vtkRenderer::TwoSidedLightingOff, the side of smaller values. (Its highlights are wider: they are
 * by the half-way vector. It takes ambient light from lights, which is black by default; here, as
 * on surfaces, it is white.) The reflected light is found at
 * both ends of the part of a ray in a tetrahedron and is linear between them, and that is
 * integrated as exactly as all else. So for tetrahedra with gradients of their own and lights
 * without a position it is exact, and otherwise right at the faces, and the better the smaller the
 * cells are. It is not clamped: highlights are rounded to white in the picture alone. A cloud casts
 * and receives no shadows, and maximum intensity is not lit.
 *
 * The cloud takes all components of the scalars, if there are several and VectorMode is DISABLED:
 * - vtkVolumeProperty::IndependentComponents on (the default), 2 to 4: each is a cloud by itself,
 *   with the transfer functions and the unit distance of its component of the property, and the
 *   clouds are mixed, as vtkUnstructuredGridLinearRayIntegrator mixes them: attenuations are
 *   added, and the colour is the mean of the colours, weighted by attenuations. An attenuation is
 *   multiplied by the ComponentWeight (from 0 to 1; default: 1). Each is lit by its own gradient,
 *   with its own material, if its own Shade is on.
 * - Off, 2: the colour is that of the first component, and the opacity that of the second, by the
 *   transfer functions of component 0 of the property, as in vtkProjectedTetrahedraMapper.
 * - Off, 4: the components are red, green, blue and the opacity themselves, from 0 to 255 of
 *   unsigned char and from 0 to 1 of other types. Lower and higher ones count as these.
 * If these dependent components are lit, it is by the gradient of the last one, the opacity, with
 * the material of component 0 of the property.
 *
 * All components are linear along a ray in a tetrahedron: the light of a mixture is integrated as
 * exactly as that of one component. Other numbers of components are an error; cells with a value
 * that is not finite are passed over, whichever component it is of. Maximum intensity and
 * isosurfaces are those of one component, which VectorMode selects, as in
 * vtkIsosurfaceRayTraceMeshMapper.
 *
 * All else is that of vtkIsosurfaceRayTraceMeshMapper, with the same settings: inputs (also
 * composite ones and several connections), arrays, hidden cells, clipping planes, opaque geometry
 * in the cloud, ImageSampleDistance, RenderToImage, threads, errors and events. Picking, CastRays
 * and selections find the isosurfaces. RenderToFragments is an error: a cloud fills the space
 * between surfaces.
 *
 * K.-L. Ma, S. Parker: Massively Parallel Software Rendering for Visualizing Large-Scale Data Sets.
 * IEEE Computer Graphics and Applications 21(4), 2001.
 * K.-L. Ma, T. W. Crockett: A Scalable Parallel Cell-Projection Volume Rendering Algorithm for
 * Three-Dimensional Unstructured Data. IEEE Parallel Rendering Symposium, 1997.
 *
 * @sa vtkIsosurfaceRayTraceMeshMapper vtkUnstructuredGridVolumeRayCastMapper
 * vtkProjectedTetrahedraMapper
 */

#ifndef vtkCellProjectionMapper_h
#define vtkCellProjectionMapper_h

#include "vtkIsosurfaceRayTraceMeshMapper.h"
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingModule.h" // for export macro

namespace vtkIsosurfaceRayTracing
{
class MessageExchange;
struct Sharing;
struct SharingCounts;
}

VTK_ABI_NAMESPACE_BEGIN

class VTKISOSURFACERAYTRACING_EXPORT vtkCellProjectionMapper
  : public vtkIsosurfaceRayTraceMeshMapper
{
public:
  static vtkCellProjectionMapper* New();
  vtkTypeMacro(vtkCellProjectionMapper, vtkIsosurfaceRayTraceMeshMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/Get whether the isosurfaces of the property (vtkVolumeProperty::GetIsoSurfaceValues) are
   * drawn in the cloud. Their colours and opacities are those of vtkIsosurfaceRayTraceMeshMapper:
   * the transfer functions at the isovalue. Default: off.
   */
  vtkSetMacro(DrawIsosurfaces, bool);
  vtkGetMacro(DrawIsosurfaces, bool);
  vtkBooleanMacro(DrawIsosurfaces, bool);
  ///@}

#ifndef __VTK_WRAP__
  /**
   * Draws a part of a picture of data that lie in many processes: the tiles that this process owns,
   * with what is seen in them of the data of all. All processes of the exchange must call it, each
   * with the same view and with a volume of the same property and matrix. The output has the arrays
   * Colors and Depth of RenderToImage; pixels of other tiles are (0, 0, 0, 0) and 1. The depths are
   * those of RenderToImage, the same in all processes. Returns whether this process could do its
   * part; if not, an error reports why, and the others have no pixels. It is for
   * vtkIsosurfaceRayTraceCompositor, which joins the parts: other code calls that.
   */
  bool RenderOwnTiles(vtkVolume* volume, vtkCamera* camera, vtkLightCollection* lights, int width,
    int height, const vtkIsosurfaceRayTracing::Sharing& sharing,
    vtkIsosurfaceRayTracing::MessageExchange& exchange,
    vtkIsosurfaceRayTracing::SharingCounts& counts, vtkImageData* output, vtkFloatArray* depths);
#endif

  /**
   * Copies the inputs and all settings of another mapper of this class (of a
   * vtkIsosurfaceRayTraceMeshMapper, those that it has); inputs and clipping planes are shared.
   */
  void ShallowCopy(vtkAbstractMapper* mapper) override;

protected:
  vtkCellProjectionMapper() = default;
  ~vtkCellProjectionMapper() override = default;

  vtkIsosurfaceRayTraceSettings GetSettings() const override;
  vtkIsosurfaceRayTraceInputSettings GetInputSettings() const override;

private:
  vtkCellProjectionMapper(const vtkCellProjectionMapper&) = delete;
  void operator=(const vtkCellProjectionMapper&) = delete;

  bool DrawIsosurfaces = false;
};

VTK_ABI_NAMESPACE_END

#endif
