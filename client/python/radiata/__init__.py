"""Thin Python client of a Radiata server: what there is, pictures with exact outputs as NumPy arrays, live views.

    from radiata import Client
    with Client("127.0.0.1:50051") as client:
        frame = client.render("brain", plane="coronal", size=(800, 600), outputs=["depth", "id"])
        open("coronal.png", "wb").write(frame.png)
        print(frame.arrays["depth"].min())

Pictures are not for diagnostic use.
"""

from .camera import camera_from_json, camera_to_json, read_camera_path
from .client import Client
from .errors import RadiataError, Refused, Unreachable
from .frame import Frame
from .request import frame_request
from .view import View

__all__ = ["Client", "Frame", "View", "RadiataError", "Refused", "Unreachable", "camera_from_json", "camera_to_json",
           "read_camera_path", "frame_request"]
