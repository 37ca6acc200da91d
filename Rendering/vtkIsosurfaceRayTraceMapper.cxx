// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceMapper.h"

#include "vtkIsosurfaceRayTraceImageDisplay.h"

#include "vtkCamera.h"
#include "vtkCollectionRange.h"
#include "vtkColorTransferFunction.h"
#include "vtkCommand.h"
#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlaneCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include "CastRays.h"
#include "RenderTiles.h"
#include "Shading.h"

#include <omp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

template <typename T>
constexpr vtkirt::ScalarType IntegerType()
{
  using vtkirt::ScalarType;
  switch (sizeof(T))
  {
    case 1:
      return std::is_signed_v<T> ? ScalarType::Int8 : ScalarType::UInt8;
    case 2:
      return std::is_signed_v<T> ? ScalarType::Int16 : ScalarType::UInt16;
    case 4:
      return std::is_signed_v<T> ? ScalarType::Int32 : ScalarType::UInt32;
    default:
      return std::is_signed_v<T> ? ScalarType::Int64 : ScalarType::UInt64;
  }
}

/// The ray tracer's name for a scalar type of VTK; none for what is not a number.
std::optional<vtkirt::ScalarType> FindScalarType(int vtkType)
{
  switch (vtkType)
  {
    case VTK_FLOAT:
      return vtkirt::ScalarType::Float32;
    case VTK_DOUBLE:
      return vtkirt::ScalarType::Float64;
    case VTK_CHAR:
      return IntegerType<char>();
    case VTK_SIGNED_CHAR:
      return IntegerType<signed char>();
    case VTK_UNSIGNED_CHAR:
      return IntegerType<unsigned char>();
    case VTK_SHORT:
      return IntegerType<short>();
    case VTK_UNSIGNED_SHORT:
      return IntegerType<unsigned short>();
    case VTK_INT:
      return IntegerType<int>();
    case VTK_UNSIGNED_INT:
      return IntegerType<unsigned int>();
    case VTK_LONG:
      return IntegerType<long>();
    case VTK_UNSIGNED_LONG:
      return IntegerType<unsigned long>();
    case VTK_LONG_LONG:
      return IntegerType<long long>();
    case VTK_UNSIGNED_LONG_LONG:
      return IntegerType<unsigned long long>();
    case VTK_ID_TYPE:
      return IntegerType<vtkIdType>();
    default:
      return std::nullopt;
  }
}

/// Where an image lies in the world, without the volume's own matrix.
struct Geometry
{
  std::array<double, 3> Origin;
  std::array<double, 3> Spacing;
  std::array<double, 9> Direction;
  std::array<int, 3> FirstIndex;

  explicit Geometry(vtkImageData* image)
  {
    image->GetOrigin(this->Origin.data());
    image->GetSpacing(this->Spacing.data());
    std::copy_n(image->GetDirectionMatrix()->GetData(), 9, this->Direction.begin());
    const int* extent = image->GetExtent();
    this->FirstIndex = { extent[0], extent[2], extent[4] };
  }

  bool operator==(const Geometry& other) const
  {
    return this->Origin == other.Origin && this->Spacing == other.Spacing &&
      this->Direction == other.Direction && this->FirstIndex == other.FirstIndex;
  }

  /// From indices counted from the first sample to the coordinates of the image. The place of the
  /// first sample is computed first: an extent far from zero costs no digits.
  vtkirt::Matrix4 GetPhysicalFromIndex() const
  {
    vtkirt::Matrix4 matrix;
    vtkImageData::ComputeIndexToPhysicalMatrix(
      this->Origin.data(), this->Spacing.data(), this->Direction.data(), matrix.data());
    const vtkirt::Vector3 first = vtkirt::TransformPoint(matrix,
      { static_cast<double>(this->FirstIndex[0]), static_cast<double>(this->FirstIndex[1]),
        static_cast<double>(this->FirstIndex[2]) });
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      matrix[4 * axis + 3] = first[axis];
    }
    return matrix;
  }

  bool IsUsable() const
  {
    const vtkirt::Matrix4 m = this->GetPhysicalFromIndex();
    return std::all_of(m.begin(), m.end(), [](double v) { return std::isfinite(v); }) &&
      vtkMath::Determinant3x3(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]) != 0.0;
  }
};

/// The component whose isosurfaces are drawn, as in VTK's own isosurface blend mode.
int ChooseComponent(vtkVolumeProperty* property, int numberOfComponents)
{
  int chosen = 0;
  for (int component = 1; component < numberOfComponents; ++component)
  {
    if (property->GetComponentWeight(component) > property->GetComponentWeight(chosen))
    {
      chosen = component;
    }
  }
  return chosen;
}

/// The isovalues of the property whose surfaces can be seen at all, in ascending order.
std::vector<vtkirt::Isosurface> GetSurfaces(vtkVolumeProperty* property, int component)
{
  vtkContourValues* contours = property->GetIsoSurfaceValues();
  std::vector<double> isovalues(
    contours->GetValues(), contours->GetValues() + contours->GetNumberOfContours());
  isovalues.erase(std::remove_if(isovalues.begin(), isovalues.end(),
                    [](double isovalue) { return !std::isfinite(isovalue); }),
    isovalues.end());
  std::sort(isovalues.begin(), isovalues.end());
  isovalues.erase(std::unique(isovalues.begin(), isovalues.end()), isovalues.end());
  std::vector<vtkirt::Isosurface> surfaces;
  for (const double isovalue : isovalues)
  {
    const double opacity = property->GetScalarOpacity(component)->GetValue(isovalue);
    if (opacity > 0.0)
    {
      surfaces.push_back({ isovalue, std::min(opacity, 1.0) });
    }
  }
  return surfaces;
}

vtkirt::Vector3 GetColor(vtkVolumeProperty* property, int component, double isovalue)
{
  vtkirt::Vector3 color;
  if (property->GetColorChannels(component) == 1)
  {
    color.fill(property->GetGrayTransferFunction(component)->GetValue(isovalue));
  }
  else
  {
    property->GetRGBTransferFunction(component)->GetColor(isovalue, color.data());
  }
  return color;
}

vtkirt::Material GetMaterial(vtkVolumeProperty* property, int component)
{
  return { property->GetShade(component) != 0, property->GetAmbient(component),
    property->GetDiffuse(component), property->GetSpecular(component),
    property->GetSpecularPower(component) };
}

vtkirt::Light ConvertLight(vtkLight* light)
{
  using vtkirt::operator*;
  using vtkirt::operator-;
  vtkirt::Light result;
  vtkirt::Vector3 focus;
  light->GetTransformedPosition(result.Position.data());
  light->GetTransformedFocalPoint(focus.data());
  result.Direction = vtkirt::Normalized(result.Position - focus);
  light->GetDiffuseColor(result.DiffuseColor.data());
  light->GetSpecularColor(result.SpecularColor.data());
  result.DiffuseColor = result.DiffuseColor * light->GetIntensity();
  result.SpecularColor = result.SpecularColor * light->GetIntensity();
  result.Positional = light->GetPositional() != 0;
  result.ConeAngle = light->GetConeAngle();
  result.Exponent = light->GetExponent();
  light->GetAttenuationValues(result.Attenuation.data());
  return result;
}

void AddLights(vtkRenderer* renderer, vtkirt::Scene& scene)
{
  scene.TwoSidedLighting = renderer->GetTwoSidedLighting() != 0;
  for (vtkLight* light : vtk::Range(renderer->GetLights()))
  {
    if (light->GetSwitch())
    {
      scene.Lights.push_back(ConvertLight(light));
    }
  }
}

vtkirt::Matrix4 GetWorldFromIndex(vtkVolume* volume, const Geometry& geometry)
{
  const vtkirt::Matrix4 physicalFromIndex = geometry.GetPhysicalFromIndex();
  vtkirt::Matrix4 worldFromIndex;
  vtkMatrix4x4::Multiply4x4(
    volume->GetMatrix()->GetData(), physicalFromIndex.data(), worldFromIndex.data());
  return worldFromIndex;
}

vtkirt::Camera MakeCamera(
  vtkRenderer* renderer, const vtkirt::Matrix4& worldFromIndex, int width, int height)
{
  vtkMatrix4x4* clipFromWorld = renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1.0, 1.0);
  vtkirt::Matrix4 clipFromIndex;
  vtkMatrix4x4::Multiply4x4(clipFromWorld->GetData(), worldFromIndex.data(), clipFromIndex.data());
  vtkirt::Matrix4 indexFromClip;
  vtkMatrix4x4::Invert(clipFromIndex.data(), indexFromClip.data());
  return { clipFromIndex, indexFromClip, worldFromIndex, width, height };
}

/// The pixels that the box of a volume covers: all, if a part of it is beside or behind the eye.
vtkirt::PixelRectangle GetPixels(const vtkirt::Camera& camera, const vtkirt::Index3& dimensions)
{
  const double width = camera.GetWidth();
  const double height = camera.GetHeight();
  double low[2] = { width, height };
  double high[2] = { 0.0, 0.0 };
  for (int corner = 0; corner < 8; ++corner)
  {
    const double point[4] = { (corner & 1) * (dimensions[0] - 1.0),
      (corner >> 1 & 1) * (dimensions[1] - 1.0), (corner >> 2) * (dimensions[2] - 1.0), 1.0 };
    double clip[4];
    vtkMatrix4x4::MultiplyPoint(camera.GetClipFromIndex().data(), point, clip);
    if (!(clip[3] > 0.0))
    {
      return { 0, 0, camera.GetWidth(), camera.GetHeight() };
    }
    const double x = 0.5 * (clip[0] / clip[3] + 1.0) * width;
    const double y = 0.5 * (clip[1] / clip[3] + 1.0) * height;
    low[0] = std::min(low[0], x);
    low[1] = std::min(low[1], y);
    high[0] = std::max(high[0], x);
    high[1] = std::max(high[1], y);
  }
  // One more pixel than needed, whatever rounding does.
  const int left = static_cast<int>(std::clamp(std::floor(low[0]) - 1.0, 0.0, width));
  const int bottom = static_cast<int>(std::clamp(std::floor(low[1]) - 1.0, 0.0, height));
  const int right = static_cast<int>(std::clamp(std::ceil(high[0]) + 1.0, 0.0, width));
  const int top = static_cast<int>(std::clamp(std::ceil(high[1]) + 1.0, 0.0, height));
  return { left, bottom, std::max(0, right - left), std::max(0, top - bottom) };
}

}

//------------------------------------------------------------------------------
class vtkIsosurfaceRayTraceMapper::Internals
{
public:
  /// The scalars a volume was built from, and how. While it is the same, so is the volume.
  struct VolumeKey
  {
    vtkDataArray* Array;
    vtkMTimeType ArrayTime;
    const void* Buffer;
    vtkirt::Index3 Dimensions;
    int Component;
    vtkirt::VolumeSettings Settings;

    bool operator==(const VolumeKey& other) const
    {
      return this->Array == other.Array && this->ArrayTime == other.ArrayTime &&
        this->Buffer == other.Buffer && this->Dimensions == other.Dimensions &&
        this->Component == other.Component && this->Settings == other.Settings;
    }
  };

  struct Input
  {
    vtkImageData* Image;
    vtkDataArray* Scalars;
    int Component;
  };

  /// What stands in the way of drawing; empty if nothing does.
  static std::string FindProblem(vtkIsosurfaceRayTraceMapper* self);
  static std::string FindProblem(vtkImageData* image, vtkDataArray* scalars, bool areCellScalars);

  static vtkDataArray* GetScalars(
    vtkIsosurfaceRayTraceMapper* self, vtkImageData* image, bool& areCellScalars);

  /// Whether a message is new. Every cause is named once, not once per frame.
  bool IsNews(const std::string& message, std::string& last) const
  {
    const bool news = !message.empty() && message != last;
    last = message;
    return news;
  }

  /// Makes sure that the volume is that of the input. Returns whether it had to be built.
  bool UpdateVolume(const Input& input, const vtkirt::VolumeSettings& settings, int threads);

  /// The hits of rays given in the world, up to tEnd times their direction.
  vtkirt::RayHits Cast(const std::vector<vtkirt::Vector3>& origins,
    const std::vector<vtkirt::Vector3>& directions, double tEnd, int threads);
  vtkIdType GetCellId(const vtkirt::Hit& hit) const;
  /// In the world, towards smaller values, of length one.
  vtkirt::Vector3 GetNormal(const vtkirt::Hit& hit, int normalMode) const;
  void WriteHits(const vtkirt::RayHits& hits, int normalMode, vtkPolyData* output) const;

  std::unique_ptr<vtkirt::TracedVolume> Volume;
  std::optional<VolumeKey> Key;
  std::optional<Geometry> ImageGeometry;
  vtkMTimeType ImageTime = 0;
  /// A copy of scalars that are not plain arrays in memory.
  vtkSmartPointer<vtkDataArray> PlainScalars;

  /// What the volume of the last call looks like: see vtkIsosurfaceRayTraceMapper::UpdateVolume.
  int Component = 0;
  vtkirt::Matrix4 WorldFromIndex;
  vtkirt::Wanted Want;

  vtkirt::Frame Picture;
  std::vector<float> SceneDepths;
  vtkIsosurfaceRayTraceImageDisplay Display;
  std::string LastProblem;
  std::string LastWarning;

private:
  vtkDataArray* GetPlainScalars(const Input& input, int& component);
};

//------------------------------------------------------------------------------
vtkDataArray* vtkIsosurfaceRayTraceMapper::Internals::GetScalars(
  vtkIsosurfaceRayTraceMapper* self, vtkImageData* image, bool& areCellScalars)
{
  int association = 0;
  vtkDataArray* scalars = vtkAbstractMapper::GetScalars(
    image, self->ScalarMode, self->ArrayAccessMode, self->ArrayId, self->ArrayName, association);
  areCellScalars = association != 0;
  return scalars;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMapper::Internals::FindProblem(vtkIsosurfaceRayTraceMapper* self)
{
  if (self->GetBlendMode() != vtkVolumeMapper::ISOSURFACE_BLEND)
  {
    return "The blend mode is not ISOSURFACE_BLEND, the only one this mapper has. Call "
           "SetBlendModeToIsoSurface(), or use another volume mapper.";
  }
  auto* image = vtkImageData::SafeDownCast(self->GetDataSetInput());
  if (!image)
  {
    return "There is no input. Give a vtkImageData with SetInputData or SetInputConnection.";
  }
  int association = 0;
  vtkDataArray* scalars = vtkAbstractMapper::GetScalars(
    image, self->ScalarMode, self->ArrayAccessMode, self->ArrayId, self->ArrayName, association);
  return FindProblem(image, scalars, association != 0);
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceMapper::Internals::FindProblem(
  vtkImageData* image, vtkDataArray* scalars, bool areCellScalars)
{
  std::ostringstream problem;
  const int* dimensions = image->GetDimensions();
  if (!scalars)
  {
    problem
      << "The input has no scalars of the kind asked for. Add point scalars to it, or name an "
         "array with SetScalarModeToUsePointFieldData() and SelectScalarArray().";
  }
  else if (areCellScalars)
  {
    problem << "The scalars are those of cells. Make point scalars of them with "
               "vtkCellDataToPointData.";
  }
  else if (std::min({ dimensions[0], dimensions[1], dimensions[2] }) < 2)
  {
    problem << "The input has " << dimensions[0] << " x " << dimensions[1] << " x " << dimensions[2]
            << " points. An isosurface needs at least 2 along each axis.";
  }
  else if (scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    problem << "The scalars have " << scalars->GetNumberOfTuples() << " tuples for "
            << image->GetNumberOfPoints() << " points. Give one for every point.";
  }
  else if (scalars->GetDataType() != VTK_BIT && !FindScalarType(scalars->GetDataType()))
  {
    problem << "The scalars are of type " << scalars->GetDataTypeAsString()
            << ", which is no number.";
  }
  else if (scalars->GetNumberOfComponents() > VTK_MAX_VRCOMP)
  {
    problem << "The scalars have " << scalars->GetNumberOfComponents() << " components, of which "
            << VTK_MAX_VRCOMP
            << " at most can be chosen from (vtkVolumeProperty::SetComponentWeight). Extract one "
               "with vtkImageExtractComponents.";
  }
  else if (!Geometry(image).IsUsable())
  {
    problem << "The origin, spacing and direction of the input leave it without a finite volume. "
               "Give finite numbers, a spacing other than 0 and a direction matrix of full rank.";
  }
  return problem.str();
}

//------------------------------------------------------------------------------
vtkDataArray* vtkIsosurfaceRayTraceMapper::Internals::GetPlainScalars(
  const Input& input, int& component)
{
  component = input.Component;
  const bool isBits = input.Scalars->GetDataType() == VTK_BIT;
  if (input.Scalars->HasStandardMemoryLayout() && !isBits)
  {
    this->PlainScalars = nullptr;
    return input.Scalars;
  }
  this->PlainScalars.TakeReference(
    vtkDataArray::CreateDataArray(isBits ? VTK_UNSIGNED_CHAR : input.Scalars->GetDataType()));
  this->PlainScalars->SetNumberOfTuples(input.Scalars->GetNumberOfTuples());
  this->PlainScalars->CopyComponent(0, input.Scalars, component);
  component = 0;
  return this->PlainScalars;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::Internals::UpdateVolume(
  const Input& input, const vtkirt::VolumeSettings& settings, int threads)
{
  VolumeKey key;
  key.Array = input.Scalars;
  key.ArrayTime = input.Scalars->GetMTime();
  key.Buffer =
    input.Scalars->HasStandardMemoryLayout() ? input.Scalars->GetVoidPointer(0) : nullptr;
  std::copy_n(input.Image->GetDimensions(), 3, key.Dimensions.begin());
  key.Component = input.Component;
  key.Settings = settings;

  // Those who write into the scalars often tell the image, not the array. So a change of the image
  // counts as one of the scalars, unless its geometry has changed, which explains it.
  const Geometry geometry(input.Image);
  const bool imageChanged = input.Image->GetMTime() != this->ImageTime && this->ImageGeometry &&
    *this->ImageGeometry == geometry;
  this->ImageGeometry = geometry;
  this->ImageTime = input.Image->GetMTime();
  if (this->Volume && this->Key == key && !imageChanged)
  {
    return false;
  }

  this->Volume.reset(); // Its memory first.
  int component = 0;
  vtkDataArray* scalars = this->GetPlainScalars(input, component);
  vtkirt::VolumeView view;
  view.Type = *FindScalarType(scalars->GetDataType());
  view.Samples = scalars->GetVoidPointer(component);
  view.Stride = scalars->GetNumberOfComponents();
  view.Dimensions = key.Dimensions;
  this->Volume = vtkirt::TracedVolume::New(view, settings, threads);
  this->Key = key;
  return true;
}

//------------------------------------------------------------------------------
vtkirt::RayHits vtkIsosurfaceRayTraceMapper::Internals::Cast(
  const std::vector<vtkirt::Vector3>& origins, const std::vector<vtkirt::Vector3>& directions,
  double tEnd, int threads)
{
  vtkirt::Matrix4 indexFromWorld;
  vtkMatrix4x4::Invert(this->WorldFromIndex.data(), indexFromWorld.data());
  // The place of the first sample is taken off first: a volume far from the origin of the world
  // loses nothing.
  const vtkirt::Vector3 first = vtkirt::TransformPoint(this->WorldFromIndex, { 0.0, 0.0, 0.0 });
  std::vector<std::optional<vtkirt::Ray>> rays(origins.size());
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    using vtkirt::operator-;
    rays[i] = vtkirt::ClipToVolume(vtkirt::TransformDirection(indexFromWorld, origins[i] - first),
      vtkirt::TransformDirection(indexFromWorld, directions[i]), 0.0, tEnd,
      this->Volume->GetDimensions());
  }
  this->Volume->Select(this->Want, threads);
  return vtkirt::CastRays(*this->Volume, rays, threads);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::Internals::GetCellId(const vtkirt::Hit& hit) const
{
  const vtkirt::Index3& dimensions = this->Volume->GetDimensions();
  return static_cast<vtkIdType>(
    vtkirt::Offset(hit.Cell, { dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1 }));
}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceMapper::Internals::GetNormal(
  const vtkirt::Hit& hit, int normalMode) const
{
  using vtkirt::operator*;
  const vtkirt::Vector3 gradient =
    this->Volume->GetGradient(hit, static_cast<vtkirt::NormalMode>(normalMode));
  return vtkirt::Normalized(vtkirt::GradientToWorld(this->WorldFromIndex, gradient)) * -1.0;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Internals::WriteHits(
  const vtkirt::RayHits& hits, int normalMode, vtkPolyData* output) const
{
  const auto count = static_cast<vtkIdType>(hits.Hits.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkNew<vtkIdTypeArray> rayIds;
  vtkNew<vtkIdTypeArray> cellIds;
  vtkNew<vtkDoubleArray> ts;
  vtkNew<vtkDoubleArray> isovalues;
  vtkNew<vtkDoubleArray> parametric;
  vtkNew<vtkDoubleArray> normals;
  parametric->SetNumberOfComponents(3);
  normals->SetNumberOfComponents(3);
  const auto add = [count, output](vtkDataArray* array, const char* name)
  {
    array->SetName(name);
    array->SetNumberOfTuples(count);
    output->GetPointData()->AddArray(array);
  };
  add(rayIds, "RayId");
  add(ts, "T");
  add(cellIds, "CellId");
  add(parametric, "ParametricCoordinates");
  add(isovalues, "Isovalue");
  add(normals, "Normals");
  output->GetPointData()->SetActiveNormals("Normals");
  output->SetPoints(points);

  for (std::size_t ray = 0; ray + 1 < hits.First.size(); ++ray)
  {
    for (std::size_t i = hits.First[ray]; i < hits.First[ray + 1]; ++i)
    {
      const vtkirt::Hit& hit = hits.Hits[i];
      const auto row = static_cast<vtkIdType>(i);
      points->SetPoint(row, vtkirt::TransformPoint(this->WorldFromIndex, hit.GetPoint()).data());
      rayIds->SetValue(row, static_cast<vtkIdType>(ray));
      ts->SetValue(row, hit.T);
      cellIds->SetValue(row, this->GetCellId(hit));
      parametric->SetTypedTuple(row, hit.Parametric.data());
      isovalues->SetValue(row, this->Want.Surfaces[static_cast<std::size_t>(hit.Surface)].Isovalue);
      normals->SetTypedTuple(row, this->GetNormal(hit, normalMode).data());
    }
  }
}

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfaceRayTraceMapper);

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMapper::vtkIsosurfaceRayTraceMapper()
  : Internal(std::make_unique<Internals>())
{
  this->BlendMode = vtkVolumeMapper::ISOSURFACE_BLEND;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMapper::~vtkIsosurfaceRayTraceMapper() = default;

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetMacrocellBranching(int level, int branching)
{
  if (level < 0 || level >= MaximumNumberOfMacrocellLevels)
  {
    vtkErrorMacro("There is no macrocell level " << level << ": levels are 0 to "
                                                 << MaximumNumberOfMacrocellLevels - 1 << ".");
    return;
  }
  const int clamped = std::clamp(branching, 2, 64);
  if (this->MacrocellBranching[level] != clamped)
  {
    this->MacrocellBranching[level] = clamped;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::GetMacrocellBranching(int level)
{
  if (level < 0 || level >= MaximumNumberOfMacrocellLevels)
  {
    vtkErrorMacro("There is no macrocell level " << level << ": levels are 0 to "
                                                 << MaximumNumberOfMacrocellLevels - 1 << ".");
    return 0;
  }
  return this->MacrocellBranching[level];
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::SetTileSize(int width, int height)
{
  const int clamped[2] = { std::clamp(width, 1, 4096), std::clamp(height, 1, 4096) };
  if (this->TileSize[0] != clamped[0] || this->TileSize[1] != clamped[1])
  {
    this->TileSize[0] = clamped[0];
    this->TileSize[1] = clamped[1];
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetMacrocellMemory()
{
  const auto& volume = this->Internal->Volume;
  return volume ? static_cast<vtkIdType>(volume->GetMacrocellMemory()) : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetBrickMemory()
{
  const auto& volume = this->Internal->Volume;
  return volume ? static_cast<vtkIdType>(volume->GetBrickMemory()) : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetNumberOfBricks()
{
  const auto& volume = this->Internal->Volume;
  return volume ? static_cast<vtkIdType>(volume->GetNumberOfBricks()) : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsosurfaceRayTraceMapper::GetMaximumNumberOfBricks()
{
  const auto& volume = this->Internal->Volume;
  return volume ? static_cast<vtkIdType>(volume->GetMaximumNumberOfBricks()) : 0;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Display.ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  this->MacrocellBuildTime = 0.0;
  this->BrickBuildTime = 0.0;
  this->TraceTime = 0.0;
  this->ShadeTime = 0.0;
  this->DisplayTime = 0.0;
  if (renderer->GetSelector())
  {
    // The window holds ids now, and not colours.
    return;
  }
  const Clock::time_point start = Clock::now();
  if (!vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()))
  {
    this->ReportOnce("The renderer is not in an OpenGL render window. Add it to a vtkRenderWindow, "
                     "and initialize the module vtkRenderingOpenGL2 (VTK_MODULE_INIT, "
                     "vtk_module_autoinit, or import vtkmodules.vtkRenderingOpenGL2).");
    return;
  }
  if (!this->UpdateVolume(volume))
  {
    return;
  }
  this->WarnOfWhatIsIgnored();

  this->InvokeEvent(vtkCommand::VolumeMapperRenderStartEvent, nullptr);
  if (this->RenderFrame(renderer, volume))
  {
    this->TimeToDraw = SecondsSince(start);
  }
  this->InvokeEvent(vtkCommand::VolumeMapperRenderEndEvent, nullptr);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::WarnOfWhatIsIgnored()
{
  std::string warning;
  if (this->Cropping)
  {
    warning += "Cropping is on, but this mapper does not crop. Crop the input with vtkExtractVOI. ";
  }
  if (this->ClippingPlanes && this->ClippingPlanes->GetNumberOfItems() > 0)
  {
    warning += "There are clipping planes, but this mapper does not clip. ";
  }
  if (this->Internal->IsNews(warning, this->Internal->LastWarning))
  {
    vtkWarningMacro(<< warning);
  }
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::ReportOnce(const std::string& problem)
{
  if (this->Internal->IsNews(problem, this->Internal->LastProblem))
  {
    vtkErrorMacro(<< problem);
  }
  return !problem.empty();
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::GetThreads()
{
  return this->NumberOfThreads > 0 ? this->NumberOfThreads : std::max(1, omp_get_max_threads());
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::UpdateVolume(vtkVolume* volume)
{
  if (this->GetNumberOfInputConnections(0) > 0)
  {
    this->GetInputAlgorithm()->Update();
  }
  Internals& internal = *this->Internal;
  if (this->ReportOnce(Internals::FindProblem(this)))
  {
    return false;
  }
  auto* image = vtkImageData::SafeDownCast(this->GetDataSetInput());
  bool areCellScalars = false;
  vtkDataArray* scalars = Internals::GetScalars(this, image, areCellScalars);
  vtkVolumeProperty* property = volume->GetProperty();
  internal.Component = ChooseComponent(property, scalars->GetNumberOfComponents());

  vtkirt::VolumeSettings settings;
  settings.MacrocellBranching.assign(
    this->MacrocellBranching, this->MacrocellBranching + this->NumberOfMacrocellLevels);
  settings.Layout = static_cast<vtkirt::BrickLayout>(this->BrickLayout);
  settings.BrickSize = this->BrickSize;
  settings.BrickGroupSize = this->BrickGroupSize;

  const Clock::time_point start = Clock::now();
  if (internal.UpdateVolume({ image, scalars, internal.Component }, settings, this->GetThreads()))
  {
    this->MacrocellBuildTime = SecondsSince(start);
  }
  internal.WorldFromIndex = GetWorldFromIndex(volume, Geometry(image));
  internal.Want.Surfaces = GetSurfaces(property, internal.Component);
  internal.Want.Solver = static_cast<vtkirt::RootSolver>(this->RootSolver);
  internal.Want.Interpolations = this->NumberOfInterpolations;
  internal.Want.MaximumMemory = this->MaximumBrickMemory > 0
    ? static_cast<std::size_t>(this->MaximumBrickMemory) << 20
    : std::numeric_limits<std::size_t>::max();
  return true;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::RenderFrame(vtkRenderer* renderer, vtkVolume* volume)
{
  Internals& internal = *this->Internal;
  vtkVolumeProperty* property = volume->GetProperty();
  vtkirt::Scene scene;
  scene.Threads = this->GetThreads();
  scene.TileWidth = this->TileSize[0];
  scene.TileHeight = this->TileSize[1];
  scene.Normals = static_cast<vtkirt::NormalMode>(this->NormalMode);
  scene.Want = internal.Want;
  for (const vtkirt::Isosurface& surface : scene.Want.Surfaces)
  {
    scene.Colors.push_back(GetColor(property, internal.Component, surface.Isovalue));
  }
  AddLights(renderer, scene);
  scene.Look = GetMaterial(property, internal.Component);

  int width = 0;
  int height = 0;
  int left = 0;
  int bottom = 0;
  renderer->GetTiledSizeAndOrigin(&width, &height, &left, &bottom);
  scene.View = MakeCamera(renderer, internal.WorldFromIndex, width, height);
  scene.Pixels = GetPixels(scene.View, internal.Volume->GetDimensions());
  if (scene.Want.Surfaces.empty() || scene.Pixels.Width == 0 || scene.Pixels.Height == 0)
  {
    return true;
  }

  const Clock::time_point depthStart = Clock::now();
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  left += scene.Pixels.X;
  bottom += scene.Pixels.Y;
  // With nothing drawn before, there is nothing to be hidden by.
  if (renderer->GetNumberOfPropsRendered() > 0 || renderer->GetPreserveDepthBuffer())
  {
    const int right = left + scene.Pixels.Width - 1;
    const int top = bottom + scene.Pixels.Height - 1;
    internal.SceneDepths.resize(
      static_cast<std::size_t>(scene.Pixels.Width) * static_cast<std::size_t>(scene.Pixels.Height));
    window->GetZbufferData(left, bottom, right, top, internal.SceneDepths.data());
    scene.Depth = internal.SceneDepths.data();
  }
  this->DisplayTime = SecondsSince(depthStart);

  vtkirt::FrameTimes times;
  const bool complete = vtkirt::RenderTiles(scene, *internal.Volume, internal.Picture, times,
    [this, window](double fraction) { return this->ReportProgress(window, fraction); });
  this->BrickBuildTime = times.Bricks;
  this->TraceTime = times.Trace;
  this->ShadeTime = times.Shade;
  if (!complete)
  {
    return false;
  }

  const Clock::time_point displayStart = Clock::now();
  const bool opaque = std::all_of(scene.Want.Surfaces.begin(), scene.Want.Surfaces.end(),
    [](const vtkirt::Isosurface& surface) { return surface.Opacity >= 1.0; });
  internal.Display.Display(window,
    { left, bottom, scene.Pixels.Width, scene.Pixels.Height, internal.Picture.Colors.data(),
      internal.Picture.Depths.data(), opaque });
  this->DisplayTime += SecondsSince(displayStart);
  return true;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceMapper::IntersectWithLine(vtkVolume* volume, const double p1[3],
  const double p2[3], double& t, double x[3], double pcoords[3], vtkIdType& cellId,
  double& isovalue, double normal[3])
{
  if (!volume || !this->UpdateVolume(volume))
  {
    return 0;
  }
  Internals& internal = *this->Internal;
  const vtkirt::Vector3 from = { p1[0], p1[1], p1[2] };
  const vtkirt::Vector3 direction = { p2[0] - p1[0], p2[1] - p1[1], p2[2] - p1[2] };
  const vtkirt::RayHits hits = internal.Cast({ from }, { direction }, 1.0, 1);
  if (hits.Hits.empty())
  {
    return 0;
  }
  const vtkirt::Hit& hit = hits.Hits.front();
  t = hit.T;
  isovalue = internal.Want.Surfaces[static_cast<std::size_t>(hit.Surface)].Isovalue;
  cellId = internal.GetCellId(hit);
  std::copy_n(hit.Parametric.begin(), 3, pcoords);
  const vtkirt::Vector3 point = vtkirt::TransformPoint(internal.WorldFromIndex, hit.GetPoint());
  std::copy_n(point.begin(), 3, x);
  const vtkirt::Vector3 outward = internal.GetNormal(hit, this->NormalMode);
  std::copy_n(outward.begin(), 3, normal);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::CastRays(
  vtkVolume* volume, vtkPoints* origins, vtkDataArray* directions, vtkPolyData* output)
{
  if (!volume || !origins || !directions || !output || directions->GetNumberOfComponents() != 3 ||
    directions->GetNumberOfTuples() != origins->GetNumberOfPoints())
  {
    vtkErrorMacro("CastRays needs a volume, origins, as many directions of 3 components, and an "
                  "output.");
    return false;
  }
  output->Initialize();
  if (!this->UpdateVolume(volume))
  {
    return false;
  }
  const auto count = static_cast<std::size_t>(origins->GetNumberOfPoints());
  std::vector<vtkirt::Vector3> from(count);
  std::vector<vtkirt::Vector3> along(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    origins->GetPoint(static_cast<vtkIdType>(i), from[i].data());
    directions->GetTuple(static_cast<vtkIdType>(i), along[i].data());
  }
  Internals& internal = *this->Internal;
  const vtkirt::RayHits hits =
    internal.Cast(from, along, std::numeric_limits<double>::infinity(), this->GetThreads());
  internal.WriteHits(hits, this->NormalMode, output);
  return true;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMapper::ReportProgress(vtkRenderWindow* window, double fraction)
{
  this->InvokeEvent(vtkCommand::VolumeMapperRenderProgressEvent, &fraction);
  return window->CheckAbortStatus() == 0;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NormalMode: "
     << (this->NormalMode == INTERPOLANT_GRADIENT ? "InterpolantGradient" : "CentralDifferences")
     << "\n";
  const char* const solvers[] = { "Robust", "Fast", "Analytic", "Marmitt", "Linear" };
  os << indent << "RootSolver: " << solvers[this->RootSolver] << "\n";
  os << indent << "NumberOfInterpolations: " << this->NumberOfInterpolations << "\n";
  const char* const layouts[] = { "NoBricks", "ApronBricks", "TwoLevelBricks" };
  os << indent << "BrickLayout: " << layouts[this->BrickLayout] << "\n";
  os << indent << "BrickSize: " << this->BrickSize << "\n";
  os << indent << "BrickGroupSize: " << this->BrickGroupSize << "\n";
  os << indent << "MaximumBrickMemory: " << this->MaximumBrickMemory << "\n";
  os << indent << "NumberOfMacrocellLevels: " << this->NumberOfMacrocellLevels << "\n";
  os << indent << "MacrocellBranching:";
  for (int level = 0; level < this->NumberOfMacrocellLevels; ++level)
  {
    os << " " << this->MacrocellBranching[level];
  }
  os << "\n";
  os << indent << "TileSize: " << this->TileSize[0] << " x " << this->TileSize[1] << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "MacrocellBuildTime: " << this->MacrocellBuildTime << "\n";
  os << indent << "BrickBuildTime: " << this->BrickBuildTime << "\n";
  os << indent << "TraceTime: " << this->TraceTime << "\n";
  os << indent << "ShadeTime: " << this->ShadeTime << "\n";
  os << indent << "DisplayTime: " << this->DisplayTime << "\n";
  os << indent << "MacrocellMemory: " << this->GetMacrocellMemory() << "\n";
  os << indent << "BrickMemory: " << this->GetBrickMemory() << "\n";
  os << indent << "NumberOfBricks: " << this->GetNumberOfBricks() << "\n";
  os << indent << "MaximumNumberOfBricks: " << this->GetMaximumNumberOfBricks() << "\n";
}

VTK_ABI_NAMESPACE_END
