#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# What a user does in the first hour, as a page (Documentation/first-hour.md): each command, what it prints and its time.
# The current folder has the packages (*.deb), a CT (ct), and the viewer's user (view_ct.py); see
# Utilities/document_first_hour.sh. Testing/Packages/TestFirstHour.py runs it with a stand-in for apt.
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive
examples=${EXAMPLES:-/usr/share/doc/vtkisosurfaceraytracing-doc/Examples}

# Runs a command, and shows the last lines of what it prints. It ends where the command fails.
run() {
  local start lines output tenths
  printf '```console\n$ %s\n' "$1"
  start=$(date +%s%N)
  if ! output=$(bash -c "$1" 2>&1); then
    printf '%s\n' "$output" >&2
    exit 1
  fi
  tenths=$((($(date +%s%N) - start) / 100000000))
  lines=$(wc -l <<<"$output")
  if ((lines > 5)); then
    echo "... ($((lines - 5)) lines)"
  fi
  if [[ -n $output ]]; then
    tail -n 5 <<<"$output" | tr --delete '\r' | cut -c 1-110
  fi
  printf '```\n\n%d.%d seconds.\n\n' $((tenths / 10)) $((tenths % 10))
}

cat <<'END'
# The first hour

What a new user types on a bare Debian 12, as root, what is printed (the last five lines), and how long it takes, the
download of packages included. `Utilities/document_first_hour.sh` makes the system, this page and its pictures.

END
echo "Done on $(date +%F), on $(nproc) cores of a shared machine, whose load was $(cut -d ' ' -f 1 /proc/loadavg) before."
cat <<'END'

## Install

In the folder of the packages that the chapter [Install](../README.md#install) makes:

END
run 'apt install --yes ./*.deb'

cat <<'END'
## A picture with one command

END
run "python3 $examples/Python/numpy_to_png.py gyroid.png"
cat <<'END'
![A gyroid, coloured by the distance from its middle](images/first-hour-gyroid.png)

## From a folder of DICOM slices to a picture

The folder `ct` has the 108 slices of a CT (that of Debian's package `invesalius-examples`, written as DICOM).

END
run "python3 -c 'from vtkIsosurfaceRayTracing import render; render(\"ct\", [-300, 300], color=[\"peachpuff\", \"ivory\"], background=\"white\").save(\"head.png\")'"
cat <<'END'
![A skull below translucent skin](images/first-hour-head.png)

Without Python, and by many processes if need be:

END
run 'vtkIsosurfaceRender --input ct --isovalue 300 --output skull.png'
cat <<'END'
## The viewer

Start `vtkIsosurfaceViewer ct`, and press the keys `3 0 0 Return a - 3 0 0 Return x`: an isovalue, a second surface and its
isovalue, and a clip plane. A bare system has no display; here Xvfb stands in for it, and for the user `view_ct.py`, which is
in no package, but in the folder `Testing/Packages` of the source.

END
run 'apt install --yes xvfb xauth xdotool x11-apps'
run 'xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" python3 view_ct.py vtkIsosurfaceViewer ct viewer.png'
cat <<'END'
![The viewer's window: the cut skull and skin, sliders above a histogram](images/first-hour-viewer.png)

## C++

END
run 'apt install --yes g++ cmake make'
run "cmake -S $examples/Cxx/Minimal -B minimal -DCMAKE_BUILD_TYPE=Release"
run 'cmake --build minimal'
run 'minimal/Minimal'
cat <<'END'
![Waves, lit from the camera](images/first-hour-minimal.png)

## Remove

END
run 'apt remove --yes "*vtkisosurfaceraytracing*"'
