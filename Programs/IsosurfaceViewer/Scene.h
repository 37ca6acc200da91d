// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Scene_h
#define Scene_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkNew.h>

#include <array>
#include <cstddef>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
class vtkIsosurfaceRayTraceMapper;
class vtkIsosurfaceVolume;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace Viewer
{

class Scalars;

/// One of the isosurfaces.
struct Surface
{
  double Isovalue;
  double Opacity;
  std::array<double, 3> Color;
  bool IsVisible;
};

constexpr std::size_t NumberOfSurfaces = 2;

/// Up to two isosurfaces of data, lit in a renderer.
class Scene
{
public:
  /// The isovalues are those of the opaque surface and of the translucent one. Without them,
  /// the first is the threshold of the scalars, and the second surface is hidden.
  Scene(vtkDataObject* data, const Scalars& scalars, const std::vector<double>& isovalues);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  vtkRenderer* GetRenderer() const { return this->Renderer; }
  vtkIsosurfaceRayTraceMapper* GetMapper() const { return this->Mapper; }
  vtkIsosurfaceVolume* GetVolume() const { return this->Volume; }

  const Surface& GetSurface(std::size_t number) const { return this->Surfaces.at(number); }
  void SetSurface(std::size_t number, const Surface& surface);

  void ToggleShadows();
  void ToggleAmbientOcclusion();
  void ToggleCubicInterpolation();

  /// Looks at the surfaces, or at all data if there are none, from where the camera is.
  void FrameSurfaces();

private:
  void UpdateColors();
  void UpdateMaterial();

  const double Highest;
  std::array<Surface, NumberOfSurfaces> Surfaces;
  vtkNew<vtkIsosurfaceRayTraceMapper> Mapper;
  vtkNew<vtkIsosurfaceVolume> Volume;
  vtkNew<vtkRenderer> Renderer;
};

}

#endif
