#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Every test has one kind, and none is both quick and slow: CONTRIBUTING.md tells what the labels mean.

Arguments: ctest, the build folder."""

import json
import subprocess
import sys

KINDS = {"unit", "render", "build"}

listed = subprocess.run([sys.argv[1], "--show-only=json-v1"], cwd=sys.argv[2], check=True, capture_output=True).stdout
count = 0
for test in json.loads(listed)["tests"]:
    properties = {each["name"]: each["value"] for each in test["properties"]}
    labels = set(properties.get("LABELS", []))
    if len(labels & KINDS) != 1 or {"quick", "slow"} <= labels:
        sys.exit(f"{test['name']} has the labels {sorted(labels)}: one of {sorted(KINDS)}, and quick or slow or neither")
    count += 1
print(f"{count} tests")
