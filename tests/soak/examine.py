# SPDX-License-Identifier: Apache-2.0
"""Reads one recording to its end:  examine.py FIRST_FILE KNOWN_HASHES.json CHECK_CONTENT ANSWER.json

A recording is one file, or a chain of them: 000.mkv, 000.002.mkv and so on. The answer has the pictures of every stream,
whether they can be decoded, and what is wrong with the recording.
"""
import hashlib
import json
import pathlib
import shutil
import subprocess
import sys

from recordings import decodable, read_pictures
from theatron_process import PROGRAM

KNOWN_ATTEMPTS = 20


def program(*words):
    done = subprocess.run([PROGRAM, *map(str, words)], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def hashes_of(folder):
    """Hashes of the exported pictures of depth, by camera's folder, in order."""
    answer = {}
    for depth in sorted(folder.rglob("depth")):
        answer[depth.parent.name] = [hashlib.sha256(path.read_bytes()).hexdigest()
                                     for path in sorted(depth.glob("*.png"))]
    return answer


def known_hashes(source, folder):
    """Hashes of all pictures of `source` after they were recorded and exported."""
    pictures = len(list((source / "depth").glob("*.png")))
    known, file, exported = set(), folder / "known.mkv", folder / "known"
    for _ in range(KNOWN_ATTEMPTS):
        # A busy machine's cameras pass over some; the next round has them.
        code, _, errors = program("record", "--camera", f"folder:{source},loop=1,preload=1", "--raw", "--seconds", 2,
                                  "--overwrite", file)
        assert code == 0, errors
        code, _, errors = program("export", file, "--png", exported)
        assert code == 0, errors
        known.update(value for values in hashes_of(exported).values() for value in values)
        shutil.rmtree(exported)
        if len(known) == pictures:
            return sorted(known)
    raise RuntimeError(f"only {len(known)} of {pictures} pictures could be recorded on this machine")


def check_content(path, expected, known):
    """Exports every picture of depth: as many as can be decoded, each bit by bit one of the cameras' own."""
    folder = path.with_suffix(".pictures")
    code, _, errors = program("export", path, "--png", folder)
    exported = hashes_of(folder) if folder.exists() else {}
    shutil.rmtree(folder, ignore_errors=True)
    problems = []
    count = sum(map(len, exported.values()))
    if code != 0 and count < expected:
        problems.append(f"export ends with {code} after {count} of {expected} pictures: {errors.strip()[-300:]}")
    elif count < expected:
        problems.append(f"export writes {count} of {expected} pictures of depth that can be decoded")
    strange = sum(value not in known for values in exported.values() for value in values)
    if strange:
        problems.append(f"{strange} exported pictures are none that a camera gave")
    return problems


def verify(path, pictures, decodable_pictures):
    """Has the program decode everything; it must find as many pictures of depth as are there, and none damaged."""
    code, out, errors = program("inspect", path, "--verify", "--json")
    try:
        told = json.loads(out)
        minutes = [minute["depth"] for camera in told["cameras"] for minute in camera["minutes"]]
    except (ValueError, KeyError):
        return [f"inspect --verify ends with {code}: {errors.strip()[-300:]}"]
    problems = []
    found = sum(minute["pictures"] for minute in minutes)
    damaged = sum(minute["damaged"] for minute in minutes)
    decoded = found - damaged - sum(minute["undecodable"] for minute in minutes)
    if found != pictures:
        problems.append(f"inspect --verify finds {found} pictures of depth where {pictures} are")
    if decoded != decodable_pictures:
        problems.append(f"inspect --verify decodes {decoded} of {decodable_pictures} pictures of depth that can be decoded")
    if damaged or code not in (0, 3):
        problems.append(f"inspect --verify ends with {code} and finds {damaged} pictures damaged")
    return problems


def files_of(first):
    """All files of the recording that begins in `first`."""
    return [first, *sorted(first.parent.glob(f"{first.stem}.*{first.suffix}"))]


def examine(path, known, with_content):
    pictures = [picture for file in files_of(path) for picture in read_pictures(file)]
    good = decodable(pictures)
    entries = {}
    for picture, is_good in zip(pictures, good):
        entries.setdefault(picture.stream, []).append((picture.captured_us / 1e6, picture.frame, is_good))
    answer = {"entries": entries, "bytes": sum(f.stat().st_size for f in files_of(path)), "problems": []}
    if not pictures:
        return answer
    depth = [is_good for picture, is_good in zip(pictures, good) if picture.stream % 2 == 0]
    answer["problems"] += verify(path, len(depth), sum(depth))
    if with_content:
        answer["problems"] += check_content(path, sum(depth), set(known))
    return answer


def main(file, hashes, with_content, answer):
    known = json.loads(pathlib.Path(hashes).read_text())
    found = examine(pathlib.Path(file), known, with_content == "yes")
    pathlib.Path(answer).write_text(json.dumps(found))


if __name__ == "__main__":
    main(*sys.argv[1:])
