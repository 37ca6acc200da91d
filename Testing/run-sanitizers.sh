#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Builds the tests of the core with the address and undefined behaviour sanitizers, and with the
# thread sanitizer, and runs them: with the last, those that use several threads. The first two run
# those of many processes that need no Python, too (MPI itself is not made for the last); with ALL=1
# also the tests of the VTK classes, the programs and the benchmarks.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

Utilities/install-dependencies.sh libgtest-dev libgmp-dev clang libomp-dev

targets=(vtkIsosurfaceRayTracingUnitTests vtkIsosurfaceRayTracingHardCases)
single_threaded='Kernels|Classification|PacketTracing|Tricubic|Cubic|TestCells|TestRays|TestVolumes|TestMeshes'
# Pictures that 1, 2 and 8 processes make together; those of 3 stay.
like_others='SharedPicture.*/\((1|2|8),'
export ATTACK_SCENES="${ATTACK_SCENES:-200}"

cmake --preset asan -DPython3_EXECUTABLE=/usr/bin/python3
if [[ "${ALL:-}" ]]; then
  cmake --build --preset asan
  Utilities/with-display.sh ctest --preset asan --parallel 2
else
  cmake --build --preset asan --target "${targets[@]}" vtkIsosurfaceRayTracingAllocationTests \
    vtkIsosurfaceRayTracingProcessTests vtkIsosurfaceRender
  ctest --preset asan --parallel 2 --tests-regex '^(Unit|HardCases|Parallel\.(Processes|IsosurfaceRender))' \
    --exclude-regex "${like_others}"
fi

cmake --preset tsan -DPython3_EXECUTABLE=/usr/bin/python3
cmake --build --preset tsan --target "${targets[@]}"
ctest --preset tsan --parallel 2 --tests-regex '^(Unit|HardCases)' \
  --exclude-regex "${single_threaded}|${like_others}"
