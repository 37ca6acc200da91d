#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A client shows what a server draws: the same picture as without a server, which ends with its client."""

import contextlib
import os
import re
import shutil
import socket
import subprocess
import time
import unittest

from Support import PICTURES, SECONDS, HERE, differences, draw, find_pictures, on_processes, program, run

SCENES = ("clipped", "colored_by_array", "hexahedra", "trilinear", "unordered_grid")


def find_free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return str(probe.getsockname()[1])


@contextlib.contextmanager
def run_server(processes):
    """Starts a server; gives it, and its port."""
    port = find_free_port()
    command = on_processes(processes, program("pvserver"), f"--server-port={port}")
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as server:
        try:
            while not re.search("Accepting connection", server.stdout.readline()):
                if server.poll() is not None:
                    raise AssertionError(f"{' '.join(command)} has ended")
            yield server, port
        finally:
            server.terminate()


def make_folder(name):
    folder = PICTURES / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def draw_on_server(processes):
    folder = make_folder(f"server-of-{processes}")
    with run_server(processes) as (server, port):
        run([program("pvpython"), str(HERE / "DrawScenes.py"), str(folder), *SCENES], SERVER_PORT=port)
        log, _ = server.communicate(timeout=SECONDS)  # it ends with its client
    if "ERR|" in log:
        raise AssertionError(log)
    return find_pictures(folder, SCENES)


def kill_client(processes):
    """Kills a client while a server draws for it; returns how the server ends."""
    folder = make_folder(f"killed-client-of-{processes}")
    with run_server(processes) as (server, port):
        client = [program("pvpython"), str(HERE / "DrawScenes.py"), str(folder), *SCENES]
        with subprocess.Popen(client, env={**os.environ, "SERVER_PORT": port}) as drawing:
            while not list(folder.iterdir()) and drawing.poll() is None:
                time.sleep(0.05)
            drawing.kill()
        server.communicate(timeout=60)
        return server.returncode


class TestClientServer(unittest.TestCase):
    def test_same_picture(self):
        expected = draw(1, SCENES)
        for processes in (1, 2):
            for name, path in draw_on_server(processes).items():
                with self.subTest(scene=name, processes=processes):
                    changed = int((differences(path, expected[name]) > 0).sum())
                    print(f"{name}, server of {processes}: {changed} pixels differ")
                    self.assertEqual(changed, 0)

    def test_window_of_client_refines_itself(self):
        folder = make_folder("waiting-client")
        with run_server(2) as (_, port):
            script = [str(HERE / "DrawWaiting.py"), str(folder / "waited.png")]
            self.assertIn("16 frames", run([program("pvpython"), *script], SERVER_PORT=port))

    def test_server_ends_when_its_client_is_killed(self):
        for processes in (1, 2):
            with self.subTest(processes=processes):
                self.assertEqual(kill_client(processes), 0)


if __name__ == "__main__":
    unittest.main()
