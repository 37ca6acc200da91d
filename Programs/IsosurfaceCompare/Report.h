// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Report_h
#define Report_h

#include <string>

namespace Compare
{

struct Comparison;

/// Writes report.html into a folder, which is made if it is not there: one file that needs no
/// other, with tables, plots and pictures. Where nothing can be drawn it says so and has the rest.
/// Returns its name. Throws std::runtime_error if it cannot be written.
std::string WriteReport(const Comparison& comparison, const std::string& folder);

}

#endif
