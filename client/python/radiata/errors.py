"""What can go wrong, as two kinds: the server is not there, or it said no in a sentence."""

import grpc


class RadiataError(Exception):
    """Base of both. `code` is the grpc.StatusCode."""

    def __init__(self, message, code):
        super().__init__(message)
        self.code = code


class Unreachable(RadiataError):
    """No server there, lost under way, or no answer in time."""


class Refused(RadiataError):
    """The server said no; the message is its sentence."""


def translated(error):
    """The RadiataError for a grpc.RpcError."""
    code = error.code()
    if code in (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.DEADLINE_EXCEEDED):
        return Unreachable(f"the server is not available: {error.details()}", code)
    return Refused(error.details(), code)
