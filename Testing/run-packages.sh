#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Makes the Debian packages, looks at them by lintian, and installs, uses and removes them in a bare Debian 12, which is
# made for it and downloads some 800 MB. build/debian/picture.png is what was drawn there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

skip() {
  echo "skipped: $1 The packages were not tested." >&2
  exit 0
}

Utilities/install-dependencies.sh doxygen dpkg-dev file help2man lintian mmdebstrap python3-numpy
cmake --preset debian
cmake --build --preset debian --parallel 2

# Debian's own package would close the wish for it.
lintian --allow-root --fail-on error --suppress-tags initial-upload-closes-no-bugs build/debian/packages/*.deb

mmdebstrap --quiet --simulate --variant=apt bookworm /dev/null ||
  skip "no bare Debian 12 can be made (see above)."

# The hooks are run by a shell of their own, which knows the root as $1. The root goes with the command.
# shellcheck disable=SC2016
mmdebstrap --quiet --variant=apt --dpkgopt=force-unsafe-io \
  --customize-hook='mkdir "$1/root/test"' \
  --customize-hook='copy-in build/debian/packages Testing/Packages/in-bare-root.sh Testing/Consumer/my_program.cxx README.md /root/test' \
  --customize-hook='chroot "$1" /root/test/in-bare-root.sh' \
  --customize-hook='copy-out /root/test/picture.png build/debian' \
  bookworm /dev/null
