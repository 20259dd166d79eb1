#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# build.sh [DIRECTORY]: builds what the Linux tests run: user-mode Linux with Debian's unmodified
# flexcan driver, the glue module, the device trees. The kernel stays in DIRECTORY (build/linux)
# and is built again only if its source, its configuration or the compiler is another one.
set -euo pipefail
cd "$(dirname "$0")/../.."

out=${1:-build/linux}
jobs=${JOBS:-2}
clock=8000000
archive=/usr/src/linux-source-6.1.tar.xz
mkdir -p "$out"
out=$(cd "$out" && pwd)

fail() {
  echo "linux build: $*" >&2
  exit 1
}

[ "$(uname -m)" = x86_64 ] || fail "user-mode Linux 6.1 runs on x86-64 only, this is $(uname -m)"
[ -f "$archive" ] || fail "$archive is missing; it is in Debian's package linux-source-6.1"

version=$(dpkg-query -W -f '${Version}' linux-source-6.1)
key=$({ grep '^CONFIG_' sw/linux/kernel.config
        echo "$version"
        gcc -dumpfullversion -dumpmachine; } | sha256sum | cut -c 1-12)
kernel="$out/kernel-$key"
source="$kernel/linux-source-6.1"
log="$out/build.log"

# The parts of the source that no user-mode Linux compiles, and that are large.
unpack() {
  local part
  local without=()
  for part in drivers/gpu drivers/media drivers/staging drivers/scsi drivers/net/ethernet \
              drivers/net/wireless drivers/infiniband drivers/usb sound; do
    without+=(--exclude="linux-source-6.1/$part/*.[chS]")
  done
  without+=(--exclude='linux-source-6.1/Documentation/*.rst'
            --exclude='linux-source-6.1/Documentation/*.yaml'
            --exclude='linux-source-6.1/arch/*.dts*'
            --exclude='linux-source-6.1/tools/testing/[!s]*'
            --exclude='linux-source-6.1/tools/testing/selftests/[!p]*'
            --exclude='linux-source-6.1/tools/testing/selftests/powerpc/*')
  mkdir -p "$kernel"
  tar -C "$kernel" -xf "$archive" "${without[@]}"
}

make_kernel() {
  local cc=gcc
  command -v ccache >/dev/null && cc="ccache gcc"
  nice make -C "$source" -s ARCH=um CC="$cc" KBUILD_BUILD_TIMESTAMP=@0 KBUILD_BUILD_USER=verican \
       KBUILD_BUILD_HOST=verican -j "$jobs" "$@" >>"$log" 2>&1 </dev/null ||
    { tail -n 20 "$log" >&2; fail "make $* failed; the whole output is in $log"; }
}

build_kernel() {
  local start=$SECONDS
  echo "Building user-mode Linux $version (once, some minutes; output in $log)"
  : >"$log"
  unpack
  make_kernel KCONFIG_ALLCONFIG="$PWD/sw/linux/kernel.config" allnoconfig
  local line
  grep '^CONFIG_' sw/linux/kernel.config | while read -r line; do
    grep -qx "$line" "$source/.config" || fail "the kernel's configuration refuses $line"
  done
  make_kernel linux modules modules_prepare
  mkdir "$kernel/out"
  cp "$source"/linux "$source"/net/can/*.ko "$source"/net/can/j1939/can-j1939.ko \
     "$source"/drivers/net/can/vcan.ko "$source"/drivers/net/can/dev/can-dev.ko \
     "$source"/drivers/net/can/flexcan/flexcan.ko "$kernel/out"
  gcc -O2 -w -o "$kernel/out/testptp" "$source/tools/testing/selftests/ptp/testptp.c" -lrt
  (cd "$source" && sha256sum drivers/net/can/flexcan/*.[ch]) >"$kernel/out/flexcan.sha256"
  # What an out-of-tree module needs stays.
  find "$source" -mindepth 1 -maxdepth 1 -type d ! -name include ! -name arch ! -name scripts \
       -exec rm -rf {} +
  find "$source/arch" -mindepth 1 -maxdepth 1 -type d ! -name um ! -name x86 -exec rm -rf {} +
  echo "$((SECONDS - start))" >"$kernel/complete"
  echo "User-mode Linux: $((SECONDS - start)) s, kept in $kernel"
}

if [ ! -f "$kernel/complete" ]; then
  rm -rf "$out"/kernel-*
  build_kernel
fi

# Everything else takes seconds and is made each time.
start=$SECONDS
modules="$out/modules"
rm -rf "$modules"
mkdir -p "$modules"
cp "$kernel"/out/* "$modules"
for module in glue ptp; do
  rm -rf "${out:?}/$module"
  cp -r "sw/linux/$module" "$out"
  make_kernel M="$out/$module" modules
  cp "$out/$module"/*.ko "$modules"
done
gcc -O2 -Wall -Wextra -Werror -shared -fPIC -o "$modules/wide_xstate.so" sw/linux/host/wide_xstate.c
gcc -O2 -Wall -Wextra -Werror -o "$modules/request" sw/linux/guest/request.c
# The glue's window spans those of the controllers, hence the addresses that two nodes share.
for chip in ls1021ar2 imx28; do
  sed "s/@COMPATIBLE@/fsl,$chip-flexcan/; s/@CLOCK@/$clock/" sw/linux/dts/guest.dts.in |
    dtc -W no-unique_unit_address -I dts -O dtb -o "$modules/$chip.dtb" -
done
sed "s/@CLOCK@/$clock/" sw/linux/dts/time.dts.in |
  dtc -W no-unique_unit_address -I dts -O dtb -o "$modules/time.dtb" -
# The nodes that docs/software.md gives users are some that the compiler takes.
dtc -I dts -O dtb -o "$modules/verican.dtb" - <<DTS
/dts-v1/;
/ { intc: controller { interrupt-controller; #interrupt-cells = <2>; #address-cells = <0>; }; };
/include/ "$PWD/sw/linux/verican.dtsi"
DTS
echo "Linux: kernel $version, flexcan unmodified; glue and device trees $((SECONDS - start)) s"
