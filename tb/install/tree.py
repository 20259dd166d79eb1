# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# tree: what the tests of the installed tree share: where it is, and how its users build.
"""The tree is installed once, by the test install.tree, and removed by install.remove_tree. It lies
outside of sources and build, and was moved after its installation."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


class Failed(Exception):
    """A check that failed; the text says what was wrong."""


def check(good, text):
    """Raises Failed(text) unless `good`."""
    if not good:
        raise Failed(text)


class Tree:
    """The tree that the build directory `build` installed."""

    def __init__(self, source, build, sanitized):
        self.source = pathlib.Path(source).resolve()
        self.build = pathlib.Path(build).resolve()
        self.sanitized = sanitized
        self.note = self.build / "tb" / "install" / "tree.path"

    @property
    def root(self):
        """The temporary directory of this test run."""
        check(self.note.exists(), f"{self.note} is missing: run the test install.tree first")
        return pathlib.Path(self.note.read_text(encoding="utf-8"))

    @property
    def prefix(self):
        """Where the tree lies now."""
        return self.root / "moved" / "here"

    def make_root(self):
        """A new temporary directory; an older one of this build goes."""
        self.remove_root()
        root = pathlib.Path(tempfile.mkdtemp(prefix="verican-install-")).resolve()
        for place in (self.source, self.build):
            check(place not in root.parents, f"{root} is inside of {place}: set TMPDIR")
        self.note.parent.mkdir(parents=True, exist_ok=True)
        self.note.write_text(str(root), encoding="utf-8")
        return root

    def remove_root(self):
        """Removes the temporary directory, if there is one."""
        if self.note.exists():
            shutil.rmtree(self.root, ignore_errors=True)
            self.note.unlink()

    def work(self, name):
        """A new empty directory for a test."""
        path = self.root / "work" / name
        shutil.rmtree(path, ignore_errors=True)
        path.mkdir(parents=True)
        return path

    def install(self, prefix, *components):
        """cmake --install of all components, or of those named."""
        for component in components or (None,):
            command = ["cmake", "--install", str(self.build), "--prefix", str(prefix)]
            self.run(command + (["--component", component] if component else []), prefix.parent)

    def environment(self, prefix=None):
        """What a user of the tree sets: where pkg-config looks; for a sanitized build its flags."""
        env = {key: value for key, value in os.environ.items()
               if key not in ("CPATH", "CPLUS_INCLUDE_PATH", "C_INCLUDE_PATH", "LIBRARY_PATH",
                              "CMAKE_PREFIX_PATH", "verican_DIR", "MAKEFLAGS", "MAKELEVEL")}
        found = sorted((prefix or self.prefix).rglob("*.pc"))
        check(found, f"no pkg-config files in {prefix or self.prefix}")
        env["PKG_CONFIG_PATH"] = str(found[0].parent)
        for name in ("CFLAGS", "CXXFLAGS"):
            env[name] = "-fsanitize=address,undefined" if self.sanitized else ""
        return env

    def run(self, command, cwd, env=None, expect=0):
        """Runs a command; returns what it printed. Another exit code than `expect` is a failure."""
        done = subprocess.run([str(part) for part in command], cwd=cwd, env=env, timeout=240,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
        check(done.returncode == expect,
              f"{' '.join(map(str, command))}: exit code {done.returncode} instead of {expect}\n"
              f"{done.stdout}")
        return done.stdout

    def has_systemc(self):
        """True if the machine has SystemC; then the installation must have its library, too."""
        found = subprocess.run(["pkg-config", "--exists", "systemc"], check=False).returncode == 0
        check(not found or list(self.prefix.rglob("vericansystemc.pc")),
              "SystemC is there, but vericansystemc is not installed")
        return found

    def project_version(self):
        """The version in CMakeLists.txt, the one source of all others."""
        text = (self.source / "CMakeLists.txt").read_text(encoding="utf-8")
        return re.search(r"^project\(verican VERSION ([0-9.]+)", text, re.MULTILINE).group(1)

    def check_outside(self, paths, what):
        """No path lies in the source or build tree; at least one lies in the installed tree."""
        paths = {pathlib.Path(path).resolve() for path in paths}
        for place in (self.source, self.build):
            inside = sorted(str(path) for path in paths if place in path.parents)
            check(not inside, f"{what} uses files of {place}: {', '.join(inside)}")
        check(any(self.prefix in path.parents for path in paths),
              f"{what} uses nothing of {self.prefix}")


def main(test):
    """Runs test(Tree) with the arguments SOURCE BUILD SANITIZED; one line for a failure."""
    source, build, sanitized = sys.argv[1:4]
    try:
        test(Tree(source, build, sanitized == "1"))
    except (Failed, subprocess.TimeoutExpired, OSError) as error:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {error}")
