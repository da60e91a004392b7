# SPDX-License-Identifier: Apache-2.0
"""Writes one moment of a recording as a cloud of Open3D, all cameras together in the room, thinned to a raster of 5 mm.

    open3d_cloud.py RECORDING SECONDS cloud.ply      (needs python3-open3d)
"""
import sys

import numpy as np
import open3d
import theatron

RASTER_M = 0.005


def main(recording, seconds, file):
    opened = theatron.Recording(recording)
    first = [next(opened.frames(camera.number, start=float(seconds)), None) for camera in opened.cameras]
    clouds = [frame.cloud(in_room=True) for frame in first if frame]
    if not any(len(points) for points, _ in clouds):
        raise theatron.Error(f"No camera has a measurement from {seconds} s on; the recording has {opened.seconds:.2f} s.")
    cloud = open3d.geometry.PointCloud()
    cloud.points = open3d.utility.Vector3dVector(np.concatenate([points for points, _ in clouds]).astype(np.float64))
    cloud.colors = open3d.utility.Vector3dVector(np.concatenate([colors for _, colors in clouds]) / 255.0)
    thinned = cloud.voxel_down_sample(RASTER_M)
    if not open3d.io.write_point_cloud(file, thinned):
        raise theatron.Error(f"{file} cannot be written.")
    print(f"{len(cloud.points)} points, {len(thinned.points)} written")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (theatron.Error, OSError, ValueError) as problem:
        sys.exit(str(problem))
