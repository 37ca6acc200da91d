// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ThreadsAtRest_h
#define ThreadsAtRest_h

namespace Programs
{

/// Lets threads of OpenMP that wait sleep, unless OMP_WAIT_POLICY or GOMP_SPINCOUNT say something
/// else; main calls it first, with its arguments.
///
/// GNU's threads spin for some milliseconds before they sleep. Between pictures that takes
/// processors from Mesa, which draws them with threads of its own; and if other programs run, it
/// keeps the thread that is waited for from running. The variable is read when OpenMP is loaded,
/// so the program begins once more, where /proc says which it is. Elsewhere nothing changes, nor
/// does it under Valgrind, which would be left, or if the dynamic loader was started by its name.
void LetThreadsRest(char* argv[]);

}

#endif
