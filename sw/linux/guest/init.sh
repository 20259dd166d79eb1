#!/bin/sh
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# init.sh: first program of the guest. Mounts, loads the modules, runs the scripts that the kernel's
# command line names in VERICAN_SCRIPTS (a list with commas), powers off.
# Also from there: VERICAN_MODULES, VERICAN_DIR (for results), VERICAN_GUEST (the scripts' place).
PATH=/usr/sbin:/usr/bin:/sbin:/bin
export PATH
mount -t proc none /proc
mount -t sysfs none /sys
# The root is read-only; the directory for results is mounted over itself to be written.
mount -t hostfs -o "$VERICAN_DIR" none "$VERICAN_DIR"
cd "$VERICAN_DIR" || busybox poweroff -f

. "$VERICAN_GUEST/lib.sh"
for module in can can-raw can-dev; do load $module; done
load verican_glue sockets="$VERICAN_SOCKETS"
load flexcan
if [ ! -e /sys/class/net/can1 ]; then
  echo "FAILED: no devices"
  dmesg >dmesg.txt
  busybox poweroff -f
fi
for script in $(echo "$VERICAN_SCRIPTS" | tr , ' '); do
  . "$VERICAN_GUEST/$script.sh"
done
dmesg >dmesg.txt
echo "end of $VERICAN_SCRIPTS"
busybox poweroff -f
