#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# tidy.sh BUILD: clang-tidy on every source of ours that the build compiles, two at a time. A file
# is looked at again only if it, a header of ours or the settings changed since it was found clean.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh
build=$1
stamps=$build/tidy
mkdir -p "$stamps"

# Verilated classes are headers that the build makes.
mapfile -t models < <(ninja -C "$build" -t targets all |
                      sed -n 's/^\(.*\.dir\/V[A-Za-z0-9_]*\.h\): CUSTOM_COMMAND$/\1/p')
[ "${#models[@]}" -eq 0 ] || ninja -C "$build" "${models[@]}" >/dev/null

common=$(our_files '*.hpp' '*.h' '*.sv' '.clang-tidy' | sort | xargs cat | sha256sum)
todo=()
while read -r file; do
  grep -qF "\"file\": \"$PWD/$file\"" "$build/compile_commands.json" || continue
  key=$( { echo "$common"; cat "$file"; } | sha256sum | cut -c 1-32)
  [ -e "$stamps/$key" ] || todo+=("$key $file")
done < <(our_files 'sim/*.cpp' 'sw/*.cpp' 'tb/*.cpp')
[ "${#todo[@]}" -eq 0 ] && exit 0

tidy_one() {  # BUILD STAMPS "KEY FILE"
  local build=$1 stamps=$2 key=${3%% *} file=${3#* } output
  if output=$(clang-tidy --quiet -p "$build" "$file" 2>/dev/null); then
    : >"$stamps/$key"
  else
    grep -E ': (error|warning):' <<<"$output"
    return 1
  fi
}
export -f tidy_one
printf '%s\0' "${todo[@]}" | xargs -0 -n 1 -P 2 bash -c 'tidy_one "$@"' tidy "$build" "$stamps"
