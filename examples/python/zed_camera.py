# SPDX-License-Identifier: Apache-2.0
"""Sends a Stereolabs ZED camera into a session, until Ctrl-C or its end.

    zed_camera.py LINK [NAME]      (the host's link for those who may send; needs pyzed, the ZED SDK)
"""
import sys

import numpy as np
import pyzed.sl as sl
import theatron

FPS = 30


def main(link, name="ZED"):
    zed = sl.Camera()
    wanted = sl.InitParameters()
    wanted.camera_resolution = sl.RESOLUTION.HD720
    wanted.camera_fps = FPS
    wanted.depth_mode = sl.DEPTH_MODE.NEURAL
    opened = zed.open(wanted)
    if opened != sl.ERROR_CODE.SUCCESS:
        raise theatron.Error(f"The ZED camera cannot be opened: {opened}.")
    try:
        configuration = zed.get_camera_information().camera_configuration
        # Depth and colour are rectified pictures of the left camera: one lens without distortion.
        lens, size = configuration.calibration_parameters.left_cam, configuration.resolution
        model = theatron.CameraModel(size.width, size.height, lens.fx, lens.fy, lens.cx, lens.cy)
        depth, color = sl.Mat(), sl.Mat()
        with theatron.send_camera(link, theatron.Calibration(model, model), camera=name, fps=FPS) as camera:
            while True:
                if zed.grab() != sl.ERROR_CODE.SUCCESS:
                    raise theatron.Error("The ZED camera gives no more pictures.")
                zed.retrieve_measure(depth, sl.MEASURE.DEPTH_U16_MM)  # millimetres, 0: no measurement
                zed.retrieve_image(color, sl.VIEW.LEFT)  # blue, green, red, alpha
                camera.send(depth.get_data(), np.ascontiguousarray(color.get_data()[:, :, 2::-1]))
    finally:
        zed.close()


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except KeyboardInterrupt:
        pass
    except theatron.Error as problem:
        sys.exit(str(problem))
