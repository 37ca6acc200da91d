#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Installs what is missing, builds, and runs all tests. Arguments go to ctest:
#
#   Testing/run.sh --tests-regex Unit
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

Utilities/install-dependencies.sh libgtest-dev libgmp-dev libembree-dev clang libomp-dev python3-numpy \
  xdotool x11-apps doxygen help2man make ccache
source Utilities/compiler-cache.sh

# Only Debian's Python has the modules of Debian's VTK; another python3 may come before it in PATH.
cmake --preset developer -DPython3_EXECUTABLE=/usr/bin/python3
cmake --build --preset developer
Utilities/with-display.sh ctest --preset developer --parallel 2 "$@"
