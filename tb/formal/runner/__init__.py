# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Formal proofs: catalogue, models, solvers, results; tb/formal/run.py is the program."""
