# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""pages: lays the project's Markdown pages out for MkDocs. docs/ becomes the root of the site,
README.md its index; a file of the sources that a page links to comes along as text, a folder as a
page that lists its files. The pages stay what code hosts show: only links are rewritten, and lists
get the blank line and the indentation that Python-Markdown wants.
"""
import os
import re
import shutil
import subprocess
from pathlib import Path

LINK = re.compile(r"(\]\()([^()\s]+)(\))")
FENCE = re.compile(r"^ *```")
ITEM = re.compile(r"^( *)([-*]|\d+\.) ")
# Pages outside docs/ and their places in the site.
ROOT_PAGES = {"README.md": "index.md", "CONTRIBUTING.md": "contributing.md",
              "CHANGELOG.md": "changelog.md"}
PICTURES = {".svg", ".png"}


class Site:
    """The tree of pages of one site."""

    def __init__(self, source, target):
        self.source, self.target = Path(source).resolve(), Path(target).resolve()
        self.extra = set()   # files and folders of the sources that pages lead to

    def build(self):
        """Writes the tree; what was there before goes."""
        shutil.rmtree(self.target, ignore_errors=True)
        for page in self.pages():
            self.write(self.place(page), self.page(page))
        for picture in (self.source / "docs").rglob("*"):
            if picture.suffix in PICTURES:
                self.copy(picture, self.place(picture))
        while self.extra:
            self.add(self.extra.pop())

    def pages(self):
        """The Markdown pages of the project."""
        return [self.source / name for name in ROOT_PAGES] + sorted(
            (self.source / "docs").rglob("*.md"))

    def place(self, path):
        """Where a file of the project lies in the tree."""
        inside = path.relative_to(self.source)
        if str(inside) in ROOT_PAGES:
            return self.target / ROOT_PAGES[str(inside)]
        if inside.parts[:1] == ("docs",) and path.suffix in {".md", *PICTURES}:
            return self.target.joinpath(*inside.parts[1:])
        if path.is_dir():
            return self.target / "source" / inside / "index.md"
        return self.target / "source" / inside.with_name(inside.name + ".txt")

    def page(self, path):
        """The text of a page with the site's links."""
        lines, fenced = [], False
        for line in path.read_text(encoding="utf-8").splitlines():
            fenced ^= bool(FENCE.match(line))
            lines.append(line if fenced else LINK.sub(
                lambda m: m[1] + self.link(path, m[2]) + m[3], line))
        return "\n".join(spaced(lines)) + "\n"

    def link(self, page, link):
        """A link of a page as it is in the site."""
        path, mark, anchor = link.partition("#")
        if not path or re.match(r"\w+:", link):
            return link
        target = (page.parent / path).resolve()
        if not target.exists():
            raise FileNotFoundError(f"{page}: {link}: no such file")
        place = self.place(target)
        if "source" in place.relative_to(self.target).parts[:1]:
            self.extra.add(target)
        return os.path.relpath(place, self.place(page).parent) + mark + anchor

    def add(self, path):
        """A file of the sources, or a folder's list of files."""
        place = self.place(path)
        if path.is_file():
            self.copy(path, place)
            return
        listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "--", "."],
                                cwd=path, check=True, text=True, stdout=subprocess.PIPE).stdout
        # MkDocs leaves out names that begin with a dot.
        files = [path / name for name in sorted(listed.splitlines())
                 if (path / name).is_file() and not re.search(r"(^|/)\.", name)]
        lines = ["---", "search:", "  exclude: true", "---",
                 f"# {path.relative_to(self.source)}", ""]
        for file in files:
            self.copy(file, self.place(file))
            link = os.path.relpath(self.place(file), place.parent)
            lines.append(f"- [`{file.relative_to(path)}`]({link})")
        self.write(place, "\n".join(lines) + "\n")

    @staticmethod
    def write(path, text):
        """A text file and its folder."""
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    @staticmethod
    def copy(path, place):
        """A copy of a file and its folder."""
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, place)


def spaced(lines):
    """Lists as Python-Markdown wants them: a blank line before, four spaces for what is inside."""
    before, fenced, item = "", False, False
    for line in lines:
        fenced ^= bool(FENCE.match(line))
        if not fenced:
            begins = ITEM.match(line)
            if begins and before.strip() and not item:
                yield ""
            item = bool(begins) or (item and (line.startswith("  ") or not line.strip()))
            depth = len(line) - len(line.lstrip(" "))
            if item and depth % 4 == 2 and depth < 4:
                line = "  " + line
        yield line
        before = line
