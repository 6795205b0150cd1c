"""Figs. 8, 9 and 10: the cylinder of Tables 1 and 2, on an ensemble of surfaces and on a real ground one."""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure as Canvas
from scipy.ndimage import label

import lubfric
from lubfric.scene.roughness import Roughness

from ...check import AT_LEAST, AT_MOST, Check, Item, Table
from ...fem import parts
from ...kept import Run
from ...plotting import axes, image
from ...types import FloatArray, Keywords, TableRow
from .page import picture

OWN = {  # the model, the grid and the film of the paper
    **{"model": "paper", "grid": "given"},
    **{"sampling": "patch", "film_deflection": "hydrodynamic"},
}
PAPER = lubfric.load_scene("paper").with_(numerics=OWN)
ELASTIC = {"hardness": None}
SUMMITS = {"model": "summits"}
MODELS: dict[str, Keywords] = {
    "half-space, elastic": {"bodies": ELASTIC},
    "half-space, elastic-plastic": {},
    "asperities (summits), elastic": {"bodies": ELASTIC, "contact": SUMMITS},
    "asperities (summits), flat strip": {"bodies": ELASTIC, "contact": SUMMITS | {"geometry": "flat"}},
}
KINDS = (("gaussian", 8e-6), ("exponential", 8e-6))
LENGTHS = (1e-6, 2e-6, 4e-6, 8e-6, 16e-6, 32e-6)
PAPER_FILM_LOAD = 0.225  # N, at 0.001 m/s
REAL = "ground-77nm.x3p"


def scene_of(acf: str = "gaussian", length: float = 8e-6, seed: int = 1) -> lubfric.Scene:
    """Return the paper's cylinder on a generated surface. Lengths that do not fit 90 µm are cut from a longer map."""
    fits = length <= (16e-6 if acf == "gaussian" else 8e-6)
    return PAPER.with_(surface={"acf": acf, "correlation_length": length, "seed": seed, "oversize": 1 if fits else 5})


def real_surface() -> Path | None:
    """Return the measured ground surface, from LUBFRIC_SURFACES or ../shared/surfaces; None where it is not there."""
    folders = [os.environ.get("LUBFRIC_SURFACES"), Path(__file__).resolve().parents[4] / "shared" / "surfaces"]
    values = [Path(f) / REAL for f in folders if f and (Path(f) / REAL).is_file()]
    return values[0] if values else None


def friction_by_model(case: tuple[tuple[str, float, int], FloatArray, str]) -> list[list[float]]:
    """Return friction over ``speeds`` with each of `MODELS`, on a generated surface (acf, length, seed), or, with an
    ``axis`` of its file along the motion, on the ground surface scaled to 100 nm with all but the flat strip."""
    (acf, length, seed), speeds, axis = case
    scene = scene_of(acf, length, seed)
    models = list(MODELS.values())
    if axis:
        rough = Roughness(file=str(real_surface()), sq=100e-9, motion_axis=axis)
        scene = PAPER.with_(surface=rough, contact={"shape": None, "spacing": None})
        models = models[:3]
    return [lubfric.stribeck(scene.with_(**change), speeds).coefficient.tolist() for change in models]


def film_load(case: tuple[str, float, int]) -> float:
    """Return F_H [N] at 0.001 m/s on one generated surface."""
    return lubfric.friction(scene_of(*case), 0.001).film_load


def stribeck_curves(level: str, run: Run = Run()) -> Iterator[Item]:
    """Fig. 8: three models with mean and band, the real surface, and F_H at 0.001 m/s over L."""
    quick = level == "quick"
    speeds = np.geomspace(1e-3, 1.0, 5 if quick else 11)
    seeds = range(1, 3 if quick else 9)
    cases = {f"{kind}, {seed}": ((*kind, seed), speeds, "") for kind in KINDS for seed in seeds}
    if real_surface() and not quick:
        cases |= {f"ground along {axis}": ((*KINDS[0], 1), speeds, axis) for axis in "xy"}
    results = {key: np.array(row) for key, (_, row) in zip(cases, run.solved(cases, friction_by_model))}
    curves = {kind: np.array([results[f"{kind}, {seed}"] for seed in seeds]) for kind in KINDS}
    real = {key[-1]: row for key, row in results.items() if key.startswith("ground")}
    lengths = LENGTHS[2:4] if quick else LENGTHS
    counted = range(1, 3 if quick else 13)
    wanted = {f"F_H, {length} m, {seed}": ("gaussian", length, seed) for length in lengths for seed in counted}
    loads = np.array([f for _, f in run.solved(wanted, film_load)]).reshape(len(lengths), -1)
    rows: list[TableRow] = [
        (*kind, name, float(u), float(m), float(lo), float(hi))
        for kind, c in curves.items()
        for name, values in zip(MODELS, c.transpose(1, 0, 2))
        for u, m, lo, hi in zip(speeds, values.mean(0), values.min(0), values.max(0))
    ]
    rows += [
        (f"ground, motion along file {axis}", "", name, float(u), float(f), float(f), float(f))
        for axis, c in real.items()
        for name, values in zip(MODELS, c)
        for u, f in zip(speeds, values)
    ]
    table = [(a, *map(float, (row.mean(), row.std(), row.min(), row.max()))) for a, row in zip(lengths, loads)]
    plastic = {kind: c.mean(0)[1] / c.mean(0)[0] - 1 for kind, c in curves.items()}
    most = max(float(np.max(np.abs(change))) for change in plastic.values())
    headings = ("surface", "L [m]", "model", "speed [m/s]", "f mean [-]", "f lowest [-]", "f highest [-]")
    of_loads = ("L, Gaussian, 1/e [m]", "F_H mean [N]", "sd [N]", "lowest [N]", "highest [N]")
    words = "f of the plastic surface compared with the elastic one: largest change"
    source = "the paper: it changes little"
    yield Check(words, most, expected=0.05, tolerance=0.0, source=source, kind=AT_MOST)
    title = "Fig. 8: the cylinder, three contact models"
    yield Table("fig8", title, headings, rows)
    yield Table("fig8_film_load", title, of_loads, table)
    canvas = _draw_stribeck(speeds, curves, real, lengths, loads)
    yield picture("fig8", title, _agrees(speeds, most, real, table), _differs(curves), canvas)


def _draw_stribeck(
    speeds: FloatArray,
    curves: dict[tuple[str, float], np.ndarray],
    real: dict[str, np.ndarray],
    lengths: Sequence[float],
    loads: np.ndarray,
) -> Canvas:
    canvas, panels = axes(1, 3, width=12.0, height=4.2)
    for ax, ((acf, length), values) in zip(panels, curves.items()):
        for i, (name, c) in enumerate(zip(MODELS, values.transpose(1, 0, 2))):
            ax.semilogx(speeds, c.mean(0), "o^sv"[i] + "-", ms=4, color=f"C{i}", label=name)
            ax.fill_between(speeds, c.min(0), c.max(0), color=f"C{i}", alpha=0.15, lw=0)
        ax.set(title=f"{acf}, L = {length * 1e6:g} µm, {len(values)} seeds", ylim=(0, 0.1))
        ax.set(xlabel="entrainment speed U (m/s)", ylabel="friction coefficient (-)")
    for axis, c in real.items():
        name = f"ground surface, motion along its {axis}"
        panels[0].semilogx(speeds, c[1], "k--" if axis == "x" else "k:", lw=1, label=name)
    canvas.legend(*panels[0].get_legend_handles_labels(), loc="outside lower left", ncols=3, fontsize=8, frameon=False)
    ax = panels[2]
    microns = np.array(lengths) * 1e6
    ax.errorbar(microns, loads.mean(1), loads.std(1), fmt="o-", capsize=3, label="mean and standard deviation")
    ax.plot(np.repeat(microns, loads.shape[1]), loads.ravel(), ".", color="grey", ms=3, label="seeds")
    ax.axhline(PAPER_FILM_LOAD, color="C1", ls="--", label="paper, 0.225 N")
    ax.set(title="film load at 0.001 m/s", xscale="log", ylim=(0, None))
    ax.set(xlabel="correlation length (µm), Gaussian, 1/e", ylabel="$F_H$ at 0.001 m/s (N)")
    ax.legend(fontsize=8)
    return canvas


def _agrees(speeds: FloatArray, most: float, real: dict[str, np.ndarray], table: list[tuple[float, ...]]) -> str:
    inside = [f"{length * 1e6:g}" for length, _, _, low, high in table if low <= PAPER_FILM_LOAD <= high]
    below = [f"{length * 1e6:g}" for length, *_, high in table if high < PAPER_FILM_LOAD]
    bracket = f"the paper's 0.225 N is within the range of the seeds for {', '.join(inside) or 'no length'} µm"
    bracket += f", and above that range for {', '.join(below)} µm" if below else ""
    text = (
        "All models agree in full-film lubrication and at low speed. Plastic deformation lowers the friction slightly "
        f"(at most {100 * most:.1f} %), as in the paper. F_H at 0.001 m/s grows with the correlation length: "
        f"{bracket}. "
    )
    if not real:
        where = "(LUBFRIC_SURFACES, ../shared/surfaces)"
        return f"{text}The measured ground surface is missing {where}, or this is a quick run; it is skipped."
    i = int(np.argmin(np.abs(speeds - 0.01)))
    result = ", ".join(
        f"f = {c[1][i]:.4f} (asperities {c[2][i]:.4f}) with the motion along its {axis}" for axis, c in real.items()
    )
    above = " and ".join(f"{100 * np.max(c[2] / c[0] - 1):.0f} %" for c in real.values())
    return (
        f"{text}On the measured ground surface, scaled to 100 nm, at {speeds[i]:.2g} m/s: {result}. The asperity "
        f"model is up to {above} above the half-space, as in the paper."
    )


def _differs(curves: dict[tuple[str, float], np.ndarray]) -> str:
    lines = []
    for (acf, _), c in curves.items():
        mean = c.mean(0)
        off = [mean[i] / mean[0] - 1 for i in (2, 3)]
        a, b = (100 * float(v[np.argmax(np.abs(v))]) for v in off)
        lines.append(f"{acf}: {a:+.0f} % (under the cylinder), {b:+.0f} % (flat strip)")
    return (
        "In the paper the asperity curve is clearly above the other two. On generated surfaces its largest deviation "
        f"from the elastic half-space is {'; '.join(lines)}. On the flat strip, fine ripples (exponential) put the "
        "asperity model above, broad summits below. Under the cylinder, independent asperities also omit the "
        "flattening by the total contact load. The surface, the asperities and the measured friction of the paper are "
        "not published as numbers."
    )


def pressure_map(level: str, run: Run = Run()) -> Iterator[Item]:
    """Fig. 9: the elastic-plastic contact pressure at 0.001 m/s, with F_C and F_H."""
    canvas, panels = axes(1, 2, width=9.4, height=4.2)
    rows: list[tuple[str, float, float, float, float, float, int]] = []
    for ax, (acf, _) in zip(panels, KINDS):
        scene = scene_of(acf)
        point = lubfric.friction(scene, 0.001, fields=True)
        pressure = parts.contact_fields(point).pressure
        x = parts.contact(point).x * 1e6
        colours = {"cmap": "magma_r", "vmin": 0, "vmax": 6, "aspect": "auto"}
        image(canvas, ax, pressure / 1e9, (x[0], x[-1], 0, 90), "contact pressure (GPa)", **colours)
        ax.set(xlim=(-15, 15), xlabel="x, direction of motion (µm)", ylabel="y (µm)")
        ax.set_title(f"{acf} ACF: $F_C$ = {point.contact_load:.3f} N, $F_H$ = {point.film_load:.3f} N")
        for edge in (-1, 1):
            ax.axvline(edge * scene.bodies.half_width * 1e6, color="grey", lw=0.7, ls="--")
        count = int(label(pressure > 0, np.ones((3, 3)))[1])
        areas = point.real_contact_area_fraction, point.plastic_area_fraction
        rows.append((acf, point.contact_load, point.film_load, *areas, float(pressure.max()), count))
    (_, c1, h1, _, _, top1, count1), (_, c2, h2, _, plastic2, top2, count2) = rows
    yields = f" ({100 * plastic2:.2f} % of the strip)" if plastic2 else ""
    reached = (
        f"The pressure reaches the hardness of 6 GPa at some places, as in the paper{yields}." if top2 >= 6e9 else ""
    )
    fractions = ("contact area fraction of the strip", "plastic area fraction")
    headings = ("acf", "F_C [N]", "F_H [N]", *fractions, "highest pressure [Pa]", "asperity contacts in 90 um")
    hardness = parts.the(PAPER.bodies.hardness, "hardness")
    yield Check(
        "F_C + F_H, Gaussian", c1 + h1, expected=PAPER.bodies.load, tolerance=1e-9, source="load balance", unit="N"
    )
    yield Check(
        "highest pressure",
        max(top1, top2),
        expected=hardness,
        tolerance=0.0,
        source="hardness",
        kind=AT_MOST,
        unit="Pa",
    )
    title = "Fig. 9: contact pressure at 0.001 m/s"
    yield Table("fig9", title, headings, rows)
    agrees = f"Almost all of the load is carried by few, small asperity contacts: F_C = {c1:.3f} and {c2:.3f} N, F_H = "
    agrees += (
        f"{h1:.3f} and {h2:.3f} N (paper: 5.275 and 0.225 N), in {count1} and {count2} asperity contacts. {reached}"
    )
    differs = f"On the smooth (Gaussian) surface the highest pressure is {top1 / 1e9:.1f} GPa. Only the sharper "
    differs += "summits of the exponential one yield. Contact reaches beyond the Hertz strip (dashed)."
    yield picture("fig9", title, agrees, differs, canvas)


def sections(level: str, run: Run = Run()) -> Iterator[Item]:
    """Fig. 10: film h, separation h - epsilon and surface z through an asperity contact, at 0.001 and 0.3 m/s."""
    canvas, panels = axes(1, 2, width=9.4, height=4.0)
    model = lubfric.prepare(PAPER)
    rows = []
    words = []
    pressure = parts.contact_fields(lubfric.friction(model, 0.001, fields=True)).pressure
    line = int(np.argmax(pressure.max(axis=0)))  # through the highest contact pressure
    z = parts.half_space(model).heights
    weight = model.rough_contact.weight / model.rough_contact.weight.sum()
    for ax, speed in zip(panels, (0.001, 0.3)):
        point = lubfric.friction(model, speed, fields=True)
        contact = parts.contact(point)
        x = contact.x
        h = parts.film(point).film_at(contact.x)
        if contact.fields is not None:
            offset = contact.fields.approach
            gap = contact.fields.gap[:, line]
        else:
            offset = -float(weight @ z.mean(axis=1))  # Eq. (8) without contact: volume of h over z
            gap = h - offset - z[:, line]
        for values, name in ((h, "film h"), (h - offset, "separation $h_s$"), (z[:, line], "surface z")):
            ax.plot(x * 1e6, values * 1e6, label=name, lw=1.2)
        limits = {"xlim": (-20, 20), "ylim": (-0.35, 0.6 if speed < 0.01 else 2.5)}
        ax.set(title=f"U = {speed:g} m/s", xlabel="x (µm)", ylabel="height (µm)", **limits)
        ax.legend()
        columns = np.stack([np.full(x.size, speed), x, h, h - offset, z[:, line], gap], axis=1)
        rows += [tuple(row) for row in columns.tolist()]
        words.append(
            f"At {speed:g} m/s the mean film over the Hertz strip is {weight @ h * 1e9:.0f} nm, F_H = "
            f"{point.film_load:.3g} N, and {100 * point.real_contact_area_fraction:.1f} % of the strip is in contact."
        )
    yield Check(
        "smallest gap over Sq",
        min(r[5] for r in rows) / 100e-9,
        expected=0.0,
        tolerance=0.01,
        source="no penetration",
        kind=AT_LEAST,
    )
    title = "Fig. 10: film, separation and surface at 0.001 and 0.3 m/s"
    yield Table("fig10", title, ("speed [m/s]", "x [m]", "h [m]", "h_s [m]", "z [m]", "gap [m]"), rows)
    agrees = "In boundary lubrication the separation lies below the summits, in full-film lubrication above them.\n\n- "
    differs = "Where the surface is drawn above h_s, the contact deflects it: the gap h_s - z + u is zero there. The "
    differs += "displacement u has a free constant; the distance between h_s and z depends on it, the gap does not."
    yield picture("fig10", title, agrees + "\n- ".join(words) + "\n", differs, canvas)
