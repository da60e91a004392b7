# SPDX-License-Identifier: Apache-2.0
"""Sends an Intel RealSense camera into a session, until Ctrl-C or its end.

    realsense_camera.py LINK [NAME]      (the host's link for those who may send; needs pyrealsense2)
"""
import sys

import numpy as np
import pyrealsense2 as rs
import theatron

WIDTH, HEIGHT, FPS = 640, 480, 30
MILLISECONDS = 1000  # that a picture may take before the camera counts as gone


def model_of(profile):
    i = profile.as_video_stream_profile().get_intrinsics()
    # Coefficients of the inverse model cannot be used as OpenCV's; on most cameras they are 0.
    usable = i.model in (rs.distortion.brown_conrady, rs.distortion.modified_brown_conrady)
    return theatron.CameraModel(i.width, i.height, i.fx, i.fy, i.ppx, i.ppy, i.coeffs if usable else [])


def pose_of(profile, other):
    e = profile.get_extrinsics_to(other)
    pose = np.eye(4)
    pose[:3, :3] = np.reshape(e.rotation, (3, 3)).T  # column by column
    pose[:3, 3] = e.translation  # metres
    return pose


def main(link, name="RealSense"):
    pipeline, config = rs.pipeline(), rs.config()
    config.enable_stream(rs.stream.depth, WIDTH, HEIGHT, rs.format.z16, FPS)
    config.enable_stream(rs.stream.color, WIDTH, HEIGHT, rs.format.rgb8, FPS)
    started = pipeline.start(config)
    try:
        depth, color = started.get_stream(rs.stream.depth), started.get_stream(rs.stream.color)
        unit_mm = 1000 * started.get_device().first_depth_sensor().get_depth_scale()
        calibration = theatron.Calibration(model_of(depth), model_of(color), pose_of(depth, color), depth_unit_mm=unit_mm)
        with theatron.send_camera(link, calibration, camera=name, fps=FPS) as camera:
            while True:
                frames = pipeline.wait_for_frames(MILLISECONDS)
                camera.send(np.asanyarray(frames.get_depth_frame().get_data()),
                            np.asanyarray(frames.get_color_frame().get_data()))
    finally:
        pipeline.stop()


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except KeyboardInterrupt:
        pass
    except (theatron.Error, RuntimeError) as problem:
        sys.exit(str(problem))
