# SPDX-License-Identifier: Apache-2.0
"""A stand-in for Orbbec's module of SDK v2, with what examples/python/orbbec_camera.py uses of it. Depth is in steps of 0.25 mm, and
the first wait gives nothing."""
import enum
import time
import types

import numpy as np
import scene
import theatron


class OBSensorType(enum.Enum):
    DEPTH_SENSOR = 3
    COLOR_SENSOR = 2


class OBFormat(enum.Enum):
    MJPG = 5
    Y16 = 8


class Config:
    def __init__(self):
        self.profiles = []

    def enable_stream(self, profile):
        self.profiles.append(profile)


class _Profiles:
    def get_default_video_stream_profile(self):
        return OBFormat.Y16

    def get_video_stream_profile(self, width, height, pixel, fps):
        return pixel


class _Frame:
    def __init__(self, data):
        self.data = data

    def get_width(self):
        return scene.WIDTH

    def get_height(self):
        return scene.HEIGHT

    def get_depth_scale(self):
        return 0.25  # millimetres

    def get_data(self):
        return self.data


class Pipeline:
    def __init__(self):
        self.jpeg = np.frombuffer(theatron.ColorEncoder("jpeg:quality=95").encode(scene.color()).data, np.uint8)
        self.waits = 0

    def get_stream_profile_list(self, sensor):
        return _Profiles()

    def enable_frame_sync(self):
        pass

    def start(self, config):
        assert config.profiles == [OBFormat.Y16, OBFormat.MJPG]

    def get_camera_param(self):
        lens = types.SimpleNamespace(width=scene.WIDTH, height=scene.HEIGHT, fx=60.0, fy=61.0, cx=31.5, cy=23.5)
        bent = types.SimpleNamespace(k1=0.1, k2=0.2, k3=0.3, k4=0.4, k5=0.5, k6=0.6, p1=0.001, p2=0.002)
        rot = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]], np.float32)
        return types.SimpleNamespace(depth_intrinsic=lens, rgb_intrinsic=lens, depth_distortion=bent, rgb_distortion=bent,
                                     transform=types.SimpleNamespace(rot=rot, transform=np.array([15, 0, 0], np.float32)))

    def wait_for_frames(self, milliseconds):
        self.waits += 1
        if self.waits == 1:
            return None
        time.sleep(1 / 30)
        depth = _Frame(scene.depth().view(np.uint8).ravel())
        return types.SimpleNamespace(get_depth_frame=lambda: depth, get_color_frame=lambda: _Frame(self.jpeg))

    def stop(self):
        pass
