# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""usage: installed_docs.py SOURCE PAGES PLACE=FOLDER...

Makes the links of installed pages work. PAGES is the installed folder with README.md and docs/;
each PLACE, a folder of the sources, has been installed as FOLDER. A link to what is installed leads
there; of a link to anything else the text stays.
"""
import os
import re
import sys
from pathlib import Path

LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)")
OUTSIDE = re.compile(r"^([a-z]+:|#)")


def installed_at(target, source, pages, places):
    """Where a file or folder of the sources lies now; None if nowhere."""
    inside = os.path.relpath(target, source)
    for place, folder in places:
        if inside == place or inside.startswith(place + os.sep):
            found = folder / os.path.relpath(inside, place)
            return found if found.exists() else None
    found = pages / inside
    return found if found.exists() else None


def rewritten(page, source, pages, places):
    """The page with links that work."""
    def link(match):
        mark, text, target = match.groups()
        if OUTSIDE.match(target):
            return match.group(0)
        path, _, anchor = target.partition("#")
        written = source / page.relative_to(pages)
        now = installed_at((written.parent / path).resolve(), source.resolve(), pages, places)
        if now is None:
            return text
        relative = os.path.relpath(now, page.parent)
        return f"{mark}[{text}]({relative}{'#' + anchor if anchor else ''})"
    return LINK.sub(link, page.read_text(encoding="utf-8"))


def main():
    source, pages = Path(sys.argv[1]), Path(sys.argv[2])
    places = [(place, Path(folder)) for place, _, folder in
              (word.partition("=") for word in sys.argv[3:])]
    for page in sorted(pages.rglob("*.md")):
        page.write_text(rewritten(page, source, pages, places), encoding="utf-8")


if __name__ == "__main__":
    main()
