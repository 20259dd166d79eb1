# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# canfdtest: one generates frames, 50 under way, the other sends each back with one more in
# identifier and bytes. No bits are flipped: a frame that is repeated comes twice to who has seen it
# whole, and canfdtest takes that for an error.
# VERICAN_FRAMES: frames to check. VERICAN_SABOTAGE: what to spoil from the beginning.
. "$VERICAN_GUEST/stacks.sh"
open_bus canfdtest
[ -z "$VERICAN_SABOTAGE" ] || tell sabotage "$VERICAN_SABOTAGE"
canfdtest can1 >back.txt 2>&1 &
back=$!
sleep 0.01
in_background canfdtest -g -l "$VERICAN_FRAMES" can0 >generator.txt 2>&1
weather 0 clear
sleep 0.05
kill $back
close_bus canfdtest
