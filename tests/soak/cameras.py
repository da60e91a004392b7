# SPDX-License-Identifier: Apache-2.0
"""Four cameras with known pictures, and when the faults of two of them are (src/capture/faulty_camera.cpp)."""
from accounting import Window
from theatron_process import make_recording

WIDTH, HEIGHT, FRAMES, FPS = 160, 120, 30, 30.0
CAMERAS = 4
FAULTY = (2, 3)
FAULTS_EVERY_S = 15
FAULTS_FROM_S = 2.0  # after the host began
# Time after a fault in which pictures may be missing: the host opens the camera again at most 5 s later, and checks it afresh.
RECOVERY_S = {"silence": 2.5, "lost_frames": 0.5, "repeat": 2.5, "time_jump": 4.0, "unplugged": 5.5, "hang": 4.0}
KINDS = ("silence", "lost_frames", "repeat", "time_jump", "unplugged", "hang")
MASK = (1 << 64) - 1


def make_cameras(folder, seed):
    """Returns the words that name the cameras for `host`."""
    source = make_recording(folder / "camera", WIDTH, HEIGHT, FRAMES)
    usual = f"folder:{source},loop=1,preload=1"
    return [f"{usual},faults={(seed + number) % 1_000_000},faults_every={FAULTS_EVERY_S}" if number in FAULTY else usual
            for number in range(CAMERAS)], source


def mixed(x):
    x = (x + 0x9e3779b97f4a7c15) & MASK
    x = ((x ^ (x >> 30)) * 0xbf58476d1ce4e5b9) & MASK
    x = ((x ^ (x >> 27)) * 0x94d049bb133111eb) & MASK
    return x ^ (x >> 31)


def fault_of_stretch(seed, stretch, every_us):
    """(kind, begin, end) of a camera's fault, in seconds of the steady clock."""
    chance = mixed((stretch * 0x10001 + seed) & MASK)
    kind = KINDS[chance % len(KINDS)]
    least, most = {"lost_frames": (30_000, 130_000), "hang": (500_000, 2_500_000)}.get(kind, (300_000, 3_000_000))
    length = min(least + mixed(chance) % (most - least), every_us // 3)
    begin = stretch * every_us + mixed((chance + 1) & MASK) % (every_us // 3)
    return kind, begin / 1e6, (begin + length) / 1e6


def camera_windows(seed, host_starts, begin, end, patience):
    """Windows of the cameras' own faults between two moments of the steady clock."""
    every_us = FAULTS_EVERY_S * 1_000_000
    windows = []
    for number in FAULTY:
        streams = frozenset((2 * number, 2 * number + 1))
        for stretch in range(int(begin * 1e6) // every_us, int(end * 1e6) // every_us + 1):
            kind, fault_begin, fault_end = fault_of_stretch((seed + number) % 1_000_000, stretch, every_us)
            # The host insists on all its cameras when it starts.
            if any(start <= fault_begin < start + FAULTS_FROM_S - 0.5 for start in host_starts):
                continue
            windows.append(Window(fault_begin - 0.1, fault_end + RECOVERY_S[kind] * patience, f"camera: {kind}", streams,
                                  camera_side=True))
    return windows
