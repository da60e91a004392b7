#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Unpacks Debian's SciPy into build/scipy, for the tests of the report of studies. It cannot be installed beside libboost1.81-dev:
# its package depends on Pythran, which SciPy needs for its own compilation alone, and Pythran depends on another Boost.
# Without a network those tests are left out. The packages that it loads are in packages.txt.
set -euo pipefail
cd "$(dirname "$0")/.."
modules=build/scipy/usr/lib/python3/dist-packages/scipy
[ -e "$modules" ] && exit 0
/usr/bin/python3 -c 'import scipy.stats' 2> /dev/null && exit 0

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if command -v apt-get > /dev/null && (cd "$work" && apt-get -q -o APT::Sandbox::User="$(id -un)" download python3-scipy > /dev/null 2>&1); then
    mkdir -p build
    rm -rf build/scipy
    dpkg-deb --extract "$work"/python3-scipy_*.deb "$work/scipy"
    mv "$work/scipy" build/scipy
else
    echo "setup: SciPy cannot be fetched, so the tests of the report of studies are left out" >&2
fi
