"""The client proper: one channel, and a method for each call."""

import time

import grpc

from .errors import Unreachable, translated
from .frame import Frame
from .request import enum_value, frame_request, voxel_selection
from .v1 import (catalog_pb2, catalog_pb2_grpc, frame_pb2, limits_pb2, limits_pb2_grpc, pick_pb2, pick_pb2_grpc, render_pb2,
                 render_pb2_grpc, scene_pb2, selection_pb2, selection_pb2_grpc)
from .view import View, picked

# The answer of grpc.health.v1.Health/Check that says SERVING; written out, so that no further package is needed.
_SERVING = b"\x08\x01"


class Client:
    """A connection to a server, closed by close() or the end of a `with` block. Calls raise Refused or Unreachable.

    `timeout` is the longest time for one call, in seconds.
    """

    def __init__(self, address="127.0.0.1:50051", timeout=600):
        self.timeout = timeout
        self._channel = grpc.insecure_channel(address, options=[("grpc.max_receive_message_length", -1),
                                                                ("grpc.max_send_message_length", -1),
                                                                ("grpc.enable_http_proxy", 0),
                                                                ("grpc.max_reconnect_backoff_ms", 500)])
        self._catalog = catalog_pb2_grpc.CatalogServiceStub(self._channel)
        self._render = render_pb2_grpc.RenderServiceStub(self._channel)
        self._pick = pick_pb2_grpc.PickServiceStub(self._channel)
        self._selection = selection_pb2_grpc.SelectionServiceStub(self._channel)
        self._limits = limits_pb2_grpc.LimitsServiceStub(self._channel)
        self._health = self._channel.unary_unary("/grpc.health.v1.Health/Check")

    def wait_until_serving(self, seconds):
        """Returns when the health service says SERVING; raises Unreachable after so many seconds."""
        end = time.monotonic() + seconds
        while True:
            try:
                if self._health(b"", timeout=max(0.1, min(5, end - time.monotonic()))) == _SERVING:
                    return
                why, code = "its health service does not say SERVING", grpc.StatusCode.UNAVAILABLE
            except grpc.RpcError as error:
                why, code = error.details(), error.code()
            if time.monotonic() + 0.1 >= end:
                raise Unreachable(f"the server does not serve: {why}", code)
            time.sleep(0.1)

    def _call(self, method, request):
        try:
            return method(request, timeout=self.timeout)
        except grpc.RpcError as error:
            raise translated(error) from None

    def list(self):
        """All datasets, as the contract's Dataset messages."""
        return list(self._call(self._catalog.ListDatasets, catalog_pb2.ListDatasetsRequest()).datasets)

    def info(self, dataset):
        """One dataset."""
        return self._call(self._catalog.GetDataset, catalog_pb2.GetDatasetRequest(id=dataset)).dataset

    def limits(self):
        """What the server accepts, and the device that draws."""
        return self._call(self._limits.GetLimits, limits_pb2.GetLimitsRequest())

    def fit_camera(self, dataset, aspect=16 / 9, convention=None, **selection):
        """A camera that shows a selection (plane, position_mm, normal, slab_mm, volume); aspect is width / height."""
        request = catalog_pb2.FitCameraRequest(dataset_id=dataset, aspect=aspect)
        request.selection.CopyFrom(voxel_selection(**selection))
        request.convention = enum_value(scene_pb2.Annotations.Convention, "CONVENTION_", convention)
        return self._call(self._catalog.FitCamera, request).camera

    def request(self, dataset=None, **options):
        """A FrameRequest of frame_request's options; without a camera the one that fits the selection."""
        request = frame_request(dataset, **options)
        if not request.HasField("camera"):
            # Kept within what FitCamera takes, so that an impossible size is refused as a size.
            aspect = min(max(request.width / max(1, request.height), 0.05), 20)
            first = request.scene.layers[0]
            content = getattr(first, first.WhichOneof("content") or "glyphs")
            shown = content.glyphs if first.HasField("tensor_glyphs") else content
            fit = catalog_pb2.FitCameraRequest(dataset_id=shown.dataset_id, aspect=aspect)
            if shown is not content or first.HasField("glyphs"):
                fit.selection.CopyFrom(shown.selection)
            fit.convention = request.scene.annotations.convention
            request.camera.CopyFrom(self._call(self._catalog.FitCamera, fit).camera)
        return request

    def render(self, dataset=None, *, outputs=(), image_format="png", **options):
        """A Frame with all samples. `outputs`: any of depth, id, position, normal, steps; `options`: see frame_request."""
        request = render_pb2.RenderRequest(frame=self.request(dataset, **options))
        request.format = enum_value(frame_pb2.ImageFormat, "IMAGE_FORMAT_", image_format)
        request.outputs.extend(enum_value(frame_pb2.Output, "OUTPUT_", name) for name in outputs)
        return Frame(self._call(self._render.Render, request).frame)

    def pick(self, dataset, x, y, radius_px=0, *, all_hits=False, **options):
        """What lies under a pixel of the picture that render makes with the same options; None: nothing.

        A PickedGlyph, PickedFibre or PickedSurface message. Fibres are looked for within radius_px pixels. With all_hits=True a
        glyph's `hits` are all those of the pixel's ray, by the method that `intersection` names.
        """
        request = pick_pb2.PickRequest(x=x, y=y, radius_px=radius_px, all_hits=all_hits)
        request.request.CopyFrom(self.request(dataset, **options))
        return picked(self._call(self._pick.Pick, request))

    def pick_fibres(self, outline, dataset=None, *, through=False, fibres_max=2**32 - 1, **options):
        """The fibres within an outline on the picture that render makes with the same options, as PickedFibres messages.

        outline: (x, y) pairs in pixels from the upper left corner, of two the box between them, of one its pixel. One message for
        each layer of fibres; through=True finds those that others hide, too.
        """
        request = pick_pb2.PickFibresRequest(request=self.request(dataset, **options), through=through, fibres_max=fibres_max)
        for x, y in outline:
            request.outline.add(x=x, y=y)
        return list(self._call(self._pick.PickFibres, request).layers)

    def select(self, dataset, selection, fibres_max=2**32 - 1):
        """The fibres of a tractogram that a selection names (docs/formats/selection.md), as a SelectResponse message."""
        request = selection_pb2.SelectRequest(dataset_id=dataset, selection=selection, fibres_max=fibres_max)
        return self._call(self._selection.Select, request)

    def stream(self, dataset=None, *, window=None, **options):
        """A live View of a scene: iterate over it for frames, which are acknowledged by themselves."""
        return View(self._channel, self.request(dataset, **options), window, self.timeout)

    def close(self):
        """Ends every view and call of this client."""
        self._channel.close()

    def __enter__(self):
        return self

    def __exit__(self, *ignored):
        self.close()
