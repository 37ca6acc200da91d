#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Makes the Debian package of the plugin, for the ParaView that run.sh has unpacked, and draws with it in a bare Debian 12
# (see Testing/run-packages.sh). build/debian-paraview/picture.png is what was drawn there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

config=(build/paraview-root/usr/lib/*/cmake/paraview-*)
if [[ ! -d ${config[0]} ]]; then
  echo "error: ParaView is not in build/paraview-root. Call ParaView/Testing/run.sh before." >&2
  exit 1
fi
Utilities/install-dependencies.sh dpkg-dev file lintian mmdebstrap

cmake -S ParaView -B build/debian-paraview -G Ninja -DParaView_DIR="$PWD/${config[0]}" \
  -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_INSTALL_RPATH="\$ORIGIN" -DvtkIsosurfaceRayTracing_DEBIAN_PACKAGES=ON
cmake --build build/debian-paraview --target package
lintian --allow-root --fail-on error --suppress-tags initial-upload-closes-no-bugs build/debian-paraview/packages/*.deb

# shellcheck disable=SC2016
mmdebstrap --quiet --variant=apt --dpkgopt=force-unsafe-io \
  --customize-hook='mkdir "$1/root/test"' \
  --customize-hook='copy-in build/debian-paraview/packages ParaView/Testing/DrawPackage.py /root/test' \
  --customize-hook='chroot "$1" sh -c "cd /root/test && DEBIAN_FRONTEND=noninteractive apt-get install --quiet=2 --yes --no-install-recommends --option Dpkg::Use-Pty=0 ./packages/*.deb python3-paraview xvfb xauth"' \
  --customize-hook='chroot "$1" sh -c "cd /root/test && xvfb-run pvpython DrawPackage.py picture.png"' \
  --customize-hook='copy-out /root/test/picture.png build/debian-paraview' \
  bookworm /dev/null
