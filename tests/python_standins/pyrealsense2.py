# SPDX-License-Identifier: Apache-2.0
"""A stand-in for Intel's module, with what examples/python/realsense_camera.py uses of it. Depth is in steps of 0.25 mm."""
import enum
import types

import scene


class stream(enum.Enum):
    depth = 1
    color = 2


class format(enum.Enum):
    z16 = 1
    rgb8 = 5


class distortion(enum.Enum):
    none = 0
    modified_brown_conrady = 1
    inverse_brown_conrady = 2
    brown_conrady = 4


class config:
    def __init__(self):
        self.wanted = {}

    def enable_stream(self, kind, width, height, pixel, fps):
        self.wanted[kind] = (width, height, pixel, fps)


class _Profile:
    def __init__(self, kind):
        self.kind = kind

    def as_video_stream_profile(self):
        return self

    def get_intrinsics(self):
        model = distortion.brown_conrady if self.kind is stream.depth else distortion.inverse_brown_conrady
        return types.SimpleNamespace(width=scene.WIDTH, height=scene.HEIGHT, fx=60.0, fy=61.0, ppx=31.5, ppy=23.5, model=model,
                                     coeffs=[0.1, 0.2, 0.0, 0.0, 0.0])

    def get_extrinsics_to(self, other):
        assert (self.kind, other.kind) == (stream.depth, stream.color)
        # A quarter turn about z, column by column.
        return types.SimpleNamespace(rotation=[0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0], translation=[0.015, 0.0, 0.0])


class _Frame:
    def __init__(self, picture):
        self.picture = picture

    def get_data(self):
        return self.picture


class pipeline:
    def start(self, settings):
        assert settings.wanted[stream.depth][2] is format.z16 and settings.wanted[stream.color][2] is format.rgb8
        sensor = types.SimpleNamespace(get_depth_scale=lambda: 0.00025)
        device = types.SimpleNamespace(first_depth_sensor=lambda: sensor)
        return types.SimpleNamespace(get_stream=_Profile, get_device=lambda: device)

    def wait_for_frames(self, milliseconds):
        import time
        time.sleep(1 / 30)
        return types.SimpleNamespace(get_depth_frame=lambda: _Frame(scene.depth()), get_color_frame=lambda: _Frame(scene.color()))

    def stop(self):
        pass
