// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Report_h
#define Report_h

#include <string>

namespace Compare
{

struct Comparison;

/// Writes report.html into a folder, which is created if it does not exist: a self-contained file
/// with tables, plots and pictures. Without a display it says so and has no plots. Returns its
/// name. Throws std::runtime_error if it cannot be written.
std::string WriteReport(const Comparison& comparison, const std::string& folder);

}

#endif
