# SPDX-License-Identifier: Apache-2.0
"""Publishes a recording in ROS 1 as Debian packages it, under the names that image_transport and depth_image_proc expect.

    ros_publish.py RECORDING [CAMERA]      (needs python3-rospy, python3-sensor-msgs and a roscore)

Depth goes out as sensor_msgs/Image with 16UC1 in millimetres, colour as rgb8; JPEG pictures also as they are, for
image_transport's `compressed`.
"""
import sys

import rospy
import theatron
from sensor_msgs.msg import CameraInfo, CompressedImage, Image


def image(header, array, encoding):
    height, width = array.shape[:2]
    return Image(header=header, height=height, width=width, encoding=encoding, is_bigendian=0, step=array.strides[0],
                 data=array.tobytes())


def camera_info(header, model):
    k = model.matrix
    return CameraInfo(header=header, height=model.height, width=model.width, distortion_model="rational_polynomial",
                      D=list(model.distortion), K=list(k.ravel()), R=[1, 0, 0, 0, 1, 0, 0, 0, 1],
                      P=[k[0, 0], 0, k[0, 2], 0, 0, k[1, 1], k[1, 2], 0, 0, 0, 1, 0])


def main(recording, camera=0):
    rospy.init_node("theatron")
    topics = {name: rospy.Publisher(name, kind, queue_size=2) for name, kind in (
        ("depth/image_raw", Image), ("depth/camera_info", CameraInfo), ("rgb/image_raw", Image), ("rgb/camera_info", CameraInfo),
        ("rgb/image_raw/compressed", CompressedImage))}
    begin = rospy.Time.now()
    for frame in theatron.Recording(recording).frames(int(camera)):
        due = begin + rospy.Duration.from_sec(frame.seconds)
        rospy.sleep(due - rospy.Time.now())
        if rospy.is_shutdown():
            return
        info = camera_info(None, frame.calibration.depth)
        info.header.stamp, info.header.frame_id = due, "depth"
        if frame.calibration.depth_unit_mm != 1:
            raise theatron.Error("16UC1 is in millimetres, and this camera measures in other steps; publish depth_m() as 32FC1.")
        topics["depth/image_raw"].publish(image(info.header, frame.depth, "16UC1"))
        topics["depth/camera_info"].publish(info)
        if frame.color is None:
            continue
        info = camera_info(None, frame.calibration.color)
        info.header.stamp, info.header.frame_id = due, "rgb"
        topics["rgb/image_raw"].publish(image(info.header, frame.color, "rgb8"))
        topics["rgb/camera_info"].publish(info)
        if frame.jpeg:
            topics["rgb/image_raw/compressed"].publish(CompressedImage(header=info.header, format="jpeg", data=frame.jpeg))


if __name__ == "__main__":
    arguments = rospy.myargv()[1:]  # without those of ROS
    if len(arguments) not in (1, 2):
        sys.exit(__doc__)
    try:
        main(*arguments)
    except rospy.ROSInterruptException:  # Ctrl-C
        pass
    except (theatron.Error, ValueError) as problem:
        sys.exit(str(problem))
