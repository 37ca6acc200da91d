// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Report_h
#define Report_h

#include "Samples.h"

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace Benchmark
{

/// Nothing, a text, a number, or what repeating a measurement gave. A NaN is nothing.
using Cell = std::variant<std::monostate, std::string, double, Samples>;

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

/// What was asked for, and what was measured, as a ratio.
struct Goal
{
  int Number;
  std::string What;
  double Measured;
  /// Measured must not be above the limit, or not below.
  bool AtMost;
  double Limit;

  bool IsMet() const
  {
    return this->AtMost ? this->Measured <= this->Limit : this->Measured >= this->Limit;
  }
};

/// All that is measured, and of what.
struct Report
{
  /// The machine, the command and so on: name and value.
  std::vector<std::pair<std::string, std::string>> Circumstances;
  std::vector<Table> Tables;
  std::vector<Goal> Goals;

  std::string GetMarkdown() const;
  std::string GetJson() const;
};

}

#endif
