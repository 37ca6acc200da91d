#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The type stubs of the compiled modules have each class and method, with types that exist."""

import ast
import importlib
import inspect
import unittest
from pathlib import Path

import vtkIsosurfaceRayTracing

PACKAGE = Path(vtkIsosurfaceRayTracing.__file__).parent


def is_public(name):
    return not name.startswith("_")


class TestStubs(unittest.TestCase):
    def check(self, name):
        module = importlib.import_module(f"vtkIsosurfaceRayTracing.{name}")
        text = (PACKAGE / f"{name}.pyi").read_text(encoding="utf-8")
        classes = {node.name: node for node in ast.parse(text).body if isinstance(node, ast.ClassDef)}
        expected = dict(inspect.getmembers(module, inspect.isclass))
        self.assertEqual(set(classes), set(expected))
        for stub in classes.values():
            names = {node.target.id if isinstance(node, ast.AnnAssign) else node.name for node in stub.body
                     if not isinstance(node, ast.Expr)}
            self.assertEqual(names, set(filter(is_public, vars(expected[stub.name]))), stub.name)
        # The modules that it imports, and what it takes of them.
        exec(compile("from __future__ import annotations\n" + text, name, "exec"), {})
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Attribute) and ast.unparse(node).startswith("vtkmodules.vtk") and ast.unparse(node).count(".") == 2:
                owner, attribute = ast.unparse(node).rsplit(".", 1)
                self.assertTrue(hasattr(importlib.import_module(owner), attribute), ast.unparse(node))
        return text

    def test_classes(self):
        text = self.check("vtkIsosurfaceRayTracing")
        for line in (
            "class vtkIsosurfaceVolume(vtkmodules.vtkRenderingCore.vtkVolume):",
            "    def GetTileSize(self) -> Tuple[int, int]: ...",
            "    @overload\n    def SetTileSize(self, width: int, height: int) -> None: ...",
            "    @overload\n    def SetTileSize(self, size: Sequence[int]) -> None: ...",
            "    def FindSurfaceBounds(self, volume: vtkmodules.vtkRenderingCore.vtkVolume, bounds: MutableSequence[float]) -> bool: ...",
            "    @staticmethod\n    def SwitchOn() -> None: ...",
            "    CUBIC: InterpolationModes",
        ):
            self.assertIn(line, text)

    def test_compositor(self):
        if not list(PACKAGE.glob("vtkIsosurfaceRayTracingParallel.*")):
            self.skipTest("the module for many processes is not built")
        self.check("vtkIsosurfaceRayTracingParallel")

    def test_package_has_types(self):
        """Of the functions in their own source, of the classes in the stubs."""
        self.assertTrue((PACKAGE / "py.typed").exists())
        for name in ("isosurface", "render", "show", "cast_rays", "read"):
            function = getattr(vtkIsosurfaceRayTracing, name)
            self.assertIn("return", function.__annotations__, name)
            for parameter in inspect.signature(function).parameters.values():
                self.assertIsNot(parameter.annotation, parameter.empty, (name, parameter))


if __name__ == "__main__":
    unittest.main()
