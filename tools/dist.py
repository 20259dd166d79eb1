#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""dist.py OUT [--flat BUS_SIZE ...] [--bitstream FILE]: the archives of a release, in OUT:

  verican-<version>.tar.gz      the sources as committed
  verican-ip-<version>.tar.gz   what an integrator takes: RTL, Verilog-2005 files (--flat, or all),
                                packages for other tools, driver, constraints, pages,
                                the bitstream of examples/hx8k (--bitstream)
  verican-<version>.spdx        files and licences (SPDX 2.3)
  SHA256SUMS

The same commit gives the same bytes. Changes that are not committed are refused. A commit without
the tag v<version> is named <version>+g<commit>; with it, CHANGELOG.md must have a heading for it.
SOURCE_DATE_EPOCH: the times in the archives, instead of the commit's. A release that is in OUT
already goes; an OUT that holds anything else is refused.
"""
import argparse
import gzip
import hashlib
import io
import os
import re
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

# ruff: noqa: E402  (the path must be set first)
from pack import contents, flat, spdx
from pack.wrappers import ROOT, version, wrappers

OWN = re.compile(r"verican-(?:ip-)?(\d.*)\.tar\.gz|verican-(\d.*)\.spdx|SHA256SUMS")
LAST_EPOCH = 2**33 - 1   # of 11 octal digits, which is all that a tar file has for it


def fail(text):
    """Ends the program with a message."""
    sys.exit(f"dist.py: {text}")


def git(*words, binary=False):
    """The output of git."""
    done = subprocess.run(["git", "-c", "tar.umask=0022", *words], cwd=ROOT, check=False,
                          capture_output=True)
    if done.returncode != 0:
        fail(f"git {words[0]}: {done.stderr.decode().strip()}")
    return done.stdout if binary else done.stdout.decode().strip()


def name_of_version():
    """The version, with the commit behind it where it is not a release."""
    number, tag = version(), f"v{version()}"
    if tag not in git("tag", "--points-at", "HEAD").split():
        return f"{number}+g{git('rev-parse', '--short=10', 'HEAD')}"
    if f"## {number}" not in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"):
        fail(f"CHANGELOG.md has no heading '## {number}', but HEAD has tag {tag}")
    return number


def compressed(data):
    """gzip without name and time."""
    buffer = io.BytesIO()
    with gzip.GzipFile(filename="", mode="wb", fileobj=buffer, compresslevel=9, mtime=0) as file:
        file.write(data)
    return buffer.getvalue()


def tar_of(folder, top, epoch):
    """A folder as a tar file: names sorted, owner 0, modes 644 and 755, one time."""
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w", format=tarfile.PAX_FORMAT) as tar:
        for path in sorted(folder.rglob("*"), key=lambda path: path.relative_to(folder).parts):
            if path.is_dir():
                continue
            entry = tarfile.TarInfo(f"{top}/{path.relative_to(folder)}")
            entry.size, entry.mtime = path.stat().st_size, epoch
            entry.mode = 0o755 if path.stat().st_mode & 0o100 else 0o644
            with path.open("rb") as file:
                tar.addfile(entry, file)
    return buffer.getvalue()


def manifest(folder):
    """Path, size and SHA-256 of every file, a line each."""
    lines = []
    for path in sorted(folder.rglob("*"), key=lambda path: path.relative_to(folder).parts):
        if path.is_file():
            data = path.read_bytes()
            lines.append(f"{hashlib.sha256(data).hexdigest()}  {len(data):8}  "
                         f"{path.relative_to(folder)}\n")
    return "".join(lines)


def epoch_given():
    """SOURCE_DATE_EPOCH, None if it is not set."""
    text = os.environ.get("SOURCE_DATE_EPOCH")
    if not text:
        return None
    if not re.fullmatch("[0-9]{1,10}", text) or int(text) > LAST_EPOCH:
        fail(f"SOURCE_DATE_EPOCH is '{text}'; allowed: seconds since 1970, 0 to {LAST_EPOCH}")
    return int(text)


def release_in(out):
    """The files of the release that is in OUT, if one is; ends if OUT holds anything else, a second
    release too."""
    try:
        files = sorted(out.iterdir()) if out.exists() else []
    except OSError as error:
        fail(f"{out}: {error.strerror}")
    matches = [path.is_file() and OWN.fullmatch(path.name) for path in files]
    if not all(matches) or len({match[1] or match[2] for match in matches} - {None}) > 1:
        fail(f"{out} holds something else than one release that this script has made; it is left "
             "as it is: name another folder, or remove it")
    return files


def write(out, old, files):
    """Puts files, name -> bytes, in the place of old ones."""
    try:
        for path in old:
            path.unlink(missing_ok=True)
        for name, data in files.items():
            (out / name).write_bytes(data)
    except OSError as error:
        fail(f"{error.filename}: {error.strerror}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--flat", nargs="+", default=["all"], metavar="BUS_SIZE")
    parser.add_argument("--bitstream", type=Path, help="of examples/hx8k, made by tools/hx8k.sh")
    arguments = parser.parse_args()
    if arguments.bitstream and not arguments.bitstream.is_file():
        fail(f"--bitstream {arguments.bitstream}: no such file; make hx8k makes it")
    try:
        flat.chosen(wrappers(), arguments.flat)
    except flat.FlatError as error:
        fail(f"--flat: {error}")
    out, epoch = arguments.out.resolve(), epoch_given()
    old = release_in(out)
    changed = git("status", "--porcelain")
    if changed:
        fail(f"not committed:\n{changed}")
    number = name_of_version()
    if epoch is None:
        epoch = int(git("log", "-1", "--format=%ct"))
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        fail(f"{out}: {error.strerror}")

    files = {}
    with tempfile.TemporaryDirectory() as name:
        subprocess.run(["tar", "-x", "-C", name], check=True, umask=0o022,
                       input=git("archive", "--format=tar", "HEAD", binary=True))
        sources = tar_of(Path(name), f"verican-{number}", epoch)
    files[f"verican-{number}.tar.gz"] = compressed(sources)
    with tempfile.TemporaryDirectory() as name:
        stage = Path(name)
        contents.stage(stage, arguments.flat, arguments.bitstream)
        (stage / "MANIFEST").write_text(manifest(stage), encoding="utf-8")
        archive = tar_of(stage, f"verican-ip-{number}", epoch)
    files[f"verican-ip-{number}.tar.gz"] = compressed(archive)
    files[f"verican-{number}.spdx"] = spdx.render(number, epoch).encode()
    sums = "".join(f"{hashlib.sha256(data).hexdigest()}  {name}\n"
                   for name, data in sorted(files.items()))
    write(out, old, {**files, "SHA256SUMS": sums.encode()})
    print(sums, end="")


if __name__ == "__main__":
    main()
