#!/bin/sh
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# init.sh: first program of the guest. Mounts, loads the CAN modules, runs the script VERICAN_SCRIPT
# in the directory for results, powers off. From the kernel's command line: VERICAN_DIR (results,
# with settings.sh, the variables of the script), VERICAN_GUEST (the scripts' place).
PATH=/usr/sbin:/usr/bin:/sbin:/bin
export PATH
unset LD_PRELOAD
mount -t proc none /proc
mount -t sysfs none /sys
# The root is read-only; the directory for results is mounted over itself to be written.
mount -t hostfs -o "$VERICAN_DIR" none "$VERICAN_DIR"
cd "$VERICAN_DIR" || busybox poweroff -f
echo >started
export TMPDIR="$VERICAN_DIR"
. ./settings.sh
. "$VERICAN_GUEST/lib.sh"

modules=/usr/lib/uml/modules/$(uname -r)/kernel
for module in net/can/can net/can/can-raw drivers/net/can/dev/can-dev drivers/net/can/vcan \
              drivers/net/can/vxcan; do
  busybox insmod "$modules/$module.ko" || complain "insmod $module"
done
# Room for all that a flood leaves in the sockets of its listeners while they wait for the CPU.
echo 67108864 >/proc/sys/net/core/rmem_max
ip link set lo up

. "$VERICAN_GUEST/$VERICAN_SCRIPT.sh"
# The bridge's logs are complete when it ends: a script that leaves one running has not done it.
[ -z "$bridge" ] || complain "the script left a bridge running"
dmesg >dmesg.txt
echo >ended
busybox poweroff -f
