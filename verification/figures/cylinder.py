"""Figs. 8, 9 and 10: the cylinder of Tables 1 and 2, on an ensemble of surfaces and on a real ground one."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Any

import numpy as np

import lubfric
from lubfric.sharing import prepare

from .. import parts
from ..check import AT_LEAST, AT_MOST, Check
from .draw import axes, image, png
from .page import PaperFigure
from .spread import spread

PAPER = lubfric.load_scene("paper").with_(numerics={"model": "full", "sampling": "patch"})  # on the grid of the paper
MODELS: dict[str, dict[str, dict[str, Any]]] = {
    "half-space, elastic": {"bodies": {"hardness": None}},
    "half-space, elastic-plastic": {},
    "asperities (summits), elastic": {"bodies": {"hardness": None}, "contact": {"model": "summits"}},
}
FLAT_STRIP: dict[str, dict[str, Any]] = {
    "bodies": {"hardness": None},
    "contact": {"model": "summits", "geometry": "flat"},
}
LENGTHS = (1e-6, 2e-6, 4e-6, 8e-6, 16e-6, 32e-6)
PAPER_FILM_LOAD = 0.225  # N, at 0.001 m/s
REAL = "ground-77nm.x3p"


def scene_of(acf="gaussian", length=8e-6, seed=1):
    """The paper's cylinder on a generated surface. Lengths that do not fit 90 µm are cut from a longer map."""
    fits = length <= (16e-6 if acf == "gaussian" else 8e-6)
    return PAPER.with_(surface={"acf": acf, "correlation_length": length, "seed": seed, "oversize": 1 if fits else 5})


def real_surface() -> Path | None:
    """The measured ground surface, from LUBFRIC_SURFACES or ../shared/surfaces; None where it is not there."""
    root = Path(__file__).resolve().parents[2]
    folders = [os.environ.get("LUBFRIC_SURFACES"), root.parent / "shared" / "surfaces"]
    found = [Path(f) / REAL for f in folders if f and (Path(f) / REAL).is_file()]
    return found[0] if found else None


def ensemble_member(acf, length, seed, speeds) -> list[np.ndarray]:
    """Friction over ``speeds`` of one surface with each of `MODELS`, and with summits on the flat strip."""
    scene = scene_of(acf, length, seed)
    return [lubfric.stribeck(scene.with_(**change), speeds).coefficient for change in (*MODELS.values(), FLAT_STRIP)]


def film_load(acf, length, seed) -> float:
    """F_H [N] at 0.001 m/s on one generated surface."""
    return lubfric.friction(scene_of(acf, length, seed), 0.001).film_load


def real_curves(axis, speeds) -> list[np.ndarray]:
    """As `ensemble_member`, on the ground surface scaled to 100 nm. The ``axis`` of the file lies along the motion."""
    scene = PAPER.with_(
        surface=lubfric.scene.Roughness(file=str(real_surface()), sq=100e-9, motion_axis=axis),
        contact={"shape": None, "spacing": None},
    )
    return [lubfric.stribeck(scene.with_(**change), speeds).coefficient for change in MODELS.values()]


def stribeck_curves(quick: bool) -> PaperFigure:
    """Fig. 8: three models with ensemble mean and band, the real surface, and F_H at 0.001 m/s over
    correlation length."""
    speeds = np.geomspace(1e-3, 1.0, 5 if quick else 11)
    seeds = range(1, 3 if quick else 9)
    kinds = (("gaussian", 8e-6), ("exponential", 8e-6))
    found = spread(ensemble_member, [(*kind, seed, speeds) for kind in kinds for seed in seeds], quick)
    curves = {kind: np.array(found[i * len(seeds) : (i + 1) * len(seeds)]) for i, kind in enumerate(kinds)}
    file = real_surface()
    real = dict(zip("xy", spread(real_curves, [("x", speeds), ("y", speeds)], quick))) if file and not quick else {}
    counted = range(1, 3 if quick else 13)
    lengths = LENGTHS[2:4] if quick else LENGTHS
    cases = [("gaussian", length, seed) for length in lengths for seed in counted]
    loads = np.array(spread(film_load, cases, quick)).reshape(len(lengths), -1)
    picture = _draw_stribeck(speeds, curves, real, lengths, loads)
    rows: list[tuple] = [
        (*kind, name, float(u), float(m), float(lo), float(hi))
        for kind, c in curves.items()
        for name, values in zip((*MODELS, "asperities (summits), flat strip"), c.transpose(1, 0, 2))
        for u, m, lo, hi in zip(speeds, values.mean(0), values.min(0), values.max(0))
    ]
    rows += [
        ("ground, motion along file " + axis, "", name, float(u), float(f), float(f), float(f))
        for axis, c in real.items()
        for name, values in zip(MODELS, c)
        for u, f in zip(speeds, values)
    ]
    table = [
        (length, float(row.mean()), float(row.std()), float(row.min()), float(row.max()))
        for length, row in zip(lengths, loads)
    ]
    agrees, differs = _stribeck_verdict(speeds, curves, real, table)
    return PaperFigure(
        "fig8",
        "Fig. 8: the cylinder, three contact models",
        agrees,
        differs,
        picture,
        {
            "fig8": (
                ("surface", "L [m]", "model", "speed [m/s]", "f mean [-]", "f lowest [-]", "f highest [-]"),
                rows,
            ),
            "fig8_film_load": (
                ("L, Gaussian, 1/e [m]", "F_H mean [N]", "sd [N]", "lowest [N]", "highest [N]"),
                table,
            ),
        },
        (
            Check(
                "f of the plastic surface against the elastic one: largest change",
                max(float(np.max(np.abs(c.mean(0)[1] / c.mean(0)[0] - 1))) for c in curves.values()),
                0.05,
                0.0,
                "the paper: plastic deformation changes little",
                AT_MOST,
            ),
        ),
    )


def _draw_stribeck(speeds, curves, real, lengths, loads) -> bytes:
    canvas, panels = axes(1, 3, width=12.0, height=4.2)
    for ax, ((acf, length), values) in zip(panels, curves.items()):
        for i, (name, c) in enumerate(zip((*MODELS, "asperities, flat strip"), values.transpose(1, 0, 2))):
            ax.semilogx(speeds, c.mean(0), "o^sv"[i] + "-", ms=4, color=f"C{i}", label=name)
            ax.fill_between(speeds, c.min(0), c.max(0), color=f"C{i}", alpha=0.15, lw=0)
        ax.set(
            title=f"{acf}, L = {length * 1e6:g} µm, {len(values)} seeds",
            xlabel="entrainment speed U (m/s)",
            ylabel="friction coefficient (-)",
            ylim=(0, 0.1),
        )
    for axis, c in real.items():
        panels[0].semilogx(
            speeds,
            c[1],
            "k" + ("--" if axis == "x" else ":"),
            lw=1,
            label=f"ground surface, motion along its {axis}",
        )
    canvas.legend(*panels[0].get_legend_handles_labels(), loc="outside lower left", ncols=3, fontsize=8, frameon=False)
    ax = panels[2]
    ax.errorbar(np.array(lengths) * 1e6, loads.mean(1), loads.std(1), fmt="o-", capsize=3, label="mean and sd")
    ax.plot(
        np.repeat(np.array(lengths) * 1e6, loads.shape[1]),
        loads.ravel(),
        ".",
        color="grey",
        ms=3,
        label="seeds",
    )
    ax.axhline(PAPER_FILM_LOAD, color="C1", ls="--", label="paper: 0.225 N")
    ax.set(
        xscale="log",
        xlabel="correlation length (µm), Gaussian, 1/e",
        ylabel="$F_H$ at 0.001 m/s (N)",
        ylim=(0, None),
        title="film load at 0.001 m/s",
    )
    ax.legend(fontsize=8)
    return png(canvas)


def _stribeck_verdict(speeds, curves, real, table) -> tuple[str, str]:
    change = {kind: (c.mean(0)[1] / c.mean(0)[0] - 1) for kind, c in curves.items()}
    most = max(float(np.max(np.abs(v))) for v in change.values())
    off = {
        kind: [100 * float(v[np.argmax(np.abs(v))]) for v in (c.mean(0)[i] / c.mean(0)[0] - 1 for i in (2, 3))]
        for kind, c in curves.items()
    }
    lines = "; ".join(
        f"{acf}: {a:+.0f} % (under the cylinder), {b:+.0f} % (flat strip)" for (acf, _), (a, b) in off.items()
    )
    inside = [f"{length * 1e6:g}" for length, mean, sd, low, high in table if low <= PAPER_FILM_LOAD <= high]
    below = [f"{length * 1e6:g}" for length, _, _, _, high in table if high < PAPER_FILM_LOAD]
    means = ", ".join(f"{mean:.3f} ± {sd:.3f} N at {length * 1e6:g} µm" for length, mean, sd, _, _ in table)
    bracket = f"0.225 N lies inside the spread for {', '.join(inside) or 'none'} µm"
    bracket += f" and above all of {', '.join(below)} µm" if below else ""
    agrees = (
        "All models meet in full film and at low speed. Plastic deformation lowers the friction slightly "
        f"(at most {100 * most:.1f} %), as the paper finds. F_H at 0.001 m/s on generated surfaces of 100 "
        f"nm: {means}; {bracket}. "
        + (
            f"On the real ground surface, scaled to 100 nm: {_real_words(speeds, real)}"
            if real
            else "The real ground surface was not found (LUBFRIC_SURFACES, ../shared/surfaces) or left out of a "
            "quick run, and is skipped."
        )
    )
    differs = (
        "The paper's asperity curve lies clearly above the other two. On generated surfaces its largest "
        f"deviation from the elastic half-space is {lines}. Which way it goes depends on the roughness. On the flat "
        "strip, fine ripples (exponential) put the asperity model above, broad summits below. Under the cylinder, "
        "independent asperities also miss the flattening by the whole contact load: they carry it on a shorter "
        "strip. The paper's surface, its definition of an asperity and the measured friction in numbers are not "
        "published. So none of them is drawn."
    )
    return agrees, differs


def _real_words(speeds, real) -> str:
    i = int(np.argmin(np.abs(speeds - 0.01)))
    return (
        ", ".join(
            f"f = {c[1][i]:.4f} (elastic {c[0][i]:.4f}, asperities {c[2][i]:.4f}) with the motion along its {axis}"
            for axis, c in real.items()
        )
        + f" at {speeds[i]:.2g} m/s; there the asperity model is above the half-space by up to "
        + " and ".join(f"{100 * np.max(c[2] / c[0] - 1):.0f} %" for c in real.values())
        + ", as in the paper."
    )


def pressure_map(quick: bool) -> PaperFigure:
    """Fig. 9: the elastic-plastic contact pressure at 0.001 m/s, with F_C and F_H."""
    canvas, panels = axes(1, 2, width=9.4, height=4.2)
    rows, found = [], []
    hardness = parts.the(PAPER.bodies.hardness, "hardness")
    for ax, acf in zip(panels, ("gaussian", "exponential")):
        scene = scene_of(acf)
        point = lubfric.friction(scene, 0.001, fields=True)
        pressure = parts.contact_fields(point).pressure
        x = parts.balance(point).contact.x * 1e6
        image(
            canvas,
            ax,
            pressure / 1e9,
            (x[0], x[-1], 0, 90),
            "contact pressure (GPa)",
            cmap="magma_r",
            vmin=0,
            vmax=6,
            aspect="auto",
        )
        ax.set(
            xlim=(-15, 15),
            xlabel="x, direction of motion (µm)",
            ylabel="y (µm)",
            title=f"{acf} ACF: $F_C$ = {point.contact_load:.3f} N, $F_H$ = {point.film_load:.3f} N",
        )
        for edge in (-1, 1):
            ax.axvline(edge * scene.bodies.half_width * 1e6, color="grey", lw=0.7, ls="--")
        spots = _spots(pressure)
        rows.append(
            (
                acf,
                point.contact_load,
                point.film_load,
                point.real_contact_area_fraction,
                point.plastic_area_fraction,
                float(pressure.max()),
                spots,
            )
        )
        found.append(point)
    return PaperFigure(
        "fig9",
        "Fig. 9: contact pressure at 0.001 m/s",
        "Almost all of the load is carried by few, small contact spots: F_C = "
        f"{found[0].contact_load:.3f} and {found[1].contact_load:.3f} N, F_H = {found[0].film_load:.3f} and "
        f"{found[1].film_load:.3f} N (paper: 5.275 and 0.225 N), {rows[0][6]} and {rows[1][6]} spots. "
        + (
            "The pressure reaches the hardness of 6 GPa at some spots, as in the paper"
            + (f" ({100 * rows[1][4]:.2f} % of the strip)." if rows[1][4] else ".")
            if rows[1][5] >= 6e9
            else ""
        ),
        "The paper's surface is not published. On the smooth (Gaussian) surrogate the highest pressure is "
        f"{rows[0][5] / 1e9:.1f} GPa. Only the sharper summits of the exponential one yield. The dashed lines are the "
        "Hertz strip, over which Eq. (8) is balanced. Contact reaches beyond it, because summits stand up to three "
        "Sq above the mean plane.",
        png(canvas),
        {
            "fig9": (
                (
                    "acf",
                    "F_C [N]",
                    "F_H [N]",
                    "contact area fraction of the strip",
                    "plastic area fraction",
                    "highest pressure [Pa]",
                    "contact spots in 90 um",
                ),
                rows,
            )
        },
        (
            Check("F_C + F_H, Gaussian", rows[0][1] + rows[0][2], PAPER.bodies.load, 1e-9, "load balance", unit="N"),
            Check("highest pressure", max(r[5] for r in rows), hardness, 0.0, "hardness", AT_MOST, "Pa"),
        ),
    )


def _spots(pressure) -> int:
    from scipy.ndimage import label

    return int(label(pressure > 0, np.ones((3, 3)))[1])


def sections(quick: bool) -> PaperFigure:
    """Fig. 10: film h, separation h - epsilon and surface z through a contact spot, at 0.001 and 0.3 m/s."""
    canvas, panels = axes(1, 2, width=9.4, height=4.0)
    model, rows, words = prepare(PAPER), [], []
    pressure = parts.contact_fields(lubfric.friction(model, 0.001, fields=True)).pressure
    line = int(np.argmax(pressure.max(axis=0)))  # through the highest contact pressure
    z = parts.half_space(model).heights
    for ax, speed in zip(panels, (0.001, 0.3)):
        point = lubfric.friction(model, speed, fields=True)
        closure, film = parts.balance(point).contact, parts.balance(point).film
        x, h = closure.x, film.film_at(closure.x)
        weight = model.contact.weight / model.contact.weight.sum()
        if closure.contact is not None:
            offset, gap = closure.contact.approach, closure.contact.gap[:, line]
        else:
            offset = -float(weight @ z.mean(axis=1))  # Eq. (8) without contact: volume of h over z
            gap = h - offset - z[:, line]
        for values, label in ((h, "film h"), (h - offset, "separation $h_s$"), (z[:, line], "surface z")):
            ax.plot(x * 1e6, values * 1e6, label=label, lw=1.2)
        ax.set(
            title=f"U = {speed:g} m/s",
            xlabel="x (µm)",
            ylabel="height (µm)",
            xlim=(-20, 20),
            ylim=(-0.35, 0.6 if speed < 0.01 else 2.5),
        )
        ax.legend()
        rows += [
            (speed, float(a), float(b), float(b - offset), float(c), float(g))
            for a, b, c, g in zip(x, h, z[:, line], gap)
        ]
        words.append(
            f"At {speed:g} m/s the film is {weight @ h * 1e9:.0f} nm over the strip, F_H = {point.film_load:.3g} N, "
            f"and {100 * point.real_contact_area_fraction:.1f} % of it are in contact."
        )
    return PaperFigure(
        "fig10",
        "Fig. 10: film, separation and surface at 0.001 and 0.3 m/s",
        "In boundary lubrication the separation cuts through the summits. In full film it clears them.\n\n- "
        + "\n- ".join(words)
        + "\n",
        "h_s has the form of h, as in the paper, and is offset by epsilon. Where the surface is drawn above h_s, the "
        "contact deflects it: the gap h_s - z + u is zero there (last column of the table). In this line-contact "
        "kernel u is known up to a constant. So the distance between h_s and z depends on that constant, and the gap "
        "does not. The section is one of the generated surface of the built-in scene; the paper's is not published.",
        png(canvas),
        {"fig10": (("speed [m/s]", "x [m]", "h [m]", "h_s [m]", "z [m]", "gap [m]"), rows)},
        (Check("smallest gap over Sq", min(r[5] for r in rows) / 100e-9, 0.0, 0.01, "no penetration", AT_LEAST),),
    )


def mean_pressure_check() -> float:
    """Mean Hertz pressure [Pa] of Tables 1 and 2 (the paper: 102 MPa)."""
    b = PAPER.bodies
    return b.load / (2 * b.width * math.sqrt(8 * b.load / b.width * b.radius / (math.pi * b.e_prime)))
