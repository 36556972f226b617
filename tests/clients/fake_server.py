"""A server that misbehaves on purpose, for what the real one never does: arrays of the wrong size, frames without a
picture, views that end early, a health service that says NOT_SERVING. Prints its port.

    fake_server.py MODE     MODE: array, picture, view, health
"""

import sys
from concurrent import futures

import grpc

from radiata.v1 import (catalog_pb2, catalog_pb2_grpc, frame_pb2, render_pb2, render_pb2_grpc, view_pb2, view_pb2_grpc)


class Catalog(catalog_pb2_grpc.CatalogServiceServicer):
    def ListDatasets(self, request, context):
        return catalog_pb2.ListDatasetsResponse(datasets=[catalog_pb2.Dataset(id="fake")])

    def FitCamera(self, request, context):
        response = catalog_pb2.FitCameraResponse()
        response.camera.eye_mm.z = 1
        response.camera.up.y = 1
        response.camera.height_mm = 1
        return response


class Render(render_pb2_grpc.RenderServiceServicer):
    def __init__(self, mode):
        self.mode = mode

    def Render(self, request, context):
        frame = frame_pb2.Frame(width=request.frame.width, height=request.frame.height, image=b"picture")
        if self.mode == "picture":
            frame.image = b""
        if self.mode == "array":
            frame.outputs.add(output=frame_pb2.OUTPUT_DEPTH, shape=[frame.height, frame.width], data=b"1234")
        return render_pb2.RenderResponse(frame=frame)


class View(view_pb2_grpc.ViewServiceServicer):
    def Open(self, request, context):
        yield view_pb2.OpenResponse(view_id="view")

    def Update(self, request, context):
        return view_pb2.UpdateResponse()


def main(mode):
    server = grpc.server(futures.ThreadPoolExecutor(4))
    catalog_pb2_grpc.add_CatalogServiceServicer_to_server(Catalog(), server)
    render_pb2_grpc.add_RenderServiceServicer_to_server(Render(mode), server)
    view_pb2_grpc.add_ViewServiceServicer_to_server(View(), server)
    status = b"\x08\x02" if mode == "health" else b"\x08\x01"
    check = grpc.unary_unary_rpc_method_handler(lambda request, context: status)
    server.add_generic_rpc_handlers((grpc.method_handlers_generic_handler("grpc.health.v1.Health", {"Check": check}),))
    port = server.add_insecure_port("127.0.0.1:0")
    server.start()
    print(f"listening on 127.0.0.1:{port}", flush=True)
    server.wait_for_termination(timeout=120)


if __name__ == "__main__":
    main(sys.argv[1])
