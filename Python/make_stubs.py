#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Write type stubs of compiled modules: make_stubs.py FOLDER PACKAGE MODULE...

They are made of the signatures in the docstrings of VTK's wrappers. (VTK has vtkmodules.generate_pyi for that from 9.2
on.)
"""

import ast
import builtins
import importlib
import inspect
import re
import sys
from pathlib import Path

HEADER = "from typing import Any, MutableSequence, Sequence, Tuple, overload\n"


def make_stub(module):
    # A class follows those that it inherits from.
    classes = sorted((value for _, value in inspect.getmembers(module, inspect.isclass)),
                     key=lambda each: (len(each.__mro__), each.__name__))
    text = "\n\n".join(make_class(each, module.__name__) for each in classes)
    imports = sorted(set(re.findall(r"(vtkmodules\.\w+)\.", text)))
    return HEADER + "".join(f"import {name}\n" for name in imports) + "\n\n" + text


def make_class(of, module):
    members = sorted((name, value) for name, value in vars(of).items() if not name.startswith("_"))
    owner = of.__base__.__module__
    prefix = "" if owner in ("builtins", module) else f"{owner}."
    lines = [f"class {of.__name__}({prefix}{of.__base__.__name__}):"]
    lines += [f"    {line}" for name, value in members for line in make_member(name, value, module)]
    return "\n".join(lines if len(lines) > 1 else [lines[0] + " ..."]) + "\n"


def make_member(name, value, module):
    if inspect.isclass(value):
        return make_class(value, module).splitlines()
    if not callable(value):
        return [f"{name}: {type(value).__name__}"]
    lines = []
    signatures = find_signatures(value)
    for signature in signatures:
        lines += ["@overload"] if len(signatures) > 1 else []
        lines += [] if signature.args.args[:1] and signature.args.args[0].arg == "self" else ["@staticmethod"]
        lines.append(write_signature(signature, module))
    return lines


def find_signatures(method):
    """The definitions of its overloads, which are before the text of its docstring."""
    head = re.sub(r"\n\s+", " ", (method.__doc__ or "").split("\n\n")[0])
    lines = [line for line in head.splitlines() if line.startswith(method.__name__ + "(")]
    return [ast.parse(f"def {line}: ...").body[0] for line in lines]


def write_signature(signature, module):
    arguments = [argument.arg + (f": {write_type(argument.annotation, module)}" if argument.annotation else "")
                 for argument in signature.args.args]
    arguments += [f"*{signature.args.vararg.arg}: Any"] if signature.args.vararg else []
    result = write_type(signature.returns, module, is_result=True) if signature.returns else "None"
    return f"def {signature.name}({', '.join(arguments)}) -> {result}: ..."


def write_type(annotation, module, is_result=False):
    """VTK writes (float, float) for what is read and [float, float] for what is written."""
    if isinstance(annotation, (ast.Tuple, ast.List)):
        inner = [write_type(each, module, is_result) for each in annotation.elts]
        if is_result:
            return f"Tuple[{', '.join(inner)}]"
        return f"{'Sequence' if isinstance(annotation, ast.Tuple) else 'MutableSequence'}[{inner[0]}]"
    name = str(annotation.value) if isinstance(annotation, ast.Constant) else ast.unparse(annotation)
    if hasattr(builtins, name) or hasattr(sys.modules[module], name):
        return name
    of_vtk = [each for each in sorted(sys.modules) if each.startswith("vtkmodules.vtk")]
    owners = [each for each in of_vtk if hasattr(sys.modules[each], name)]
    return f"{owners[0]}.{name}" if owners else "Any"


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    folder, package, *modules = sys.argv[1:]
    for name in modules:
        stub = make_stub(importlib.import_module(f"{package}.{name}"))
        ast.parse(stub)
        Path(folder, f"{name}.pyi").write_text(stub, encoding="utf-8")


if __name__ == "__main__":
    main()
