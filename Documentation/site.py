#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""What Doxygen reads of a page: the links of the repository as links of the site. site.py PAGE.md"""

import re
import sys
from pathlib import Path

page = Path(sys.argv[1])


def id_of(name, heading):
    """Of a heading on the site; GitHub has the second part of it."""
    return f"{name}-" + re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


def title_of(path):
    return re.match(r"# (.*)\n", (page.parent / path).read_text(encoding="utf-8"))[1]


def name_headings(text):
    known = set()

    def name(match):
        if (heading := id_of(page.stem, match[2])) in known:
            return match[0]
        known.add(heading)
        return f"{match[0]} {{#{heading}}}"

    return re.sub(r"^(##+) (.*)$", name, text, flags=re.M)


def change_links(text):
    # The header of a class is its page, and files lie beside the pages.
    text = re.sub(r"\]\((?:\.\./)?[A-Za-z]+/(vtk[A-Za-z]+)\.h\)", r"](@ref \1)", text)
    text = re.sub(r"\]\((?:\.\./)?(?:Examples|Testing)/(?:[A-Za-z]+/)*([A-Za-z_]+\.[a-z]+)\)", r"](\1)", text)
    text = re.sub(r"\]\((?:\.\./)?(LICENSE|pyproject\.toml)\)", r"](./\1)", text)
    # A page that is called by the name of its file has a title.
    text = re.sub(r"\[(?:[A-Za-z]+/)?[\w-]+\.md\]\(([\w/.-]+\.md)(#[^)]*)?\)",
                  lambda match: f"[{title_of(match[1])}]({match[1]}{match[2] or ''})", text)
    return re.sub(r"\]\(([\w/.-]+\.md)?#([\w-]+)\)",
                  lambda match: f"](@ref {Path(match[1] or page).stem}-{match[2]})", text)


def quote_code(text):
    # Doxygen takes a quote in code for the end of the code, unless there are two backquotes.
    return re.sub(r"^((?:[^`\n]*`[^`'\n]*`)*[^`\n]*)`([^`\n]*'[^`\n]*)`", r"\1``\2``", text, flags=re.M)


parts = re.split(r"(^```.*?^```$)", page.read_text(encoding="utf-8"), flags=re.M | re.S)
names = name_headings("\0".join(parts[::2])).split("\0")  # not of the lines of code that look like headings
for i, text in enumerate(names):
    parts[2 * i] = quote_code(change_links(text))
sys.stdout.write("".join(parts))
