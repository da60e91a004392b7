#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every check that must hold, the quick ones first. Used by `make test` and by CI.
set -euo pipefail
cd "$(dirname "$0")/.."

step() { printf '\n== %s (%s)\n' "$1" "$(date +%H:%M:%S)"; }

step "Format and licence lines"
tools/check_sources.py

step "Directions of dependencies"
tools/check_includes.py

step "Release build"
cmake --preset release > /dev/null
cmake --build --preset release

step "Sanitizer build of what reads outside bytes"
cmake --preset fuzz > /dev/null
cmake --build --preset fuzz --target fuzzers

step "Web modules with em++"
cmake --preset web > /dev/null
cmake --build --preset web

step "Every fuzz target for a few seconds"
tools/fuzz.sh 5

step "Tests"
ctest --preset release
