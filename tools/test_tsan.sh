#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Unit tests of the modules that have threads, under the thread sanitizer.
# Usage: test_tsan.sh [MODULE...]
set -euo pipefail
cd "$(dirname "$0")/.."
modules=("$@")
[ $# -gt 0 ] || modules=(base capture client host net publish receive record send session sound)

cmake --preset tsan > /dev/null
cmake --build --preset tsan --target "${modules[@]/%/_test}"
names=$(IFS='|'; echo "${modules[*]}")
# The sanitizer wants memory where it expects it: no random addresses, where that may be asked for.
fixed=()
setarch -R true 2> /dev/null && fixed=(setarch -R)
"${fixed[@]}" ctest --preset tsan --tests-regex "^($names)\$"
