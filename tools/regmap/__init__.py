# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The register map of sw/registers.yaml and what is written from it; see tools/registers.py."""
