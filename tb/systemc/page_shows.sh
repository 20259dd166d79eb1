#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# page_shows.sh PAGE PROGRAM: the first C++ block of the page is the program, from its first
# #include on.
set -euo pipefail
page=$1 program=$2
diff <(awk '/^```cpp$/ {on = 1; next} /^```$/ {if (on) exit} on' "$page") \
     <(sed -n '/^#include/,$p' "$program")
