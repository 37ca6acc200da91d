// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TableFiles_h
#define TableFiles_h

#include <string>

namespace Compare
{

struct Comparison;

/// Write the table; values that were not measured are nan in CSV and null in JSON. Throw
/// std::runtime_error if the file cannot be written.
void WriteCsv(const Comparison& comparison, const std::string& fileName);
void WriteJson(const Comparison& comparison, const std::string& fileName);

}

#endif
