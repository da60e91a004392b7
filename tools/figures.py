#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Repeats the figures in docs/ that do not depend on a machine's speed, and compares.

A table that can be repeated has the line `<!-- figures: NAME -->` in front, and its page names the
command that makes it. Sequences are those of --data (../shared/data); rows whose sequence is
not there are counted as skipped. Exits with 1 if a figure is another one, naming page, row,
column, what it was and what it is, and if a page has lost a table, a row or its command.

  tools/figures.py            all; some minutes
  tools/figures.py --quick    what takes a few seconds, for `make test`
"""

import argparse
import functools
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from grey_png import read_png, write_png

ROOT = pathlib.Path(__file__).resolve().parent.parent
ALL_SKIPPED = 77  # for ctest
# A figure is the page's if it differs by one in its last digit or by this share. Strata's weights come
# from sums in floating point, whose order depends on the instruction set.
SAME_SHARE = 0.002
PICTURES_A_KEY_FRAME = 45  # 1.5 s of recordings


class Missing(Exception):
    """A sequence that is not there."""


# ---- pages

class Table:
    """Rows of cells below a marker. An empty first cell is that of the row above."""

    def __init__(self, page, name):
        text = (ROOT / page).read_text()
        marker = f"<!-- figures: {name} -->"
        if marker not in text:
            raise SystemExit(f"{page}: the marker '{marker}' is gone.")
        lines = text[text.index(marker):].splitlines()[1:]
        while lines and not lines[0].startswith("|"):
            lines.pop(0)
        rows = []
        for line in lines:
            if not line.startswith("|"):
                break
            rows.append([cell.strip().replace("`", "") for cell in line.strip("|").split("|")])
        self.page, self.columns, self.rows = page, rows[0], rows[2:]
        for before, row in zip(self.rows, self.rows[1:]):
            row[0] = row[0] or before[0]

    def names_its_command(self, command):
        words = " ".join((ROOT / self.page).read_text().split())
        return f"{' '.join(command.split())}`" in words or f"{' '.join(command.split())} " in words


def numbers(cell):
    """The numbers of a cell as (value, unit of the last digit)."""
    return [(float(n), 10.0 ** -len(n.partition(".")[2])) for n in re.findall(r"[-+]?\d+(?:\.\d+)?", cell)]


# ---- the program and its input

class Program:
    def __init__(self, path, data, folder):
        self.path, self.data, self.folder = path, data, folder

    def run(self, *words):
        done = subprocess.run([self.path, *map(str, words)], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"theatron {' '.join(map(str, words))}: {done.stderr.strip().splitlines()[-1]}")
        return done.stdout

    @functools.cache
    def bench(self, kind, *words):
        file = self.folder / "figures.json"
        self.run("bench", kind, *words, "--json", file)
        return json.loads(file.read_text())

    @functools.cache
    def sequence(self, name):
        """The folder of a sequence by its name or the beginning of it."""
        if name.startswith("synthetic-room"):
            return self.synthetic_room()
        found = sorted(self.data.glob(name.replace(" ", "_") + "*"))
        if not found:
            raise Missing(name)
        return found[0]

    def synthetic_room(self):
        folder = self.folder / "synthetic-room"
        film = self.folder / "room.mkv"
        camera = "synthetic:room,color=depth,seconds=2,preload=1"
        self.run("record", "--camera", camera, "--seconds", 2, "--overwrite", film)
        self.run("export", film, "--png", folder)
        made = sorted(folder.rglob("depth"))
        if not made or len(list(made[0].glob("*.png"))) < 60:
            raise Missing("synthetic-room: the machine is too busy to record 60 frames in 2 s")
        return made[0].parent

    def codecs(self, kind, folder, codecs, *words):
        result = self.bench(kind, folder, *words, *(["--codecs", *codecs] if codecs else []))
        return {codec["name"]: codec for codec in result["codecs"]}


def kilobytes(codec):
    return codec["bytes_mean"] / 1000


# ---- the figures: each gives, row by row of its table, the values of some columns

class Figure:
    def __init__(self, page, name, command, quick=None, slow=False):
        """`quick`: a test of a row, whether it is repeated in a few seconds."""
        self.page, self.name, self.command, self.quick, self.slow = page, name, command, quick, slow

    def __call__(self, function):
        self.values = function
        FIGURES.append(self)
        return self


FIGURES = []
YARDSTICKS = {"JPEG-LS": "jpegls", "FFV1": "ffv1", "libjpeg-turbo": "libjpeg_turbo",
              "zstd level 1 on the pixels": "zstd1_raw"}


@Figure("docs/codecs.md", "depth sizes",
        "theatron bench depth FOLDER --frames 60 "
        "--codecs strata trvl rvl ans:delta=1 ans zstd:delta=1 zstd lz4",
        quick=lambda row: row[0].startswith("azure"))
def depth_sizes(program, table, row):
    codecs = [c for c in table.columns[1:] if c not in YARDSTICKS]
    measured = program.codecs("depth", program.sequence(row[0]), codecs, "--frames", 60)
    return {c: [kilobytes(measured[YARDSTICKS.get(c, c)])] for c in table.columns[1:]}


@Figure("docs/codecs.md", "colour sizes", "theatron bench color FOLDER --frames 60")
def colour_sizes(program, table, row):
    name = "azure-nfov-unbinned" if row[0].startswith("azure") else row[0]
    measured = program.codecs("color", program.sequence(name), [], "--frames", 60)
    codec = row[1].split(" (")[0]
    codec = measured[YARDSTICKS.get(codec, codec)]
    result = {"kB a frame": [kilobytes(codec)]}
    if codec["psnr_db"] is not None:
        result["PSNR"] = [codec["psnr_db"]]
    return result


@Figure("docs/decisions/depth-codecs.md", "layers",
        "theatron bench depth FOLDER --frames 60 "
        "--codecs trvl trvl:layers=2 trvl:layers=3 ans:delta=1 ans:delta=1,layers=3 zstd:delta=1 zstd:delta=1,layers=3")
def layers(program, table, row):
    codecs = layers.command.partition("--codecs ")[2].split()
    folder = program.sequence(re.search(r"\((.*)\)", row[0])[1])
    measured = program.codecs("depth", folder, codecs, "--frames", 60)
    sizes = [kilobytes(measured[c]) for c in codecs]
    return dict(zip(table.columns[1:], (sizes[:3], sizes[3:5], sizes[5:])))


@Figure("docs/decisions/depth-h264.md", "rate factors",
        "theatron bench depth FOLDER --frames 60 --codecs h264:crf=2 h264:crf=8 h264:crf=16 strata")
def rate_factors(program, table, row):
    codecs = rate_factors.command.partition("--codecs ")[2].split()
    measured = program.codecs("depth", program.sequence(row[0]), codecs, "--frames", 60)
    codec = next(m for name, m in measured.items() if name == row[1] or name == "h264" and row[1] == "h264:crf=8")
    return {"kB": [kilobytes(codec)], "RMSE mm": [codec["rmse_mm"]], "max mm": [codec["max_error_mm"]]}


@Figure("docs/decisions/optional-h264.md", "presets",
        "theatron bench color FOLDER --frames 60 "
        "--codecs jpeg:quality=85 h264:crf=20,encoder=x264 h264:crf=20,preset=superfast h264:crf=20,preset=veryfast",
        quick=lambda row: True)
def presets(program, table, row):
    codecs = presets.command.partition("--codecs ")[2].split()
    codec = program.codecs("color", program.sequence("table-person"), codecs, "--frames", 60)[row[0]]
    return {"first kB": [codec["bytes_first"] / 1000], "kB a frame": [kilobytes(codec)], "PSNR dB": [codec["psnr_db"]]}


@Figure("docs/decisions/jpeg.md", "encoder",
        "theatron bench color FOLDER --tile 640x576 --frames 30 "
        "--codecs jpeg jpeg:quality=95 jpeg:subsampling=444")
def encoder(program, table, row):
    codecs = encoder.command.partition("--codecs ")[2].split()
    measured = program.codecs("color", program.sequence(row[0].split(",")[0]), codecs,
                              "--tile", "640x576", "--frames", 30)
    ours, theirs = measured[row[1]], measured[row[1].replace("jpeg", "libjpeg_turbo", 1)]
    return {"kB, ours / turbo": [kilobytes(ours), kilobytes(theirs)],
            "PSNR dB": [ours["psnr_db"], theirs["psnr_db"]]}


@Figure("docs/decisions/cropping.md", "border",
        "theatron bench depth FOLDER --crop 50:50:540x476 --codecs rvl zstd ans strata h264:crf=8",
        quick=lambda row: row[0] != "h264:crf=8")
def border(program, table, row):
    codecs = border.command.partition("--codecs ")[2].split()
    whole = program.sequence("azure-nfov-unbinned")
    bordered = empty_border(whole, program.folder / "bordered", 50, 50, 540, 476)
    runs = (program.codecs("depth", whole, codecs), program.codecs("depth", whole, codecs, "--crop", "50:50:540x476"),
            program.codecs("depth", bordered, codecs))
    name = "h264" if row[0] == "h264:crf=8" and "h264" in runs[0] else row[0]
    sizes = [kilobytes(run[name]) for run in runs]
    return dict(zip(table.columns[1:], ([s] for s in (*sizes, sizes[2] - sizes[1]))))


@Figure("docs/decisions/cropping.md", "full resolution",
        "theatron bench color FOLDER --tile SIZE --frames 30 "
        "--codecs jpeg:quality=85 h264:crf=20 h264:crf=24 h264:crf=24,preset=veryfast",
        quick=lambda row: row[0].startswith("azure"))
def full_resolution(program, table, row):
    codecs = full_resolution.command.partition("--codecs ")[2].split()
    name, size = row[0].split(", ")
    tile = ["--tile", size] if name == "table-person" else []
    codec = program.codecs("color", program.sequence(name), codecs, *tile, "--frames", 30)[row[1]]
    return {"kB": [kilobytes(codec)], "PSNR dB": [codec["psnr_db"]]}


@Figure("docs/recording.md", "key frames", "theatron bench depth FOLDER --frames 60 --codecs strata trvl zstd:delta=1",
        quick=lambda row: row[1].startswith("h264"))
def key_frames(program, table, row):
    kind = "color" if row[1].startswith("h264") else "depth"
    codecs = [row[1]] if kind == "color" else key_frames.command.partition("--codecs ")[2].split()
    codec = program.codecs(kind, program.sequence(row[0]), codecs, "--frames", 60)[row[1]]
    first, mean = codec["bytes_first"] / 1000, kilobytes(codec)
    return {"key frame": [first], "other": [mean], "more": [100 * (first - mean) / (PICTURES_A_KEY_FRAME * mean)]}


@Figure("docs/filters.md", "truth", "theatron bench filter --quality --room", slow=True)
def truth(program, table, row):
    chains = {c["name"]: c for c in program.bench("filter", "--quality", "--room")}
    scale = {"temporal_sigma_mm": 1, "temporal_sigma_cut": 1, "rmse_mm": 1, "valid": 100, "flips": 100, "flying": 100,
             "holes_filled": 100, "holes_error_mm": 1, "ghosts": 100}
    keys = dict(zip((r[0] for r in table.rows), scale))
    if row[0] not in keys:
        return {}  # boards that move and cross: means of both directions
    key = keys[row[0]]
    return {name: [scale[key] * scene[key] for scene in chains[name]["scenes"]]
            for name, cell in zip(table.columns[1:], row[1:]) if cell}


@Figure("docs/filters.md", "saved", "theatron bench filter --quality --room", slow=True)
def saved(program, table, row):
    chains = {c["name"]: c for c in program.bench("filter", "--quality", "--room")}
    if row[0] not in chains:
        return {}  # these need a recorded background, or chains of their own
    room = next(s for s in chains[row[0]]["scenes"] if s["scene"] == "operating_room")
    return {"depth, Mbit/s": [room["depth_mbit_per_second"]]}


@Figure("docs/filters.md", "stereo", "theatron bench filter FOLDER --quality --frames 60 --filters off default stereo")
def stereo(program, table, row):
    chains = program.bench("filter", program.sequence(row[0]), "--quality", "--frames", 60,
                           "--filters", "off", "default", "stereo")
    scenes = [chain["scenes"][0] for chain in chains]
    scale = {"kb_per_frame": 1, "still_sigma_mm": 1, "still_changes": 100, "changes": 100, "flips": 100}
    return {column: [scale[key] * scene[key] for scene in scenes] for column, key in zip(table.columns[1:], scale)
            if row[table.columns.index(column)]}


@Figure("docs/filters.md", "stereo truth", "theatron bench filter --quality --stereo --filters off default stereo")
def stereo_truth(program, table, row):
    chains = {c["name"]: c for c in program.bench("filter", "--quality", "--stereo",
                                                  "--filters", "off", "default", "stereo")}
    scale = {"depth_mbit_per_second": 1, "temporal_sigma_mm": 1, "rmse_mm": 1, "flips": 100, "flying": 100, "ghosts": 100}
    keys = dict(zip((r[0] for r in table.rows), scale))
    if row[0] not in keys:
        return {}  # boards that move and cross: means of both directions
    key = keys[row[0]]
    return {name: [scale[key] * scene[key] for scene in chains[name]["scenes"]] for name in table.columns[1:]}


@Figure("docs/rendering.md", "view", "theatron bench view --cameras 4 --filter FILTER", slow=True)
def view(program, table, row):
    result = program.bench("view", "--cameras", 4, "--filter", row[0])
    drawn = {r["name"]: r for r in result["renderers"]}[row[1]]
    keys = ("psnr_db", "psnr_overlap_db", "ssim", "holes_percent", "silhouette_px", "flicker_overlap")
    return {column: [drawn[key]] for column, key in zip(table.columns[2:], keys)}


@Figure("docs/rendering.md", "patterned", "theatron bench view --cameras 4 --filter FILTER", slow=True)
def patterned(program, table, row):
    result = program.bench("view", "--cameras", 4, "--filter", "default")
    drawn = {r["name"]: r for r in result["renderers"]}[row[0]]
    keys = ("fine_db", "db", "depth_sized_db", "registered_db")
    return {column: [drawn[f"psnr_patterned_{key}"]] for column, key in zip(table.columns[1:], keys)}


@Figure("docs/table1.md", "table1 sizes", "theatron bench table1 --runs 1", slow=True)
def table1_sizes(program, table, row):
    measured = {r["name"]: r for r in program.bench("table1", "--runs", 1)["rows"]}[row[0]]
    return {"the paper's method here": [measured["same"]["median"]], "Theatron's own choice": [measured["best"]["median"]]}


# ---- pictures with an empty border

@functools.cache
def empty_border(folder, out, left, top, width, height):
    (out / "depth").mkdir(parents=True)
    for picture in sorted((folder / "depth").glob("*.png")):
        full, _, rows = read_png(picture)
        for y, row in enumerate(rows):
            inside = top <= y < top + height
            kept = row[2 * left:2 * (left + width)] if inside else bytes(2 * width)
            rows[y] = bytes(2 * left) + kept + bytes(2 * (full - left - width))
        write_png(out / "depth" / picture.name, full, rows)
    return out


# ---- comparing

def compare(figure, program, quick):
    """Prints what differs. Returns how many figures are the page's, others, and skipped rows."""
    table = Table(figure.page, figure.name)
    same = other = skipped = 0
    if not table.names_its_command(figure.command):
        print(f"{figure.page}, {figure.name}: the page does not name its command, {figure.command}")
        other += 1
    for row in table.rows:
        label = ", ".join(dict.fromkeys(row[:2] if table.columns[1] in ("codec", "setting", "renderer") else row[:1]))
        if quick and not figure.quick(row):
            continue
        try:
            values = figure.values(program, table, row)
        except Missing:
            skipped += 1
            continue
        except KeyError as gone:
            print(f"{figure.page}, {figure.name}: {label}: this build does not measure {gone}.")
            other += 1
            continue
        for column, now in values.items():
            cell = row[table.columns.index(column)]
            was = numbers(cell)
            fits = len(was) == len(now) and all(
                abs(w - n) <= max(1.0 * unit, SAME_SHARE * abs(n)) for (w, unit), n in zip(was, now))
            same += fits
            other += not fits
            if not fits:
                digits = max((len(re.sub(r"^.*?(\.|$)", "", str(w))) for w, _ in was), default=2)
                print(f"{figure.page}, {figure.name}: {label}, {column}: was {cell}, is "
                      + " / ".join(f"{n:.{max(digits, 1)}f}" for n in now))
    return same, other, skipped


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--quick", action="store_true", help="only what takes a few seconds")
    parser.add_argument("--only", help="only the table of this name; also slow ones")
    parser.add_argument("--slow", action="store_true", help="also tables that take many minutes")
    parser.add_argument("--program", default=ROOT / "build/release/apps/theatron/theatron", type=pathlib.Path)
    parser.add_argument("--data", default=os.environ.get("THEATRON_DATA", ROOT.parent / "shared/data"),
                        type=pathlib.Path)
    arguments = parser.parse_args()
    same = other = skipped = 0
    with tempfile.TemporaryDirectory() as folder:
        program = Program(arguments.program.resolve(), arguments.data.resolve(), pathlib.Path(folder))
        for figure in FIGURES:
            if arguments.only and figure.name != arguments.only or arguments.quick and not figure.quick:
                continue
            if figure.slow and not (arguments.slow or arguments.only):
                continue
            counts = compare(figure, program, arguments.quick)
            print(f"{figure.page}, {figure.name}: {counts[0]} figures are the page's, {counts[1]} are not"
                  + (f", {counts[2]} rows skipped: no such sequence in {arguments.data}" if counts[2] else ""))
            same, other, skipped = same + counts[0], other + counts[1], skipped + counts[2]
    print(f"{same} figures are those of the pages, {other} are not, {skipped} rows skipped.")
    if skipped:
        print(f"skipped: figures: {skipped} rows: no such sequence in {arguments.data}")  # for tools/skipped_tests.py
    if other:
        return 1
    return 0 if same else ALL_SKIPPED


if __name__ == "__main__":
    sys.exit(main())
