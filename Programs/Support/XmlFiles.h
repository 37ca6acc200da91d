// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef XmlFiles_h
#define XmlFiles_h

#include <string>

namespace Programs
{

/// Throws std::runtime_error if a file of XML, or one that it names, ends before its raw appended
/// data do, or if its pieces do not fill its extent: VTK's readers leave these samples undefined.
/// And if one that it names has no end, by which readers of grids in pieces crash.
void CheckXmlFile(const std::string& fileName);

}

#endif
