#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds targets of a preset, or all of it. A build of the same preset that runs already is waited for.
# Usage: build.sh PRESET [TARGET...]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:?usage: build.sh PRESET [TARGET...]}
shift
mkdir -p build
exec 9> "build/$preset.lock"
flock -n 9 || { echo "build: another build of '$preset' is running; this one waits for it" >&2; flock 9; }
# The lock is this script's alone: what it starts does not inherit it.
cmake --preset "$preset" 9>&- > /dev/null
cmake --build --preset "$preset" ${1+--target "$@"} 9>&-
