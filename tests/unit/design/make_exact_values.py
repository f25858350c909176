"""Makes `exact_values.json`: the solved families at 30 digits, by a way that shares nothing with the package.

The constraint equations are written out in the cosines and sines of Kriikku eq 1, over angular frequency, in
seconds and amplitudes; mpmath finds their roots from the undamped formulas, raising the damping by at most
0.005 at a time and by less where the solution moves fast. Run `python make_exact_values.py` (ten minutes).
"""

import json
from pathlib import Path

TOLERANCES = ("0.02", "0.05", "0.1")
DAMPINGS = ("0", "0.05", "0.1", "0.2")
UNITY = {"um-zv": 3, "um-zvd": 5, "um-ei": 5}


def sums(mp, impulses, angular, damping):
    """C, S and their derivatives over angular frequency."""
    turn = mp.sqrt(1 - damping**2)
    terms = [(a * mp.exp(damping * angular * t), angular * turn * t, t) for a, t in impulses]
    return (
        mp.fsum(e * mp.cos(p) for e, p, _ in terms),
        mp.fsum(e * mp.sin(p) for e, p, _ in terms),
        mp.fsum(e * t * (damping * mp.cos(p) - turn * mp.sin(p)) for e, p, t in terms),
        mp.fsum(e * t * (damping * mp.sin(p) + turn * mp.cos(p)) for e, p, t in terms),
    )


def hump(mp, impulses, angular, damping, tolerance):
    """V^2 - tolerance^2 and dV^2/dw."""
    c, s, dc, ds = sums(mp, impulses, angular, damping)
    last = impulses[-1][1]
    decay = mp.exp(-2 * damping * angular * last)
    bend = 2 * (c * dc + s * ds) - 2 * damping * last * (c * c + s * s)
    return [decay * (c * c + s * s) - tolerance**2, decay * bend]


def equations(mp, family, tolerance, damping):
    """Residuals in amplitudes (unless they are +1, -1, ...), times after the first, zeros and humps."""
    count = {"ei": 3, "ei2": 4, "ei3": 5, **UNITY}[family]
    zeros = {"ei": 2, "ei2": 2, "ei3": 4, "um-ei": 2}.get(family, 0)
    mode = 2 * mp.pi

    def residuals(*unknowns):
        rest = list(unknowns)
        amplitudes = (
            [(-1) ** i for i in range(count)] if family in UNITY else [rest.pop(0) for _ in range(count)]
        )
        impulses = list(zip(amplitudes, [mp.mpf(0), *(rest.pop(0) for _ in range(count - 1))], strict=True))
        values = [] if family in UNITY else [mp.fsum(amplitudes) - 1]
        for angular in [rest.pop(0) for _ in range(zeros)]:
            values += sums(mp, impulses, angular, damping)[:2]
        if family in ("ei2", "um-zv", "um-zvd"):
            values += sums(mp, impulses, mode, damping)[: 4 if family == "um-zvd" else 2]
        for angular in [*rest, *([mode] if family in ("ei", "ei3", "um-ei") else [])]:
            values += hump(mp, impulses, angular, damping, tolerance)
        return values

    return residuals


def undamped(mp, family, v):
    """Formulas, or four digits where there are none."""
    half, period = mp.mpf(1) / 2, 2 * mp.pi
    if family == "um-zv":
        return [mp.mpf(1) / 6, mp.mpf(1) / 3]
    if family == "um-zvd":
        return [mp.mpf(digits) for digits in ("0.0895", "0.3662", "0.6430", "0.7325")]
    if family == "um-ei":
        reach = mp.sqrt(v) * mp.mpf("0.58")
        times = [mp.mpf(digits) for digits in ("0.0941", "0.3684", "0.6427", "0.7367")]
        return [*times, period * (1 - reach), period * (1 + reach)]
    if family == "ei":
        reach = mp.acos((1 - v) / (1 + v)) / mp.pi
        return [
            (1 + v) / 4,
            (1 - v) / 2,
            (1 + v) / 4,
            half,
            2 * half,
            period * (1 - reach),
            period * (1 + reach),
        ]
    if family == "ei2":
        x = mp.cbrt(v**2 * (mp.sqrt(1 - v**2) + 1))
        a = (3 * x**2 + 2 * x + 3 * v**2) / (16 * x)
        cosine = mp.sqrt((8 * a - 1) / (8 * a))
        zero, crest = (2 * mp.acos(c) / mp.pi for c in (cosine, cosine / mp.sqrt(3)))
        marks = [period * r for r in (zero, 2 - zero, crest, 2 - crest)]
        return [a, half - a, half - a, a, half, 2 * half, 3 * half, *marks]
    a, b = (1 + 3 * v + 2 * mp.sqrt(2 * (v**2 + v))) / 16, (1 - v) / 4
    c = 1 - 2 * (a + b)
    root = mp.sqrt(4 * b**2 - 16 * a * (c - 2 * a))
    low, high, crest = (
        mp.acos(u) / mp.pi for u in ((root - 2 * b) / (8 * a), (-root - 2 * b) / (8 * a), -b / (4 * a))
    )
    marks = [period * r for r in (low, high, 2 - high, 2 - low, crest, 2 - crest)]
    return [a, b, c, b, a, half, 2 * half, 3 * half, 4 * half, *marks]


def continued(mp, family, tolerance):
    """Yield damping and solution for each damping of the table."""
    damping, step, largest_step, off = mp.mpf(0), mp.mpf("0.005"), mp.mpf("0.005"), mp.mpf("0.01")
    unknowns, previous = undamped(mp, family, tolerance), None
    unknowns = list(mp.findroot(equations(mp, family, tolerance, damping), unknowns, tol=1e-40))
    for text in DAMPINGS:
        while damping < mp.mpf(text):
            ahead = min(step, mp.mpf(text) - damping)
            pairs = zip(unknowns, previous[0], strict=True) if previous else ((x, x) for x in unknowns)
            guess = [x + (x - y) * ahead / (previous[1] if previous else 1) for x, y in pairs]
            try:
                found = mp.findroot(
                    equations(mp, family, tolerance, damping + ahead), guess, tol=1e-40, maxsteps=12
                )
                near = max(abs(x - y) for x, y in zip(found, guess, strict=True)) < off
            except (ValueError, ZeroDivisionError):
                near = False
            if not near:
                step = ahead / 2
                continue
            previous, unknowns, damping = (unknowns, ahead), list(found), damping + ahead
            step = min(largest_step, step * mp.mpf("1.3"))
        yield text, unknowns


def main():
    import mpmath as mp  # only to make the table, not to test with it

    mp.mp.dps = 30
    lines = []
    for family, count in {"ei": 3, "ei2": 4, "ei3": 5, **UNITY}.items():
        for tolerance in TOLERANCES if family not in ("um-zv", "um-zvd") else ("0.05",):
            for damping, unknowns in continued(mp, family, mp.mpf(tolerance)):
                rest = [float(x) for x in unknowns]
                amplitudes = [(-1.0) ** i for i in range(count)] if family in UNITY else rest[:count]
                times_s = [0.0, *rest[0 if family in UNITY else count :][: count - 1]]
                row = {"family": family, "tolerance": float(tolerance), "damping_ratio": float(damping)}
                lines.append(json.dumps({**row, "times_s": times_s, "amplitudes": amplitudes}))
    Path(__file__).with_name("exact_values.json").write_text("[\n  " + ",\n  ".join(lines) + "\n]\n")


if __name__ == "__main__":
    main()
