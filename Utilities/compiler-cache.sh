# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# shellcheck shell=bash

# To be sourced in the root of the project: where ccache is installed, the builds that follow compile
# once what several of them compile alike. The core is built for the tests, by Examples/run.sh, and for
# ParaView, and takes half of the time of each.
if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_DIR=$PWD/build/ccache
  # What compiles with warnings as errors has none.
  export CCACHE_IGNOREOPTIONS=-Werror
fi
