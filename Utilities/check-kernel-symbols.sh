#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Tells which objects of kernels define more than their table. Of a function that several objects
# define (an inline one that was not inlined) the linker keeps any, for all of the program: were it
# the one for AVX-512, the program would end on a processor without. Ends with 77 where there is
# nothing to look at, or nothing to look with.
set -euo pipefail

if [ $# -lt 1 ]; then
  echo "usage: Utilities/check-kernel-symbols.sh NM OBJECT..." >&2
  exit 2
fi
nm=$1
shift
if ! command -v "${nm}" >/dev/null; then
  echo "skipped: there is no ${nm} to read the symbols with (binutils has one)"
  exit 77
fi
if [ $# -eq 0 ]; then
  echo "skipped: this processor has one instruction set only"
  exit 77
fi

status=0
for object in "$@"; do
  name=$(basename "${object}")
  table=${name#Kernels}
  table=${table%%.*}Kernels
  # Weak and unique functions are external too. Weak data (V) has no instructions: sanitizers, and
  # code that is not optimized, bring some, and another symbol for the table.
  symbols=$("${nm}" --defined-only --extern-only --demangle "${object}" |
    grep -v ' V \| __odr_asan' | cut -d ' ' -f 3- || true)
  if [ "${symbols}" != "vtkIsosurfaceRayTracing::${table}" ]; then
    echo "${name} must define vtkIsosurfaceRayTracing::${table} and nothing else, but has:"
    echo "${symbols:-nothing}"
    status=1
  fi
done
exit "${status}"
