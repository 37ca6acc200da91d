#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Tells which objects of kernels define more than their table. Of a function that several objects
# define (an inline one that was not inlined) the linker keeps any, for all of the program: were it
# the one for AVX-512, the program would end on a processor without.
set -euo pipefail

if [ $# -lt 2 ]; then
  echo "usage: Utilities/check-kernel-symbols.sh NM OBJECT..." >&2
  exit 2
fi
nm=$1
shift

status=0
for object in "$@"; do
  name=$(basename "${object}")
  table=${name#Kernels}
  table=${table%%.*}Kernels
  # Weak and unique ones are external too. (Sanitizers mark the table with a symbol of their own.)
  symbols=$("${nm}" --defined-only --extern-only --demangle "${object}" |
    grep -v ' __odr_asan' | cut -d ' ' -f 3- || true)
  if [ "${symbols}" != "vtkIsosurfaceRayTracing::${table}" ]; then
    echo "${name} must define vtkIsosurfaceRayTracing::${table} and nothing else, but has:"
    echo "${symbols:-nothing}"
    status=1
  fi
done
exit "${status}"
