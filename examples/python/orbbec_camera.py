# SPDX-License-Identifier: Apache-2.0
"""Sends an Orbbec camera (SDK v2) into a session, until Ctrl-C or its end.

    orbbec_camera.py LINK [NAME]      (the host's link for those who may send; needs pyorbbecsdk)
"""
import sys

import numpy as np
import theatron
from pyorbbecsdk import Config, OBFormat, OBSensorType, Pipeline

FPS = 30
MILLISECONDS = 100  # of one wait


def model_of(lens, d):
    return theatron.CameraModel(lens.width, lens.height, lens.fx, lens.fy, lens.cx, lens.cy,
                                [d.k1, d.k2, d.p1, d.p2, d.k3, d.k4, d.k5, d.k6])


def calibration_of(parameters, unit_mm):
    pose = np.eye(4)
    pose[:3, :3] = np.reshape(parameters.transform.rot, (3, 3))
    pose[:3, 3] = np.ravel(parameters.transform.transform) / 1000  # the SDK has millimetres
    return theatron.Calibration(model_of(parameters.depth_intrinsic, parameters.depth_distortion),
                                model_of(parameters.rgb_intrinsic, parameters.rgb_distortion), pose, depth_unit_mm=unit_mm)


def depth_of(frame):
    return np.frombuffer(frame.get_data(), np.uint16).reshape(frame.get_height(), frame.get_width())


def main(link, name="Orbbec"):
    pipeline, config = Pipeline(), Config()
    config.enable_stream(pipeline.get_stream_profile_list(OBSensorType.DEPTH_SENSOR).get_default_video_stream_profile())
    # The camera's own JPEG pictures go out as they are; width and height as it has them.
    config.enable_stream(pipeline.get_stream_profile_list(OBSensorType.COLOR_SENSOR).get_video_stream_profile(0, 0, OBFormat.MJPG, FPS))
    pipeline.enable_frame_sync()
    pipeline.start(config)
    camera = None
    try:
        while True:
            frames = pipeline.wait_for_frames(MILLISECONDS)
            depth = frames.get_depth_frame() if frames else None
            color = frames.get_color_frame() if frames else None
            if depth is None:
                continue
            if camera is None:
                calibration = calibration_of(pipeline.get_camera_param(), depth.get_depth_scale())
                camera = theatron.send_camera(link, calibration, camera=name, fps=FPS)
            camera.send(depth_of(depth), jpeg=bytes(color.get_data()) if color is not None else None)
    finally:
        if camera is not None:
            camera.close()
        pipeline.stop()


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except KeyboardInterrupt:
        pass
    except theatron.Error as problem:
        sys.exit(str(problem))
