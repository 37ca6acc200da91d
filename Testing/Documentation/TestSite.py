#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The site that Doxygen makes has all pages and public classes, and its links lead somewhere.

Arguments: the source folder, the folder of the site. (That Doxygen warns of nothing is tested when it is made.)"""

import re
import sys
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

SOURCE, SITE = map(Path, sys.argv[1:3])


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links, self.text, self.places = [], "", set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        self.links += [value for name, value in attributes if name in ("href", "src") and value]
        self.places |= {value for name, value in attributes if name in ("id", "name")}

    def handle_data(self, data):
        self.text += data


class TestSite(unittest.TestCase):
    def test_links(self):
        count = 0
        pages = {path.name: Page(path) for path in SITE.glob("*.html")}
        for path in SITE.glob("*.html"):
            page = pages[path.name]
            links = [urlsplit(link) for link in page.links]
            files = {unquote(link.path) for link in links if link.path and not link.scheme}
            count += len(files)
            self.assertEqual([file for file in files if not (SITE / file).is_file()], [], path.name)
            # Markdown that was not understood.
            self.assertEqual(re.findall(r"\[\w.-]+\]\([^ ]+\)|[`‘].{20}", page.text), [], path.name)
            for link in links:
                if link.fragment and not link.scheme and (link.path or path.name) in pages:
                    self.assertIn(unquote(link.fragment), pages[link.path or path.name].places, (path.name, link))
        self.assertGreater(count, 500)

    def test_links_of_the_repository(self):
        """As GitHub shows the pages: files, and headings in them."""
        count = 0
        for path in [*SOURCE.glob("*.md"), *(SOURCE / "Documentation").glob("*.md")]:
            text = re.sub(r"^```.*?^```$", "", path.read_text(encoding="utf-8"), flags=re.M | re.S)
            for link in re.findall(r"\]\(([^ ):]+)\)", text):
                file, _, heading = link.partition("#")
                target = path.parent / file if file else path
                self.assertTrue(target.exists(), (path.name, link))
                if heading:
                    headings = re.findall(r"^#+ (.*)$", target.read_text(encoding="utf-8"), re.M)
                    names = [re.sub(r"[^\w -]", "", each.lower()).replace(" ", "-") for each in headings]
                    self.assertIn(heading, names, (path.name, link))
                count += 1
        self.assertGreater(count, 100)

    def test_pages(self):
        for path in (SOURCE / "Documentation").glob("*.md"):
            name = path.stem.replace("-", "_")
            self.assertTrue((SITE / f"md_Documentation_{name}.html").is_file(), path.name)

    def test_public_classes(self):
        lists = [(SOURCE / "Module/module.cmake").read_text(encoding="utf-8").split("set(classes")[1].split(")")[0],
                 (SOURCE / "Parallel/CMakeLists.txt").read_text(encoding="utf-8").split("PRIVATE_")[0]]  # fmt: skip
        classes = set(re.findall(r"\bvtkIsosurface(?!RayTracing)\w+|\bvtk(?:Cell|Mapped)\w+", " ".join(lists)))
        self.assertGreater(len(classes), 9)
        self.assertEqual({path.stem[len("class"):] for path in SITE.glob("classvtk*.html")
                          if not path.stem.endswith("-members")}, classes)  # fmt: skip


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
