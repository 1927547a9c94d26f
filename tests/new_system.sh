#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# What the tests of packages share: they source this file, which makes $folder for them until they end.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
packages="$root/build/packages"
folder="$(mktemp -d)"
trap 'rm -rf --one-file-system "$folder"' EXIT

fail() {
  echo "$(basename "$0" .sh): FAILED: $*" >&2
  exit 1
}

# $1: a pattern of file names in $packages.
require_packages() {
  compgen -G "$packages/$1" >/dev/null || fail "no $1 in $packages; run configs/package.sh"
}

# Makes a minimal Debian in a folder, from where this machine has its packages from.
new_system() { # RELEASE FOLDER [PACKAGE,...]
  local mirror
  mirror="$(apt-cache policy | sed -n 's/^ *[0-9]* \(http[^ ]*\) [a-z]*\/main.*/\1/p' | head -n 1)"
  debootstrap --variant=minbase ${3:+--include="$3"} "$1" "$2" "$mirror" >"$folder/log" 2>&1 ||
    fail "debootstrap: $(tail -n 5 "$folder/log")"
}

# Runs a command in a system, as root in its home.  What it says is then in $folder/log.  Programs find
# libraries beside them by /proc.
run_in() { # SYSTEM COMMAND
  DEBIAN_FRONTEND=noninteractive unshare --mount sh -c \
    "mount -t proc proc '$1/proc' && exec chroot '$1' sh -c \"\$1\"" sh "cd /root && $2" >"$folder/log" 2>&1
}
