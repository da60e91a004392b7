# SPDX-License-Identifier: Apache-2.0
"""Plots the coloured points of one frame of a recording, as seen from the camera.

    plot_cloud.py RECORDING SECONDS cloud.png      (needs python3-matplotlib)
"""
import sys

import matplotlib

matplotlib.use("Agg")  # without a window
import matplotlib.pyplot as plt
import theatron

MOST_POINTS = 20_000  # more take matplotlib long


def main(recording, seconds, picture):
    opened = theatron.Recording(recording)
    frame = next(opened.frames(start=float(seconds)), None)
    if frame is None:
        raise theatron.Error(f"There is no frame from {seconds} s on; the recording has {opened.seconds:.2f} s.")
    points, colors = frame.cloud()
    if len(points) == 0:
        raise theatron.Error(f"The frame at {frame.seconds:.2f} s has no measurement.")
    step = max(1, len(points) // MOST_POINTS)
    x, y, z = points[::step].T
    axes = plt.figure(figsize=(8, 6)).add_subplot(projection="3d")
    # The camera looks along z and its y points down; the plot's z axis points up.
    axes.scatter(x, z, -y, s=1, c=colors[::step] / 255)
    axes.set(xlabel="right [m]", ylabel="forward [m]", zlabel="up [m]", title=f"{frame.name} at {frame.seconds:.2f} s")
    axes.set_box_aspect((x.ptp(), z.ptp(), y.ptp()))
    axes.view_init(elev=15, azim=-80)
    plt.savefig(picture)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (theatron.Error, OSError, ValueError) as problem:
        sys.exit(str(problem))
