# SPDX-License-Identifier: Apache-2.0
"""A stand-in for ROS's client, with what examples/python/ros_publish.py uses of it: each message becomes a line of JSON, and time passes
only in sleep()."""
import json
import sys

_now = 0.0


class ROSInterruptException(Exception):
    pass


class Duration(float):
    @staticmethod
    def from_sec(seconds):
        return Duration(seconds)


class Time(float):
    @staticmethod
    def now():
        return Time(_now)

    def __add__(self, duration):
        return Time(float(self) + duration)

    def __sub__(self, other):
        return Duration(float(self) - other)


class Publisher:
    def __init__(self, name, kind, queue_size):
        self.name, self.kind = name, kind

    def publish(self, message):
        assert type(message) is self.kind
        data = getattr(message, "data", b"")
        print(json.dumps({"topic": self.name, "stamp": message.header.stamp, "frame": message.header.frame_id,
                          "width": getattr(message, "width", 0), "step": getattr(message, "step", 0),
                          "encoding": getattr(message, "encoding", ""), "bytes": len(data), "K": getattr(message, "K", None)}))


def init_node(name):
    pass


def sleep(duration):
    global _now
    _now += max(0.0, duration)


def is_shutdown():
    return False


def myargv():
    return sys.argv
