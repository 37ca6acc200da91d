// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "AppendedSamples.h"

#include <vtkDataSetAttributes.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace ImageFiles
{
namespace
{

/// Empty if it is not there.
std::string GetText(vtkXMLDataElement* element, const char* attribute)
{
  const char* text = element ? element->GetAttribute(attribute) : nullptr;
  return text ? text : "";
}

//------------------------------------------------------------------------------
/// The only element of this name within another; null if there is none, or are more.
vtkXMLDataElement* FindOnly(vtkXMLDataElement* parent, const char* name)
{
  vtkXMLDataElement* only = nullptr;
  for (int i = 0; parent && i < parent->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* element = parent->GetNestedElement(i);
    if (std::string(element->GetName()) == name)
    {
      if (only)
      {
        return nullptr;
      }
      only = element;
    }
  }
  return only;
}

//------------------------------------------------------------------------------
/// The elements of the arrays of this name.
std::vector<vtkXMLDataElement*> FindArrays(vtkXMLDataElement* arrays, const std::string& name)
{
  std::vector<vtkXMLDataElement*> found;
  for (int i = 0; arrays && i < arrays->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* element = arrays->GetNestedElement(i);
    if (GetText(element, "Name") == name)
    {
      found.push_back(element);
    }
  }
  return found;
}

//------------------------------------------------------------------------------
/// The element of the active scalars; null if there is none, or are several of their name, or if
/// scalars alone are not all: points or cells are hidden.
vtkXMLDataElement* FindScalars(vtkXMLDataElement* root)
{
  vtkXMLDataElement* piece = FindOnly(FindOnly(root, "ImageData"), "Piece");
  vtkXMLDataElement* points = FindOnly(piece, "PointData");
  for (vtkXMLDataElement* arrays : { points, FindOnly(piece, "CellData") })
  {
    if (!FindArrays(arrays, vtkDataSetAttributes::GhostArrayName()).empty())
    {
      return nullptr;
    }
  }
  const std::vector<vtkXMLDataElement*> scalars = FindArrays(points, GetText(points, "Scalars"));
  return scalars.size() == 1 ? scalars.front() : nullptr;
}

//------------------------------------------------------------------------------
std::uint64_t ReadNumber(std::istream& file, int bits, bool isBigEndian)
{
  std::uint64_t number = 0;
  for (int bit = 0; bit < bits; bit += 8)
  {
    const auto byte = static_cast<std::uint64_t>(file.get() & 0xff);
    number |= byte << (isBigEndian ? bits - 8 - bit : bit);
  }
  return number;
}

}

//------------------------------------------------------------------------------
bool AppendedSamples::HaveSize(double size) const
{
  const double modulus = std::ldexp(1.0, this->BitsOfSize);
  return std::fmod(size, modulus) == static_cast<double>(this->Size);
}

//------------------------------------------------------------------------------
std::optional<AppendedSamples> FindAppendedSamples(
  vtkXMLDataParser* parser, const std::string& fileName)
{
  vtkXMLDataElement* root = parser ? parser->GetRootElement() : nullptr;
  vtkXMLDataElement* scalars = FindScalars(root);
  const bool areRaw = GetText(FindOnly(root, "AppendedData"), "encoding") == "raw";
  const bool areCompressed = !GetText(root, "compressor").empty();
  if (!scalars || !areRaw || areCompressed || GetText(scalars, "format") != "appended" ||
    !GetText(scalars, "TimeStep").empty())
  {
    return {};
  }
  AppendedSamples samples;
  samples.FileName = fileName;
  samples.ArrayName = GetText(scalars, "Name");
  samples.AreBigEndian = GetText(root, "byte_order") == "BigEndian";
  samples.BitsOfSize = GetText(root, "header_type") == "UInt64" ? 64 : 32;
  // Whatever number is in the file: the sum may not overflow, and is then no place in the file.
  const auto offset =
    static_cast<std::uint64_t>(std::strtoll(GetText(scalars, "offset").c_str(), nullptr, 10));
  const auto place = static_cast<std::int64_t>(
    static_cast<std::uint64_t>(parser->GetAppendedDataPosition()) + offset);
  std::ifstream file(fileName, std::ios::binary);
  file.seekg(place);
  samples.Size = ReadNumber(file, samples.BitsOfSize, samples.AreBigEndian);
  samples.Offset = place + samples.BitsOfSize / 8;
  if (!file)
  {
    throw std::runtime_error(
      fileName + " cannot be mapped: it ends before its scalars begin. " + "Complete the file.");
  }
  return samples;
}

}
