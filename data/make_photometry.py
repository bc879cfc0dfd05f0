#!/usr/bin/env python3
"""Writes the luminaire files of data/photometry from formulas (data/README.md). Deterministic, standard library only."""
import math
import pathlib

HERE = pathlib.Path(__file__).resolve().parent / "photometry"


def lm63(name, title, intensity, verticals, horizontals, lumens, kind=1, first="IESNA:LM-63-2002", tilt="NONE",
         multiplier=1.0, ballast=1.0):
    """intensity(v, h) in cd, degrees; multiplier and ballast factor are taken out of the printed numbers."""
    lines = [first, "[TEST] by formula, data/make_photometry.py", "[MANUFAC] Lumenwalk", f"[LUMINAIRE] {title}",
             f"TILT={tilt}"]
    lines.append(f"1 {lumens} {multiplier:g} {len(verticals)} {len(horizontals)} {kind} 2 0.1 0.1 0")
    lines.append(f"{ballast:g} 1 10")
    lines.append(" ".join(f"{v:g}" for v in verticals))
    lines.append(" ".join(f"{h:g}" for h in horizontals))
    for h in horizontals:
        lines.append(" ".join(f"{intensity(v, h) / multiplier / ballast:.3f}" for v in verticals))
    (HERE / name).write_text("\r\n".join(lines) + "\r\n")


def eulumdat(name, title, intensity, symmetry, planes, verticals, given, lumens, ratio, kelvin):
    """intensity(g, c) in cd per 1000 lm of the lamps; `given` are the planes written."""
    head = ["Lumenwalk", "1", str(symmetry), str(len(planes)), f"{360 / len(planes):g}", str(len(verticals)),
            f"{verticals[1] - verticals[0]:g}", "by formula", title, "0", name, "2026", "100", "100", "50", "90", "90",
            "0", "0", "0", "0", "100", f"{ratio:.1f}", "1.0", "0", "1", "1", "LED", f"{lumens}", f"{kelvin} K", "90",
            "10"]
    head += ["0.5"] * 10 + [f"{c:g}" for c in planes] + [f"{g:g}" for g in verticals]
    rows = [f"{intensity(g, c):.3f}" for c in given for g in verticals]
    (HERE / name).write_text("\r\n".join(head + rows) + "\r\n")


def cosine(degrees):
    return max(math.cos(math.radians(degrees)), 0.0)


def main():
    HERE.mkdir(exist_ok=True)
    # Power-cosine downlight: I = 1000 cos^8 g, flux 2 pi 1000 / 9 lm.
    lm63("downlight.ies", "downlight, I = 1000 cos^8", lambda v, h: 1000 * cosine(v) ** 8, [2.5 * i for i in range(37)],
         [0], 1000, multiplier=2, ballast=0.5)
    # Batwing: I = 300 (cos g + 3 sin^2 g cos g (1 + cos 2C) / 2): two wings in the C0-C180 plane.
    lm63("batwing.ies", "batwing", lambda v, h: 300 * (cosine(v) + 3 * math.sin(math.radians(v)) ** 2 * cosine(v) *
                                                      (1 + math.cos(2 * math.radians(h))) / 2),
         [2.5 * i for i in range(37)], [5 * i for i in range(19)], 2000, first="IES:LM-63-2019")
    # Flood light, type B: I = 5000 cos^6 H cos^4 V, in the frame of a lying polar axis.
    lm63("flood.ies", "flood", lambda v, h: 5000 * cosine(h) ** 6 * cosine(v) ** 4, [5 * i for i in range(-18, 19)],
         [5 * i for i in range(-18, 19)], -1, kind=2, first="IESNA:LM-63-1995")
    # Wall washer: I per 1000 lm = k cos g (1 + 0.8 sin g cos C), symmetric about the plane C0-C180; flux k pi.
    k = 1000 * 0.8 / math.pi
    eulumdat("washer.ldt", "wall washer", lambda g, c: k * cosine(g) * (1 + 0.8 * math.sin(math.radians(g)) *
                                                                      math.cos(math.radians(c))),
             2, [15 * i for i in range(24)], [2.5 * i for i in range(37)], [15 * i for i in range(13)], 1500, 80, 3000)


main()
