#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""site.py [OUT]: the documentation as a site that needs no network, in OUT/site (build/docs):
the pages of docs/ with search, and the C driver's and the simulator's headers by Doxygen.

Needs the packages of packages-docs.txt. What MkDocs or Doxygen warn of is an error. A site that is
in OUT already goes; an OUT that holds anything else is refused.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parent.parent
DEFAULT = (ROOT / "build/docs").resolve()
OWN = ("mkdocs.yml", "pages", "site")   # all that is in OUT
sys.path.insert(0, str(ROOT / "tools/site"))

# ruff: noqa: E402  (the path must be set first)
from pages import Site

# What Doxygen reads: name, title, folders, what is not public.
REFERENCES = {
    "driver": ("VeriCAN C driver", ["sw/driver/include"], []),
    "simulator": ("VeriCAN simulator", ["sim"], None),
}
PLACEHOLDER = "---\nsearch:\n  exclude: true\n---\n# {title}\n\n[Reference by Doxygen](" \
              "../reference/{name}/index.html)\n"


def fail(text):
    """Ends the program with a message."""
    sys.exit(f"site.py: {text}")


def not_installed():
    """The patterns that cmake/package.cmake leaves out of the installed headers."""
    text = (ROOT / "cmake/package.cmake").read_text(encoding="utf-8")
    block = text.partition('"${PROJECT_SOURCE_DIR}/sim/" DESTINATION')[2].partition("install(")[0]
    return re.findall(r'PATTERN "([\w.]+)" EXCLUDE', block)


def is_own(out):
    """Whether all that is in OUT is a site of this script's, or the part that an interrupted run
    has left in the default place."""
    if any(path.name not in OWN or path.is_symlink() for path in out.iterdir()):
        return False
    settings = out / OWN[0]
    if settings.is_file():
        return "site_name: VeriCAN\n" in settings.read_text(encoding="utf-8", errors="replace")
    return out == DEFAULT


def check(out):
    """Makes the folder; ends if it holds anything else than a site."""
    try:
        out.mkdir(parents=True, exist_ok=True)
        if any(out.iterdir()) and not is_own(out):
            fail(f"{out} is not empty, and not a site that this script has made; it is left as it "
                 "is: name another folder, or remove it")
    except OSError as error:
        fail(f"{out}: {error.strerror}")


def doxygen(name, out):
    """The reference of one set of headers."""
    title, folders, hidden = REFERENCES[name]
    hidden = not_installed() if hidden is None else hidden
    hidden = [f"*/{word}" if "." in word else f"*/{word}/*" for word in hidden]
    target = out / "pages/reference" / name
    target.mkdir(parents=True)
    settings = (ROOT / "docs/doxygen/Doxyfile").read_text(encoding="utf-8") + "\n".join([
        f'PROJECT_NAME = "{title}"', f"OUTPUT_DIRECTORY = {target.parent}", f"HTML_OUTPUT = {name}",
        f"INPUT = {' '.join(str(ROOT / folder) for folder in folders)}",
        f"STRIP_FROM_PATH = {' '.join(str(ROOT / folder) for folder in folders)}",
        f"STRIP_FROM_INC_PATH = {' '.join(str(ROOT / folder) for folder in folders)}",
        f"EXCLUDE_PATTERNS = {' '.join(hidden)}", ""])
    done = subprocess.run(["doxygen", "-"], input=settings, text=True, capture_output=True,
                          check=False)
    if done.returncode != 0 or done.stderr.strip():
        fail(f"doxygen of {name}:\n{done.stdout[-2000:] if done.returncode else ''}{done.stderr}")
    for page in target.glob("*.html"):
        whole = page.read_text(encoding="utf-8")
        # The summary of a class leads to its private ones, which are not on the page.
        if '"#nested-classes"' in whole and 'name="nested-classes"' not in whole:
            page.write_text(re.sub(r'<a href="#nested-classes">.*?</a>( &#124;)?', "", whole),
                            encoding="utf-8")


def configure(out):
    """The settings of MkDocs. They come first: by them OUT is known as a site."""
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    for key, folder in (("docs_dir", "pages"), ("site_dir", "site")):
        text, count = re.subn(rf"^{key}:.*$", f"{key}: {out / folder}", text, flags=re.MULTILINE)
        if count != 1:
            fail(f"mkdocs.yml: {key} is there {count} times")
    (out / OWN[0]).write_text(text, encoding="utf-8")


def mkdocs(out):
    """The pages."""
    command = ["/usr/bin/python3", "-B", "-m", "mkdocs", "build", "--strict",
               "--config-file", str(out / OWN[0])]
    done = subprocess.run(command, env={**os.environ, "PYTHONPATH": str(ROOT / "tools/site")},
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode != 0:
        fail(f"mkdocs:\n{done.stdout}")


def main():
    if any(word.startswith("-") for word in sys.argv[1:]) or len(sys.argv) > 2:
        sys.exit(__doc__)
    out = Path(sys.argv[1] if len(sys.argv) == 2 else DEFAULT).resolve()
    check(out)
    for program in ("mkdocs", "doxygen"):
        if not shutil.which(program):
            fail(f"{program} is not installed (packages-docs.txt)")
    configure(out)
    for name in OWN[1:]:
        shutil.rmtree(out / name, ignore_errors=True)
    site = Site(ROOT, out / "pages")
    site.build()
    for name, (title, _, _) in REFERENCES.items():
        site.write(site.target / f"api/{name}.md", PLACEHOLDER.format(title=title, name=name))
        doxygen(name, out)
    mkdocs(out)
    count = len(list((out / "site").rglob("*.html")))
    print(f"{count} pages: {out / 'site/index.html'}")
    print(f"with search: python3 -m http.server -d {out / 'site'}")


if __name__ == "__main__":
    main()
