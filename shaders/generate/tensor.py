"""Writes straight-line GLSL for Cartesian tensors of one order: tensor.py ORDER OUTPUT.glsl

Source: Hlawitschka et al., Reynolds glyphs, Eq. 4 (entries, any tensor) and Eq. 5 (symmetric tensors) with their derivatives.
Note: the paper prints the multiplicity as 3n / (hx! hy! hz!); right is n! / (hx! hy! hz!).
The glyph depends on the symmetric part alone: the product x_i1 ... x_in by which an entry is weighted does not change when the
indices change places. So the symmetric components, ordered as server/math/cartesian_tensor.h says, serve tensors without symmetry too.

For weights w[TENSOR_COUNT] = multiplicity times component:
  tensorWeights(t, scale, w)            weights from components
  float tensorEvaluate(w, p)            f(p), nested (Horner): first x, then y with powers of z
  vec4 tensorEvaluateGradient(w, p)     gradient and value, differentiated analytically
  Interval / Affine tensorRange(w, x, y, z)   where f lies over ranges (shaders/common/range_arithmetic.glsl, included before)
For orders up to 4 also Eq. 4 as it stands, over all 3^n entries, to hold the rest against:
  float tensorEvaluateEntries(t, p)
"""
import math
import sys


def components(order):
    return [(a, b, order - a - b) for a in range(order, -1, -1) for b in range(order - a, -1, -1)]


def index(b, c):
    return (b + c) * (b + c + 1) // 2 + c


def multiplicity(a, b, c):
    return math.factorial(a + b + c) // (math.factorial(a) * math.factorial(b) * math.factorial(c))


def product(*factors):
    """Of texts; factors of 1 are left out."""
    kept = [f for f in factors if f != "1.0"]
    return " * ".join(kept) if kept else "1.0"


def power(name, n):
    return "1.0" if n == 0 else f"{name}{n}"


def powers(name, source, n):
    lines = [f"    const float {name}1 = {source};"] if n > 0 else []
    for i in range(2, n + 1):
        lines.append(f"    const float {name}{i} = {name}{i // 2} * {name}{i - i // 2};")
    return lines


def nested(variable, terms):
    """sum of terms[i] variable^i, nested."""
    text = terms[-1]
    for term in reversed(terms[:-1]):
        text = f"({text}) * {variable} + {term}"
    return text


def weight(b, c, factor=1):
    return f"w[{index(b, c)}]" if factor == 1 else f"{factor}.0 * w[{index(b, c)}]"


def evaluate(order):
    lines = ["float tensorEvaluate(const float w[TENSOR_COUNT], vec3 p) {"]
    lines += powers("z", "p.z", order)
    for a in range(order + 1):
        m = order - a
        terms = [product(weight(b, m - b), power("z", m - b)) for b in range(m + 1)]
        lines.append(f"    const float g{a} = {nested('p.y', terms)};")
    lines.append(f"    return {nested('p.x', [f'g{a}' for a in range(order + 1)])};")
    return lines + ["}"]


def gradient(order):
    lines = ["vec4 tensorEvaluateGradient(const float w[TENSOR_COUNT], vec3 p) {"]
    lines += powers("z", "p.z", order)
    for a in range(order + 1):
        m = order - a
        value = [product(weight(b, m - b), power("z", m - b)) for b in range(m + 1)]
        by_y = [product(weight(b, m - b, b), power("z", m - b)) for b in range(1, m + 1)]
        by_z = [product(weight(b, m - b, m - b), power("z", m - b - 1)) for b in range(m)]
        lines.append(f"    const float g{a} = {nested('p.y', value)};")
        if m > 0:
            lines.append(f"    const float gy{a} = {nested('p.y', by_y)};")
            lines.append(f"    const float gz{a} = {nested('p.y', by_z)};")
    value = nested("p.x", [f"g{a}" for a in range(order + 1)])
    by_x = nested("p.x", [f"{a}.0 * g{a}" for a in range(1, order + 1)])
    by_y = nested("p.x", [f"gy{a}" for a in range(order)])
    by_z = nested("p.x", [f"gz{a}" for a in range(order)])
    lines.append(f"    return vec4({by_x},\n                {by_y},\n                {by_z},\n                {value});")
    return lines + ["}"]


def range_of(order, kind):
    """Monomials, not nested: even powers are squares, which ranges know to be positive."""
    lines = [f"{kind} tensorRange(const float w[TENSOR_COUNT], {kind} x1, {kind} y1, {kind} z1) {{"]
    for name in "xyz":
        for i in range(2, order + 1):
            made = f"rangeSquare({name}{i // 2})" if i % 2 == 0 else f"rangeMultiply({name}{i - 1}, {name}1)"
            lines.append(f"    const {kind} {name}{i} = {made};")
    total = None
    for a in range(order + 1):
        m = order - a
        terms = []
        for b in range(m + 1):
            c = m - b
            if m == 0:
                continue
            factor = f"y{b}" if c == 0 else f"z{c}" if b == 0 else f"rangeMultiply(y{b}, z{c})"
            terms.append(f"rangeScale({weight(b, c)}, {factor})")
        if m == 0:
            part = f"rangeScale({weight(0, 0)}, x{a})"
        else:
            lines.append(f"    {kind} g{a} = {terms[0]};")
            lines += [f"    g{a} = rangeAdd(g{a}, {term});" for term in terms[1:]]
            part = f"g{a}" if a == 0 else f"rangeMultiply(x{a}, g{a})"
        if total is None:
            lines.append(f"    {kind} sum = {part};")
            total = "sum"
        else:
            lines.append(f"    sum = rangeAdd(sum, {part});")
    return lines + ["    return sum;", "}"]


def entries(order):
    lines = [f"#define TENSOR_ENTRIES {3 ** order}", "float tensorEvaluateEntries(const float t[TENSOR_ENTRIES], vec3 p) {",
             "    float sum = 0.0;"]
    for entry in range(3 ** order):
        digits = [entry // 3 ** i % 3 for i in reversed(range(order))]
        lines.append("    sum += " + " * ".join([f"t[{entry}]"] + ["p." + "xyz"[d] for d in digits]) + ";")
    return lines + ["    return sum;", "}"]


def main():
    if len(sys.argv) != 3 or not sys.argv[1].isdigit() or not 2 <= int(sys.argv[1]) <= 12:
        sys.exit(f"{sys.argv[0]}: the arguments are {sys.argv[1:]}; they must be: ORDER (2 to 12) OUTPUT.glsl")
    order = int(sys.argv[1])
    parts = components(order)
    lines = ["// Generated by shaders/generate/tensor.py.", f"#define TENSOR_ORDER {order}", f"#define TENSOR_COUNT {len(parts)}",
             "", "void tensorWeights(const float t[TENSOR_COUNT], float scale, out float w[TENSOR_COUNT]) {"]
    for i, (a, b, c) in enumerate(parts):
        assert index(b, c) == i
        lines.append(f"    w[{i}] = {multiplicity(a, b, c)}.0 * scale * t[{i}];")
    lines += ["}", ""] + evaluate(order) + [""] + gradient(order)
    lines += [""] + range_of(order, "Interval") + [""] + range_of(order, "Affine")
    if order <= 4:
        lines += [""] + entries(order)
    with open(sys.argv[2], "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
