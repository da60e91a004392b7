#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the source package and, from it alone and without a network, the Debian packages into build/packages, and lets lintian
# and the validators of their parts look at them. --twice: compiles them again, in another time zone, and compares the bytes.
# Usage: package.sh [--twice]
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh packages_package.txt
folder=$PWD/build/packages
rm -rf "$folder"
mkdir -p "$folder"

fail() { echo "package: $1" >&2; exit 1; }

# The program is not installed here; nothing else may be said of the unit.
said=$(systemd-analyze verify --man=no packaging/theatron-host@.service 2>&1 | grep -v 'theatron is not executable: No such file' || true)
[ -z "$said" ] || fail "the unit: $said"
systemd-analyze security --offline=true --threshold=15 packaging/theatron-host@.service > /dev/null ||
    fail "the unit is more exposed than 1.5: systemd-analyze security --offline=true packaging/theatron-host@.service"
# A runtime folder, which the user's manager has.
said=$(XDG_RUNTIME_DIR=/tmp systemd-analyze --user verify --man=no packaging/theatron-or-screen.service 2>&1 | grep -v 'theatron is not executable: No such file' || true)
[ -z "$said" ] || fail "the unit of the OR screen: $said"
apparmor_parser -Q packaging/theatron-host.apparmor
desktop-file-validate packaging/*.desktop
# The project has no domain of which its name could be a part.
appstreamcli validate --no-net --override=cid-desktopapp-is-not-rdns=info packaging/theatron.metainfo.xml > /dev/null

# The tracked files, and the sources of Debian's libraries that the page compiles.
[ -s libraries/versions.txt ] || fail "libraries/ is missing, so the page would lack zstd, lz4 and Opus: tools/library_sources.sh"
version=$(dpkg-parsechangelog --show-field Version)
tree=$folder/theatron-$version
SOURCE_DATE_EPOCH=$(dpkg-parsechangelog --show-field Timestamp)
export SOURCE_DATE_EPOCH
mkdir "$tree"
git ls-files -z | tar --create --null --exclude='libraries/*/.pc' --files-from=- libraries | tar --extract --directory="$tree"
(cd "$folder" && dpkg-source --build "$tree")
rm -rf "$tree"

# Where namespaces can be made, the build has no network. ccache has the objects of a build before.
offline=()
unshare --net true 2> /dev/null && offline=(unshare --net)
[ ${#offline[@]} -gt 0 ] || echo "package: no namespace can be made here, so the build could reach the network"

# build_into FOLDER [NAME=VALUE...]: the packages, from the source package alone and with these words in the environment.
build_into() {
    local into=$1
    shift
    (cd "$folder" && dpkg-source --extract "theatron_$version.dsc" "$tree")
    (cd "$tree" && env THEATRON_DEB_FOLDER="$into" "$@" "${offline[@]}" dpkg-buildpackage --build=binary --unsigned-changes --unsigned-buildinfo \
        --buildinfo-option="-u$into" --changes-option="-u$into" \
        --buildinfo-file="$into/theatron.buildinfo" --changes-file="$into/theatron.changes")
    local web=$tree/build/web/apps/web
    [ -s "$web/page/files.txt" ] || fail "the packages have no page: $web/page/files.txt is missing"
    [ -z "$(tr -d '[:space:]' < "$web/missing.txt")" ] ||
        fail "the page lacks $(cat "$web/missing.txt"), which tools/library_sources.sh fetches"
    rm -rf "$tree"
}

build_into "$folder"
lintian --fail-on error "$folder"/*.deb "$folder"/*.dsc
if [ "${1:-}" = --twice ]; then
    again=$folder/again
    mkdir "$again"
    build_into "$again" TZ=Pacific/Kiritimati CCACHE_RECACHE=1
    differ=()
    for package in "$folder"/*.deb; do
        cmp --quiet "$package" "$again/${package##*/}" || differ+=("${package##*/}")
    done
    [ ${#differ[@]} -eq 0 ] || fail "two builds differ in ${differ[*]}; the second ones are in $again (diffoscope compares them)"
    rm -rf "$again"
    echo "package: two builds are the same bytes"
fi
ls -l "$folder"/*.deb
