#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds what has SIMD kernels for 64-bit ARM and runs its tests under QEMU.
set -euo pipefail
cd "$(dirname "$0")/.."

if ! dpkg --print-foreign-architectures | grep -qx arm64; then
    root=()
    [ "$(id -u)" -eq 0 ] || root=(sudo)
    "${root[@]}" dpkg --add-architecture arm64
fi
tools/setup.sh packages_arm64.txt
cmake --preset arm64 > /dev/null
cmake --build --preset arm64
ctest --preset arm64
