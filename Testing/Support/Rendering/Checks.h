// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Checks_h
#define Checks_h

#include <vtkCommand.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

namespace MapperTesting
{

/// Counts failed checks, and prints them.
class Checks
{
public:
  void That(bool isTrue, const std::string& claim)
  {
    if (!isTrue)
    {
      std::cerr << "Not true: " << claim << "\n";
      ++this->Failures;
    }
  }

  template <typename T>
  void Equal(const T& actual, const T& expected, const std::string& what)
  {
    if (!(actual == expected))
    {
      std::cerr << what << " is " << actual << ", not " << expected << "\n";
      ++this->Failures;
    }
  }

  void Near(double actual, double expected, double tolerance, const std::string& what)
  {
    if (!(std::abs(actual - expected) <= tolerance))
    {
      std::cerr << what << " is " << actual << ", not " << expected << " within " << tolerance
                << "\n";
      ++this->Failures;
    }
  }

  int Result() const { return this->Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE; }

private:
  int Failures = 0;
};

/// Counts the events of a kind, and keeps the last text that came with one.
class EventCounter : public vtkCommand
{
public:
  vtkTypeMacro(EventCounter, vtkCommand);
  static EventCounter* New() { return new EventCounter; }
  void Execute(vtkObject*, unsigned long event, void* data) override
  {
    ++this->Count;
    if (event == vtkCommand::ErrorEvent || event == vtkCommand::WarningEvent)
    {
      this->Text = static_cast<const char*>(data);
    }
  }

  int Count = 0;
  std::string Text;
};

}

#endif
