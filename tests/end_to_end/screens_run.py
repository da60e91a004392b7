# SPDX-License-Identifier: Apache-2.0
"""A shared source of 1920x1080 at 30 fps beside two cameras: ages, pictures lost, likeness to the source.

    python3 tests/end_to_end/screens_run.py --seconds 30 --json screens.json

Phases of one session, each with one viewer without a window: the cameras alone; with the shared file; with a shared X11
display of the same size that plays it. Ages are from the capture to the decoded picture. Then a recorder's pictures of the screen are
compared with all pictures of the source (SSIM of ffmpeg, the best one). Exit code 1 if 95 in 100 pictures of the screen are
not younger than 150 ms (99 are measured), if a camera loses more pictures than alone, or if SSIM is below 0.98.
"""
import argparse
import json
import pathlib
import re
import shutil
import subprocess
import tempfile

from theatron_process import Process, host, run, tell_result
from virtual_screen import VirtualScreen

OLDEST_MS, LEAST_SSIM = 150, 0.98
SIZE = "1920x1080"


def figures_of(link, seconds):
    code, out, errors = run("join", link, "--no-window", "--json", "--warmup", "4", "--seconds", str(seconds))
    if code != 0:
        raise SystemExit(errors)
    figures = json.loads(out)
    return {c["name"]: {"fps": round(c["fps"], 2), "frames": c["frames"], "dropped": c["dropped"], "codec": c["color_codec"],
                        "mbit_per_s": round(c["mbit_per_s"], 1), "age_ms": c["age_ms"], "color_age_ms": c["color_age_ms"]}
            for c in figures["cameras"]}


def is_sent(figures):
    """A publisher's line: the host has given its camera a number."""
    return figures["cameras"][0]["id"] is not None


def likeness(h, video, folder, camera):
    """SSIM of recorded pictures of the screen to the source's most similar one."""
    code, _, errors = run("record", h.greeting["link"], folder / "screen.mkv", "--seconds", "4")
    if code not in (0, 3):  # 3: some pictures are missing, which the phases count
        raise SystemExit(errors)
    code, _, errors = run("export", folder / "screen.mkv", "--png", folder / "png", "--camera", str(camera))
    if code != 0:
        raise SystemExit(errors)
    pictures = sorted((folder / "png").rglob("color/*.jpg"))
    best = []
    for picture in pictures[10::25][:4]:
        # At the source's rate: at the usual one of 25 a second, one in six of its pictures is compared with none.
        done = subprocess.run(["ffmpeg", "-v", "error", "-framerate", "30", "-loop", "1", "-i", picture, "-i", video, "-lavfi",
                               "[0]scale=out_range=tv:out_color_matrix=bt709,format=yuv420p[a];[a][1]ssim=stats_file=-:shortest=1", "-f", "null", "-"],
                              capture_output=True, text=True)
        best.append(max((float(x) for x in re.findall(r"All:([\d.]+)", done.stdout)), default=0))
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=int, default=30)
    parser.add_argument("--camera", default="synthetic:seconds=2,preload=1,quality=quick,camera=%d", help="two cameras, numbered from 0")
    parser.add_argument("--source", default="testsrc2", help="of ffmpeg: the pictures that are shared")
    parser.add_argument("--json")
    options = parser.parse_args()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="theatron_screens_run_"))
    result, problems = {"seconds": options.seconds, "source": options.source}, []
    video = folder / "source.mp4"
    subprocess.run(["ffmpeg", "-v", "error", "-f", "lavfi", "-i", f"{options.source}=s={SIZE}:r=30", "-t", "4", "-c:v", "libx264",
                    "-preset", "ultrafast", "-crf", "12", "-pix_fmt", "yuv420p", "-colorspace", "bt709", video], check=True)
    try:
        with host(folder / "state", *(options.camera % n for n in (0, 1))) as h:
            link, publish = h.greeting["link"], h.greeting["publish_link"]
            alone = result["alone"] = figures_of(link, options.seconds)

            def measure(phase, name, figures):
                result[phase] = figures
                if figures[name]["color_age_ms"]["p99"] >= OLDEST_MS:
                    problems.append(f"{phase}: age {figures[name]['color_age_ms']['p99']:.0f} ms")
                for camera in alone:
                    if figures[camera]["dropped"] > alone[camera]["dropped"]:
                        problems.append(f"{phase}: {camera} lost {figures[camera]['dropped']}, alone {alone[camera]['dropped']}")

            with Process("publish", publish, "--share", f"{video},loop=1", "--may-record", "--every", "1") as cart:
                cart.wait_for(is_sent)
                measure("file", "source", figures_of(link, options.seconds))
                result["ssim"] = likeness(h, video, folder, 2)
                if not result["ssim"] or min(result["ssim"]) < LEAST_SSIM:
                    problems.append(f"SSIM {result['ssim']}")
            with VirtualScreen(*map(int, SIZE.split("x"))) as screen:
                player = subprocess.Popen(["ffmpeg", "-v", "error", "-re", "-stream_loop", "-1", "-i", video, "-pix_fmt", "rgb24", "-window_fullscreen",
                                           "1", "-f", "sdl", "player"], env=screen.environment, stdin=subprocess.DEVNULL)
                try:
                    with Process("publish", publish, "--share", "x11:display", "--every", "1", env=screen.environment) as cart:
                        cart.wait_for(is_sent)
                        measure("display", "display", figures_of(link, options.seconds))
                finally:
                    player.kill()
                    player.wait()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return tell_result(result, problems, options.json)


if __name__ == "__main__":
    raise SystemExit(main())
