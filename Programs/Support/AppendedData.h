// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AppendedData_h
#define AppendedData_h

#include <string>

namespace Programs
{

/// Throws std::runtime_error if a file of XML, or one that it names, ends before its raw appended
/// data do: VTK's readers leave these samples undefined.
void CheckAppendedData(const std::string& fileName);

}

#endif
