"""``lubfric fit``: find parameters of a scene from a measured curve, and write them to a folder."""

from __future__ import annotations

import json
import time
from pathlib import Path

from .._base import FolderLock, new_figure, plain, shown, whole_file, write_whole
from ..errors import InputError
from ..scene import Scene
from ..studies import FitResult, explain_fit, fit, in_words, read_measured
from .console import Pace, say, say_written


def run_fit(scene: Scene, arguments) -> None:
    """Say what it will cost, search, and write fitted.toml, fit.png and, last, fit.json."""
    bounds, begun, pace = _bounds(arguments.parameter), time.perf_counter(), Pace()
    columns = {"speed": arguments.speed, "slide_roll_ratio": arguments.ratio, "deviation": arguments.deviation}
    rolling = not arguments.without_rolling
    measured = read_measured(arguments.measured, coefficient=arguments.coefficient, rolling=rolling, **columns)
    say(explain_fit(scene, measured, bounds))

    def on_progress(done: int, total: int, left: float, misfit: float, values: dict[str, float]) -> None:
        if pace.due(done == 1):
            off = f"{100 * misfit:.2g} % of f" if measured.deviation is None else f"{misfit:.3g} deviations"
            best = ", ".join(f"{key} = {value:.4g}" for key, value in values.items())
            passed = f"{time.perf_counter() - begun:.0f} s, about {in_words(left)} left"
            say(f"curve {done} of about {total}: nearest so far {off} off at {best}; {passed}")

    found = fit(scene, measured, bounds, on_progress=on_progress)
    say(found.explain())
    say_written(_write(found, arguments.out), arguments.out, begun)


def _bounds(texts: list[str]) -> dict[str, tuple[float, float]]:
    found = {}
    for text in texts:
        key, _, ends = text.partition("=")
        try:
            low, high = map(float, ends.split(":"))
        except ValueError:
            raise InputError(f"--parameter {shown(text)}; write 'section.key=lowest:highest', in SI units") from None
        if key.strip() in found:
            raise InputError(f"--parameter {shown(text)}: {key.strip()} is given twice; give it once")
        found[key.strip()] = (low, high)
    return found


def _write(found: FitResult, folder: Path) -> list[str]:
    names = ("values", "intervals", "covariance", "moved_by_surface", "undetermined", "at_bounds", "validity")
    record = {name: getattr(found, name) for name in names} | {
        "parameters": list(found.parameters),
        "x": found.measured.x,
        "measured": found.measured.coefficient,
        "fitted": found.predicted,
        "report": found.report.as_dict(),
    }
    figure = new_figure(figsize=(7, 6.5))
    top, bottom = figure.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": [3, 1.5]})
    found.plot(top).set_xlabel("")
    found.plot_residuals(bottom)
    with FolderLock(folder):
        write_whole(folder / "fitted.toml", found.scene.to_toml().encode())
        with whole_file(folder / "fit.png") as part:
            figure.savefig(part, dpi=150)
        write_whole(folder / "fit.json", json.dumps(plain(record), indent=1).encode())
    return ["fitted.toml", "fit.png", "fit.json"]
