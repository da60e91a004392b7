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
    frame = next(theatron.Recording(recording).frames(start=float(seconds)))
    points, colors = frame.cloud()
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
    try:
        main(*sys.argv[1:])
    except theatron.Error as problem:
        sys.exit(str(problem))
