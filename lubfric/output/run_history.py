"""``lubfric run`` on a scene whose motion, load or lubricant changes in time, and the figures of such a run."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np

from .._base import BLUE, GREEN, GREY, RED, load_shares, new_figure, read_table, table_bytes, whole_file
from ..errors import ConvergenceError, LubfricError, ValidityError
from ..scene import Scene
from ..sharing import in_a_cell
from ..studies import fingerprint
from ..time import STATE, UNITS, TransientResult, friction_over_time, time_scale, transient
from .console import Pace, keeping, say
from .fields import npz_bytes
from .run_folder import CHECKPOINT, RunFolder, read_record, ready, run_folder

FRAMES = 150  # of an animation at most, spread over the run


def run_history(scene: Scene, arguments) -> None:
    """Compute and write history.csv, history.png, fields.npz (with ``arguments.animation``: animation.gif) and, last,
    result.json to ``arguments.out``.

    The scene is checked and made ready before the folder is touched, and the results of an earlier run stay until those
    of this one are there. An interrupted run continues from its folder checkpoint. A failed run writes what it has, and
    then raises `ConvergenceError`.
    """
    begun, reached, pace, out = time.perf_counter(), 0.0, Pace(), arguments.out
    failure: LubfricError | None = None
    prepared = ready(scene)

    def on_step(now, duration, row):
        nonlocal reached
        reached = now
        if row is not None and pace.due(now >= duration):
            say(
                f"t = {now:<8.5g} of {duration:g} s: U = {row['entrainment_speed']:<9.4g} m/s, f = "
                f"{row['coefficient']:<8.5f}, F_C = {row['contact_load']:<9.4g} N, F_H = {row['film_load']:<9.4g} N, "
                f"h_min = {row['min_film'] * 1e9:<6.4g} nm (step {row['steps']:.0f})"
            )

    def kept() -> str:
        return f"interrupted; the state at t = {reached:.5g} s is kept in {out}: the same command goes on from there"

    with keeping(kept), run_folder(out, fingerprint(prepared), begun) as folder:
        checkpoint = out / CHECKPOINT
        if (checkpoint / STATE).is_file():
            say(f"going on from {checkpoint}")
        try:
            result = transient(prepared, checkpoint=checkpoint, on_step=on_step)
        except (ConvergenceError, ValidityError) as error:
            if error.result is None:
                raise
            result, failure = error.result, error
        _write(folder, scene, result, arguments.animation)
        folder.finish(folder.record(prepared, result))
    if failure:
        raise failure


def _write(folder: RunFolder, scene: Scene, result: TransientResult, animation: bool) -> None:
    """All but the result."""
    folder.clear()
    columns = {f"{name} [{unit}]": result.columns[name] for name, unit in UNITS.items()}
    told = {"validity": [in_a_cell(entries) for entries in result.entries]}
    folder.write("history.csv", table_bytes(columns | told))
    fields = {"time": result.time, "x": result.x, "pressure": result.pressure, "film_thickness": result.film_thickness}
    folder.write("fields.npz", npz_bytes(fields))
    if result.time.size > 1:
        folder.draw("history.png", plot_history, result.columns, scene.name)
    if animation:
        folder.make("animation.gif", animate, result, scene.bodies.half_width)


def plot_again(arguments) -> None:
    """Draw history.png of ``arguments.folder`` again."""
    columns, record = read_table(arguments.folder / "history.csv"), read_record(arguments.folder)
    with whole_file(arguments.folder / "history.png") as part:
        plot_history(part, columns, record["scene"]["name"])


def plot_history(path: Path, columns: dict[str, np.ndarray], title: str) -> None:
    """Speed and load, film, shares of the load, and friction over time, from the columns of history.csv."""
    c = columns
    t = c["time"] * time_scale(c["time"][-1])[0]
    figure = new_figure(figsize=(7.5, 9))
    first, second, third, fourth = figure.subplots(4, 1, sharex=True)
    first.plot(t, c["entrainment_speed"], color=BLUE)
    first.axhline(0.0, color=GREY, lw=0.6)
    first.set_ylabel("entrainment speed U (m/s)", color=BLUE)
    first.set_title(title)
    load = first.twinx()
    load.plot(t, c["load"], color=RED, lw=1)
    load.set_ylim(0.0, 1.15 * c["load"].max())
    load.set_ylabel("load $F_T$ (N)", color=RED)
    second.plot(t, c["central_film"] * 1e9, color=BLUE, label="central film")
    second.plot(t, c["min_film"] * 1e9, color=GREEN, label="minimum film")
    second.plot(t, c["mean_gap"] * 1e9, color=GREY, lw=0.9, ls="--", label="mean gap over A")
    second.set_ylabel("film thickness (nm)")
    second.set_ylim(bottom=0.0)
    second.legend(frameon=False, ncols=3, fontsize=8)
    load_shares(third, t, c["contact_load"] / c["load"])
    third.legend(frameon=False, ncols=2, fontsize=8)
    error = c.get("sampling_error", np.zeros(0))
    if np.any(error > 0):
        low, high = (c["coefficient"] * (1 + sign * 2 * error) for sign in (-1, 1))
        fourth.fill_between(t, low, high, color=BLUE, alpha=0.2, lw=0, label="2 standard errors: finite surface")
    friction_over_time(fourth, c)
    fourth.set_xlim(t[0], t[-1])
    figure.savefig(path, dpi=150)


def animate(path: Path, result: TransientResult, half_width: float) -> None:
    """GIF of pressure and film along the contact over time (Pillow writer)."""
    from matplotlib.animation import FuncAnimation, PillowWriter

    count, x, h = result.time.size, result.x, result.film_thickness
    radius = (x[0] ** 2 - x[1] ** 2) / (2.0 * (h[0, 0] - h[0, 1]))  # of the undeformed gap, far out
    reach = 3.0 * max(half_width, float(np.sqrt(h.min(axis=1).max() * 2.0 * radius)))
    seen = np.abs(x) <= reach
    x, thick = x[seen] * 1e6, h[:, seen] * 1e9
    figure = new_figure(figsize=(7, 4.5))
    top = figure.subplots()
    bottom = top.twinx()
    (pressure,) = top.plot([], [], color=RED)
    (film,) = bottom.plot([], [], color=BLUE)
    top.set(xlim=(x[0], x[-1]), ylim=(0.0, 1.1 * result.pressure.max() / 1e6), xlabel="x (µm)")
    top.set_ylabel("film pressure (MPa)", color=RED)
    bottom.set_ylim(0.0, 1.5 * max(result.central_film.max() * 1e9, np.median(thick.min(axis=1)) * 2.0))
    bottom.set_ylabel("film thickness (nm)", color=BLUE)
    scale, unit = time_scale(result.time[-1])

    def draw(i):
        pressure.set_data(x, result.pressure[i, seen] / 1e6)
        film.set_data(x, thick[i])
        speed, friction = result.entrainment_speed[i], result.coefficient[i]
        moment = f"t = {result.time[i] * scale:.4g} {unit},  U = {speed:.3g} m/s,  f = {friction:.4f}"
        top.set_title(moment, fontsize=10)
        return pressure, film

    draw(0)
    figure.canvas.draw()
    figure.set_layout_engine("none")  # laid out once: the frames must not jump, and are drawn faster
    frames = np.unique(np.linspace(0, count - 1, min(FRAMES, count)).round().astype(int)).tolist()
    FuncAnimation(figure, draw, frames=frames, blit=False).save(path, writer=PillowWriter(fps=15), dpi=80)
