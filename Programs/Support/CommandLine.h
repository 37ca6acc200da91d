// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CommandLine_h
#define CommandLine_h

#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <vtksys/CommandLineArguments.hxx>

namespace Programs
{

/// The options of a program, parsed by vtksys, whose numbers are checked: it takes any text for
/// one. A value may follow its option as another argument or after an equals sign. What an option
/// that is not given stands for stays as it is. --help is added.
class CommandLine
{
public:
  CommandLine(int argc, char* argv[]);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  void Add(const char* option, std::string* text, const char* help);
  void Add(const char* option, std::vector<std::string>* texts, const char* help);
  void Add(const char* option, int* number, const char* help);
  void Add(const char* option, double* number, const char* help);
  void Add(const char* option, std::vector<double>* numbers, const char* help);

  void Add(const char* option, bool* isGiven, const char* help);

  /// Takes arguments that are no options.
  void AddFiles(std::vector<std::string>* files) { this->Files = files; }

  /// Returns whether the options are to be done, false if only the help is asked for. Throws
  /// std::runtime_error if an option is unknown or lacks its value, or if a number is none.
  bool Parse();
  std::string GetHelp();

private:
  void PassArguments();
  void TakeFiles();

  /// As they are given, after the name of the program.
  std::vector<std::string> Arguments;
  /// The texts of options with several values.
  std::map<std::string, std::vector<std::string>*> Lists;
  vtksys::CommandLineArguments Parser;
  /// What is to be converted into numbers. The parser keeps their places.
  std::deque<std::string> TextOfNumber;
  std::deque<std::vector<std::string>> TextsOfNumbers;
  std::vector<std::function<void()>> Conversions;
  std::vector<std::string>* Files = nullptr;
  bool Help = false;
};

}

#endif
