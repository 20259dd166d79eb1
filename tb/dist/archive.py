#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""usage: archive.py [FOLDER BUS_SIZE ...]

The archives of `make dist`: two runs in different folders, time zones, locales and umasks give the
same bytes, what is not committed is refused, and the archive for integrators stands alone: in an
empty folder it is linted, synthesised and simulated, its driver compiled, its lists checked.

Without arguments the tests make the archives from a copy of the working tree, with one Verilog-2005
build; with FOLDER, they take those that `make dist` has put there, with the builds named."""

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GIVEN = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else None
BUILDS = sys.argv[2:] or ["wb_16"]
# In place of the bitstream, which takes two minutes; make dist takes the true one.
IMAGE = bytes.fromhex("FF007EAA997E") + bytes(range(256))
# Of what lies in the archive and pages of it name.
PATH = re.compile(r"\b(?:sw/(?:litex|driver|remote)|rtl|constraints|examples/hx8k)"
                  r"/[\w./*-]*(?:[\w*/]|\.\[\w+\])")
LINK = re.compile(r"\]\(([^()\s#:]+)(#[^()\s]*)?\)")


def run(*command, cwd=ROOT, env=None, umask=-1):
    """Exit code and output of a command."""
    done = subprocess.run([str(word) for word in command], cwd=cwd, text=True, check=False,
                          env={**os.environ, **(env or {})}, umask=umask,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    return done.returncode, done.stdout


def repository(folder):
    """A copy of the working tree with one commit, whose time is fixed."""
    names = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, check=True,
                           text=True, stdout=subprocess.PIPE).stdout.splitlines()
    for name in names:
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, folder / name)
    run("git", "init", "-q", cwd=folder)
    commit(folder, "-A")


def commit(folder, what):
    """Commits `what`, the same for the same content."""
    person = {f"GIT_{who}_{what}": value for who in ("AUTHOR", "COMMITTER") for what, value in
              (("NAME", "test"), ("EMAIL", "test@localhost"), ("DATE", "1700000000 +0000"))}
    for words in (("add", what), ("commit", "-q", "-m", "test")):
        code, text = run("git", *words, cwd=folder, env=person)
        if code != 0:
            raise AssertionError(text)


class Archive(unittest.TestCase):
    """One set of archives for all tests."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.work = Path(folder.name)
        cls.dist = GIVEN or cls.work / "dist"
        if not GIVEN:
            cls.copy = cls.work / "first"
            cls.copy.mkdir()
            repository(cls.copy)
            cls.image = cls.work / "image.bin"
            cls.image.write_bytes(IMAGE)
            code, text = run("tools/dist.py", cls.dist, "--flat", *BUILDS, "--bitstream",
                             cls.image, cwd=cls.copy, umask=0o022,
                             env={"TZ": "Asia/Tokyo", "LC_ALL": "C"})
            if code != 0:
                raise AssertionError(text)
        archive, = cls.dist.glob("verican-ip-*.tar.gz")
        run("tar", "-x", "-z", "-f", archive, cwd=cls.work)
        cls.ip, = cls.work.glob("verican-ip-*")

    @unittest.skipIf(GIVEN, "the archives were given")
    def test_two_runs_give_the_same_bytes(self):
        second = self.work / "a longer name of a folder"
        second.mkdir()
        run("git", "clone", "-q", self.copy, second)
        (self.work / "again").mkdir()
        for name in ("verican-0.0.1.tar.gz", "verican-ip-0.0.1.tar.gz", "SHA256SUMS"):
            (self.work / "again" / name).write_text("a release before\n", encoding="utf-8")
        code, text = run("tools/dist.py", self.work / "again", "--flat", *BUILDS, "--bitstream",
                         self.image, cwd=second, umask=0o077,
                         env={"TZ": "America/New_York", "LC_ALL": "C.UTF-8"})
        self.assertEqual(code, 0, text)
        first, again = ({path.name: hashlib.sha256(path.read_bytes()).hexdigest()
                         for path in folder.iterdir()}
                        for folder in (self.dist, self.work / "again"))
        self.assertEqual(first, again)
        self.assertEqual(len(first), 4)

    @unittest.skipIf(GIVEN, "the archives were given")
    def test_what_is_not_committed_is_refused(self):
        other = self.work / "dirty"
        run("git", "clone", "-q", self.copy, other)
        for name, words in (("rtl/new.sv", "?? rtl/new.sv"), ("README.md", "M README.md")):
            (other / name).write_text("changed\n", encoding="utf-8")
            code, text = run("tools/dist.py", self.work / "none", cwd=other)
            self.assertEqual(code, 1)
            self.assertIn(words, text)
            self.assertFalse((self.work / "none").exists())
            (other / "rtl/new.sv").unlink(missing_ok=True)

    @unittest.skipIf(GIVEN, "the archives were given")
    def test_a_tag_without_a_heading_is_refused(self):
        other = self.work / "tagged"
        run("git", "clone", "-q", self.copy, other)
        version = re.search(r"project\(verican VERSION ([\d.]+)",
                            (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
        changes = other / "CHANGELOG.md"
        text = changes.read_text(encoding="utf-8").replace(f"## {version}", "## 0.0.0")
        changes.write_text(f"{text}\n", encoding="utf-8")
        commit(other, "CHANGELOG.md")
        run("git", "tag", f"v{version}", cwd=other)
        code, text = run("tools/dist.py", self.work / "none", cwd=other)
        self.assertEqual(code, 1)
        self.assertIn("no heading", text)

    @unittest.skipIf(GIVEN, "the archives were given")
    def test_a_bitstream_that_is_not_there_is_told(self):
        code, text = run("tools/dist.py", self.work / "none", "--bitstream", "none.bin",
                         cwd=self.copy)
        self.assertEqual(code, 1)
        self.assertIn("none.bin: no such file; make hx8k makes it", text)

    def test_the_boards_bitstream_is_in_it(self):
        image = self.ip / "examples/hx8k/can_hx8k.bin"
        if GIVEN and not shutil.which("nextpnr-ice40"):
            self.skipTest("nextpnr-ice40 is not here: no bitstream")
        data = image.read_bytes()
        self.assertIn(bytes.fromhex("7EAA997E"), data[:300], "the preamble of iCE40 images")
        if GIVEN:
            self.assertGreater(len(data), 100_000)  # of an HX8K
        else:
            self.assertEqual(data, IMAGE)

    def test_constraints_can_be_written_for_an_instance(self):
        code, text = run("/usr/bin/python3", "-B", "tools/constraints.py", self.work / "xdc",
                         "--instance", "u_soc/u_can", "--mhz", 0, "--reset", "", "--rx", "can_rxd",
                         "--tx", "can_txd", cwd=self.ip)
        self.assertEqual((code, text), (0, ""))
        self.assertIn("u_soc/u_can/u_top/u_core/u_sync/meta_q_reg*",
                      (self.work / "xdc/xilinx/can.xdc").read_text(encoding="utf-8"))

    def test_sums_and_manifest_hold(self):
        self.assertEqual(run("sha256sum", "--check", "--quiet", "SHA256SUMS", cwd=self.dist),
                         (0, ""))
        listed = {}
        for line in (self.ip / "MANIFEST").read_text(encoding="utf-8").splitlines():
            digest, size, name = line.split(maxsplit=2)
            listed[name] = (digest, int(size))
        there = {str(path.relative_to(self.ip)): (
            hashlib.sha256(path.read_bytes()).hexdigest(), path.stat().st_size)
            for path in self.ip.rglob("*") if path.is_file() and path.name != "MANIFEST"}
        self.assertEqual(listed, there)
        self.assertGreater(len(there), 150)

    def test_sources_are_those_that_are_committed(self):
        """Each file, with its mode."""
        archive, = set(self.dist.glob("verican-*.tar.gz")) - set(self.dist.glob("verican-ip-*"))
        with tarfile.open(archive) as tar:
            there = {entry.name.partition("/")[2]: (entry.mode, tar.extractfile(entry).read())
                     for entry in tar if entry.isfile()}
        folder = ROOT if GIVEN else self.copy
        files = run("git", "ls-files", "-s", cwd=folder)[1].splitlines()
        committed = {name: (0o755 if mode == "100755" else 0o644, (folder / name).read_bytes())
                     for mode, _, _, name in (line.split(maxsplit=3) for line in files)}
        self.assertEqual(set(there), set(committed))
        self.assertEqual([name for name in there if there[name] != committed[name]], [])

    def test_every_licence_has_its_text(self):
        spdx, = self.dist.glob("*.spdx")
        text = spdx.read_text(encoding="utf-8")
        named = set(re.findall(r"^LicenseInfoInFile: (.*)$", text, re.MULTILINE))
        self.assertEqual(named, {"Apache-2.0", "GPL-2.0"})
        for licence in named:
            self.assertTrue((ROOT / "LICENSES" / f"{licence}.txt").is_file(), licence)
            self.assertTrue((self.ip / "LICENSES" / f"{licence}.txt").is_file(), licence)
        kernel = re.findall(r"FileName: \./(sw/linux/(?:glue|ptp)/\S+)(?:.*\n)+?LicenseConcluded: "
                            r"(\S+)", text)
        self.assertTrue(kernel)
        self.assertEqual({licence for _, licence in kernel}, {"GPL-2.0"})

    def test_nothing_knows_the_machine(self):
        for path in self.ip.rglob("*"):
            if path.is_file():
                data = path.read_bytes()
                words = [str(self.work), str(ROOT), str(ROOT.resolve().parent)]
                if path.suffix != ".bin":  # a short name is in a bitstream by chance
                    words.append(os.uname().nodename)
                for word in words:
                    self.assertNotIn(word.encode(), data, path)

    def test_links_of_the_pages_lead_somewhere(self):
        for page in self.ip.rglob("*.md"):
            for target, _ in LINK.findall(page.read_text(encoding="utf-8")):
                self.assertTrue((page.parent / target).exists(), f"{page.name}: {target}")

    def rtl(self):
        return (self.ip / "lists/can_root.f").read_text(encoding="utf-8").split()

    def test_it_is_linted(self):
        for bus in ("ahb", "apb", "axil", "wb"):
            code, text = run("verilator", "--lint-only", "-Wall", "--top-module", f"can_{bus}",
                             "rtl/lint.vlt", "-f", "lists/can_root.f", cwd=self.ip)
            self.assertEqual((code, text), (0, ""))

    def test_a_design_elsewhere_takes_the_list(self):
        sys.path.insert(0, str(ROOT / "tb/integration"))
        import design  # pylint: disable=import-outside-toplevel
        variable, = set(re.findall(r"\$\{(\w+)\}", (self.ip / "lists/can_abs.f").read_text(
            encoding="utf-8")))
        self.assertIn(f"`{variable}`", (self.ip / "README.md").read_text(encoding="utf-8"))
        other = self.work / "user"
        other.mkdir()
        (other / "user_top.sv").write_text(design.user_top(), encoding="utf-8")
        code, text = run("verilator", "--lint-only", "-Wall", "--top-module", "user_top",
                         self.ip / "rtl/lint.vlt", "-f", self.ip / "lists/can_abs.f",
                         "user_top.sv", cwd=other, env={variable: str(self.ip)})
        self.assertEqual((code, text), (0, ""))

    def test_it_is_synthesised(self):
        code, text = run("yosys", "-q", "-p", (
            f"read_verilog -sv {' '.join(self.rtl())}; hierarchy -check -top can_apb "
            "-chparam NumMb 16; synth_ice40 -top can_apb; tee -o stat.txt stat"), cwd=self.ip)
        (self.ip / "stat.txt").rename(self.work / "stat.txt")
        self.assertEqual(code, 0, text)
        self.assertRegex((self.work / "stat.txt").read_text(encoding="utf-8"), r"SB_RAM40_4K +6")

    def smoke(self, language, sources, options=()):
        bench = sorted((self.ip / "tb/smoke").glob("*.v"))
        out = self.work / "smoke.vvp"
        code, text = run("iverilog", language, "-s", "can_smoke", "-o", out, *options, *sources,
                         *bench)
        text = re.sub(r".*sorry: constant selects in always_\*.*\n", "", text)
        self.assertEqual((code, text), (0, ""))
        self.assertEqual(run("vvp", "-n", out)[1].splitlines()[:1], ["smoke: passed"])

    def test_it_is_simulated_from_its_rtl(self):
        copies = []
        for name in self.rtl():  # always_comb as Icarus 11 can run it: docs/errata.md, E-08
            copies.append(self.work / Path(name).name)
            copies[-1].write_text(re.sub(r"\balways_comb\b", "always @*",
                                         (self.ip / name).read_text(encoding="utf-8")),
                                  encoding="utf-8")
        self.smoke("-g2012", copies)

    def test_it_is_simulated_from_its_verilog(self):
        for build in BUILDS if BUILDS != ["all"] else ["ahb_16", "apb_32", "axil_64", "wb_64"]:
            bus = build.split("_")[0]
            others = [f"-DNO_{name.upper()}" for name in ("ahb", "apb", "axil", "wb")
                      if name != bus]
            file = self.ip / f"verilog/can_{build}.v"
            top = re.search(rf"^module (can_{build}_[0-9_]+) ?\(",
                            file.read_text(encoding="utf-8"), re.MULTILINE)[1]
            self.smoke("-g2005-sv", [file], [*others, f"-DCAN_{bus.upper()}={top}"])

    def test_driver_is_compiled(self):
        sources = sorted((self.ip / "sw/driver/src").glob("*.c"))
        self.assertGreater(len(sources), 3)
        for source in sources:
            code, text = run("gcc", "-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-c",
                             "-I", self.ip / "sw/driver/include", "-o", self.work / "driver.o",
                             source)
            self.assertEqual((code, text), (0, ""))

    def test_client_of_remote_nodes_is_compiled(self):
        sources = [*sorted((self.ip / "sw/remote/src").glob("*.c")),
                   self.ip / "sw/remote/verican_remote_driver.c"]
        self.assertGreater(len(sources), 3)
        for source in sources:
            code, text = run("gcc", "-std=c99", "-Wall", "-Wextra", "-c", "-I",
                             self.ip / "sw/remote", "-I", self.ip / "sw/driver/include", "-o",
                             self.work / "remote.o", source)
            self.assertEqual((code, text), (0, ""))

    def test_what_pages_name_of_it_is_there(self):
        """Paths in commands and in the text, of the parts for whoever takes the archive."""
        for page in self.ip.glob("docs/*.md"):
            for path in PATH.findall(page.read_text(encoding="utf-8")):
                self.assertTrue(list(self.ip.glob(path.rstrip("/."))), f"{page.name}: {path}")

    def test_rtl_of_remote_nodes_comes_with_its_pages(self):
        for name in ("docs/remote.md", "docs/remote-node.md", "docs/hx8k.md", "rtl/remote",
                     "sw/remote/verican_remote.py", "tools/remote_memory.py"):
            self.assertTrue((self.ip / name).exists(), name)
        text = (self.ip / "docs/integration.md").read_text(encoding="utf-8")
        for page in ("remote.md", "hx8k.md"):
            self.assertIn(f"[{page}]({page})", text)

    def test_core_file_and_package_are_whole(self):
        self.assertEqual(run("/usr/bin/python3", "-B", "tools/core_check.py", cwd=self.ip),
                         (0, "can.core: 0 problems\n"))
        for place in ("sw/litex/verican/__init__.py", "sw/profiles.yaml", "sw/verican.svd",
                      "ipxact/can_axil.xml", "fpga/vivado/package.tcl", "verilog/can_axil_v.v"):
            self.assertTrue((self.ip / place).is_file(), place)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
