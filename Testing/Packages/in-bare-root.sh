#!/bin/sh
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# What a user does with the packages, as root of a bare Debian 12: see Testing/run-packages.sh.
set -eu
cd "$(dirname "$0")"
export DEBIAN_FRONTEND=noninteractive
install="apt-get install --quiet=2 --yes --no-install-recommends --option Dpkg::Use-Pty=0"
start=$(date +%s)

step() {
  echo "== after $(($(date +%s) - start)) s: $*"
}

step "apt install all but the development files"
# shellcheck disable=SC2046,SC2086
$install $(find ./packages -name '*.deb' -not -name '*-dev_*')

step "draw, in one line"
python3 -c 'import numpy as np; from vtkIsosurfaceRayTracing import render
x, y, z = np.mgrid[-7:7:96j, -7:7:96j, -7:7:96j]
render(np.cos(x) * np.sin(y) + np.cos(y) * np.sin(z) + np.cos(z) * np.sin(x), 0.3, size=(400, 400)).save("picture.png")'

step "the programs and their manual pages"
printf 'ObjectType = Image\nNDims = 3\nDimSize = 8 8 8\nElementType = MET_UCHAR\nElementDataFile = ramp.raw\n' >ramp.mhd
for layer in 000 040 100 140 200 240 300 340; do printf "\\$layer%.0s" $(seq 64); done >ramp.raw
vtkIsosurfaceRender --input ramp.mhd --isovalue 100 --output ramp.png --width 64 --height 64
test -s ramp.png
for program in Compare Render Viewer; do
  vtkIsosurface$program --help >/dev/null
  gzip --test /usr/share/man/man1/vtkIsosurface$program.1.gz
done

step "the development files, and the project of README.md"
# shellcheck disable=SC2086
$install ./packages/*-dev_*.deb g++ make cmake
mkdir project
cp my_program.cxx project
{
  echo 'cmake_minimum_required(VERSION 3.21...3.25)'
  sed '/^```cmake$/,/^```$/!d; /^```/d' README.md
} >project/CMakeLists.txt
cmake -S project -B project/build -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build project/build

step "apt remove"
# shellcheck disable=SC2046
apt-get remove --quiet=2 --yes --option Dpkg::Use-Pty=0 $(dpkg-query --show --showformat '${Package}\n' '*vtkisosurfaceraytracing*')
# Dpkg keeps the name of a package that has a script for later, until it is purged.
left=$(find / -xdev -ipath '*isosurface*' -not -path "$PWD/*" -not -path '/var/lib/dpkg/*')
if [ -n "$left" ]; then
  echo "error: removed packages left behind: $left" >&2
  exit 1
fi
step "done"
