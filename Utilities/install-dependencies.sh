#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Installs the Debian packages needed to build and to draw, and those named as arguments:
#
#   Utilities/install-dependencies.sh [PACKAGE...]
#
# It calls apt-get for the missing ones alone, so running it again costs nothing. It runs as root,
# or as a user with sudo.
set -euo pipefail

packages=(
  g++ cmake ninja-build
  libvtk9-dev                    # depends on VTK's Python modules and on Python's headers too
  xvfb xauth libgl1-mesa-dri     # a display without a screen, and OpenGL without a graphics card
  "$@")

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  {
    echo "error: this is not a Debian system (no apt-get and dpkg-query)."
    echo "Install what these Debian packages hold: ${packages[*]}"
    echo "Then build with CMake: cmake --preset release && cmake --build --preset release"
  } >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  if [[ $status != installed* ]]; then
    missing+=("$package")
  fi
done
if ((${#missing[@]} == 0)); then
  exit 0
fi

echo "Installing Debian packages, and what they depend on: ${missing[*]}"
as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "error: not root and no sudo. As root: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get --option DPkg::Lock::Timeout=300 "$@"
}

# Slim images lack two things: what packages put below /usr/share/doc (the CT of the example), and the
# folder of manual pages, without which Java (on which libvtk9-dev depends) fails to install.
"${as_root[@]}" mkdir -p /usr/share/man/man1
install=(install --yes --no-install-recommends
  --option 'Dpkg::Options::=--path-include=/usr/share/doc/*/examples/*' "${missing[@]}")

# The package lists may be absent (fresh systems), which a simulation tells, or name files that the
# mirror no longer has, which only the download tells.
if ! apt "${install[@]}" --simulate >/dev/null 2>&1; then
  apt update
fi
if ! apt "${install[@]}"; then
  echo "Trying again with fresh package lists."
  apt update
  apt "${install[@]}"
fi
