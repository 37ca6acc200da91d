// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "NumberEntry.h"

#include <cmath>
#include <cstdlib>

namespace Viewer
{
namespace
{

bool BeginsNumber(char character)
{
  return character != '\0' && std::string("0123456789+-.").find(character) != std::string::npos;
}

std::optional<double> ToNumber(const std::string& text)
{
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return *end == '\0' && std::isfinite(number) ? std::optional<double>(number) : std::nullopt;
}

}

//------------------------------------------------------------------------------
NumberEntry::Result NumberEntry::TakeKey(const std::string& name, char character)
{
  if (this->Text.empty() && !BeginsNumber(character))
  {
    return Result::Ignored;
  }
  if (name == "Escape")
  {
    this->Text.clear();
    return Result::Cancelled;
  }
  if (name == "Return" || name == "KP_Enter")
  {
    this->Number = ToNumber(this->Text);
    this->Text.clear();
    return Result::Finished;
  }
  if (name == "BackSpace")
  {
    this->Text.pop_back();
    return this->Text.empty() ? Result::Cancelled : Result::Typing;
  }
  if (BeginsNumber(character) || character == 'e')
  {
    this->Text += character;
  }
  return Result::Typing;
}

}
