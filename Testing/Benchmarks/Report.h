// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Report_h
#define Report_h

#include "Json.h"

#include <string>
#include <vector>

namespace Benchmark
{

/// Nothing, a text, a number, or what repeating a measurement gave.
struct Cell
{
  Cell() = default;
  template <typename Content>
  Cell(const Content& content)
    : Value(ToJson(content))
  {
  }

  Json::Value Value;
};

struct Table
{
  /// For programs.
  std::string Name;
  std::string Title;
  /// What must be known to read it.
  std::string Note;
  std::vector<std::string> Columns;
  std::vector<std::vector<Cell>> Rows;
};

/// A target and the ratio that was measured.
struct Goal
{
  int Number;
  std::string What;
  double Measured;
  /// Measured must not be above the limit, or not below.
  bool AtMost;
  double Limit;
};

/// All that is measured, and of what.
struct Report
{
  Json::Value Environment;
  std::vector<Table> Tables;
  std::vector<Goal> Goals;

  /// Adds a row to the table of this name, which is added where it is not there.
  void AddRow(const Table& empty, const std::vector<Cell>& row);

  Json::Value GetJson() const;
};

}

#endif
