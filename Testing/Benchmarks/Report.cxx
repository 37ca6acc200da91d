// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Report.h"

#include <vtk_jsoncpp.h>

#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace Benchmark
{
namespace
{

/// Three digits, and all before the point.
std::string Format(double value)
{
  std::ostringstream text;
  if (std::abs(value) >= 1000.0)
  {
    text << std::fixed << std::setprecision(0) << value;
  }
  else
  {
    text << std::setprecision(3) << value;
  }
  return text.str();
}

std::string ToMarkdown(const Cell& cell)
{
  if (const auto* text = std::get_if<std::string>(&cell))
  {
    return *text;
  }
  if (const auto* number = std::get_if<double>(&cell))
  {
    return std::isnan(*number) ? "" : Format(*number);
  }
  if (const auto* samples = std::get_if<Samples>(&cell); samples && !samples->IsEmpty())
  {
    const std::string median = Format(samples->GetMedian());
    return samples->GetCount() == 1
      ? median
      : median + " (" + Format(samples->GetMinimum()) + "-" + Format(samples->GetMaximum()) + ")";
  }
  return {};
}

Json::Value ToJson(const Cell& cell)
{
  if (const auto* text = std::get_if<std::string>(&cell))
  {
    return *text;
  }
  if (const auto* number = std::get_if<double>(&cell); number && std::isfinite(*number))
  {
    return *number;
  }
  Json::Value value;
  if (const auto* samples = std::get_if<Samples>(&cell); samples && !samples->IsEmpty())
  {
    value["median"] = samples->GetMedian();
    value["minimum"] = samples->GetMinimum();
    value["maximum"] = samples->GetMaximum();
    value["count"] = samples->GetCount();
  }
  return value;
}

void WriteTable(const Table& table, std::ostream& out)
{
  out << "\n### " << table.Title << "\n\n";
  if (!table.Note.empty())
  {
    out << table.Note << "\n\n";
  }
  for (const std::string& column : table.Columns)
  {
    out << "| " << column << " ";
  }
  out << "|\n";
  for (std::size_t i = 0; i < table.Columns.size(); ++i)
  {
    out << "|---";
  }
  out << "|\n";
  for (const auto& row : table.Rows)
  {
    for (const Cell& cell : row)
    {
      out << "| " << ToMarkdown(cell) << " ";
    }
    out << "|\n";
  }
}

/// What a goal needs to be measured.
const std::array<const char*, 7> GoalNeeds = { "the rival embree", "the rival polygons", "--goals",
  "--input", "--goals and a display", "--threads 1 and more, --goals", "--growth" };

Table MakeGoalTable(const std::vector<Goal>& goals)
{
  Table table{ "goals", "Goals", "", { "goal", "what", "asked", "measured", "" }, {} };
  for (int number = 1; number <= static_cast<int>(GoalNeeds.size()); ++number)
  {
    bool isMeasured = false;
    for (const Goal& goal : goals)
    {
      if (goal.Number == number)
      {
        isMeasured = true;
        const std::string asked = (goal.AtMost ? "at most " : "at least ") + Format(goal.Limit);
        table.Rows.push_back({ 1.0 * number, goal.What, asked, goal.Measured,
          std::string(goal.IsMet() ? "met" : "**missed**") });
      }
    }
    if (!isMeasured)
    {
      const std::string needs = GoalNeeds[static_cast<std::size_t>(number) - 1];
      table.Rows.push_back({ 1.0 * number, "not measured, which needs " + needs, std::monostate(),
        std::monostate(), std::monostate() });
    }
  }
  return table;
}

}

//------------------------------------------------------------------------------
std::string Report::GetMarkdown() const
{
  std::ostringstream out;
  for (const auto& circumstance : this->Circumstances)
  {
    out << "- " << circumstance.first << ": " << circumstance.second << "\n";
  }
  out << "\nTimes are medians, in brackets the fastest and the slowest; ratios are medians of the "
         "ratios of\nmeasurements taken in turn.\n";
  WriteTable(MakeGoalTable(this->Goals), out);
  for (const Table& table : this->Tables)
  {
    WriteTable(table, out);
  }
  return out.str();
}

//------------------------------------------------------------------------------
std::string Report::GetJson() const
{
  Json::Value root;
  for (const auto& circumstance : this->Circumstances)
  {
    root["circumstances"][circumstance.first] = circumstance.second;
  }
  for (const Goal& goal : this->Goals)
  {
    Json::Value row;
    row["goal"] = goal.Number;
    row["what"] = goal.What;
    row["limit"] = goal.Limit;
    row["atMost"] = goal.AtMost;
    row["measured"] = goal.Measured;
    row["met"] = goal.IsMet();
    root["goals"].append(row);
  }
  for (const Table& table : this->Tables)
  {
    Json::Value value;
    value["name"] = table.Name;
    value["title"] = table.Title;
    for (const auto& cells : table.Rows)
    {
      Json::Value row;
      for (std::size_t i = 0; i < cells.size(); ++i)
      {
        row[table.Columns[i]] = ToJson(cells[i]);
      }
      value["rows"].append(row);
    }
    root["tables"].append(value);
  }
  std::ostringstream out;
  out << root << "\n";
  return out.str();
}

}
