// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "TableFiles.h"

#include "Comparison.h"
#include "Support/OutputFile.h"

#include <vtkAbstractArray.h>
#include <vtkDelimitedTextWriter.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkTable.h>
#include <vtkVariant.h>
#include <vtk_jsoncpp.h>

#include <cmath>
#include <memory>

namespace Compare
{
namespace
{

Json::Value ToJson(const vtkVariant& value)
{
  if (value.IsString())
  {
    return value.ToString();
  }
  if (!value.IsDouble())
  {
    return static_cast<Json::Int64>(value.ToTypeInt64());
  }
  return std::isfinite(value.ToDouble()) ? Json::Value(value.ToDouble()) : Json::Value();
}

Json::Value ToJson(const Costs& costs)
{
  Json::Value value;
  value["first"] = costs.First;
  value["next"] = costs.Next;
  return value;
}

Json::Value ToJson(const int dimensions[3])
{
  Json::Value value;
  for (int axis = 0; axis < 3; ++axis)
  {
    value.append(dimensions[axis]);
  }
  return value;
}

}

//------------------------------------------------------------------------------
void WriteCsv(const Comparison& comparison, const std::string& fileName)
{
  vtkNew<vtkDelimitedTextWriter> writer;
  writer->SetInputData(comparison.Table);
  writer->WriteToOutputStringOn();
  writer->Write();
  const std::unique_ptr<char[]> text(writer->RegisterAndGetOutputString());
  Programs::WriteFile(text.get(), fileName);
}

//------------------------------------------------------------------------------
void WriteJson(const Comparison& comparison, const std::string& fileName)
{
  Json::Value root;
  root["command"] = comparison.Command;
  root["input"] = comparison.Input;
  root["machine"] = comparison.Machine;
  root["repeats"] = comparison.Repeats;
  root["points"] = static_cast<Json::Int64>(comparison.Data->GetNumberOfPoints());
  root["cells"] = static_cast<Json::Int64>(comparison.Data->GetNumberOfCells());
  if (auto* image = vtkImageData::SafeDownCast(comparison.Data))
  {
    root["dimensions"] = ToJson(image->GetDimensions());
  }
  root["rows"] = Json::Value(Json::arrayValue);
  for (vtkIdType row = 0; row < comparison.Table->GetNumberOfRows(); ++row)
  {
    Json::Value value;
    for (vtkIdType column = 0; column < comparison.Table->GetNumberOfColumns(); ++column)
    {
      value[comparison.Table->GetColumnName(column)] =
        ToJson(comparison.Table->GetValue(row, column));
    }
    root["rows"].append(value);
  }
  for (const Crossover& crossover : comparison.Crossovers)
  {
    Json::Value value;
    value["dimensions"] = ToJson(crossover.Dimensions);
    value["triangles"] = ToJson(crossover.Triangles);
    value["rays"] = ToJson(crossover.Rays);
    value["verdict"] = Describe(Judge(crossover.Triangles, crossover.Rays));
    value["verdictIfDrawingWereFree"] =
      Describe(Judge(crossover.GetFreeTriangles(), crossover.Rays));
    root["crossovers"].append(value);
  }
  Programs::WriteFile(root.toStyledString(), fileName);
}

}
