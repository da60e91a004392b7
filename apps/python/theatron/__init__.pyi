# SPDX-License-Identifier: Apache-2.0
"""Theatron's recordings, folders, cameras and codecs as numpy arrays.

Functions release Python's lock while they read, decode, encode or wait, so that other threads run. All objects may be
used from several threads. What is wrong outside the program (a file, a camera, a codec, encoded bytes) raises Error, whose text is
the sentence that the program `theatron` prints; a wrong argument raises ValueError or TypeError.
"""
import datetime
import os
from typing import Any, Dict, Iterator, List, Optional, Sequence, Tuple, TypedDict, Union

import numpy as np
from numpy.typing import NDArray

__version__: str

class Error(RuntimeError):
    """Something outside the program is wrong; one sentence says what."""

class CameraModel:
    """A pinhole camera with OpenCV's rational distortion. Pixel coordinates: the centre of the top left pixel is (0, 0)."""

    def __init__(self, width: int, height: int, fx: float, fy: float, cx: float, cy: float,
                 distortion: Sequence[float] = ..., max_radius: float = 0.0) -> None:
        """`distortion`: up to 8 coefficients in OpenCV's order k1, k2, p1, p2, k3, k4, k5, k6. `max_radius`: directions further from
        the axis (x/z, y/z) are not imaged; 0: no limit."""
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def fx(self) -> float:
        """Focal lengths and principal point in pixels."""
    @property
    def fy(self) -> float: ...
    @property
    def cx(self) -> float: ...
    @property
    def cy(self) -> float: ...
    @property
    def max_radius(self) -> float: ...
    @property
    def distortion(self) -> NDArray[np.float64]:
        """Shape (8,): k1, k2, p1, p2, k3, k4, k5, k6."""
    @property
    def matrix(self) -> NDArray[np.float64]:
        """Shape (3, 3): OpenCV's camera matrix, in pixels."""
    def rays(self) -> NDArray[np.float32]:
        """Shape (height, width, 2): the direction (x/z, y/z) of each pixel without distortion; NaN outside of the lens. A pixel
        with the depth z metres is the point (x/z * z, y/z * z, z). Takes some tens of milliseconds."""

class Calibration:
    """The lenses of a camera, the place of its colour camera, and its place in the room. Camera frames: x right, y down, z
    forward; room: y up, 0 on the floor, right-handed; metres."""

    def __init__(self, depth: CameraModel, color: Optional[CameraModel] = None, color_from_depth: Optional[NDArray[Any]] = None,
                 depth_unit_mm: float = 1.0, room_from_camera: Optional[NDArray[Any]] = None,
                 depth_offset_mm: Optional[float] = None) -> None:
        """Raises ValueError for a calibration that no camera can have, and for a matrix that is no rotation and translation.
        Without `room_from_camera` the camera's place is unknown."""
    @property
    def depth(self) -> Optional[CameraModel]: ...
    @property
    def color(self) -> Optional[CameraModel]: ...
    @property
    def color_from_depth(self) -> NDArray[np.float64]:
        """Shape (4, 4): from the depth camera's frame to the colour camera's."""
    @property
    def room_from_camera(self) -> NDArray[np.float64]:
        """Shape (4, 4): from the depth camera's frame to the room. A default unless `registered`."""
    @property
    def depth_unit_mm(self) -> float:
        """Millimetres per unit of a depth pixel."""
    @property
    def depth_offset_mm(self) -> Optional[float]:
        """Millimetres by which depth is too large, if that was measured."""
    @property
    def registered(self) -> bool:
        """The camera's place in the room is known."""
    @property
    def person(self) -> int:
        """The participant whom the camera sees, in whose frame its place is; 0: none."""
    @property
    def color_gain(self) -> Optional[Tuple[float, float, float]]:
        """Factors of red, green and blue sRGB values, if they were measured."""
    def to_json(self) -> str:
        """The text of a calibration.json beside a folder of pictures."""

class Frame:
    """The pictures of one camera at one moment. Arrays stay valid as long as somebody has them. Those of a recording or a
    folder may be written to; those of a camera are read-only."""

    @property
    def depth(self) -> NDArray[np.uint16]:
        """Shape (height, width), in calibration.depth_unit_mm; 0: no measurement. Not a copy."""
    def depth_m(self) -> NDArray[np.float32]:
        """Shape (height, width): metres along the camera's axis, without the camera's offset; 0: no measurement."""
    @property
    def color(self) -> Optional[NDArray[np.uint8]]:
        """Shape (height, width, 3): red, green, blue in sRGB. None: no colour at this moment, or a damaged picture. A JPEG picture is
        decoded at the first use."""
    @property
    def jpeg(self) -> Optional[bytes]:
        """The colour picture as the camera gave it, if that is JPEG."""
    def points(self, in_room: bool = False) -> NDArray[np.float32]:
        """Shape (n, 3), metres: a point for each measured pixel, row by row, in the depth camera's frame or in the room."""
    def cloud(self, in_room: bool = False) -> Tuple[NDArray[np.float32], NDArray[np.uint8]]:
        """points(), and the colour of each: shape (n, 3); 128, 128, 128 where the colour camera does not see it."""
    @property
    def camera(self) -> int:
        """The number of the camera, from 0."""
    @property
    def name(self) -> str:
        """The name of the camera."""
    @property
    def calibration(self) -> Calibration:
        """At this frame: cameras may be moved or adjusted while they are recorded."""
    @property
    def number(self) -> int:
        """As the camera counted; a gap is a frame that is missing. Begins anew where a recording has another segment."""
    @property
    def seconds(self) -> float:
        """When it was captured, since the recording's first frame; of a camera, since its own first frame."""
    @property
    def moment(self) -> int:
        """Microseconds of the session's clock; equal for the frames of several cameras that belong together."""
    @property
    def utc(self) -> Optional[datetime.datetime]:
        """The time of day when it was captured, in UTC; None: not known."""

class Losses:
    """Counts of pictures that were left out. `if losses` is true where there are any."""

    @property
    def damaged_depth(self) -> int: ...
    @property
    def undecodable_depth(self) -> int:
        """Whole, but the picture that they refer to is damaged or missing."""
    @property
    def damaged_color(self) -> int:
        """JPEG pictures count when their pixels are asked for, or when their bytes have another checksum."""
    @property
    def undecodable_color(self) -> int: ...
    def __bool__(self) -> bool: ...

class Frames:
    """An iterator of frames, in order. Memory of frames that nobody has any more is used again."""

    def __iter__(self) -> Frames: ...
    def __next__(self) -> Frame:
        """Damaged frames are left out and counted. Raises Error where a camera fails."""
    def seek(self, seconds: float) -> None:
        """The next frame is the first one that is not before this time. Counts of losses begin anew. Raises Error for cameras."""
    @property
    def losses(self) -> Losses:
        """Pictures that were left out so far."""
    @property
    def problem_at_end(self) -> str:
        """What is missing at the end, one sentence; empty: nothing."""
    def close(self) -> None:
        """Closes the file or the camera; no frame follows. `with` does the same."""
    def __enter__(self) -> Frames: ...
    def __exit__(self, *exception: object) -> None: ...

class RecordedCamera:
    """A camera of a recording."""

    @property
    def number(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def fps(self) -> float:
        """Frames per second, as the camera promised."""
    @property
    def frames(self) -> int:
        """Depth images that are in the recording, damaged ones included."""
    @property
    def depth_codec(self) -> str: ...
    @property
    def color_codec(self) -> Optional[str]: ...
    @property
    def calibration(self) -> Calibration:
        """At the beginning; Frame.calibration is that of each frame."""

class VerifiedPictures(TypedDict):
    pictures: int  # that were decoded
    damaged: int
    undecodable: int
    missing: int
    gaps: int

class VerifiedMinute(TypedDict):
    minute: int
    depth: VerifiedPictures
    color: VerifiedPictures

class Verification(TypedDict):
    damaged: bool
    cameras: List[List[VerifiedMinute]]

class RoomChanges:
    def __iter__(self) -> Iterator[Dict[str, Any]]: ...
    def __next__(self) -> Dict[str, Any]: ...

class Recording:
    """A recording with all its segments. Only an index is kept in memory, 28 bytes for each picture."""

    def __init__(self, file: Union[str, os.PathLike[str]]) -> None:
        """`file`: the first of its files; the others are found. Raises Error if it is no recording."""
    @property
    def file(self) -> str: ...
    @property
    def cameras(self) -> List[RecordedCamera]: ...
    @property
    def seconds(self) -> float:
        """From the first picture to the end of the last segment."""
    @property
    def begin(self) -> Optional[datetime.datetime]:
        """The time of day of the first frame, in UTC; None: not known."""
    @property
    def complete(self) -> bool:
        """False if a segment is missing, was never closed, was cut off, ended early or is damaged where its elements show it, or if its
        recorder noted that something is missing; `remarks` has the reasons. Only `verify()` finds damage inside pictures: `frames()`
        leaves those out and counts them in `losses`."""
    @property
    def remarks(self) -> List[str]:
        """What `theatron inspect` says of damage and missing parts, a sentence each; empty: nothing."""
    def frames(self, camera: int = 0, *, start: float = 0.0, stop: Optional[float] = None) -> Frames:
        """The frames of a camera, from `start` to before `stop` (seconds). Raises Error if there is no such camera, or if this
        build cannot decode it."""
    def room(self, seconds: float) -> Optional[Dict[str, Any]]:
        """People, objects and poses at this time (docs/formats/room.md); None if the room was not recorded."""
    def room_changes(self) -> RoomChanges:
        """The room at each moment at which it changed, as `theatron export --room` writes it."""
    def verify(self) -> Verification:
        """Decodes every picture, as `theatron inspect --verify` does, and counts minute by minute."""

def open_folder(folder: Union[str, os.PathLike[str]], *, fps: float = 30.0, invalid: int = 0, start: float = 0.0,
                stop: Optional[float] = None) -> Frames:
    """The frames of a folder of pictures (docs/formats/camera_folder.md), as fast as they can be read. `invalid`: a depth value that
    means no reading; 0: none. Raises Error."""

def open_camera(specification: str, *, every: bool = False) -> Frames:
    """The frames of a camera when they are due, such as 'synthetic:surgeon' or 'k4a:0'. Late frames are skipped; with `every`
    recorded and generated cameras wait instead. Cameras that only the program `theatron` opens raise Error: mkv, video, x11, v4l2 and rtsp."""

def camera_kinds() -> List[str]:
    """The kinds of camera with their options, one line each."""

class EncodedDepth:
    """An encoded depth image and its place in its stream."""

    def __init__(self, data: bytes, frame: int = 0, reference: Optional[int] = None, layer: int = 0, key: bool = True) -> None: ...
    @property
    def data(self) -> bytes: ...
    @property
    def frame(self) -> int: ...
    @property
    def reference(self) -> int:
        """The frame that it refers to; of a key frame, its own number."""
    @property
    def layer(self) -> int: ...
    @property
    def key(self) -> bool:
        """Decodable by itself."""

class DepthEncoder:
    """Encodes the depth images of one stream."""

    def __init__(self, codec: str = "strata") -> None:
        """`codec`: a name with options, as in 'zstd:delta=1' (docs/codecs.md). Raises Error if there is none such."""
    @property
    def codec(self) -> str: ...
    def encode(self, depth: NDArray[np.uint16], key: bool = False) -> EncodedDepth:
        """`depth`: shape (height, width), up to 8192 each. The first image, one of another size, and one with `key` are key
        frames; others may refer to earlier ones."""

class DepthDecoder:
    """Decodes the depth images of one stream, in order, with gaps. Safe for any bytes."""

    def __init__(self, codec: str = "strata") -> None: ...
    @property
    def codec(self) -> str: ...
    def decode(self, encoded: EncodedDepth) -> NDArray[np.uint16]:
        """Shape (height, width), up to 2048 x 2048 pixels. Raises Error if the bytes are damaged or the frame referred to was not decoded."""

def encode_depth(depth: NDArray[np.uint16], codec: str = "strata") -> bytes:
    """Encodes one depth image by itself."""

def decode_depth(data: bytes, codec: str = "strata") -> NDArray[np.uint16]:
    """Decodes what encode_depth() returned with the same codec."""

def depth_codecs() -> List[str]: ...

class EncodedColor:
    @property
    def data(self) -> bytes: ...
    @property
    def key(self) -> bool:
        """Decodable by itself; else it refers to the picture before it."""

class ColorEncoder:
    """Encodes the colour pictures of one stream."""

    def __init__(self, codec: str = "jpeg:quality=85") -> None: ...
    @property
    def codec(self) -> str: ...
    def encode(self, color: NDArray[np.uint8], key: bool = False) -> EncodedColor:
        """`color`: shape (height, width, 3), sRGB."""

class ColorDecoder:
    """Decodes the colour pictures of one stream, in order. Safe for any bytes."""

    def __init__(self, codec: str = "jpeg:quality=85") -> None: ...
    @property
    def codec(self) -> str: ...
    def decode(self, data: bytes) -> NDArray[np.uint8]:
        """Shape (height, width, 3), sRGB, up to 4096 x 3072 pixels. Raises Error if the bytes are damaged."""

def color_codecs() -> List[str]: ...

class SessionCamera:
    """A camera of a session. Its number is the session's."""

    @property
    def number(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def calibration(self) -> Calibration: ...

class Session:
    """A joined session. A lost connection is tried again."""

    @property
    def host(self) -> str: ...
    @property
    def cameras(self) -> List[SessionCamera]:
        """Those that are there now."""
    def frames(self) -> Frames:
        """The newest frames of all cameras, as they come; those in between are left out where the loop is slower. Ends with the
        session. Frame.camera is SessionCamera.number, and Frame.utc follows this machine's clock."""
    def close(self) -> None:
        """Leaves the session, and ends the loops over its frames. `with` does the same."""
    def __enter__(self) -> Session: ...
    def __exit__(self, *exception: object) -> None: ...

def join(link: str, *, name: str = "python", depth_codec: str = "strata", color_codec: str = "jpeg:quality=85",
         wait: float = 15.0) -> Session:
    """Joins a session with the link that its host printed, and waits until the host lets this program in. Raises Error if the link
    is wrong, the host refuses, or it does not answer within `wait` seconds; time in which somebody must let the program in does
    not count."""

class CameraSender:
    """A camera in a session, whose frames are arrays."""

    def send(self, depth: NDArray[np.uint16], color: Optional[NDArray[np.uint8]] = None, *, jpeg: Optional[bytes] = None,
             age: float = 0.0) -> None:
        """`depth`: shape (height, width), in calibration.depth_unit_mm, 0: no measurement. `color`: shape (height, width, 3), sRGB; or
        `jpeg`, a baseline JPEG picture. Both of the calibration's sizes. `age`: seconds since the exposure, 0 to 10. The arrays are
        copied. Does not wait for the network: of frames that come too fast, the newest is sent. Raises Error if the session
        has ended or refuses the camera, or a frame does not fit the calibration."""
    @property
    def is_wanted(self) -> bool:
        """Somebody sees the camera; otherwise nothing is encoded."""
    @property
    def taken(self) -> int:
        """Frames that were taken to be sent."""
    @property
    def replaced(self) -> int:
        """Frames that a newer one replaced before they were taken."""
    def close(self) -> None:
        """Takes the camera out of the session. `with` does the same."""
    def __enter__(self) -> CameraSender: ...
    def __exit__(self, *exception: object) -> None: ...

def send_camera(link: str, calibration: Calibration, *, camera: str = "camera", fps: float = 30.0, name: str = "python",
                may_record: bool = False) -> CameraSender:
    """Brings a camera into a session, with the host's link for those who may send, and waits until it is there. `camera` and `name`:
    shown to people. `may_record`: others may record it. Raises Error if the link is wrong or the host refuses."""
