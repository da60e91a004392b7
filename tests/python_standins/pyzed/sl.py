# SPDX-License-Identifier: Apache-2.0
"""A stand-in for Stereolabs' module, with what examples/python/zed_camera.py uses of it."""
import enum
import time
import types

import numpy as np
import scene

RESOLUTION = enum.Enum("RESOLUTION", "HD720 HD1080")
DEPTH_MODE = enum.Enum("DEPTH_MODE", "NONE NEURAL")
ERROR_CODE = enum.Enum("ERROR_CODE", "SUCCESS FAILURE")
MEASURE = enum.Enum("MEASURE", "DEPTH DEPTH_U16_MM")
VIEW = enum.Enum("VIEW", "LEFT RIGHT")


class InitParameters:
    pass


class Mat:
    def get_data(self):
        return self.picture


class Camera:
    def open(self, parameters):
        assert parameters.depth_mode is DEPTH_MODE.NEURAL
        return ERROR_CODE.SUCCESS

    def get_camera_information(self):
        lens = types.SimpleNamespace(fx=60.0, fy=61.0, cx=31.5, cy=23.5)
        return types.SimpleNamespace(camera_configuration=types.SimpleNamespace(
            resolution=types.SimpleNamespace(width=scene.WIDTH, height=scene.HEIGHT),
            calibration_parameters=types.SimpleNamespace(left_cam=lens)))

    def grab(self):
        time.sleep(1 / 30)
        return ERROR_CODE.SUCCESS

    def retrieve_measure(self, mat, measure):
        assert measure is MEASURE.DEPTH_U16_MM
        mat.picture = scene.depth()

    def retrieve_image(self, mat, view):
        alpha = np.full((scene.HEIGHT, scene.WIDTH, 1), 255, np.uint8)
        mat.picture = np.concatenate([scene.color()[:, :, ::-1], alpha], axis=2)

    def close(self):
        pass
