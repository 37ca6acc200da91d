// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RunProgram_h
#define RunProgram_h

#include "Support/OutputFile.h"
#include "Support/ThreadsAtRest.h"

#include <cstdio>
#include <cstdlib>
#include <exception>

namespace Benchmark
{

/// Parses the arguments of a program, and if there is something to do does it; returns the status
/// of main. Parse returns whether there is, and has printed what is to be known if not; run returns
/// whether all is well. Arguments have a member Help.
template <typename Arguments, typename Parse, typename Run>
int RunProgram(int argc, char* argv[], const Parse& parse, const Run& run)
{
  Programs::LetThreadsRest(argv);
  Arguments arguments;
  try
  {
    const bool isParsed = parse(argc, argv, arguments);
    const bool isWell = isParsed ? run(arguments) : arguments.Help;
    Programs::FlushStandardOutput();
    return isWell ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "error: %s\n", error.what());
    return EXIT_FAILURE;
  }
}

}

#endif
