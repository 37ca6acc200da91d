// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ThreadsAtRest_h
#define ThreadsAtRest_h

namespace Programs
{

/// Lets threads of GNU's OpenMP that wait sleep after some 0.3 ms, unless OMP_WAIT_POLICY or
/// GOMP_SPINCOUNT say something else; main calls it first, with its arguments.
///
/// Else they spin for some 8 ms. Between pictures that takes processors from Mesa, which draws them
/// with threads of its own; and if other programs run, it may keep the thread that is waited for
/// from running. At once they should not sleep either: to be woken takes 0.1 ms, in virtual
/// machines more. The variable is read when OpenMP is loaded, so the program begins once more,
/// where /proc says which it is. Elsewhere nothing changes, nor does it under Valgrind, which would
/// be left, or if the dynamic loader was started by its name.
void LetThreadsRest(char* argv[]);

}

#endif
