#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the packages that are missing of a list beside this file. Needs root or sudo only then.
# With the usual list also fetches sources of libraries (library_sources.sh).
# Usage: setup.sh [LIST=packages.txt]
set -euo pipefail
cd "$(dirname "$0")"
[ -f "${1:-packages.txt}" ] || { echo "setup: there is no list '$1' beside setup.sh (usage: setup.sh [LIST=packages.txt])" >&2; exit 2; }

# A simulated headset and rules of accessibility for tests; without npm or a network those are left out.
tests=../tests/end_to_end
if { [ ! -e "$tests/node_modules/iwer" ] || [ ! -e "$tests/node_modules/axe-core" ]; } && command -v npm > /dev/null; then
    npm ci --silent --no-fund --no-audit --fetch-retries=0 --fetch-timeout=20000 --prefix "$tests" ||
        echo "setup: iwer and axe-core cannot be fetched, so tests/end_to_end/web_headset_test.py is left out, and web_access_test.py is shorter" >&2
fi

# install_missing PACKAGE...
install_missing() {
    local package missing=() root=() unknown=()
    for package in "$@"; do
        # A line for each kind of machine that it is installed for.
        dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0

    if ! command -v apt-get >/dev/null; then
        echo "setup: this is no Debian system; install what corresponds to: ${missing[*]}" >&2
        exit 1
    fi
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "setup: packages are missing and neither root nor sudo is at hand; as root, run:" >&2
            echo "  apt-get install ${missing[*]}" >&2
            exit 1
        fi
        root=(sudo)
    fi

    echo "setup: installing ${#missing[@]} package(s): ${missing[*]}"
    "${root[@]}" apt-get update -q
    # A package that cannot be had is named, instead of failing as a whole list.
    for package in "${missing[@]}"; do
        apt-cache show "$package" >/dev/null 2>&1 || unknown+=("$package")
    done
    if [ ${#unknown[@]} -gt 0 ]; then
        echo "setup: your package sources do not have: ${unknown[*]}" >&2
        echo "setup: Theatron is built on Debian 12; check /etc/apt/sources.list." >&2
        exit 1
    fi
    DEBIAN_FRONTEND=noninteractive "${root[@]}" apt-get install -y -q --no-install-recommends "${missing[@]}"
}

mapfile -t wanted < <(grep -vE '^\s*(#|$)' "${1:-packages.txt}")
install_missing "${wanted[@]}"
[ $# -gt 0 ] || ./library_sources.sh
