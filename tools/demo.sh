#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the demo alone and opens it at once; the other commands and the browser client are built meanwhile.
# Usage: demo.sh [OPTION of theatron demo...]
set -euo pipefail
cd "$(dirname "$0")/.."
programs=build/release/apps/theatron
log=build/rest.log
builder=

# is_built PRESET TARGET
is_built() { ninja -C "build/$1" -n "$2" 2> /dev/null | grep -q 'no work to do'; }

end_builder() {
    [ -n "$builder" ] || return 0
    if kill -0 "$builder" 2> /dev/null; then
        kill -- -"$builder" 2> /dev/null || true
        echo "demo: commands and browser client are not complete yet; make build completes them"
    elif ! wait "$builder"; then
        echo "demo: commands or browser client could not be built; $log says why"
    fi
}
trap end_builder EXIT

cmake --preset release > /dev/null
if ! is_built release theatron_demo; then
    echo "demo: the demo is compiled first, for some minutes; the counter below tells how far it is"
fi
cmake --build --preset release --target theatron_demo

command -v em++ > /dev/null || echo "demo: em++ is missing, so the demo has no browser client"
if ! { is_built release theatron && [ -e demo/case ] && { ! command -v em++ > /dev/null || is_built web page; }; }; then
    echo "demo: the other commands and the browser client are built while you look; links open in a browser in some minutes"
    # A process group of its own: Ctrl-C ends the demo, and the demo's end the building.
    setsid nice -n 15 sh -c "
        cmake --build --preset release --target theatron || exit 1
        [ -e demo/case ] || $programs/theatron case synth demo/case --dicom demo/ct || exit 1
        ! command -v em++ || { cmake --preset web && cmake --build --preset web --target page; }" > "$log" 2>&1 &
    builder=$!
fi
"$programs/theatron_demo" demo "$@"
