#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Write every array of every scene to the standard output, for compare_builds.py.

For each scene there is one pickle: its name, and its arrays by name, each as the format character of
its numbers, the number of components and the bytes; or None if this build lacks a setting of it."""

import argparse
import fnmatch
import os
import pickle
import sys

import picture_scenes
import ray_scenes
from mapper_settings import NotInThisBuild, apply_settings


def record(make, settings):
    try:
        scene = make()
        apply_settings(scene.mapper, settings)
    except NotInThisBuild:
        return None
    return {name: (memoryview(array).format, array.GetNumberOfComponents(), bytes(memoryview(array)))
            for name, array in scene.record().items()}


def parse_setting(text):
    name, _, value = text.partition("=")
    return name, int(value) if value.isdigit() else value


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", default="*", help="the pattern of their names")
    parser.add_argument("--quick", action="store_true", help="a part of the scenes")
    parser.add_argument("settings", nargs="*", metavar="NAME=VALUE", help="of the mapper")
    options = parser.parse_args()
    settings = dict(map(parse_setting, options.settings))
    scenes = {**picture_scenes.make_scenes(options.quick), **ray_scenes.make_scenes(options.quick)}
    # Numbers only: what else is printed must not get among them.
    output = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    for name, make in scenes.items():
        if fnmatch.fnmatch(name, options.scenes):
            pickle.dump((name, record(make, settings)), output, protocol=5)
            output.flush()


if __name__ == "__main__":
    main()
