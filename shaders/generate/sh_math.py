"""Spherical-harmonics facts that the generators share, in double precision.

Internal basis (descoteaux07): for m > 0, with P the associated Legendre function without Condon-Shortley phase,
  Y(l,-m) = sqrt2 K P_l^m(cos t) cos(m a),   Y(l,+m) = (-1)^m sqrt2 K P_l^m(cos t) sin(m a),   Y(l,0) = K P_l(cos t).
N(l,m)(z) = sqrt2 K P_l^m / sin^m t is a polynomial in z = cos t, so Y = N(z) Re or Im (x + i y)^m.
"""
import math
import sys

import numpy as np


def arguments():
    """K, whether the layout is full, and the file to write, from the command line: K even|full OUTPUT.glsl"""
    if len(sys.argv) != 4 or not sys.argv[1].isdigit() or sys.argv[2] not in ("even", "full"):
        sys.exit(f"{sys.argv[0]}: the arguments are {sys.argv[1:]}; they must be: K even|full OUTPUT.glsl")
    k = int(sys.argv[1])
    if k % 2:
        sys.exit(f"{sys.argv[0]}: K is {k}; it must be even, as circles are sampled at K + 1 angles of which all but the first "
                 "come in pairs")
    return k, sys.argv[2] == "full", sys.argv[3]


def layout(k, full):
    """(l, m) pairs in storage order."""
    return [(l, m) for l in range(0, k + 1, 1 if full else 2) for m in range(-l, l + 1)]


def index(l, m, full):
    return l * (l + 1) + m if full else l * (l + 1) // 2 + m


def n_mm(m):
    """N(m,m), a constant."""
    value = math.sqrt(1.0 / (4.0 * math.pi)) * (math.sqrt(2.0) if m > 0 else 1.0)
    for i in range(1, m + 1):
        value *= math.sqrt((2.0 * i + 1.0) / (2.0 * i))
    return value


def alpha(l, m):
    """N(l) = alpha(l) z N(l-1) - beta(l) N(l-2)"""
    return math.sqrt((4.0 * l * l - 1.0) / (l * l - m * m))


def beta(l, m):
    if l - 1 <= m:
        return 0.0
    return math.sqrt(((l - 1.0) ** 2 - m * m) * (2.0 * l + 1.0) / ((2.0 * l - 3.0) * (l * l - m * m)))


def two_step(l, m):
    """(a, b, c) with N(l+2) = (a z^2 + b) N(l) + c N(l-2)."""
    a = alpha(l + 2, m) * alpha(l + 1, m)
    if l == m:
        return a, -beta(l + 2, m), 0.0
    ratio = alpha(l + 2, m) * beta(l + 1, m) / alpha(l, m)
    return a, -ratio - beta(l + 2, m), -ratio * beta(l, m)


def basis(directions, k, full):
    """Values [len(directions), count] of all basis functions at unit vectors."""
    x, y, z = np.asarray(directions, dtype=float).T
    columns = {}
    power = np.ones_like(x, dtype=complex)
    for m in range(0, k + 1):
        previous, current = np.zeros_like(x), np.full_like(x, n_mm(m))
        for l in range(m, k + 1):
            if full or l % 2 == 0:
                columns[(l, -m)] = current * power.real
                if m > 0:
                    columns[(l, m)] = (-1) ** m * current * power.imag
            previous, current = current, alpha(l + 1, m) * z * current - beta(l + 1, m) * previous
        power = power * (x + 1j * y)
    return np.stack([columns[lm] for lm in layout(k, full)], axis=1)


def band_transform(l, rotation):
    """Matrix X with coefficients(f o rotation) = X coefficients(f) for band l."""
    rng = np.random.default_rng(1)
    v = rng.normal(size=(8 * l + 8, 3))
    v /= np.linalg.norm(v, axis=1)[:, None]
    first = l * l
    at = basis(v, l, True)[:, first:first + 2 * l + 1]
    rotated = basis(v @ np.asarray(rotation).T, l, True)[:, first:first + 2 * l + 1]
    solution = np.linalg.lstsq(at, rotated, rcond=None)[0]
    solution[np.abs(solution) < 1e-12] = 0.0
    return solution


def number(value):
    """A GLSL float literal."""
    text = repr(float(np.float32(value)))
    return text if ("." in text or "e" in text) else text + ".0"


def number64(value):
    """A GLSL double literal."""
    text = repr(float(value))
    return (text if ("." in text or "e" in text) else text + ".0") + "lf"
