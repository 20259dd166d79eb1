# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# common.sh: what the scripts share; to be sourced in the project's root, but for needs().

# The RTL files of rtl/can.f, in the order of the data path.
rtl_files() {
  sed 's/#.*//; s/[[:space:]]//g; /^$/d; s|^|rtl/|' rtl/can.f
}

# has_module NAME: whether the file list holds that module.
has_module() {
  rtl_files | grep -q "/$1\.sv$"
}

# our_files PATTERN...: files of the project that match, new ones included, ignored ones left out.
# Fails if there is none, so that no check passes because it has looked at nothing.
our_files() {
  local files file
  files=$(git ls-files --cached --others --exclude-standard -- "$@") || return 1
  [ -n "$files" ] || { echo "no files match: $*" >&2; return 1; }
  while read -r file; do
    [ ! -f "$file" ] || printf '%s\n' "$file"
  done <<<"$files"
}

# needs COUNT SYNTAX ARGUMENT...: ends the script with its SYNTAX if there are fewer ARGUMENTs than
# COUNT.
needs() {
  if [ $(($# - 2)) -lt "$1" ]; then
    echo "usage: tools/$2" >&2
    exit 2
  fi
}

# all_there PROGRAM...: whether all of them can be run; says which cannot. (`command -v` of several
# succeeds with one.)
all_there() {
  local program missing=
  for program; do
    command -v "$program" >/dev/null || missing+=" $program"
  done
  [ -z "$missing" ] || { echo "missing:$missing" >&2; return 1; }
}
