"""Running-in of a ground and of a Gaussian surface over the sliding distance, compared with published ranges."""

from collections.abc import Iterator

import numpy as np

import lubfric

from ... import plotting
from ...check import REPORTED, Check, Figure, Item, Table
from ...kept import Run

SQ = 300e-9  # m
CELL = 2e-6  # m
SHAPES = {  # cells: two, four and eight Hertz strips long
    "quick": (360, 48),
    "default": (720, 64),
    "full": (1440, 256),
}
LENGTHS = {  # correlation lengths along and across the motion [m]
    "Gaussian": (12e-6, 12e-6),
    "ground along the motion": (60e-6, 12e-6),
}
WEAR = 1e-7  # K [-]: mild, of mixed lubrication; only K s counts
DISTANCE = 100.0  # m of sliding in the contact: as much as takes the asperity load of these surfaces nearly away
SPEED = 0.5  # m/s: the asperities carry a third of the load at first
# J. Hansen, M. Björling, R. Larsson, Sci. Rep. 10 (2020) 20386, doi:10.1038/s41598-020-77434-y, abstract: ball on disc
PUBLISHED_SQ = 0.83  # Sq after over before, at the least
PUBLISHED_SPEED = 0.10  # speed of full film after over before, at the least


def running_in(level: str, run: Run = Run()) -> Iterator[Item]:
    """Sq, lift-off speed, friction and asperity load of a steel roller of 1 GPa and 7 GPa hardness over the distance:
    first the dents, then wear by Archard's law. Published: a ball on a disc lost up to 17 % of Sq and 90 % of the
    speed at which the film is full. That is a point contact with additives, so the ranges are a bracket, not a
    target."""
    cases = {kind: (kind, SHAPES[level]) for kind in LENGTHS}
    solved = list(run.solved(cases, history))
    rows = []
    for (kind, _), columns in solved:
        table = np.array(columns)
        dented = table[:, 1]
        last = table[:, -1]
        yield Check(
            f"{kind}: Sq after over before",
            last[1],
            expected=PUBLISHED_SQ,
            tolerance=0.17,
            source="Hansen et al. 2020",
            kind=REPORTED,
        )
        ratio = last[2] / table[2, 0]
        yield Check(
            f"{kind}: lift-off speed after over before",
            ratio,
            expected=PUBLISHED_SPEED,
            tolerance=0.9,
            source="Hansen et al. 2020",
            kind=REPORTED,
        )
        for name, at in (("dents", dented), ("wear", last)):
            rows.append((kind, name, f"{at[0]:.3g}", f"{at[1]:.3f}", f"{at[2]:.3g}", f"{at[3]:.3g}", f"{at[4]:.4f}"))
        rows.append((kind, "as made", "", "1", f"{table[2, 0]:.3g}", f"{table[3, 0]:.3g}", f"{table[4, 0]:.4f}"))
    columns = ("surface", "after", "distance m", "Sq/Sq as made", "lift-off speed m/s", "F_C/F_T", "f")
    yield Table("running-in", "A roller of 1 GPa before and after running in", columns, sorted(rows))
    yield drawn([(kind, np.array(columns)) for (kind, _), columns in solved])


def history(case: tuple[str, tuple[int, int]]) -> list[list[float]]:
    """Return distance [m], Sq over that as made, lift-off speed [m/s], asperity load ratio and f: as made, after the
    dents (distance 0), and at each recorded distance."""
    kind, shape = case
    scene = roller()
    made = lubfric.generate_surface(shape, CELL, sq=SQ, correlation_length=LENGTHS[kind], acf="gaussian", seed=11)
    result = lubfric.run_in(scene, made, distance=DISTANCE, wear_coefficient=WEAR)
    wear = result.wear
    assert wear is not None
    as_made = lubfric.run_in(scene.with_(bodies={"hardness": 1e13}), made, distance=1e-9, wear_coefficient=1e-12).wear
    assert as_made is not None
    columns = []
    for first, later in (
        (0.0, wear.distance),
        (1.0, wear.sq / made.sq),
        (as_made.lift_off_speed[0], wear.lift_off_speed),
        (as_made.asperity_load_ratio[0], wear.asperity_load_ratio),
        (as_made.coefficient[0], wear.coefficient),
    ):
        columns.append([float(first), *later.tolist()])
    return columns


def roller() -> lubfric.Scene:
    """Return a steel roller of 10 mm at 1 GPa with a mineral oil at 60 °C, in rolling with a tenth of sliding."""
    return lubfric.load_scene("paper").with_(
        bodies={
            "radius": 10e-3,
            "width": 5e-3,
            "hertz_pressure": 1e9,
            "boundary_friction_coefficient": 0.12,
            "hardness": 7e9,
        },
        lubricant={
            "viscosity": 0.03,
            "pressure_viscosity_coefficient": 18e-9,
            "density_law": "dowson-higginson",
            "eyring_stress": 5e6,
        },
        motion={"entrainment_speed": SPEED, "slide_roll_ratio": 0.1},
        numerics={"model": "paper", "heat": "off", "tolerance": 0.02},
    )


def drawn(histories: list[tuple[str, np.ndarray]]) -> Figure:
    """Return Sq and lift-off speed over the distance, each over its value as made, with the published ranges."""
    canvas, (left, right) = plotting.axes(1, 2, 9.0, 4.0)
    for k, (kind, table) in enumerate(histories):
        dented = table[:, 1]
        worn = table[:, 2:]
        speed = table[2, 0]
        style = {"linestyle": ":", "color": f"C{k}", "label": f"{kind}, dents alone"}
        left.plot(worn[0], worn[1], f"C{k}{'os'[k]}-", label=kind)
        right.plot(worn[0], worn[2] / speed, f"C{k}{'os'[k]}-", label=kind)
        left.axhline(dented[1], **style)
        right.axhline(dented[2] / speed, **style)
    left.axhspan(PUBLISHED_SQ, 1.0, color="0.9", label="published: decrease by up to 17 %")
    right.axhspan(PUBLISHED_SPEED, 1.0, color="0.9", label="published: decrease by up to 90 %")
    distance = "sliding distance in the contact (m)"
    left.set(xscale="log", xlabel=distance, ylabel="Sq / Sq as made (-)", ylim=(0.5, 1.05))
    right.set(xscale="log", xlabel=distance, ylabel="lift-off speed / lift-off speed as made (-)", ylim=(0, 1.05))
    for ax in (left, right):
        ax.legend(fontsize=8, loc="lower left")
    caption = "Running-in of a roller of 1 GPa by dents (dotted) and wear, with the ranges of Hansen et al. (2020)"
    return plotting.finish("running-in", canvas, caption)
