# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Test docs.links_lead_somewhere: what the pages link to is there.
"""usage: links.py SOURCE

Checks links to files, and to headings (#...) of Markdown files. Addresses of the network are not
followed.
"""
import functools
import pathlib
import re
import sys

LINK = re.compile(r"\]\(([^()\s]+)\)")
FENCE = re.compile(r"^```.*?^```$", re.DOTALL | re.MULTILINE)


@functools.lru_cache(maxsize=None)
def anchors(page):
    """The anchors that a Markdown page has: ids, and headings as GitHub and GitLab make them."""
    text = FENCE.sub("", page.read_text(encoding="utf-8"))
    titles = re.findall(r"^#+ +(.*)$", text, re.MULTILINE)
    plain = [re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title) for title in titles]
    ids = set(re.findall(r'<a id="([^"]+)"', text))
    return ids | {re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-")
                  for title in plain}


def links(page):
    """The links of a page to files and headings."""
    found = LINK.findall(FENCE.sub("", page.read_text(encoding="utf-8")))
    return [link for link in found if not re.match(r"\w+:", link)]


def broken(page):
    """The links of a page that lead nowhere."""
    for link in links(page):
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists():
            yield f"{page}: {link}: no such file"
        elif anchor and target.suffix == ".md" and anchor not in anchors(target):
            yield f"{page}: {link}: no such heading"


def main():
    """All pages of the project."""
    source = pathlib.Path(sys.argv[1])
    pages = [*sorted(source.glob("*.md")), *sorted((source / "docs").rglob("*.md"))]
    wrong = [text for page in pages for text in broken(page)]
    count = sum(len(links(page)) for page in pages)
    # Each page of docs/ is linked from another at least.
    if wrong or len(pages) < 10 or count < len(pages):
        sys.exit("\n".join(wrong) or f"only {len(pages)} pages with {count} links")
    print(f"{len(pages)} pages, {count} links")


main()
