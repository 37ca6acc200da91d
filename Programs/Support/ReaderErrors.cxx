// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ReaderErrors.h"

#include <vtkAlgorithm.h>
#include <vtkExecutive.h>

#include <cstdio>

namespace Programs
{

//------------------------------------------------------------------------------
ReaderErrors::ReaderErrors(vtkAlgorithm* reader)
  : Reader(reader)
{
  this->Observer->SetCallback(&ReaderErrors::Add);
  this->Observer->SetClientData(&this->Count);
  reader->AddObserver(vtkCommand::ErrorEvent, this->Observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Silence);
}

//------------------------------------------------------------------------------
ReaderErrors::~ReaderErrors()
{
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
