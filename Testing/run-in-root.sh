#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Builds what is committed, and runs the tests, with VTK and the compilers of another release of Debian, in a bare root
# that is made for it and downloads some 800 MB. Arguments after the release go to ctest:
#
#   Testing/run-in-root.sh trixie --tests-regex Unit
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if (($# == 0)); then
  echo "usage: Testing/run-in-root.sh RELEASE [ARGUMENT OF CTEST...]" >&2
  exit 2
fi
release=$1
shift
Utilities/install-dependencies.sh git mmdebstrap
mkdir -p build/roots
git archive --output="build/roots/$release.tar" HEAD

# The hooks are run by a shell of their own, which knows the root as $1. The root goes with the command. (Mirrors that
# are copies of one day have lists that are out of date.)
# shellcheck disable=SC2016
mmdebstrap --quiet --variant=apt --dpkgopt=force-unsafe-io \
  --aptopt='Acquire::Check-Valid-Until "false"' \
  --customize-hook='mkdir "$1/root/source"' \
  --customize-hook="tar-in build/roots/$release.tar /root/source" \
  --customize-hook='chroot "$1" /root/source/Testing/run.sh '"${*@Q}" \
  "$release" /dev/null
