# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The broadcast manager: cyclic frames, notes of changes and of silence, answers to remote frames,
# while a third node loads the bus and bits are flipped.
. "$VERICAN_GUEST/stacks.sh"
load can-bcm
open_bus bcm
[ -z "$VERICAN_SABOTAGE" ] || tell sabotage "$VERICAN_SABOTAGE"
# A guest whose time stands still finds no random numbers, for which Python would wait.
export PYTHONHASHSEED=0
in_background /usr/bin/python3 "$VERICAN_GUEST/bcm.py" can0 can1 >bcm.txt
weather "$VERICAN_LOAD"
close_bus bcm
