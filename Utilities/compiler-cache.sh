# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# shellcheck shell=bash

# To be sourced in the root of the project: where ccache is installed, the builds that follow compile
# once what several of them compile alike. The library is built for the tests, by Examples/run.sh, in
# a stand-in for VTK's tree, and, its core, for ParaView.
if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_DIR=$PWD/build/ccache
  # Paths are compared as seen from the folder of a build: it must be as deep in the project as others.
  export CCACHE_BASEDIR=$PWD
  # The first build has all warnings, as errors: what it compiles has none.
  export CCACHE_IGNOREOPTIONS='-W*'
  # ctest sets variables of the locale, in which messages are compared: there are none.
  export CCACHE_SLOPPINESS=locale
fi
