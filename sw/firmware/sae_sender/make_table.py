#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Makes sae_table.c from a CSV file with the columns message, bytes, period_ms; rows in the order
of their priority.

usage: make_table.py sae17.csv >sae_table.c
"""
import csv
import sys

HEAD = """/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The SAE class-C messages. Made by make_table.py; do not edit.
 */
#include "sae_table.h"

/* clang-format off */
const sae_message_t sae_table[SAE_MESSAGES] = {
"""


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with open(sys.argv[1], newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lines = [f"    {{{number}, {row['bytes']}, {row['period_ms']}}}, /* message {row['message']} */"
             for number, row in enumerate(rows, start=1)]
    sys.stdout.write(HEAD + "\n".join(lines) + "\n};\n")


if __name__ == "__main__":
    main()
