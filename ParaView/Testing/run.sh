#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Builds the plugin for Debian's ParaView in build/paraview, and tests it:
#
#   ParaView/Testing/run.sh [CTEST_ARGUMENT...]
#
# Debian's python3-paraview cannot be installed beside python3-vtk9. So ParaView's packages are not
# installed but unpacked, in build/paraview-root; what they depend on is installed. Where the packages
# cannot be had, the tests are skipped, which is no error.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

root=$PWD/build/paraview-root

skip() {
  echo "skipped: $1 The plugin for ParaView was neither built nor tested." >&2
  exit 0
}

as_root=()
if ((EUID != 0)); then
  as_root=(sudo)
fi

# Unpacks into a folder that gets its name only when all is there.
unpack_paraview() {
  local folder=$root.part
  rm -rf "$folder"
  mkdir -p "$folder/packages"
  (cd "$folder/packages" && apt-get download paraview paraview-dev python3-paraview) || return 1
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get --option DPkg::Lock::Timeout=300 \
    satisfy --yes --no-remove --no-install-recommends \
    "$(dpkg-deb --field "$folder"/packages/paraview_*.deb Depends)" || return 1
  for package in "$folder"/packages/*.deb; do
    dpkg-deb --extract "$package" "$folder"
  done
  rm -r "$folder/packages"
  mv "$folder" "$root"
}

if ! command -v apt-get >/dev/null; then
  skip "this is not a Debian system (no apt-get)."
fi
Utilities/install-dependencies.sh libdouble-conversion-dev libfreetype-dev libgl1-mesa-dev libglew-dev \
  liblz4-dev liblzma-dev libopenmpi-dev libutfcpp-dev openmpi-bin python3-numpy ccache
if [[ ! -d $root ]]; then
  unpack_paraview || skip "Debian's packages of ParaView, or what they need, cannot be had (see above)."
fi

source Utilities/compiler-cache.sh
config=("$root"/usr/lib/*/cmake/paraview-*)
cmake -S ParaView -B build/paraview -G Ninja -DParaView_DIR="${config[0]}" -DBUILD_TESTING=ON \
  -DvtkIsosurfaceRayTracing_WARNINGS_AS_ERRORS=ON -DPython3_EXECUTABLE=/usr/bin/python3
cmake --build build/paraview
cd build/paraview
# Threads that wait sleep, as in our other tests.
OMP_WAIT_POLICY=passive ../../Utilities/with-display.sh ctest --output-on-failure "$@"
