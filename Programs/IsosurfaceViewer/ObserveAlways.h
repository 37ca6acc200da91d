// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ObserveAlways_h
#define ObserveAlways_h

#include <vtkCommand.h>
#include <vtkRenderWindowInteractor.h>

namespace Viewer
{

/// Observes an event of an interactor, also while a widget or a style has grabbed all events. The
/// callback must not enable or disable widgets, which observe it as well.
template <typename T>
void ObserveAlways(
  vtkRenderWindowInteractor* interactor, unsigned long event, T* observer, void (T::*callback)())
{
  const unsigned long tag = interactor->AddObserver(event, observer, callback);
  interactor->GetCommand(tag)->SetPassiveObserver(1);
}

}

#endif
