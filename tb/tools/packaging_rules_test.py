#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What tools/packaging_rules.py takes for a test."""
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import packaging_rules  # pylint: disable=wrong-import-position

PYTHON = """
# test_in_a_comment
KEY = "test_in_a_string"
def test_of_no_class(): pass
class Case(TestCase):
    def test_is_one(self): self.test_is_called()
    def helper(self): pass
"""
CPP = """
// TEST(Suite, InAComment)
const char *kText = "TEST(Suite, InAString)";
TEST_F(Fixture, IsOne) { kConstant(); }
TEST(Suite, DISABLED_IsNone) {}
"""


class Tests(unittest.TestCase):
    """Names of tests, and nothing else that stands in the file."""

    def named(self, suffix, text):
        """What a file of this text has."""
        with tempfile.TemporaryDirectory(prefix="verican-packaging-") as folder:
            path = Path(folder) / f"file{suffix}"
            path.write_text(text, encoding="utf-8")
            return packaging_rules.tests_of(path)

    def test_python(self):
        self.assertEqual(self.named(".py", PYTHON), {"test_is_one"})

    def test_google_test(self):
        self.assertEqual(self.named(".cpp", CPP), {"Fixture", "IsOne"})

    def test_pages_and_scripts_have_none(self):
        for suffix in (".md", ".sh", ".txt"):
            self.assertEqual(self.named(suffix, PYTHON + CPP), set())

    def test_properties_and_proofs(self):
        host = ROOT / "tb/formal/host"
        self.assertIn("PK-12", packaging_rules.tests_of(host / "apb.sv"))
        self.assertNotIn("assert", packaging_rules.tests_of(host / "apb.sv"))
        self.assertLessEqual({"apb", "axil", "wb"}, packaging_rules.tests_of(host / "proofs.yaml"))
        # A file of properties that no proof takes.
        self.assertEqual(self.named(".sv", (host / "apb.sv").read_text(encoding="utf-8")), set())

    def test_what_is_no_test_is_told(self):
        for entry in ("tb/integration/wrappers.py AT_ONCE",
                      "tb/mailbox/register_map_test.cpp kAllBuilds",
                      "docs/integration.md", "tools/lint.sh spdx", "tb/campaign.yaml formal"):
            row = {"title": "a row", "tests": [entry]}
            said = list(packaging_rules.problems([{"section": "one", "rows": {"PK-01": row}}]))
            file, _, word = entry.partition(" ")
            self.assertIn(f"PK-01: {file}: no test {word}".rstrip(), said)


if __name__ == "__main__":
    unittest.main()
