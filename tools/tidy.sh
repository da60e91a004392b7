#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# clang-tidy over the sources that differ from a commit, or over all of them. Fails on any finding.
# Eight sources are checked at once, as they are compiled at once (cmake/CompileTogether.cmake): their common
# headers are read once, which is most of the time. Sources of the web build alone are left out.
# Usage: tidy.sh COMMIT|--all
set -euo pipefail
cd "$(dirname "$0")/.."
since=${1:?a commit or --all}

# The compile commands, and what is generated.
cmake --preset dev > /dev/null
cmake --build --preset dev --target generated

changed=$(mktemp)
trap 'rm -f "$changed"' EXIT
if [ "$since" = --all ]; then
    git ls-files -- '*.cpp' > "$changed"
elif git rev-parse --quiet --verify "$since^{commit}" > /dev/null; then
    git diff --name-only --diff-filter=d "$since" -- '*.cpp' '*.h' > "$changed"
else
    echo "tidy: there is no commit $since here to compare with, so nothing is checked."
    exit 0
fi
mapfile -t units < <(tools/compiled_units.py build/dev "$changed")
[ ${#units[@]} -gt 0 ] || { echo "tidy: no source has changed."; exit 0; }
echo "tidy: ${#units[@]} unit(s) of the compiler"

check_one() {
    local code=0 found
    found=$(clang-tidy --quiet --warnings-as-errors='*' --checks=-bugprone-suspicious-include \
        --header-filter="^$PWD/(src|apps|bench|examples|tests|tools)/" -p build/dev "$1" 2> /dev/null) || code=$?
    [ "$code" -eq 0 ] || printf '%s\n' "$found"
    echo "tidy: $1" >&2
    return "$code"
}
export -f check_one
printf '%s\0' "${units[@]}" | xargs -0 -n 1 -P "$(nproc)" bash -c 'check_one "$@"' tidy
