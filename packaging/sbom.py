#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the software bill of materials of a build as SPDX 2.3 JSON: the program, the page, the Debian packages and sources
whose code became part of them, and the packages whose shared libraries the program links or loads.

The packages that are compiled in come from the lists beside the notices (cmake/Notices.cmake), the linked ones from the
program itself, the sources of the page from libraries/versions.txt. Versions and licences are those of this machine's packages.
SOURCE_DATE_EPOCH is its time, so two builds of the same sources and packages give the same bytes.

Example: packaging/sbom.py --version 0.3.0 --program build/release/apps/theatron/theatron \\
             --compiled-in build/release/apps/theatron/licences.txt.packages --output theatron.spdx.json
"""

import argparse
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys
import time
import urllib.parse

# Loaded while the program runs, where they are installed (debian/control recommends them).
LOADED = ("libavcodec59", "libavformat59", "libavutil57", "libswscale6")
SUPPLIER = "Organization: Debian"


class Problem(Exception):
    pass


def output_of(*command):
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ | {"LC_ALL": "C.UTF-8"})
    if done.returncode != 0:
        raise Problem(f"{' '.join(command)} failed: {done.stderr.strip() or done.returncode}")
    return done.stdout


def linked_libraries(program):
    """Paths of the shared libraries that the program names itself."""
    names = re.findall(r"\(NEEDED\).*\[(.+)\]", output_of("readelf", "--dynamic", program))
    if not names:
        raise Problem(f"{program} names no shared library; is it the program?")
    known = {}
    for line in output_of("/sbin/ldconfig", "-p").splitlines():
        match = re.match(r"\s+(\S+) \(.*\) => (\S+)", line)
        if match:
            known.setdefault(match[1], match[2])
    missing = [name for name in names if name not in known]
    if missing:
        raise Problem(f"{program} needs {', '.join(missing)}, which this machine does not have.")
    return [known[name] for name in names]


def packages_of(libraries):
    """The Debian packages that have these libraries."""
    # dpkg may know a library under /usr/lib or under /lib, which are the same folder.
    wanted = {}
    for library in libraries:
        for path in (library, os.path.realpath(library)):
            path = path.removeprefix("/usr")
            wanted |= {path: library, "/usr" + path: library}
    # It ends with 1 where one of the paths is unknown to it.
    found = subprocess.run(("dpkg-query", "--search", *wanted), capture_output=True, text=True).stdout
    packages = {}
    for line in found.splitlines():
        names, _, path = line.rpartition(": ")
        if path in wanted:
            packages[wanted[path]] = names.split(",")[0].split(":")[0]
    missing = sorted(set(libraries) - set(packages))
    if missing:
        raise Problem(f"No Debian package has {', '.join(missing)}.")
    return sorted(set(packages.values()))


def licences_of(package):
    """The licences that the package's copyright file names, in their order; none where it has no machine-readable form."""
    path = pathlib.Path(f"/usr/share/doc/{package}/copyright")
    if not path.exists():
        return []
    text = path.read_text(errors="replace")
    if not text.startswith("Format:"):
        return []
    return list(dict.fromkeys(name.strip() for name in re.findall(r"^License:[ \t]*(.+)$", text, re.MULTILINE)))


def purl(name, version, architecture):
    return f"pkg:deb/debian/{name}@{urllib.parse.quote(version, safe='')}?arch={architecture}&distro=debian-12"


def installed():
    """Version, architecture, source package and its version of each installed package, by name."""
    lines = output_of("dpkg-query", "--show", "--showformat",
                      "${db:Status-Abbrev}\t${Package}\t${Version}\t${Architecture}\t${source:Package}\t${source:Version}\n")
    rows = [line.split("\t") for line in lines.splitlines()]
    return {name: facts for status, name, *facts in rows if status.startswith("ii")}


def debian_package(name, known):
    if name not in known:
        raise Problem(f"The package {name} is not installed, so its version is not known.")
    version, architecture, source, source_version = known[name]
    licences = licences_of(name)
    return {
        "name": name,
        "versionInfo": version,
        "supplier": SUPPLIER,
        "sourceInfo": f"source package {source} {source_version}",
        "licenseComments": ("Licences in its copyright file: " + ", ".join(licences)) if licences
        else "Its copyright file has no machine-readable form.",
        "purl": purl(name, version, architecture),
    }


def debian_source(name, version):
    return {
        "name": name,
        "versionInfo": version,
        "supplier": SUPPLIER,
        "sourceInfo": "compiled into the page from Debian's source package",
        "licenseComments": "Its notice is in the page's licences.",
        "purl": purl(name, version, "source"),
    }


def spdx_id(kind, name):
    return f"SPDXRef-{kind}-" + re.sub(r"[^A-Za-z0-9.]", "-", name)


def spdx_package(found, spdx):
    # SPDX has one expression for a package; a copyright file has one for each group of files.
    return {
        "SPDXID": spdx,
        "name": found["name"],
        "versionInfo": found["versionInfo"],
        "supplier": found["supplier"],
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "sourceInfo": found["sourceInfo"],
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": "NOASSERTION",
        "licenseComments": found["licenseComments"],
        "copyrightText": "NOASSERTION",
        "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                          "referenceLocator": found["purl"]}],
    }


def own_package(name, version, spdx, comment):
    return {
        "SPDXID": spdx,
        "name": name,
        "versionInfo": version,
        "supplier": "Organization: the Theatron authors",
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": "Apache-2.0",
        "licenseDeclared": "Apache-2.0",
        "copyrightText": "2026 the Theatron authors",
        "comment": comment,
    }


def bill(version, created, program, compiled_in, page_compiled_in, page_sources):
    """`compiled_in`, `page_compiled_in`: names of Debian packages. `page_sources`: (name, version) of source packages."""
    packages = [own_package("theatron", version, "SPDXRef-theatron", "The program."),
                own_package("theatron-page", version, "SPDXRef-theatron-page", "The page that the program serves to browsers.")]
    relations = [("SPDXRef-DOCUMENT", "DESCRIBES", "SPDXRef-theatron"),
                 ("SPDXRef-DOCUMENT", "DESCRIBES", "SPDXRef-theatron-page")]
    debian = installed()
    known = {}

    def add(found, kind):
        spdx = spdx_id(kind, found["name"])
        if spdx not in known:
            known[spdx] = spdx_package(found, spdx)
            packages.append(known[spdx])
        return spdx

    for name in sorted(set(compiled_in)):
        relations.append(("SPDXRef-theatron", "CONTAINS", add(debian_package(name, debian), "deb")))
    for name in sorted(set(page_compiled_in)):
        relations.append(("SPDXRef-theatron-page", "CONTAINS", add(debian_package(name, debian), "deb")))
    for name, source_version in sorted(page_sources):
        relations.append(("SPDXRef-theatron-page", "CONTAINS", add(debian_source(name, source_version), "source")))
    for name in packages_of(linked_libraries(program)):
        relations.append(("SPDXRef-theatron", "DYNAMIC_LINK", add(debian_package(name, debian), "deb")))
    for name in (name for name in LOADED if name in debian):
        relations.append((add(debian_package(name, debian), "deb"), "OPTIONAL_DEPENDENCY_OF", "SPDXRef-theatron"))
    return {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"theatron-{version}",
        "documentNamespace": f"urn:theatron:sbom:{version}:{created}",
        "creationInfo": {"created": created, "creators": ["Organization: the Theatron authors", "Tool: packaging/sbom.py"]},
        "packages": packages,
        "relationships": [{"spdxElementId": a, "relationshipType": kind, "relatedSpdxElement": b} for a, kind, b in relations],
    }


def names_in(files):
    for file in files:
        if not pathlib.Path(file).exists():
            raise Problem(f"{file} is missing; its build folder must be configured first (cmake --preset web for the page).")
    return [name for file in files for name in pathlib.Path(file).read_text().split()]


def sources_in(file):
    # Without these sources the page is built without their libraries (tools/library_sources.sh).
    if not file or not pathlib.Path(file).exists():
        return []
    return [tuple(line.split()) for line in pathlib.Path(file).read_text().splitlines() if line.strip()]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--version", required=True, help="of Theatron")
    parser.add_argument("--program", required=True, help="the program, whose linked libraries are named")
    parser.add_argument("--compiled-in", nargs="*", default=[], metavar="FILE", help="lists of packages beside the program's notices")
    parser.add_argument("--page-compiled-in", nargs="*", default=[], metavar="FILE", help="the same of the page")
    parser.add_argument("--page-sources", metavar="FILE", help="libraries/versions.txt: a source package and its version a line")
    parser.add_argument("--output", required=True)
    options = parser.parse_args()
    seconds = float(os.environ.get("SOURCE_DATE_EPOCH") or time.time())
    created = datetime.datetime.fromtimestamp(int(seconds), datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    try:
        found = bill(options.version, created, options.program, names_in(options.compiled_in),
                     names_in(options.page_compiled_in), sources_in(options.page_sources))
        pathlib.Path(options.output).write_text(json.dumps(found, indent=1) + "\n")
    except (Problem, OSError) as problem:
        print(f"sbom: {problem}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
