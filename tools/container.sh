#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the container image `theatron` of packaging/Containerfile from the packages of `make package`, and meets a host in it.
# It is written to build/packages/theatron_container.tar.
# Usage, as root: container.sh     Exit code 77: no container can be built here
set -euo pipefail
cd "$(dirname "$0")/.."
[ "$(id -u)" -eq 0 ] || { echo "container: left out, making a root needs root"; exit 77; }
ls build/packages/theatron_*.deb > /dev/null || { echo "container: build the packages first: make package" >&2; exit 1; }
tools/setup.sh packages_container.txt
folder=$(mktemp -d /var/tmp/theatron_container.XXXXXX)
trap 'rm -rf --one-file-system "$folder"' EXIT
export STORAGE_DRIVER=vfs BUILDAH_ISOLATION=chroot
storage=(--root "$folder/storage" --runroot "$folder/run")
buildah "${storage[@]}" from scratch > "$folder/said" 2>&1 ||
    { echo "container: left out, buildah cannot work here: $(tail -n 1 "$folder/said")"; exit 77; }

# Without systemd, so the user that theatron-server would make is made here.
mmdebstrap --variant=minbase --format=tar --include=ca-certificates,"$(echo "$PWD"/build/packages/theatron_*.deb)" \
    --hook-dir=/usr/share/mmdebstrap/hooks/file-mirror-automount --aptopt='Acquire::Languages "none"' \
    --customize-hook='chroot "$1" useradd --system --home-dir /var/lib/theatron --create-home --shell /usr/sbin/nologin theatron' \
    --customize-hook='chroot "$1" install -d -o theatron -g theatron -m 0700 /var/cache/theatron' \
    bookworm "$folder/root.tar"
cp packaging/Containerfile "$folder/"
buildah "${storage[@]}" build --tag theatron "$folder"

container=$(buildah "${storage[@]}" from theatron)
say=$(buildah "${storage[@]}" run --user theatron "$container" -- theatron --version)
echo "container: $say"
buildah "${storage[@]}" run --user theatron "$container" -- bash -c '
    theatron host --listen 127.0.0.1:0 --state /tmp/state --camera synthetic:room,seconds=2,quality=quick,color=depth \
        --json > /tmp/greeting &
    while [ ! -s /tmp/greeting ] && kill -0 %1; do sleep 0.1; done
    theatron link --show expert --state /tmp/state > /tmp/link
    theatron join @/tmp/link --seconds 3 --json > /tmp/joined
    kill %1
    wait %1
    grep -qE "\"frames\": ?[1-9]" /tmp/joined' || { echo "container: nobody got a picture of a host in it" >&2; exit 1; }
buildah "${storage[@]}" push theatron "oci-archive:build/packages/theatron_container.tar:theatron"
echo "container: build/packages/theatron_container.tar (podman load -i), an image of $(du -m "$folder/root.tar" | cut -f1) MB, a host in it, a participant: all of it worked"
