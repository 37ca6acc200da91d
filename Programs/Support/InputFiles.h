// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef InputFiles_h
#define InputFiles_h

#include <string>

namespace Programs
{

/// Whether there is such a file: no folder, and no pipe, which those who read wait for.
bool IsFile(const std::string& name);

/// Throws std::runtime_error if there is not.
void CheckIsFile(const std::string& name);

/// Throws std::runtime_error if writing a file would replace the input of a program: the file of
/// that name, or samples that a header refers to; or if the header of the input cannot be read.
void CheckIsNoInput(const std::string& output, const std::string& input);

}

#endif
