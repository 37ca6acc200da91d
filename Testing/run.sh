#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Installs what is missing, builds, and runs all tests. Arguments go to ctest:
#
#   Testing/run.sh --tests-regex Unit
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

Utilities/install-dependencies.sh libgtest-dev libgmp-dev libembree-dev

# The python3 found first may be another than Debian's, which alone knows Debian's VTK.
cmake --preset release -DPython3_EXECUTABLE=/usr/bin/python3
cmake --build --preset release
# Without -noreset the server starts anew whenever its last client leaves, and refuses the next one
# that comes meanwhile.
xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
  ctest --preset release --parallel 2 "$@"
