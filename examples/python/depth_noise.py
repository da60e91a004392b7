# SPDX-License-Identifier: Apache-2.0
"""How much depth changes from frame to frame where nothing moves, by distance: the noise of the camera.

    depth_noise.py RECORDING [CAMERA]

Half the squared difference of two successive frames is the variance of one (Allan variance at one period), which slow
changes of the scene hardly raise; the median over pixels leaves out what moves fast.
"""
import sys

import numpy as np
import theatron

STEP_M = 0.5


def main(recording, camera=0):
    frames = theatron.Recording(recording).frames(int(camera))
    before, pairs, squares, depth = None, np.zeros(()), np.zeros(()), np.zeros(())
    for frame in frames:
        metres = frame.depth_m()
        if before is not None and before.shape == metres.shape:
            both = (before > 0) & (metres > 0)
            pairs = pairs + both
            squares = squares + np.where(both, (metres - before) ** 2 / 2, 0)
            depth = depth + np.where(both, metres, 0)
        before = metres
    if not np.any(pairs):
        raise theatron.Error("No pixel was measured in two successive frames.")
    seen = pairs >= max(1, pairs.max() // 2)  # pixels that are seldom measured lie on edges
    noise_mm = 1000 * np.sqrt(squares[seen] / pairs[seen])
    distance = depth[seen] / pairs[seen]
    for near in np.arange(0, distance.max() + STEP_M, STEP_M):
        there = (distance >= near) & (distance < near + STEP_M)
        if there.any():
            print(f"{near:.1f} to {near + STEP_M:.1f} m: {np.median(noise_mm[there]):.3f} mm, {there.sum()} pixels")
    if frames.losses:
        print(f"left out: {frames.losses}", file=sys.stderr)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (theatron.Error, ValueError) as problem:
        sys.exit(str(problem))
