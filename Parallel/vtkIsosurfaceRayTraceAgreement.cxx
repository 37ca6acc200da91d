// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceAgreement.h"

#include "vtkCamera.h"
#include "vtkCellProjectionMapper.h"
#include "vtkColorTransferFunction.h"
#include "vtkContourValues.h"
#include "vtkIsosurfaceRayTraceMapper.h"
#include "vtkIsosurfaceRayTraceMeshMapper.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix4x4.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

VTK_ABI_NAMESPACE_BEGIN

namespace
{

using Numbers = std::vector<double>;

void Append(const double* values, int count, Numbers& numbers)
{
  numbers.insert(numbers.end(), values, values + count);
}

Numbers DescribeCamera(vtkCamera* camera, int width, int height)
{
  Numbers numbers;
  vtkMatrix4x4* matrix =
    camera->GetCompositeProjectionTransformMatrix(static_cast<double>(width) / height, -1.0, 1.0);
  Append(matrix->GetData(), 16, numbers);
  return numbers;
}

Numbers DescribeLights(vtkLightCollection* lights)
{
  Numbers numbers;
  for (int i = 0; lights && i < lights->GetNumberOfItems(); ++i)
  {
    auto* light = vtkLight::SafeDownCast(lights->GetItemAsObject(i));
    numbers.insert(numbers.end(),
      { static_cast<double>(light->GetLightType()), static_cast<double>(light->GetSwitch()),
        static_cast<double>(light->GetPositional()), light->GetIntensity(), light->GetConeAngle(),
        light->GetExponent() });
    for (const double* vector : { light->GetTransformedPosition(),
           light->GetTransformedFocalPoint(), light->GetAmbientColor(), light->GetDiffuseColor(),
           light->GetSpecularColor(), light->GetAttenuationValues() })
    {
      Append(vector, 3, numbers);
    }
  }
  return numbers;
}

Numbers DescribeIsovalues(vtkVolumeProperty* property)
{
  Numbers numbers;
  vtkContourValues* values = property->GetIsoSurfaceValues();
  Append(values->GetValues(), values->GetNumberOfContours(), numbers);
  return numbers;
}

/// The points of a function, each with its midpoint and sharpness in so many numbers.
template <int Count, typename Function>
void AppendNodes(Function* function, Numbers& numbers)
{
  for (int i = 0; i < function->GetSize(); ++i)
  {
    double node[Count];
    function->GetNodeValue(i, node);
    Append(node, Count, numbers);
  }
}

void AppendFunction(vtkPiecewiseFunction* function, Numbers& numbers)
{
  AppendNodes<4>(function, numbers);
  numbers.insert(numbers.end(),
    { static_cast<double>(function->GetClamping()), function->GetUseLogScale() ? 1.0 : 0.0 });
}

Numbers DescribeColors(vtkVolumeProperty* property, int component)
{
  Numbers numbers;
  AppendFunction(property->GetScalarOpacity(component), numbers);
  if (property->GetColorChannels(component) == 1)
  {
    AppendFunction(property->GetGrayTransferFunction(component), numbers);
    return numbers;
  }
  vtkColorTransferFunction* colors = property->GetRGBTransferFunction(component);
  AppendNodes<6>(colors, numbers);
  for (const int setting : { colors->GetVectorMode(), colors->GetVectorComponent(),
         colors->GetColorSpace(), colors->GetHSVWrap(), colors->GetScale(), colors->GetClamping() })
  {
    numbers.push_back(setting);
  }
  return numbers;
}

Numbers DescribeMaterial(vtkVolumeProperty* property, int component)
{
  return { static_cast<double>(property->GetShade(component)), property->GetAmbient(component),
    property->GetDiffuse(component), property->GetSpecular(component),
    property->GetSpecularPower(component) };
}

template <typename Mapper>
void AppendSharedSettings(Mapper* mapper, Numbers& numbers)
{
  numbers.insert(numbers.end(),
    { static_cast<double>(mapper->GetNormalMode()), static_cast<double>(mapper->GetVectorMode()),
      static_cast<double>(mapper->GetVectorComponent()), mapper->GetCapClippingPlanes() ? 1.0 : 0.0,
      mapper->GetShadows() ? 1.0 : 0.0, mapper->GetAmbientOcclusion() ? 1.0 : 0.0,
      static_cast<double>(mapper->GetNumberOfAmbientOcclusionRays()),
      mapper->GetAmbientOcclusionRadius() });
}

Numbers DescribeMapper(vtkAbstractVolumeMapper* mapper)
{
  Numbers numbers;
  if (auto* ofMeshes = vtkIsosurfaceRayTraceMeshMapper::SafeDownCast(mapper))
  {
    AppendSharedSettings(ofMeshes, numbers);
    return numbers;
  }
  auto* ofImages = vtkIsosurfaceRayTraceMapper::SafeDownCast(mapper);
  AppendSharedSettings(ofImages, numbers);
  numbers.insert(numbers.end(),
    { static_cast<double>(ofImages->GetBlendMode()),
      static_cast<double>(ofImages->GetInterpolationMode()),
      static_cast<double>(ofImages->GetRootSolver()),
      static_cast<double>(ofImages->GetNumberOfInterpolations()) });
  numbers.push_back(ofImages->GetCropping());
  if (ofImages->GetCropping())
  {
    numbers.push_back(ofImages->GetCroppingRegionFlags());
    Append(ofImages->GetCroppingRegionPlanes(), 6, numbers);
  }
  return numbers;
}

/// Of a cloud, which the pieces must not differ in; nothing for isosurfaces alone.
Numbers DescribeCloud(vtkAbstractVolumeMapper* mapper, vtkVolumeProperty* property)
{
  auto* ofClouds = vtkCellProjectionMapper::SafeDownCast(mapper);
  if (!ofClouds)
  {
    return {};
  }
  Numbers numbers = { static_cast<double>(ofClouds->GetBlendMode()),
    ofClouds->GetDrawIsosurfaces() ? 1.0 : 0.0,
    static_cast<double>(property->GetIndependentComponents()) };
  // A process without data does not know how many there are.
  for (int component = 0; component < VTK_MAX_VRCOMP; ++component)
  {
    for (const Numbers& described :
      { DescribeColors(property, component), DescribeMaterial(property, component) })
    {
      numbers.insert(numbers.end(), described.begin(), described.end());
    }
    numbers.push_back(property->GetScalarOpacityUnitDistance(component));
    numbers.push_back(property->GetComponentWeight(component));
  }
  return numbers;
}

Numbers DescribePlanes(vtkPlaneCollection* planes)
{
  Numbers numbers;
  for (int i = 0; planes && i < planes->GetNumberOfItems(); ++i)
  {
    Append(planes->GetItem(i)->GetOrigin(), 3, numbers);
    Append(planes->GetItem(i)->GetNormal(), 3, numbers);
  }
  return numbers;
}

Numbers DescribeMatrix(vtkVolume* volume)
{
  Numbers matrix;
  volume->ComputeMatrix();
  Append(volume->GetMatrix()->GetData(), 16, matrix);
  return matrix;
}

std::vector<vtkIsosurfaceRayTraceAgreement::Item> DescribeVolume(vtkVolume* volume)
{
  vtkVolumeProperty* property = volume->GetProperty();
  vtkAbstractVolumeMapper* mapper = volume->GetMapper();
  return { { "matrices of the volumes", DescribeMatrix(volume) },
    { "isovalues", DescribeIsovalues(property) },
    { "transfer functions", DescribeColors(property, 0) },
    { "materials", DescribeMaterial(property, 0) },
    { "settings of the mappers", DescribeMapper(mapper) },
    { "clouds", DescribeCloud(mapper, property) },
    { "clipping planes", DescribePlanes(mapper->GetClippingPlanes()) } };
}

}

namespace vtkIsosurfaceRayTraceAgreement
{

//------------------------------------------------------------------------------
std::vector<Item> Describe(const std::vector<vtkVolume*>& volumes, vtkCamera* camera,
  vtkLightCollection* lights, int width, int height)
{
  std::vector<Item> items = { { "sizes",
                                { static_cast<double>(width), static_cast<double>(height) } },
    { "cameras", DescribeCamera(camera, width, height) }, { "lights", DescribeLights(lights) },
    { "numbers of volumes", { static_cast<double>(volumes.size()) } } };
  for (vtkVolume* volume : volumes)
  {
    const std::vector<Item> ofVolume = DescribeVolume(volume);
    items.insert(items.end(), ofVolume.begin(), ofVolume.end());
  }
  return items;
}

}

VTK_ABI_NAMESPACE_END
