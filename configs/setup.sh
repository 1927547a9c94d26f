#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian packages that are missing and builds build/release.  Quiet unless it fails.
# Usage: setup.sh [program|all|packages|scheduled].  program: without tests and benchmarks, and what
# only they need; packages: builds nothing; scheduled: the same with what .ci/scheduled needs.
set -euo pipefail

what="${1:-all}"

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
log="$(mktemp)"
trap 'rm -f "$log"' EXIT

die() {
  echo "setup: $*" >&2
  exit 1
}

# Runs a command with its output kept; shows the end of it when the command fails.
quietly() {
  "$@" >"$log" 2>&1 && return
  tail -n 60 "$log" >&2
  return 1
}

wanted_packages() {
  local lists=("$root/configs/packages.txt")
  [[ "$what" == program ]] || lists+=("$root/configs/test-packages.txt")
  [[ "$what" != scheduled ]] || lists+=("$root/configs/scheduled-packages.txt")
  sed 's/#.*//' "${lists[@]}" | tr -s ' \t' '\n' | sed '/^$/d'
}

# True if apt has lists of packages, and $1 is in none of them.
is_unknown() {
  compgen -G '/var/lib/apt/lists/*_Packages*' >/dev/null && [[ -z "$(apt-cache show "$1" 2>/dev/null)" ]]
}

is_installed() {
  [[ "$(dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null)" == *installed* ]] &&
    [[ "$(dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null)" != *not-installed* ]]
}

# What ends in '?' in a list is left out where the system does not have it.
missing_packages() {
  local package wanted
  for wanted in $(wanted_packages); do
    package="${wanted%\?}"
    is_installed "$package" || { [[ "$wanted" != "$package" ]] && is_unknown "$package"; } ||
      echo "$package"
  done
}

as_root() {
  if ((EUID == 0)); then
    env DEBIAN_FRONTEND=noninteractive "$@"
  else
    sudo env DEBIAN_FRONTEND=noninteractive "$@"
  fi
}

install_packages() {
  local missing
  if ! command -v dpkg-query >/dev/null; then
    echo "setup: no dpkg here; going on without installing what configs/packages.txt and test-packages.txt list" >&2
    return
  fi
  mapfile -t missing < <(missing_packages)
  ((${#missing[@]})) || return 0
  if ((EUID != 0)) && ! command -v sudo >/dev/null; then
    die "neither root nor sudo; as root: apt-get install ${missing[*]}"
  fi
  echo "setup: installing ${missing[*]} (about a minute)"
  quietly as_root apt-get update ||
    die "apt-get update failed (no network?); these packages are missing: ${missing[*]}"
  mapfile -t missing < <(missing_packages)
  quietly as_root apt-get install --yes --no-install-recommends "${missing[@]}" ||
    die "apt-get install failed (see above); these packages are missing: ${missing[*]}"
}

build() {
  local tests=ON
  [[ "$what" == program ]] && tests=OFF
  cd "$root"
  local minutes=12
  [[ $tests == OFF ]] && minutes=4
  echo "setup: building build/release (about $minutes minutes on two cores, when it is built anew)"
  quietly cmake --preset release -DMW_BUILD_TESTS=$tests -DMW_BUILD_BENCH=$tests || die "cmake failed (see above)"
  quietly cmake --build --preset release --parallel 2 || die "the build failed (see above)"
}

[[ "$what" =~ ^(program|all|packages|scheduled)$ ]] ||
  die "'$what' is none of program, all, packages and scheduled"
install_packages
[[ "$what" == packages || "$what" == scheduled ]] || build
