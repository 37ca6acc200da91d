// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ReaderErrors.h"

#include <vtkAlgorithm.h>
#include <vtkExecutive.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <cstdio>
#include <cstring>

namespace Programs
{
namespace
{

/// Counts what readers report of files that end before their last samples: as a warning of no
/// object. The samples are undefined, then.
class ReportWindow : public vtkOutputWindow
{
public:
  static ReportWindow* New();
  vtkTypeMacro(ReportWindow, vtkOutputWindow);

  int* Count = nullptr;

  void DisplayGenericWarningText(const char* text) override
  {
    for (const char* end :
      { "Error reading ascii data", "Error reading binary data", "File operation failed" })
    {
      *this->Count += std::strstr(text, end) ? 1 : 0;
    }
    this->Superclass::DisplayGenericWarningText(text);
  }
};

vtkStandardNewMacro(ReportWindow);

}

//------------------------------------------------------------------------------
ReaderErrors::ReaderErrors(vtkAlgorithm* reader)
  : Reader(reader)
  , Window(vtkOutputWindow::GetInstance())
{
  vtkNew<ReportWindow> reports;
  reports->Count = &this->Count;
  vtkOutputWindow::SetInstance(reports);
  this->Observer->SetCallback(&ReaderErrors::Add);
  this->Observer->SetClientData(&this->Count);
  reader->AddObserver(vtkCommand::ErrorEvent, this->Observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Silence);
}

//------------------------------------------------------------------------------
ReaderErrors::~ReaderErrors()
{
  vtkOutputWindow::SetInstance(this->Window);
  this->Reader->RemoveObserver(this->Observer);
  this->Reader->GetExecutive()->RemoveObserver(this->Silence);
}

//------------------------------------------------------------------------------
void ReaderErrors::Add(vtkObject*, unsigned long, void* count, void* text)
{
  ++*static_cast<int*>(count);
  std::fprintf(stderr, "%s", static_cast<const char*>(text));
}

}
