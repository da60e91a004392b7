# SPDX-License-Identifier: Apache-2.0
"""A stand-in for Open3D, with what examples/python/open3d_cloud.py uses of it: points are thinned to one of each raster cell and
written as numbers in text."""
import types

import numpy as np


class PointCloud:
    points = colors = np.zeros((0, 3))

    def voxel_down_sample(self, side):
        thinned = PointCloud()
        _, first = np.unique(np.floor(np.asarray(self.points) / side).astype(int), axis=0, return_index=True)
        thinned.points, thinned.colors = np.asarray(self.points)[first], np.asarray(self.colors)[first]
        return thinned


def _vector(array):
    assert array.dtype == np.float64 and array.ndim == 2 and array.shape[1] == 3
    return array


geometry = types.SimpleNamespace(PointCloud=PointCloud)
utility = types.SimpleNamespace(Vector3dVector=_vector)


def _write(file, cloud):
    try:
        np.savetxt(file, np.hstack([cloud.points, cloud.colors]))
    except OSError:
        return False  # as Open3D, which raises nothing
    return True


io = types.SimpleNamespace(write_point_cloud=_write)
