# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Test install.remove_tree: cleans up behind the others.
"""usage: remove_tree.py SOURCE BUILD SANITIZED"""
import tree

tree.main(lambda installed: installed.remove_root())
