#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause

"""Puts what vtkIsosurfaceBenchmark wrote with --markdown into Documentation/performance.md.

    Utilities/document_performance.py cranium.md large.md growth.md

A file goes below the command of the page that writes one of its name.
"""

import pathlib
import re
import sys

PAGE = pathlib.Path(__file__).resolve().parent.parent / "Documentation" / "performance.md"


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    page = PAGE.read_text()
    for name in sys.argv[1:]:
        file = pathlib.Path(name)
        text = file.read_text()
        # What comes before the circumstances is the title of a page of its own.
        report = text[text.index("- date:"):].rstrip() + "\n"
        command = re.escape(f"--markdown {file.name}\n\n")
        place = re.search(rf"(?<={command})- date:.*?(?=\n## |\Z)", page, flags=re.DOTALL)
        if place is None:
            sys.exit(f"{PAGE} has no command that writes {file.name}.")
        page = page[: place.start()] + report + page[place.end():]
    PAGE.write_text(page)


if __name__ == "__main__":
    main()
