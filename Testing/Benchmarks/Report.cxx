// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Report.h"

#include <algorithm>

namespace Benchmark
{
namespace
{

Json::Value ToJson(const Goal& goal)
{
  Json::Value value;
  value["goal"] = goal.Number;
  value["what"] = goal.What;
  value["limit"] = goal.Limit;
  value["atMost"] = goal.AtMost;
  value["measured"] = goal.Measured;
  return value;
}

Json::Value ToJson(const Table& table)
{
  Json::Value value;
  value["name"] = table.Name;
  value["title"] = table.Title;
  value["note"] = table.Note;
  for (const std::string& column : table.Columns)
  {
    value["columns"].append(column);
  }
  for (const std::vector<Cell>& cells : table.Rows)
  {
    Json::Value row;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      row[table.Columns[i]] = cells[i].Value;
    }
    value["rows"].append(row);
  }
  return value;
}

}

//------------------------------------------------------------------------------
void Report::AddRow(const Table& empty, const std::vector<Cell>& row)
{
  auto table = std::find_if(this->Tables.begin(), this->Tables.end(),
    [&empty](const Table& other) { return other.Name == empty.Name; });
  if (table == this->Tables.end())
  {
    table = this->Tables.insert(table, empty);
  }
  table->Rows.push_back(row);
}

//------------------------------------------------------------------------------
Json::Value Report::GetJson() const
{
  Json::Value root;
  root["environment"] = this->Environment;
  root["goals"] = Json::Value(Json::arrayValue);
  root["tables"] = Json::Value(Json::arrayValue);
  for (const Goal& goal : this->Goals)
  {
    root["goals"].append(ToJson(goal));
  }
  for (const Table& table : this->Tables)
  {
    root["tables"].append(ToJson(table));
  }
  return root;
}

}
