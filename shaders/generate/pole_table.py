"""Writes GLSL for one layout's pole-frame table: pole_table.py K even|full OUTPUT.glsl

All rays through one point, or parallel to one direction, span planes through an axis q (unit, from the glyph's centre). In a frame with
pole q the function is f(theta, alpha) = sum over m, h of (C cos(m alpha) + S sin(m alpha)) times cos(h theta) for even m, sin(h theta)
for odd m, where h has the parity of the band. The table holds all C and S:
  poleTableBuild(c, q, table)             rotation by two quarter turns about x (constant, sparse) and two turns about z, then Legendre to Fourier
  poleTableFourier(table, ca, sa, F)      F[h] = (a, b) of the great circle of azimuth alpha, (ca, sa) = (cos alpha, sin alpha)
The frame's axes are n1 = Rz Ry x, n2 = Rz Ry y, q = Rz Ry z (poleFrame). Source: research of van Almsick et al. 2011 (k = 4), generalised.
"""
import numpy as np

from sh_math import arguments, basis, band_transform, index, number

kQuarter = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]], dtype=float)  # rotation by 90 degrees about x: y to z


def entries(k, full):
    """(m, kind, h) in table order; kind 0: C, 1: S."""
    stride = 1 if full else 2
    order = []
    for m in range(k + 1):
        for kind in range(1 if m == 0 else 2):
            for h in range(0, k + 1, stride):
                if m % 2 and h == 0:
                    continue
                order.append((m, kind, h))
    return order


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


def turn_about_z(out, k, full, source, target, cos_name, sin_name):
    """target = coefficients of f o Rz(angle): cos(m (a + angle)) and so on."""
    out.append(f"    float {cos_name}1 = {cos_name}, {sin_name}1 = {sin_name};")
    for m in range(2, k + 1):
        out.append(f"    const float {cos_name}{m} = {cos_name}{m - 1} * {cos_name} - {sin_name}{m - 1} * {sin_name}, "
                   f"{sin_name}{m} = {sin_name}{m - 1} * {cos_name} + {cos_name}{m - 1} * {sin_name};")
    for l in range(0, k + 1, 1 if full else 2):
        out.append(f"    {target}[{index(l, 0, full)}] = {source}[{index(l, 0, full)}];")
        for m in range(1, l + 1):
            minus, plus = index(l, -m, full), index(l, m, full)
            # f = c- N cos(ma) + s c+ N sin(ma), s = (-1)^m
            s = "-" if m % 2 else "+"
            t = "+" if m % 2 else "-"
            out.append(f"    {target}[{minus}] = {source}[{minus}] * {cos_name}{m} {s} {source}[{plus}] * {sin_name}{m};")
            out.append(f"    {target}[{plus}] = {source}[{plus}] * {cos_name}{m} {t} {source}[{minus}] * {sin_name}{m};")


def quarter_turn(out, k, full, source, target, transpose):
    for l in range(0, k + 1, 1 if full else 2):
        matrix = band_transform(l, kQuarter)
        matrix = matrix.T if transpose else matrix
        for row in range(2 * l + 1):
            terms = [f"{number(matrix[row, col])} * {source}[{index(l, col - l, full)}]"
                     for col in range(2 * l + 1) if matrix[row, col] != 0.0]
            out.append(f"    {target}[{index(l, row - l, full)}] = {' + '.join(terms) if terms else '0.0'};")


def build(k, full, order):
    out = ["void poleTableBuild(const float c[SH_COUNT], vec3 q, out float table[POLE_TABLE_COUNT]) {",
           "    const float sin_theta = length(q.xy);",
           "    const float cz = sin_theta > 1e-12 ? q.x / sin_theta : 1.0, sz = sin_theta > 1e-12 ? q.y / sin_theta : 0.0;",
           "    const float ct = q.z, st = sin_theta;",
           "    float r[SH_COUNT], s[SH_COUNT];"]
    turn_about_z(out, k, full, "c", "r", "cz", "sz")
    quarter_turn(out, k, full, "r", "s", True)
    turn_about_z(out, k, full, "s", "r", "ct", "st")
    quarter_turn(out, k, full, "r", "s", False)
    fourier = legendre_fourier(k, full)
    for i, (m, kind, h) in enumerate(order):
        sign = -1.0 if kind == 1 and m % 2 else 1.0
        terms = []
        for l in range(m, k + 1):
            if not full and l % 2:
                continue
            if (l - h) % 2 or h > l or abs(fourier[(l, m)][h]) < 1e-12:
                continue
            terms.append(f"{number(sign * fourier[(l, m)][h])} * s[{index(l, m if kind else -m, full)}]")
        out.append(f"    table[{i}] = {' + '.join(terms) if terms else '0.0'};")
    out.append("}")
    return out


def contract(k, full, order):
    stride = 1 if full else 2
    out = ["// T(i) reads entry i of the table.", "#define POLE_TABLE_FOURIER(T, ca, sa, F) \\"]
    lines = ["float pc1 = ca, ps1 = sa;"]
    for m in range(2, k + 1):
        lines.append(f"float pc{m} = pc{m - 1} * ca - ps{m - 1} * sa, ps{m} = ps{m - 1} * ca + pc{m - 1} * sa;")
    position = {entry: i for i, entry in enumerate(order)}
    for h in range(0, k + 1, stride):
        parts = []
        for parity in (0, 1):
            terms = []
            for m in range(parity, k + 1, 2):
                if (m, 0, h) in position:
                    terms.append(f"T({position[(m, 0, h)]})" + (f" * pc{m}" if m else ""))
                if (m, 1, h) in position:
                    terms.append(f"T({position[(m, 1, h)]}) * ps{m}")
            parts.append(" + ".join(terms) if terms else "0.0")
        lines.append(f"F[{h // stride}] = vec2({parts[0]}, {parts[1]});")
    out += ["    " + line + " \\" for line in lines]
    out.append("")
    return out


def main():
    k, full, target = arguments()
    order = entries(k, full)
    out = ["// Generated by shaders/generate/pole_table.py.", f"#define POLE_TABLE_COUNT {len(order)}", ""]
    out += build(k, full, order) + [""] + contract(k, full, order)
    with open(target, "w", encoding="ascii") as file:
        file.write("\n".join(out) + "\n")


if __name__ == "__main__":
    main()
