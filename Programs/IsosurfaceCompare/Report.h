// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Report_h
#define Report_h

#include <string>

namespace Compare
{

struct Comparison;

/// Writes a self-contained HTML file with tables, plots and pictures. Without a display it says so
/// and has no plots. Throws std::runtime_error if it cannot be written.
void WriteReport(const Comparison& comparison, const std::string& fileName);

}

#endif
