// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef NumberEntry_h
#define NumberEntry_h

#include <optional>
#include <string>

namespace Viewer
{

/// A number that is typed, key by key.
class NumberEntry
{
public:
  enum class Result
  {
    Ignored, ///< The key has nothing to do with a number.
    Typing,
    Cancelled,
    Finished
  };

  /// Takes a key by the name and the character that VTK has for it. A digit, a sign or a point
  /// begins a number, Return finishes it, Escape cancels it.
  Result TakeKey(const std::string& name, char character);

  /// What has been typed; empty unless a number is being typed.
  const std::string& GetText() const { return this->Text; }

  /// The number that has been finished; none if what was typed is no number.
  std::optional<double> GetNumber() const { return this->Number; }

private:
  std::string Text;
  std::optional<double> Number;
};

}

#endif
