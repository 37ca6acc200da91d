// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The settings that all mappers have which trace isosurfaces: how they are copied, printed and
// passed on. The mappers are friends of this class.

#ifndef vtkIsosurfaceRayTraceSharedSettings_h
#define vtkIsosurfaceRayTraceSharedSettings_h

#include "vtkAbstractVolumeMapper.h"
#include "vtkIndent.h"
#include "vtkIsosurfaceRayTraceEnumerators.h"
#include "vtkIsosurfaceRayTraceInput.h"
#include "vtkIsosurfaceRayTraceSettings.h"
#include "vtkIsosurfaceRayTraceThreads.h"
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkVolume.h"

#include <algorithm>
#include <cstddef>  // for std::size_t
#include <iterator> // for std::begin
#include <string>   // for std::string
#include <vector>   // for std::vector

VTK_ABI_NAMESPACE_BEGIN

struct vtkIsosurfaceRayTraceSharedSettings
{
  /// Calls visit(name, pointer to member) for every setting, and with the names of the enumerators
  /// if it has some.
  template <typename Mapper, typename Visitor>
  static void Visit(const Visitor& visit)
  {
    static constexpr const char* normalModes[] = { "InterpolantGradient", "CentralDifferences" };
    static constexpr const char* vectorModes[] = { "Disabled", "Magnitude", "Component" };
    visit("NormalMode", &Mapper::NormalMode, normalModes);
    visit("VectorMode", &Mapper::VectorMode, vectorModes - Mapper::DISABLED);
    visit("VectorComponent", &Mapper::VectorComponent);
    visit("ColorArrayName", &Mapper::ColorArrayName);
    visit("CompositeDataDisplayAttributes", &Mapper::CompositeDataDisplayAttributes);
    visit("ConnectionVolume", &Mapper::ConnectionVolumes);
    visit("CapClippingPlanes", &Mapper::CapClippingPlanes);
    visit("Shadows", &Mapper::Shadows);
    visit("AmbientOcclusion", &Mapper::AmbientOcclusion);
    visit("NumberOfAmbientOcclusionRays", &Mapper::NumberOfAmbientOcclusionRays);
    visit("AmbientOcclusionRadius", &Mapper::AmbientOcclusionRadius);
    visit("TileSize", &Mapper::TileSize);
    visit("AutoAdjustSampleDistances", &Mapper::AutoAdjustSampleDistances);
    visit("ImageSampleDistance", &Mapper::ImageSampleDistance);
    visit("MinimumImageSampleDistance", &Mapper::MinimumImageSampleDistance);
    visit("MaximumImageSampleDistance", &Mapper::MaximumImageSampleDistance);
    visit("ProgressiveAccumulation", &Mapper::ProgressiveAccumulation);
    visit("MaximumNumberOfAccumulatedFrames", &Mapper::MaximumNumberOfAccumulatedFrames);
    visit("NumberOfThreads", &Mapper::NumberOfThreads);
  }

  /// How many threads a mapper uses.
  template <typename Mapper>
  static int FindNumberOfThreads(const Mapper& mapper)
  {
    return vtkIsosurfaceRayTraceThreads::Find(mapper.NumberOfThreads);
  }

  /// What the settings of a mapper stand for.
  template <typename Mapper>
  static void Fill(const Mapper& mapper, vtkIsosurfaceRayTraceSettings& settings)
  {
    settings.NormalMode = vtkIsosurfaceRayTraceEnumerators::ToNormalMode(mapper.NormalMode);
    settings.CapClippingPlanes = mapper.CapClippingPlanes;
    settings.Shadows = mapper.Shadows;
    settings.NumberOfAmbientOcclusionRays =
      mapper.AmbientOcclusion ? mapper.NumberOfAmbientOcclusionRays : 0;
    if (mapper.AmbientOcclusionRadius > 0.0)
    {
      settings.AmbientOcclusionRadius = mapper.AmbientOcclusionRadius;
    }
    settings.TileWidth = mapper.TileSize[0];
    settings.TileHeight = mapper.TileSize[1];
    settings.NumberOfThreads = FindNumberOfThreads(mapper);
    settings.AutoAdjustSampleDistances = mapper.AutoAdjustSampleDistances != 0;
    settings.ImageSampleDistance = mapper.ImageSampleDistance;
    settings.MinimumImageSampleDistance = mapper.MinimumImageSampleDistance;
    settings.MaximumImageSampleDistance = mapper.MaximumImageSampleDistance;
    settings.ProgressiveAccumulation = mapper.ProgressiveAccumulation;
    settings.MaximumNumberOfAccumulatedFrames = mapper.MaximumNumberOfAccumulatedFrames;
  }

  /// Those that are about the input.
  template <typename Mapper>
  static void Fill(const Mapper& mapper, vtkIsosurfaceRayTraceInputSettings& settings)
  {
    settings.Component =
      vtkIsosurfaceRayTraceEnumerators::FindComponent(mapper.VectorMode, mapper.VectorComponent);
    settings.ColorArrayName = mapper.ColorArrayName;
    settings.Attributes = mapper.CompositeDataDisplayAttributes;
    settings.Threads = FindNumberOfThreads(mapper);
  }

  /// Clamps a size to its range. Returns whether it has changed.
  static bool SetTileSize(int width, int height, int (&size)[2])
  {
    const int before[2] = { size[0], size[1] };
    size[0] = std::clamp(width, 1, 4096);
    size[1] = std::clamp(height, 1, 4096);
    return size[0] != before[0] || size[1] != before[1];
  }

  /// Sets a name, which may be null. Returns whether it has changed.
  static bool SetName(const char* name, std::string& setting)
  {
    const std::string before = setting;
    setting = name ? name : "";
    return setting != before;
  }

  /// Sets a volume of a list by its number. Returns whether it has changed.
  static bool SetAt(int number, vtkVolume* volume, std::vector<vtkSmartPointer<vtkVolume>>& volumes)
  {
    if (GetAt(number, volumes) == volume)
    {
      return false;
    }
    const auto place = static_cast<std::size_t>(number);
    volumes.resize(std::max(volumes.size(), place + 1));
    volumes[place] = volume;
    return true;
  }

  static vtkVolume* GetAt(int number, const std::vector<vtkSmartPointer<vtkVolume>>& volumes)
  {
    const auto place = static_cast<std::size_t>(number);
    return number >= 0 && place < volumes.size() ? volumes[place].Get() : nullptr;
  }

  /// Copies the connections of a port; none, if there is no such port.
  static void CopyConnections(vtkAlgorithm* from, int port, vtkAlgorithm* to)
  {
    to->SetInputConnection(port, nullptr);
    const int connections =
      port < from->GetNumberOfInputPorts() ? from->GetNumberOfInputConnections(port) : 0;
    for (int i = 0; i < connections; ++i)
    {
      to->AddInputConnection(port, from->GetInputConnection(port, i));
    }
  }

  /// Copies which scalars are chosen.
  template <typename Mapper>
  static void CopyChoiceOfScalars(vtkAbstractVolumeMapper* from, Mapper* to)
  {
    to->SetScalarMode(from->GetScalarMode());
    to->SelectScalarArray(from->GetArrayId());
    to->SelectScalarArray(from->GetArrayName());
    to->SetArrayAccessMode(from->GetArrayAccessMode());
  }

  template <typename T>
  static void Assign(T& to, const T& from)
  {
    to = from;
  }

  template <typename T, std::size_t N>
  static void Assign(T (&to)[N], const T (&from)[N])
  {
    std::copy(std::begin(from), std::end(from), std::begin(to));
  }

  template <typename T>
  static void Write(ostream& os, const T& value)
  {
    os << value;
  }

  template <typename T>
  static void Write(ostream& os, const std::vector<vtkSmartPointer<T>>& objects)
  {
    for (const vtkSmartPointer<T>& object : objects)
    {
      os << object.Get() << " ";
    }
  }

  template <typename T>
  static void Write(ostream& os, const vtkSmartPointer<T>& object)
  {
    os << object.Get();
  }

  static void Write(ostream& os, bool value) { os << (value ? "on" : "off"); }

  template <typename T, std::size_t N>
  static void Write(ostream& os, const T (&values)[N])
  {
    const char* separator = "";
    for (const T& value : values)
    {
      os << separator << value;
      separator = " ";
    }
  }

  static void Write(ostream& os, int enumerator, const char* const* names)
  {
    os << names[enumerator];
  }

  /// Prints settings, each in a line.
  struct Printer
  {
    template <typename T, typename... Names>
    void operator()(const char* name, const T& value, Names... names) const
    {
      this->Stream << this->Indent << name << ": ";
      Write(this->Stream, value, names...);
      this->Stream << "\n";
    }

    void PrintChoiceOfScalars(vtkAbstractVolumeMapper* mapper) const
    {
      const bool isById = mapper->GetArrayAccessMode() == VTK_GET_ARRAY_BY_ID;
      const char* name = mapper->GetArrayName();
      (*this)("ArrayAccessMode", isById ? "ById" : "ByName");
      (*this)("ArrayId", mapper->GetArrayId());
      (*this)("ArrayName", name ? name : "(none)");
    }

    ostream& Stream;
    vtkIndent Indent;
  };
};

VTK_ABI_NAMESPACE_END

#endif
