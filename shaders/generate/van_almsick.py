"""Writes GLSL for one even layout's polynomial along a ray after van Almsick et al. 2011: van_almsick.py K even OUTPUT.glsl

In a frame with pole q the function, made homogeneous of degree K, is f(z, rho, alpha) = sum over m, i of (C cos(m alpha) + S sin(m alpha))
z^(K - i) rho^i, with i of the parity of m and at least m. The table holds all C and S, as many numbers as there are coefficients, and two
bounds after them; its frame is that of pole_table.py:
  vanAlmsickTable(c, q, table)      rotation, then Legendre to monomials
  VAN_ALMSICK_PLANE(T, ca, sa, g)   g[i] of z^(K - i) rho^i in the half plane of azimuth alpha, (ca, sa) = (cos alpha, sin alpha)
The bounds are the radius and the half length of the bounding cylinder around q: sums over l, m of the amplitude of azimuth's wave times the largest
|N(cos t)| sin t or |N(cos t) cos t|. Source: van Almsick et al. 2011 for K = 4, as Peters et al. 2023, Sec. 2 and 5, describe it; any even K here.
"""
import math

import numpy as np

from sh_math import arguments, basis, index, number
from sh_turns import kQuarterAboutX, multiples, quarter_turn_band, turn_band_about_z


def entries(k):
    """(m, kind, i) in table order; kind 0: C, 1: S."""
    return [(m, kind, i) for m in range(k + 1) for kind in range(1 if m == 0 else 2) for i in range(m, k + 1, 2)]


def monomials(k):
    """coefficients[(l, m)][i]: Y(l,-m) at azimuth 0 as sum over i of cos(t)^(K - i) sin(t)^i."""
    theta = np.pi * np.arange(2 * k + 2) / (2 * k + 2)
    values = basis(np.stack([np.sin(theta), np.zeros_like(theta), np.cos(theta)], axis=1), k, False)
    result = {}
    for m in range(k + 1):
        powers = list(range(m, k + 1, 2))
        matrix = np.stack([np.cos(theta) ** (k - i) * np.sin(theta) ** i for i in powers], axis=1)
        for l in range(m + m % 2, k + 1, 2):
            solution = np.linalg.lstsq(matrix, values[:, index(l, -m, False)], rcond=None)[0]
            result[(l, m)] = dict(zip(powers, solution))
    return result


def largest(k):
    """(l, m): largest |N| sin t and |N cos t|, certified: no sample is farther than pi / 4096 from the maximum (M. Riesz)."""
    theta = np.pi * np.arange(4096) / 4096
    values = np.abs(basis(np.stack([np.sin(theta), np.zeros_like(theta), np.cos(theta)], axis=1), k, False))
    margin = 1.0 / math.cos((k + 1) * np.pi / 4096) + 1e-6
    return {(l, m): (margin * np.max(values[:, index(l, -m, False)] * np.sin(theta)),
                     margin * np.max(values[:, index(l, -m, False)] * np.abs(np.cos(theta))))
            for l in range(0, k + 1, 2) for m in range(l + 1)}


def build(k, order):
    count = (k + 1) * (k + 2) // 2
    out = [f"void vanAlmsickTable(const float c[{count}], vec3 q, out float table[VAN_ALMSICK_COUNT]) {{",
           "    const float sin_theta = length(q.xy);",
           "    const float cz = sin_theta > 1e-12 ? q.x / sin_theta : 1.0, sz = sin_theta > 1e-12 ? q.y / sin_theta : 0.0;",
           "    const float ct = q.z, st = sin_theta;"]
    multiples(out, k, "cz", "sz")
    multiples(out, k, "ct", "st")
    for l in range(0, k + 1, 2):
        turn_band_about_z(out, l, False, "c[{}]", "r", "cz", "sz")
        quarter_turn_band(out, l, False, kQuarterAboutX.T, "r{}", "s")
        turn_band_about_z(out, l, False, "s{}", "u", "ct", "st")
        quarter_turn_band(out, l, False, kQuarterAboutX, "u{}", "v")
    table = monomials(k)
    for at, (m, kind, i) in enumerate(order):
        sign = -1.0 if kind == 1 and m % 2 else 1.0
        terms = [f"{number(sign * table[(l, m)][i])} * v{index(l, m if kind else -m, False)}"
                 for l in range(m + m % 2, k + 1, 2) if abs(table[(l, m)][i]) > 1e-12]
        out.append(f"    table[{at}] = {' + '.join(terms) if terms else '0.0'};")
    bounds = largest(k)
    out.append("    float radius = 0.0, half_length = 0.0, amplitude;")
    for (l, m), (across, along) in bounds.items():
        wave = f"abs(v{index(l, 0, False)})" if m == 0 else f"length(vec2(v{index(l, -m, False)}, v{index(l, m, False)}))"
        out.append(f"    amplitude = {wave};")
        out.append(f"    radius += {number(across)} * amplitude;")
        out.append(f"    half_length += {number(along)} * amplitude;")
    out += [f"    table[{count}] = radius;", f"    table[{count + 1}] = half_length;", "}"]
    return out


def plane(k, order):
    lines = ["float ac1 = ca, as1 = sa;"]
    for m in range(2, k + 1):
        lines.append(f"float ac{m} = ac{m - 1} * ca - as{m - 1} * sa, as{m} = as{m - 1} * ca + ac{m - 1} * sa;")
    for i in range(k + 1):
        terms = []
        for at, (m, kind, power) in enumerate(order):
            if power == i:
                terms.append(f"T({at})" + ("" if m == 0 else f" * {'as' if kind else 'ac'}{m}"))
        lines.append(f"g[{i}] = {' + '.join(terms)};")
    return ["// T(i) reads entry i of the table.", "#define VAN_ALMSICK_PLANE(T, ca, sa, g) \\",
            *("    " + line + " \\" for line in lines), ""]


def main():
    k, full, target = arguments()
    if full:
        raise SystemExit("van_almsick.py: odd bands have no polynomial along a ray with even ones; give an even layout")
    order = entries(k)
    out = ["// Generated by shaders/generate/van_almsick.py.", f"#define VAN_ALMSICK_COUNT {len(order) + 2}",
           f"#define VAN_ALMSICK_RADIUS {len(order)}", f"#define VAN_ALMSICK_HALF_LENGTH {len(order) + 1}", ""]
    out += build(k, order) + [""] + plane(k, order)
    with open(target, "w", encoding="ascii") as file:
        file.write("\n".join(out) + "\n")


if __name__ == "__main__":
    main()
