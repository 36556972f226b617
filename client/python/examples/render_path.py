#!/usr/bin/env python3
"""Renders the cameras of a path file to numbered pictures, and the exact outputs beside them as .npy.

    PYTHONPATH=build/release/python /usr/bin/python3 client/python/examples/render_path.py \\
        --server 127.0.0.1:50051 --dataset brain --path path.json --output out

The path file is described in docs/formats/camera.md; `radiata orbit --write-path` makes one.
"""

import argparse
import pathlib
import sys

import numpy as np

from radiata import Client, RadiataError, read_camera_path


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--server", default="127.0.0.1:50051")
    parser.add_argument("--dataset", required=True)
    parser.add_argument("--path", required=True, help="camera path, JSON")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="folder; made if missing")
    parser.add_argument("--plane", default="axial", choices=["axial", "coronal", "sagittal"])
    parser.add_argument("--size", type=int, nargs=2, default=(640, 360), metavar=("WIDTH", "HEIGHT"))
    parser.add_argument("--samples", type=int, help="per pixel; the server's choice if left out")
    parser.add_argument("--outputs", nargs="*", default=["depth", "id"],
                        choices=["depth", "id", "position", "normal", "steps"])
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    cameras = read_camera_path(arguments.path)
    arguments.output.mkdir(parents=True, exist_ok=True)
    with Client(arguments.server) as client:
        for number, camera in enumerate(cameras, start=1):
            frame = client.render(arguments.dataset, camera=camera, size=arguments.size, plane=arguments.plane,
                                  samples=arguments.samples, outputs=arguments.outputs)
            stem = f"frame-{number:04d}"
            (arguments.output / f"{stem}.png").write_bytes(frame.png)
            for name, array in frame.arrays.items():
                np.save(arguments.output / f"{stem}-{name}.npy", array)
            print(f"{number}/{len(cameras)} {stem}.png {frame.message.timing.render_ms:.1f} ms, "
                  f"{frame.message.counters.hit_pixels} pixels hit")


if __name__ == "__main__":
    try:
        main()
    except (RadiataError, ValueError, OSError) as error:
        sys.exit(f"render_path: {error}")
