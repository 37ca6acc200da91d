#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Put what vtkIsosurfaceSpeedAgainstError measured into Documentation/accuracy.md.

    document_accuracy.py report/fields report/cranium report/brain

takes the folders of its reports and replaces what is between the two lines of the page that name
this program, and the pictures Documentation/images/accuracy-*.png. What the page says around them
must be read again by a human.
"""

import re
import shutil
import sys
from pathlib import Path

DOCUMENTATION = Path(__file__).parents[1] / "Documentation"
PAGE = DOCUMENTATION / "accuracy.md"
BEGIN = "<!-- Utilities/document_accuracy.py writes from here -->\n"
END = "<!-- to here -->\n"
# The name in the report, what the page says of it, and its pictures with their captions.
INPUTS = (
    ("cranium", "The cranium CT at 300",
     (("speed-error", "Rays: speed against error"), ("errors", "How many rays have which error"),
      ("frame-misjudged", "Whole frames: speed against rays misjudged"),
      ("heat", "Errors of the pixels"))),
    ("ch2better", "An MR of a brain at 60", ()),
    ("gyroid 64^3", "A gyroid of 64^3 samples", (("heat", "Errors of the pixels"),)),
    ("near tangent 64^3", "Sheets that all but vanish, 64^3", ()),
)
# Rows of the report that the page goes without: other settings of the same.
LEFT_OUT = r"\| (Marmitt, N = [246]|Sampler.* (2\.0|1\.0|0\.25|0\.125) cells|Triangles of marching cubes) "


def file_name(text):
    return re.sub("[^0-9A-Za-z]", "-", text)


def section(text, title):
    return re.search(rf"^## {re.escape(title)}\n\n(.*?)(?=^## |\Z)", text, re.M | re.S).group(1)


def describe(reports):
    texts = {folder: (folder / "results.md").read_text(encoding="utf-8") for folder in reports}
    for folder, text in texts.items():
        said = dict(re.findall("^- ([^:]*): (.*)$", text, re.M))
        yield f"- {folder.name}: {said['machine']}; OpenGL by {said['OpenGL']}; load of the machine "
        yield f"before: {said['load of the machine before']}\n"
    yield "\n"
    prices = [section(text, "The price of the default solver").splitlines() for text in texts.values()]
    rows = [row for table in prices for row in table[2:] if row]
    yield "The price of the default solver:\n\n" + "\n".join(prices[0][:2] + rows) + "\n\n"
    for name, title, pictures in INPUTS:
        folder = next(folder for folder, text in texts.items() if f"\n## {name}\n" in text)
        rows = section(texts[folder], name).rstrip().splitlines()
        count, table = rows[0].rstrip("."), [row for row in rows[1:] if not re.match(LEFT_OUT, row)]
        yield f"### {title}\n\n{count}.\n" + "\n".join(table) + "\n\n"
        for plot, caption in pictures:
            image = f"accuracy-{plot}-{file_name(name)}.png"
            shutil.copy(folder / f"{file_name(name)}-{plot}.png", DOCUMENTATION / "images" / image)
            yield f"![{caption}](images/{image})\n\n"


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    head, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    _, tail = rest.split(END)
    described = "".join(describe([Path(folder) for folder in sys.argv[1:]]))
    PAGE.write_text(f"{head}{BEGIN}\n{described}{END}{tail}", encoding="utf-8")


if __name__ == "__main__":
    main()
