#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Tells which C++ sources clang-format 14 would change; with --fix it changes them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "$*" in
  "") mode=(--dry-run -Werror --ferror-limit=1) ;;
  --fix) mode=(-i) ;;
  *)
    echo "usage: Utilities/lint.sh [--fix]" >&2
    exit 2
    ;;
esac

find Examples Filters IO Module ParaView Parallel Programs Rendering Testing \( -name '*.h' -o -name '*.inl' -o -name '*.cxx' \) -print0 |
  xargs -0 clang-format-14 "${mode[@]}"
