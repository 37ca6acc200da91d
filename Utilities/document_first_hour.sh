#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

# Makes Documentation/first-hour.md and its pictures: builds the packages, makes a bare Debian 12, and does there what a
# user does (Testing/Packages/first-hour.sh). It downloads some 2 GB.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

Utilities/install-dependencies.sh doxygen dpkg-dev file help2man invesalius-examples mmdebstrap python3-numpy python3-pil
cmake --preset debian
cmake --build --preset debian --parallel 2

folder=build/first-hour
rm -rf "$folder"
mkdir -p "$folder/ct"
cp build/debian/packages/*.deb Testing/Packages/first-hour.sh Testing/Packages/view_ct.py Testing/Support/ViewerSession.py "$folder"
/usr/bin/python3 Examples/Python/invesalius_to_metaimage.py \
  /usr/share/doc/invesalius-examples/examples/Cranium.inv3 "$folder"
/usr/bin/python3 Testing/Python/DicomSlices.py "$folder/cranium.mhd" "$folder/ct"

# The hooks are run by a shell of their own, which knows the root as $1. The root goes with the command. (Open MPI would
# ask the X servers of this machine, which the root sees, for their GPUs.)
# shellcheck disable=SC2016
mmdebstrap --quiet --variant=apt --dpkgopt=force-unsafe-io \
  --customize-hook="copy-in $folder /root" \
  --customize-hook='chroot "$1" sh -c "cd /root/first-hour && HWLOC_COMPONENTS=-gl ./first-hour.sh >first-hour.md"' \
  --customize-hook="sync-out /root/first-hour $folder" \
  bookworm /dev/null

cp "$folder/first-hour.md" Documentation
/usr/bin/python3 - "$folder" <<'END'
import sys
from PIL import Image

for name in ("gyroid", "head", "viewer", "minimal"):
    image = Image.open(f"{sys.argv[1]}/{name}.png")
    image.thumbnail((480, 480), Image.LANCZOS)
    image.save(f"Documentation/images/first-hour-{name}.png", optimize=True)
END
