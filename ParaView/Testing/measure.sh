#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Prints the times and memory that Documentation/paraview.md quotes, after ParaView/Testing/run.sh:
#
#   ParaView/Testing/measure.sh [CELLS [PIXELS]]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

root=$PWD/build/paraview-root/usr
plugins=("$PWD"/build/paraview/lib*/paraview-*/plugins)
libraries=("$root"/lib/*-linux-gnu*)
export PV_PLUGIN_PATH=${plugins[0]}
export PYTHONPATH=$root/lib/python3/dist-packages
export LD_LIBRARY_PATH=${libraries[0]}
export OMP_NUM_THREADS=1 # threads that wait would count as time of processors

# A process for each, because the memory is the largest that the process has had.
for way in traced contour volume; do
  Utilities/with-display.sh "$root/bin/pvbatch" ParaView/Testing/MeasureTimes.py "$way" "$@"
done
