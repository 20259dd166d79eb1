# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Coverage of the RTL: points and counts, exclusions, report (docs/coverage.md)."""
