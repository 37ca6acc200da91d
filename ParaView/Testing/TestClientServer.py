#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A client shows what a server draws: the same picture as without a server."""

import re
import socket
import subprocess
import unittest

from Support import PICTURES, SECONDS, HERE, differences, draw, find_pictures, on_processes, program, run

SCENES = ("clipped", "colored_by_array", "hexahedra", "trilinear")


def find_free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return str(probe.getsockname()[1])


def draw_on_server(processes):
    folder = PICTURES / f"server-of-{processes}"
    folder.mkdir(parents=True, exist_ok=True)
    port = find_free_port()
    command = on_processes(processes, program("pvserver"), f"--server-port={port}")
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as server:
        try:
            while not re.search("Accepting connection", server.stdout.readline()):
                if server.poll() is not None:
                    raise AssertionError(f"{' '.join(command)} has ended")
            run([program("pvpython"), str(HERE / "DrawScenes.py"), str(folder), *SCENES], SERVER_PORT=port)
            log, _ = server.communicate(timeout=SECONDS)  # it ends with its client
        finally:
            server.terminate()
    if "ERR|" in log:
        raise AssertionError(log)
    return find_pictures(folder, SCENES)


class TestClientServer(unittest.TestCase):
    def test_same_picture(self):
        expected = draw(1, SCENES)
        for processes in (1, 2):
            for name, path in draw_on_server(processes).items():
                with self.subTest(scene=name, processes=processes):
                    changed = int((differences(path, expected[name]) > 0).sum())
                    print(f"{name}, server of {processes}: {changed} pixels differ")
                    self.assertEqual(changed, 0)


if __name__ == "__main__":
    unittest.main()
