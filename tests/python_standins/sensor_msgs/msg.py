# SPDX-License-Identifier: Apache-2.0
"""A stand-in for ROS's messages: their fields."""
import types


class _Message:
    fields = ()

    def __init__(self, **values):
        assert set(values) <= set(self.fields), values.keys()
        for field in self.fields:
            setattr(self, field, values.get(field))
        self.header = self.header or types.SimpleNamespace(stamp=None, frame_id="")


class Image(_Message):
    fields = ("header", "height", "width", "encoding", "is_bigendian", "step", "data")


class CompressedImage(_Message):
    fields = ("header", "format", "data")


class CameraInfo(_Message):
    fields = ("header", "height", "width", "distortion_model", "D", "K", "R", "P", "binning_x", "binning_y", "roi")
