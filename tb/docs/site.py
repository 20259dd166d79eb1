# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Test docs.site_is_whole: the site of `make docs`. Every page of docs/ is in its menu, every link
# leads to a page and an anchor that are there, nothing is taken from the network, search finds.
"""usage: site.py SOURCE"""
import functools
import http.server
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest
import urllib.parse
from html.parser import HTMLParser
from pathlib import Path

import yaml

SOURCE = Path(sys.argv[1]).resolve()
# Elements that a browser loads by itself, and where from.
LOADED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src"}


class Page(HTMLParser):
    """Anchors, links and loaded files of a page."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.loaded = {"", "top"}, [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.anchors |= {attributes[key] for key in ("id", "name") if attributes.get(key)}
        if tag == "a" and attributes.get("href"):
            self.links.append(attributes["href"])
        if tag in LOADED and attributes.get(LOADED[tag]):
            # canonical, prev and next are links, not files to load
            kind = self.links if attributes.get("rel") in {"canonical", "prev", "next"} \
                else self.loaded
            kind.append(attributes[LOADED[tag]])


@functools.lru_cache(maxsize=None)
def page_of(path):
    """A page, read once."""
    return Page(path.read_text(encoding="utf-8"))


def is_outside(link):
    """Whether a link has a scheme or a host."""
    parts = urllib.parse.urlsplit(link)
    return bool(parts.scheme or parts.netloc)


class QuietServer(http.server.SimpleHTTPRequestHandler):
    """The site over HTTP; what it could not give is kept."""

    missing = []

    def log_message(self, *_):
        pass

    def send_error(self, code, *words):
        self.missing.append(f"{code} {self.path}")
        super().send_error(code, *words)


class SiteTest(unittest.TestCase):
    """One site for all tests."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, folder)
        # A site made before, of which nothing stays.
        cls.gone = Path(folder) / "site/a-page-of-before.html"
        cls.gone.parent.mkdir()
        cls.gone.write_text("before\n", encoding="utf-8")
        (Path(folder) / "mkdocs.yml").write_text("site_name: VeriCAN\n", encoding="utf-8")
        done = subprocess.run([SOURCE / "tools/site.py", folder], check=False, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode != 0:
            raise AssertionError(done.stdout)
        cls.folder = Path(folder)
        cls.site = cls.folder / "site"
        cls.pages = sorted(cls.site.rglob("*.html"))

    def test_every_page_is_in_the_menu(self):
        class Loader(yaml.SafeLoader):
            """Without Python's names."""
        Loader.add_multi_constructor("tag:yaml.org,2002:python/", lambda *_: None)
        menu = yaml.load((SOURCE / "mkdocs.yml").read_text(encoding="utf-8"), Loader)["nav"]

        def places(entry):
            if isinstance(entry, str):
                return [entry]
            inner = entry.values() if isinstance(entry, dict) else entry
            return [place for part in inner for place in places(part)]
        listed = places(menu)
        written = {str(page.relative_to(SOURCE / "docs"))
                   for page in (SOURCE / "docs").rglob("*.md")}
        self.assertEqual(len(listed), len(set(listed)))
        self.assertEqual(written - set(listed), set(), "pages that are not in mkdocs.yml")

    def test_nothing_is_left_of_a_site_before(self):
        self.assertFalse(self.gone.exists())

    def test_links_lead_somewhere(self):
        dead, count = [], 0
        for page in self.pages:
            if page.name == "404.html":   # its links are those of a server's root
                continue
            for link in page_of(page).links + page_of(page).loaded:
                if is_outside(link):
                    continue
                count += 1
                parts = urllib.parse.urlsplit(link)
                target = page.parent / urllib.parse.unquote(parts.path) if parts.path else page
                target = target.resolve()
                anchor = urllib.parse.unquote(parts.fragment)
                if not target.is_file():
                    dead.append(f"{page.relative_to(self.site)}: {link}")
                elif target.suffix == ".html" and not self.has(target, anchor):
                    dead.append(f"{page.relative_to(self.site)}: {link}: no such anchor")
        self.assertEqual(dead[:20], [], f"{len(dead)} of {count}")
        self.assertGreater(count, 10000)

    @staticmethod
    def has(target, anchor):
        # "__" begins what the theme's script makes.
        return anchor in page_of(target).anchors or anchor.startswith("__")

    def test_nothing_comes_from_the_network(self):
        outside = {link for page in self.pages for link in page_of(page).loaded
                   if is_outside(link) and not link.startswith(("data:", "javascript:"))}
        self.assertEqual(outside, set())
        for style in self.site.rglob("*.css"):
            text = style.read_text(encoding="utf-8")
            taken = [url for url in re.findall(r"url\(([^)]*)\)|@import\s+([^;]*)", text)
                     if re.search(r"^['\"]?(https?:)?//", "".join(url))]
            self.assertEqual(taken, [], style)

    def test_references_have_the_interfaces(self):
        for name, words in (("driver", ["verican_send", "verican_config_t"]),
                            ("simulator", ["BusObserver", "RtlNode"])):
            text = "".join(page.read_text(encoding="utf-8") for page in
                           (self.site / "reference" / name).glob("*.html"))
            for word in words:
                self.assertIn(word, text, name)

    def test_registers_have_their_pictures(self):
        pictures = [link for link in page_of(self.site / "registers.html").loaded
                    if "img/registers/" in link]
        drawn = list((SOURCE / "docs/img/registers").glob("*.svg"))
        self.assertEqual(len(set(pictures)), len(drawn))

    def test_lists_and_tables_are_such(self):
        text = (self.site / "integration.html").read_text(encoding="utf-8")
        body = re.sub(r"<pre>.*?</pre>", "", text, flags=re.DOTALL)
        self.assertNotRegex(body, r"<p>[^<]*\n- ")
        self.assertNotRegex(body, r"\| *---")

    def test_search_finds(self):
        if not os.environ.get("VERICAN_REPORT_MODULES"):
            self.skipTest("VERICAN_REPORT_MODULES is not set: nothing that drives a browser")
        QuietServer.missing = []
        handler = functools.partial(QuietServer, directory=str(self.site))
        with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            done = subprocess.run(
                [os.environ["VERICAN_NODE"], Path(__file__).with_name("search.mjs"),
                 f"http://127.0.0.1:{server.server_port}/"], check=False, text=True,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            server.shutdown()
        self.assertEqual(done.returncode, 0, done.stdout)
        seen = json.loads(done.stdout)
        self.assertTrue([link for link in seen["found"] if "can-rules.html" in link], seen)
        self.assertEqual(seen["outside"], [])
        self.assertEqual(QuietServer.missing, [])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
