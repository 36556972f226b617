"""A finished frame: its picture, its exact outputs as NumPy arrays, and what is known about how it was made."""

import numpy as np

from .v1 import frame_pb2

# Output -> name, element type, channels; the shapes are [height, width] and [height, width, channels].
_LAYOUTS = {
    frame_pb2.OUTPUT_DEPTH: ("depth", "<f4", 1),
    frame_pb2.OUTPUT_ID: ("id", "<i4", 4),
    frame_pb2.OUTPUT_POSITION: ("position", "<f4", 3),
    frame_pb2.OUTPUT_NORMAL: ("normal", "<f4", 3),
    frame_pb2.OUTPUT_STEPS: ("steps", "<i4", 1),
}


class Frame:
    """`message` is the contract's Frame, with times, methods, counters and the echoed request.

    `image` holds the picture's bytes. `arrays` maps "depth", "id", "position", "normal" and "steps", as far as they were
    asked for, to arrays of [height, width] or [height, width, channels]. Depth counts from message.depth_offset_mm along the
    line of sight, position from message.position_origin_mm; `depth_mm` and `position_mm` have them added, in double.
    """

    def __init__(self, message):
        self.message = message
        self.image = message.image
        self.arrays = {}
        for output in message.outputs:
            name, kind, channels = _LAYOUTS[output.output]
            shape = (message.height, message.width) + ((channels,) if channels > 1 else ())
            self.arrays[name] = np.frombuffer(output.data, dtype=kind).reshape(shape)

    @property
    def png(self):
        """The picture's bytes; ValueError if it is a JPEG, as pictures of a moving view are."""
        if self.message.format != frame_pb2.IMAGE_FORMAT_PNG:
            raise ValueError("the picture of this frame is not a PNG; its bytes are in `image`")
        return self.image

    @property
    def converged(self):
        """Whether all samples are in and the picture is lossless."""
        return self.message.state == frame_pb2.FRAME_STATE_CONVERGED

    @property
    def depth_mm(self):
        """Distance along the line of sight from the eye, float64 [height, width], +inf where nothing is."""
        return self.arrays["depth"].astype(np.float64) + self.message.depth_offset_mm

    @property
    def position_mm(self):
        """World position, float64 [height, width, 3], NaN where nothing is."""
        return self.arrays["position"].astype(np.float64) + np.array(self.message.position_origin_mm)
