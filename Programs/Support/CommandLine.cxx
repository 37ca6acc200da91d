// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "CommandLine.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <regex>
#include <stdexcept>

namespace Programs
{

namespace
{

using Parsing = vtksys::CommandLineArguments;

//------------------------------------------------------------------------------
double ToNumber(const std::string& text)
{
  // The parser takes all that follows an option with several values for these.
  if (text.rfind("--", 0) == 0)
  {
    throw std::runtime_error("unknown option " + text + "; see --help");
  }
  char* end = nullptr;
  errno = 0;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || std::isnan(number))
  {
    throw std::runtime_error(text + " is not a number; see --help");
  }
  if (std::isinf(number) && errno == ERANGE)
  {
    throw std::runtime_error(text + " is beyond the largest number, 1.8e308");
  }
  return number;
}

//------------------------------------------------------------------------------
int ToInteger(const std::string& text)
{
  const double number = ToNumber(text);
  if (!(std::abs(number) <= std::numeric_limits<int>::max()) || number != std::floor(number))
  {
    throw std::runtime_error(text + " is not an integer; see --help");
  }
  return static_cast<int>(number);
}

}

//------------------------------------------------------------------------------
CommandLine::CommandLine(int argc, char* argv[])
  : Arguments(argv + 1, argv + argc)
{
  this->Parser.Initialize();
  this->Parser.StoreUnusedArguments(true);
  this->Parser.AddBooleanArgument("--help", &this->Help, "Show this text.");
}

//------------------------------------------------------------------------------
void CommandLine::Add(const char* option, std::string* text, const char* help)
{
  this->Parser.AddArgument(option, Parsing::SPACE_ARGUMENT, text, help);
}

//------------------------------------------------------------------------------
void CommandLine::Add(const char* option, std::vector<std::string>* texts, const char* help)
{
  this->Parser.AddArgument(option, Parsing::MULTI_ARGUMENT, texts, help);
  this->Lists[option] = texts;
}

//------------------------------------------------------------------------------
void CommandLine::Add(const char* option, int* number, const char* help)
{
  std::string& text = this->TextOfNumber.emplace_back();
  this->Add(option, &text, help);
  this->Conversions.emplace_back(
    [&text, number] { *number = text.empty() ? *number : ToInteger(text); });
}

//------------------------------------------------------------------------------
void CommandLine::Add(const char* option, double* number, const char* help)
{
  std::string& text = this->TextOfNumber.emplace_back();
  this->Add(option, &text, help);
  this->Conversions.emplace_back(
    [&text, number] { *number = text.empty() ? *number : ToNumber(text); });
}

//------------------------------------------------------------------------------
void CommandLine::Add(const char* option, std::vector<double>* numbers, const char* help)
{
  std::vector<std::string>& texts = this->TextsOfNumbers.emplace_back();
  this->Add(option, &texts, help);
  this->Conversions.emplace_back([&texts, numbers]
    { std::transform(texts.begin(), texts.end(), std::back_inserter(*numbers), ToNumber); });
}

//------------------------------------------------------------------------------
void CommandLine::Add(const char* option, bool* isGiven, const char* help)
{
  this->Parser.AddBooleanArgument(option, isGiven, help);
}

//------------------------------------------------------------------------------
bool CommandLine::Parse()
{
  this->PassArguments();
  const bool isParsed = this->Parser.Parse() != 0;
  if (this->Help)
  {
    return false;
  }
  if (!isParsed)
  {
    throw std::runtime_error("an option lacks its value; see --help");
  }
  this->TakeFiles();
  for (const std::function<void()>& convert : this->Conversions)
  {
    convert();
  }
  return true;
}

//------------------------------------------------------------------------------
std::string CommandLine::GetHelp()
{
  // The parser calls values "opt", and cuts off the second "opt" of options with several.
  const std::string help =
    std::regex_replace(this->Parser.GetHelp(), std::regex("( --[-a-z]+) opt o\\w*"), "$1 VALUE...");
  return std::regex_replace(help, std::regex("( --[-a-z]+) opt "), "$1 VALUE ");
}

//------------------------------------------------------------------------------
/// To the parser: --option=value as two, which it knows as an option of its own. After the sign an
/// option with several values has one.
void CommandLine::PassArguments()
{
  for (const std::string& argument : this->Arguments)
  {
    const std::size_t end = argument.rfind("--", 0) == 0 ? argument.find('=') : std::string::npos;
    const std::string option = argument.substr(0, end);
    const bool hasValue = end != std::string::npos;
    const auto list = this->Lists.find(option);
    if (hasValue && list != this->Lists.end())
    {
      list->second->push_back(argument.substr(end + 1));
      continue;
    }
    this->Parser.ProcessArgument(option.c_str());
    if (hasValue)
    {
      this->Parser.ProcessArgument(argument.substr(end + 1).c_str());
    }
  }
}

//------------------------------------------------------------------------------
/// Throws std::runtime_error at what is neither an option nor a file.
void CommandLine::TakeFiles()
{
  int count = 0;
  char** arguments = nullptr;
  this->Parser.GetUnusedArguments(&count, &arguments);
  const std::vector<std::string> unused(arguments + 1, arguments + count); // after the program
  this->Parser.DeleteRemainingArguments(count, &arguments);
  for (const std::string& argument : unused)
  {
    if (!this->Files || argument.rfind('-', 0) == 0)
    {
      throw std::runtime_error("unknown option " + argument + "; see --help");
    }
    this->Files->push_back(argument);
  }
}

}
