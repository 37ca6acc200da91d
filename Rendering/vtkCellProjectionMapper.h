// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCellProjectionMapper
 * @brief   volume rendering of meshes by cell projection, on the CPU
 *
 * Draws a mesh by direct volume rendering, as a cloud: each point emits and absorbs light by the
 * colour and opacity transfer functions of the property. The cloud may contain isosurfaces, opaque
 * or translucent (DrawIsosurfaces). Images, rectilinear grids and AMR data, alone or among blocks
 * and connections, have isosurfaces, but no cloud; vtkAppendFilter converts them to a mesh.
 *
 * Every cell is projected to the pixels that it covers. In a tetrahedron the values are linear
 * along a ray, and the transfer functions are linear between two of their nodes. The light of each
 * such step is integrated to about 1e-6, whatever the size of the cells is; there are no samples,
 * and so no sample distance. Functions that are not linear between their nodes (midpoint,
 * sharpness, colour spaces other than RGB) are approximated with additional nodes, to 1e-4. A ray
 * ends where less than 1 / 32768 of the light behind is seen.
 *
 * Hexahedra, voxels, wedges and pyramids are subdivided into tetrahedra: each face with four
 * corners is cut along the diagonal from its first corner (by x, then y, then z), whichever cell it
 * belongs to, so that cells meet without gaps. (The isosurfaces are those of the cells as
 * vtkIsosurfaceRayTraceMeshMapper has them; with TetrahedralizeOn, those of the same tetrahedra.)
 *
 * Transparent parts cost little: cells in which no value has any opacity are skipped.
 *
 * The point at which a ray crosses a face depends on the ray and the face alone: segments of
 * neighbouring cells join without gaps and without overlaps, and the picture is the same, bit for
 * bit, for any number of threads.
 *
 * Cells may overlap or have gaps between them. Where cells overlap, in one mesh or in several
 * connections, the segments of a ray in them are not mixed, but drawn one after the other, in the
 * order in which they begin; the smaller the cells are, the nearer the result is to a mixture.
 * Overlapping clouds are mixed exactly if they are components of one mesh (vtkResampleWithDataSet
 * puts the values of one mesh on another).
 *
 * With the blend mode MAXIMUM_INTENSITY_BLEND a ray shows the colour and the opacity of the largest
 * value along it, in front of the isosurfaces.
 *
 * As in the other mappers for unstructured grids, the opacity function is the attenuation for one
 * ScalarOpacityUnitDistance, which is a length in the world: through a thickness d of the opacity a
 * the transmittance is exp(-a d / unit). The opacity a may be more than 1.
 *
 * With vtkVolumeProperty::ShadeOn (default: off), each point of the cloud reflects light as an
 * isosurface through this point would, by the lights and the ambient, diffuse, specular and
 * specular power of the property. The normal is in the direction of the gradient:
 * - NormalMode CENTRAL_DIFFERENCES (the default): the gradient is linear between those at the
 *   points, each of which is the mean of those of the cells around it, weighted by volume. In
 *   composite data, and in the pieces of many processes, a layer of ghost cells makes it the same
 *   as in the whole data, as for isosurfaces.
 * - INTERPOLANT_GRADIENT: the gradient of each tetrahedron, constant in it.
 *
 * Where the gradient is zero, there is ambient light alone. As in vtkFixedPointVolumeRayCastMapper,
 * the side towards the viewer is lit, whichever it is, or, with vtkRenderer::TwoSidedLightingOff,
 * the side of smaller values. (The highlights of vtkFixedPointVolumeRayCastMapper are wider,
 * because it uses the half-way vector. It takes ambient light from the lights, where it is black by
 * default; here it is white, as on surfaces.)
 *
 * The reflected light is computed at both ends of the segment of a ray in a tetrahedron and is
 * linear between them; this is integrated as exactly as everything else. With INTERPOLANT_GRADIENT
 * and lights without a position it is exact. Otherwise it is exact at the faces, and the smaller
 * the cells are, the more accurate it is between them. The light is not clamped: highlights are
 * rounded to white only in the picture. A cloud neither casts nor receives shadows, and maximum
 * intensity is not lit.
 *
 * If the scalars have several components and VectorMode is DISABLED, the cloud uses all of them:
 * - vtkVolumeProperty::IndependentComponents on (the default), 2 to 4: each component is a cloud of
 *   its own, with the transfer functions and the unit distance of this component of the property.
 *   The clouds are mixed as by vtkUnstructuredGridLinearRayIntegrator: attenuations are added, and
 *   the colour is the mean of the colours, weighted by attenuations. The attenuation of a component
 *   is multiplied by its ComponentWeight (from 0 to 1; default: 1). Each cloud is lit by its own
 *   gradient, with its own material, if its own Shade is on.
 * - Off, 2: the first component gives the colour and the second one the opacity, by the transfer
 *   functions of component 0 of the property, as in vtkProjectedTetrahedraMapper.
 * - Off, 4: the components are red, green, blue and opacity themselves, from 0 to 255 for unsigned
 *   char and from 0 to 1 for other types. Lower and higher values are clamped to these ranges.
 *
 * Dependent components (off) are lit by the gradient of the last one, the opacity, with the
 * material of component 0 of the property.
 *
 * All components are linear along a ray in a tetrahedron: the light of a mixture is integrated as
 * exactly as that of one component. Other numbers of components are an error. Cells with a value
 * that is not finite, in any component, are skipped. Maximum intensity and isosurfaces are those of
 * one component, which VectorMode selects, as in vtkIsosurfaceRayTraceMeshMapper.
 *
 * Everything else is as in vtkIsosurfaceRayTraceMeshMapper, with the same settings: inputs (also
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
