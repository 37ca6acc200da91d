#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Installs what is missing, builds and installs the library and the programs below build/examples, and ray traces
# a CT of a skull (Debian's invesalius-examples):
#
#   Examples/run.sh                  writes pictures to build/examples/pictures
#   Examples/run.sh --interactive    opens vtkIsosurfaceViewer instead
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "$*" in
  "") interactive=no ;;
  --interactive) interactive=yes ;;
  *)
    echo "usage: Examples/run.sh [--interactive]" >&2
    exit 2
    ;;
esac

if [[ $interactive == yes && -z ${DISPLAY:-} ]]; then
  echo "error: --interactive needs a display, and DISPLAY is not set." >&2
  exit 1
fi

Utilities/install-dependencies.sh invesalius-examples

build=$PWD/build/examples

# Only Debian's Python has the modules of Debian's VTK; another python3 may come before it in PATH.
cmake -G Ninja -S . -B "$build" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_INSTALL_PREFIX="$build/prefix" -DPython3_EXECUTABLE=/usr/bin/python3
cmake --build "$build" --target install

/usr/bin/python3 Examples/Python/invesalius_to_metaimage.py \
  /usr/share/doc/invesalius-examples/examples/Cranium.inv3 "$build/data"

if [[ $interactive == yes ]]; then
  exec "$build/prefix/bin/vtkIsosurfaceViewer" "$build/data/cranium.mhd"
fi
packages=("$build"/prefix/lib/python3*/dist-packages)
PYTHONPATH=${packages[0]} /usr/bin/python3 Examples/Python/gallery.py \
  "$build/data/cranium.mhd" 300 "$build/pictures" # Hounsfield units: bone
echo "The pictures are in $build/pictures"
