// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "CameraStyle.h"

#include <vtkObjectFactory.h>

namespace Viewer
{

vtkStandardNewMacro(CameraStyle);

}
