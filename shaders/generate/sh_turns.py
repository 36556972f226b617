"""Turning SH coefficients about axes, as straight-line GLSL, and the series of a meridian; shared by the generators.

Any rotation is turns about z with constant, sparse turns by 90 degrees between them. Fourier series of a function on the meridian at azimuth
0: legendre_fourier(). Source: turns about z and the zeros of d(90 degrees), e.g. Varshalovich et al. 1988, 4.16.
"""
import numpy as np

from sh_math import basis, band_transform, index, number

kQuarterAboutX = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]], dtype=float)  # y to z
kQuarterAboutY = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]], dtype=float)  # z to x


def legendre_fourier(k, full):
    """coefficients[(l, m)][h]: theta-Fourier series of Y(l,-m) at azimuth 0 (cosines for even m, sines for odd m)."""
    n = 4 * k + 8
    theta = 2.0 * np.pi * np.arange(n) / n
    directions = np.stack([np.sin(theta), np.zeros(n), np.cos(theta)], axis=1)
    values = basis(directions, k, full)
    result = {}
    for l in range(0, k + 1, 1 if full else 2):
        for m in range(l + 1):
            column = values[:, index(l, -m, full)]
            wave = np.sin if m % 2 else np.cos
            result[(l, m)] = [2.0 / n * float(column @ wave(h * theta)) * (0.5 if h == 0 else 1.0) for h in range(k + 1)]
    return result


def multiples(out, k, cos_name, sin_name):
    """cos and sin of m times the angle, m = 1 to k, as NAME1, NAME2, ..."""
    out.append(f"    const float {cos_name}1 = {cos_name}, {sin_name}1 = {sin_name};")
    for m in range(2, k + 1):
        out.append(f"    const float {cos_name}{m} = {cos_name}{m - 1} * {cos_name} - {sin_name}{m - 1} * {sin_name}, "
                   f"{sin_name}{m} = {sin_name}{m - 1} * {cos_name} + {cos_name}{m - 1} * {sin_name};")


def turn_band_about_z(out, l, full, source, target, cos_name, sin_name):
    """TARGETi = coefficient i of f o Rz(angle), i in band l: cos(m (a + angle)) and so on. source: how i is read, e.g. "c[{}]"."""
    zero = index(l, 0, full)
    out.append(f"    const float {target}{zero} = {source.format(zero)};")
    for m in range(1, l + 1):
        minus, plus = index(l, -m, full), index(l, m, full)
        # f = c- N cos(ma) + s c+ N sin(ma), s = (-1)^m
        s, t = ("-", "+") if m % 2 else ("+", "-")
        out.append(f"    const float {target}{minus} = {source.format(minus)} * {cos_name}{m} {s} {source.format(plus)} * {sin_name}{m};")
        out.append(f"    const float {target}{plus} = {source.format(plus)} * {cos_name}{m} {t} {source.format(minus)} * {sin_name}{m};")


def quarter_turn_band(out, l, full, rotation, source, target):
    """TARGETi = coefficient i of f o rotation, i in band l, for one of the constant rotations or its transpose."""
    matrix = band_transform(l, rotation)
    for row in range(2 * l + 1):
        terms = [f"{number(matrix[row, col])} * {source.format(index(l, col - l, full))}"
                 for col in range(2 * l + 1) if matrix[row, col] != 0.0]
        out.append(f"    const float {target}{index(l, row - l, full)} = {' + '.join(terms) if terms else '0.0'};")
