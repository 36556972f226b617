"""A live view: an iterator over its frames that acknowledges each, and a camera that can be moved meanwhile."""

import threading
import time

import grpc

from .errors import translated
from .frame import Frame
from .request import as_camera
from .v1 import pick_pb2, pick_pb2_grpc, view_pb2, view_pb2_grpc


def picked(answer):
    """The one message that a PickResponse holds, or None."""
    for kind in ("glyph", "fibre", "surface"):
        if answer.HasField(kind):
            return getattr(answer, kind)
    return None


class View:
    """Opened by Client.stream. Iterate for frames; close() or leaving the `with` block ends it.

    The iterator ends when the view is closed. A frame is acknowledged when it is handed out, so a script that takes long over
    one frame holds back the next ones instead of piling them up. update() may be called from any thread.
    """

    def __init__(self, channel, request, window=None, timeout=600):
        self._stub = view_pb2_grpc.ViewServiceStub(channel)
        self._pick = pick_pb2_grpc.PickServiceStub(channel)
        self._timeout = timeout
        self._lock = threading.Lock()
        self._camera_sequence = 0
        self._acknowledged = 0
        self._closed = False
        opened = view_pb2.OpenRequest(frame=request)
        if window is not None:
            opened.window = window
        self._stream = self._stub.Open(opened)
        try:
            self.id = next(self._stream).view_id
        except grpc.RpcError as error:
            raise translated(error) from None

    def __iter__(self):
        return self

    def __next__(self):
        try:
            while True:
                response = next(self._stream)
                if response.HasField("frame"):
                    break
        except grpc.RpcError as error:
            if self._closed and error.code() == grpc.StatusCode.CANCELLED:
                raise StopIteration from None
            raise translated(error) from None
        with self._lock:
            self._acknowledged = response.frame.sequence
        self._send(view_pb2.UpdateRequest())
        return Frame(response.frame)

    def update(self, camera=None, scene=None, quality=None, size=None):
        """Moves the camera or changes what is shown; returns the sequence number that the answering frames echo."""
        request = view_pb2.UpdateRequest(client_time_ms=time.time() * 1e3)
        if camera is not None:
            request.camera.CopyFrom(as_camera(camera))
        if scene is not None:
            request.scene.CopyFrom(scene)
        if quality is not None:
            request.quality.CopyFrom(quality)
        if size is not None:
            request.width, request.height = size
        return self._send(request, changes=True)

    def _send(self, request, changes=False):
        request.view_id = self.id
        with self._lock:
            self._camera_sequence += changes
            request.acknowledged_sequence = self._acknowledged
            request.camera_sequence = self._camera_sequence
        try:
            self._stub.Update(request, timeout=self._timeout)
        except grpc.RpcError as error:
            raise translated(error) from None
        return request.camera_sequence

    def pick(self, frame, x, y, radius_px=0, *, all_hits=False):
        """What lies under a pixel of a frame of this view, as Client.pick; the last 64 frames are known."""
        request = pick_pb2.PickRequest(x=x, y=y, radius_px=radius_px, all_hits=all_hits)
        request.view.view_id, request.view.sequence = self.id, frame.message.sequence
        try:
            answer = self._pick.Pick(request, timeout=self._timeout)
        except grpc.RpcError as error:
            raise translated(error) from None
        return picked(answer)

    def close(self):
        """Ends the view on the server too."""
        self._closed = True
        self._stream.cancel()

    def __enter__(self):
        return self

    def __exit__(self, *ignored):
        self.close()
