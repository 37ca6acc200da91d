#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Builds the core and some of its unit tests for AArch64, compares its pictures with those that a program of this
# processor prints, and runs the unit tests, by QEMU:
#
#   Testing/AArch64/run.sh PROGRAM BUILD_FOLDER
set -euo pipefail

if (($# != 2)); then
  echo "usage: Testing/AArch64/run.sh PROGRAM BUILD_FOLDER" >&2
  exit 2
fi
program=$1
build=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
googletest=/usr/src/googletest

skip() {
  echo "skipped: $1"
  exit 77
}
for tool in aarch64-linux-gnu-g++ qemu-aarch64-static; do
  command -v "$tool" >/dev/null ||
    skip "there is no $tool (apt-get install g++-aarch64-linux-gnu qemu-user-static)"
done
[[ -d $googletest ]] || skip "there is no $googletest (apt-get install libgtest-dev)"

cmake -G Ninja -S "$here/Project" -B "$build" --toolchain "$here/toolchain.cmake" -DCMAKE_BUILD_TYPE=Release \
  -DGoogleTest_SOURCE_DIR="$googletest" -DvtkIsosurfaceRayTracing_WARNINGS_AS_ERRORS=ON
cmake --build "$build" --parallel 2

emulated() {
  qemu-aarch64-static -L /usr/aarch64-linux-gnu "$@"
}
"$program" >"$build/pictures-here.txt"
emulated "$build/PrintPictures" >"$build/pictures-AArch64.txt"
echo "Pictures of this processor (<) that differ from those of AArch64 (>):"
diff "$build/pictures-here.txt" "$build/pictures-AArch64.txt"
echo "none of $(wc -l <"$build/pictures-here.txt")"
emulated "$build/UnitTests" --gtest_brief=1
