"""Pictures of the contact at one speed (Akchurin et al. 2015, Figs. 8-10)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from .._base import figures
from ..models import ContactFields
from ..units import worded
from .picture_options import CONTACT_PANELS, INCH, PictureOptions

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import LayoutEngine

    from ..estimate import FrictionResult
    from ..models.shared import Prepared


# Choices, by looking at the figures.
MOST_DRAWN_LENGTH = 3.0  # times as long along y as along x: no more is drawn whole
SLENDER_PICTURE = 1.5  # times as long along y as along x: a narrow picture
PANEL_GAP = 0.15  # inch between panels, so that a colour bar does not touch the next panel
LARGEST_COLOURED = 0.98  # quantile of the loaded cells at which the colours may end
LEAST_COLOURED = 0.01  # of the largest value: what a loaded cell has at least
SPOT_ABOVE = 1.25  # ratio of the largest value to that quantile from which they end there
MAP_HEIGHT = 4.6  # inch: of a map of fields, where its width allows it
MAP_WIDTHS = (1.6, 3.0)  # inch: of a map of fields
MAP_BESIDE = 1.3  # inch beside a map: its bar of colours and the labels
MAP_ABOVE = 1.0  # inch above and below a map: title and labels
PICTURED_HALF_WIDTHS = 4.0  # half-widths of the Hertz strip around which a gap is drawn
INLET_PRESSURE = 0.01  # of the largest mean pressure along the line, from which on an inlet is drawn
LEAST_HEIGHT = 4.0  # inch: height of both beside each other across a page, with the bar and the key above them
SECTION_SIZE = (5.5, 5.0)  # inch: of a map of the contact pressure, and of the section beside it
MAP_IN_SECTION = 4.3  # inch: width of a map of the contact pressure beside a section
ABOVE_SECTION = 1.7  # inch above and below these: title, key and labels
ASIDE = 0.6  # inch beside the maps of a picture whose width is chosen: labels of y
CLOSE_GAP = 0.2  # of `PANEL_GAP`, between the panels of a picture whose width is chosen

# Choices, by looking at the figures.
PANEL_RATIO = 0.9  # height over width of a panel of a narrow picture
ABOVE_NARROW_MAP = 0.35  # of its width, above and below the map of a narrow picture: title, bar of colours, labels
STACKED_RATIO = 0.5  # height over width of a map, below which maps are below each other
STACKED_WIDTH = 6.5  # inch: of a map of these
STACKED_ABOVE = 0.45  # inch above and below each of them: labels
ABOVE_BAR = 1.3  # inch above and below such maps: title, bar of colours, labels


@dataclass(frozen=True, kw_only=True)
class DrawnContact:
    """The contact at one speed, as its picture shows it.

    Attributes
    ----------
    speed : entrainment speed [m/s]
    half_width : of the Hertz strip [m]; NaN without one
    fields : of one solve; None: there is no field of a contact
    has_film : whether a smooth film was solved
    """

    speed: float
    half_width: float
    fields: ContactFields | None
    has_film: bool


def drawn_contact(prepared: Prepared, point: FrictionResult) -> DrawnContact:
    """Return what a picture shows of ``point``, an answer to the scene of ``prepared``."""
    return DrawnContact(
        speed=point.speed,
        half_width=prepared.scene.bodies.half_width,
        fields=point.fields,
        has_film=point.smooth_film is not None,
    )


@figures.styled
def plot_contact(path: Path, contact: DrawnContact, options: PictureOptions = PictureOptions()) -> None:
    """Draw the fields of a ``contact``: of the deterministic model pressure, gap and shear stress from above; of load
    sharing the contact pressure from above, and film and surfaces on a section."""
    if contact.fields is not None and contact.fields.pressure_includes_film:
        figure = _deterministic_picture(contact, options)
    else:
        figure = _two_pressures(contact, options)
    figures.fit_labels(figure)
    figures.cut_height(figure)
    figure.savefig(path)


def compared_contact(prepared: Prepared, point: FrictionResult) -> DrawnContact:
    """Return what a picture shows of the load-sharing model with which ``point`` is compared."""
    films = [kept.smooth_film for kept in point.details.values() if kept is not None]
    has_film = any(film is not None for film in films)
    return replace(drawn_contact(prepared, point), fields=point.compared_fields, has_film=has_film)


def _deterministic_picture(contact: DrawnContact, options: PictureOptions) -> Figure:
    """Draw pressure, gap and shear around the Hertz strip, from above, in the part with the highest pressure."""
    from matplotlib.colors import LogNorm

    fields = contact.fields
    assert fields is not None  # of the deterministic model
    near = _near(fields, contact.half_width)
    x = fields.x[near]
    y = fields.y
    part = drawn_part(x, y, int(fields.pressure[near].max(axis=0).argmax()))
    panels = [name for name in CONTACT_PANELS if name in options.panels] or [*CONTACT_PANELS]
    count = len(panels)
    size = (
        size_of_maps(x, y[part], count) if options.width is None else _size_below_bars(x, y[part], count, options.width)
    )
    figure = figures.new_figure(figsize=size, layout=_layout(options, compress=True))
    stacked = options.width is None and are_stacked(x, y[part])
    rows = count if stacked else 1
    shown: dict[str, tuple[str, str, np.ndarray, str]] = {
        "pressure": ("pressure", "Pa", fields.pressure, "magma_r"),
        "gap": ("gap", "m", fields.gap, "viridis"),
        "shear": ("shear" if options.is_narrow else "isothermal shear stress", "Pa", fields.shear, "cividis"),
    }
    for axes, panel in zip(
        figure.subplots(rows, count // rows, sharex=stacked, sharey=True, squeeze=False).flat, panels
    ):
        label, unit, field, colours = shown[panel]
        values, name = figures.in_unit_for(field[near][:, part], unit)
        scale: dict[str, Any] = {"norm": LogNorm()} if panel == "gap" else _robust_scale(values)
        figures.field_image(
            axes, x, y[part], values, colours, f"{label} ({name})", place=_place_of_bar(options), **scale
        )
        _hertz_strip(axes, contact.half_width, options)
        axes.label_outer()
    solve = "" if options.is_narrow else f"; {fields.solve}{part_in_words(y, part, 'this strip')}"
    heat = "; f includes heat, the shear stress does not" if "shear" in panels and not options.is_narrow else ""
    _title(figure, f"U = {contact.speed:.4g} m/s{solve}{heat}; dashed: Hertz strip", options)
    return figure


def _robust_scale(values: np.ndarray) -> dict[str, Any]:
    """Return the end of the colours of ``values``, where a few cells of the contact are far above the others: their
    quantile `LARGEST_COLOURED`. The bar of colours has an arrow there."""
    high = float(values.max())
    carries = values[values > LEAST_COLOURED * high]
    most = float(np.quantile(carries, LARGEST_COLOURED)) if carries.size else high
    return {"vmin": min(0.0, float(values.min())), "vmax": most, "extend": "max"} if high > SPOT_ABOVE * most else {}


def _near(fields: ContactFields, half_width: float) -> np.ndarray:
    """Return which of the places along x are drawn: those around the Hertz strip, and the inlet from where its pressure
    is `INLET_PRESSURE` of the largest."""
    usual = PICTURED_HALF_WIDTHS * half_width
    mean = fields.pressure.mean(axis=1)
    carries = fields.x[mean >= INLET_PRESSURE * mean.max()]
    first = min(-usual, float(carries.min(initial=-usual)))
    return (fields.x >= first) & (fields.x <= usual)


def _layout(options: PictureOptions, *, compress: bool = False) -> LayoutEngine:
    """Return the engine that lays out panels with room between them."""
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    gap = PANEL_GAP if options.width is None else CLOSE_GAP * PANEL_GAP
    return ConstrainedLayoutEngine(compress=compress, w_pad=gap)


def _place_of_bar(options: PictureOptions) -> Literal["right", "top"]:
    """Return where the bar of colours of a map is: above it where the width of the picture is chosen."""
    return "right" if options.width is None else "top"


def _title(figure: Figure, text: str, options: PictureOptions) -> None:
    if not options.has_title:
        return
    figure.suptitle(text, fontsize=None if options.is_narrow else 10, wrap=True)


def size_of_maps(x: np.ndarray, y: np.ndarray, count: int) -> tuple[float, float]:
    """Return width and height [inch] of a figure with so many maps of x and y beside each other, or wide ones below
    each other (`are_stacked`), each with its bar of colours, without room that nothing fills."""
    ratio = _drawn_ratio(x, y)
    if are_stacked(x, y):
        return STACKED_WIDTH + MAP_BESIDE, count * (STACKED_WIDTH * ratio + STACKED_ABOVE) + MAP_ABOVE - STACKED_ABOVE
    width = float(np.clip(MAP_HEIGHT / ratio, *MAP_WIDTHS))
    return count * (width + MAP_BESIDE), width * ratio + MAP_ABOVE


def _size_below_bars(x: np.ndarray, y: np.ndarray, count: int, width: float) -> tuple[float, float]:
    """Return width and height [inch] of a figure of a given ``width`` [m] with so many maps beside each other, each
    below its bar of colours."""
    whole = width / INCH
    return whole, (whole - ASIDE) / count * _drawn_ratio(x, y) + ABOVE_BAR


def are_stacked(x: np.ndarray, y: np.ndarray) -> bool:
    """Return whether maps of x and y are so wide that they are below each other."""
    return _drawn_ratio(x, y) < STACKED_RATIO


def _drawn_ratio(x: np.ndarray, y: np.ndarray) -> float:
    """Return the height over the width of a map of cells at x and y; one too slender is not drawn to scale."""
    (length, width) = (np.ptp(axis) * axis.size / (axis.size - 1) for axis in (y, x))
    ratio = float(length / width)
    is_to_scale = 1 / figures.SLENDER_MAP <= ratio <= figures.SLENDER_MAP
    return ratio if is_to_scale else MAP_HEIGHT / MAP_WIDTHS[1]


def drawn_part(x: np.ndarray, y: np.ndarray, row: int) -> slice:
    """Return the rows of ``y`` to draw: all, or of long strips those around ``row``, twice as long as ``x`` is wide."""
    across = x[-1] - x[0]
    if y[-1] < MOST_DRAWN_LENGTH * across:
        return slice(None)
    first = min(max(y[row] - across, 0.0), y[-1] - 2 * across)
    return slice(int(np.searchsorted(y, first)), int(np.searchsorted(y, first + 2 * across)) + 1)


def part_in_words(y: np.ndarray, part: slice, whole: str) -> str:
    """Return which part of the ``whole`` along the line is drawn, as text; "" for all of it."""
    step = 1e6 * (y[1] - y[0])
    return "" if part == slice(None) else f"; {step * y[part].size:.0f} of {step * y.size:.0f} µm of {whole}"


def _two_pressures(contact: DrawnContact, options: PictureOptions) -> Figure:
    """Draw a map of the contact pressure; beside it, or in a narrow picture below it, film and surfaces on a section
    through the highest pressure.

    The section shows what the paper's Fig. 10 shows: the smooth film h, the separation h_s = h - epsilon as the
    counterface, and the rough surface, deformed (z - u) and undeformed (z). epsilon and u are known up to one constant.
    It is chosen so that u has zero mean over the section.
    """
    fields = contact.fields
    touching = fields is not None and bool(fields.pressure.any())
    row = 0 if fields is None else int(fields.pressure.max(axis=0).argmax())
    if fields is not None and not touching:
        row = fields.y.size // 2
    in_section = contact.has_film and fields is not None
    panels = [touching or not in_section, in_section]
    part = slice(None)
    slender = False
    wide = False
    if fields is not None and touching:
        part = drawn_part(fields.x, fields.y, row)
        slender = bool(np.ptp(fields.y[part]) > SLENDER_PICTURE * np.ptp(fields.x))
        wide = not options.is_narrow and are_stacked(fields.x, fields.y[part])
    ratio = 1.0 if fields is None or not touching else _drawn_ratio(fields.x, fields.y[part])
    (figure, axes) = _panels(sum(panels), options, slender=slender, ratio=ratio)
    if fields is not None and wide:
        (figure, axes) = _stacked(sum(panels), _drawn_ratio(fields.x, fields.y[part]), options)
    title = f"{'' if options.is_narrow else 'load-sharing model: '}U = {contact.speed:.4g} m/s"
    if fields is not None and touching:
        pressure, unit = figures.in_unit_for(fields.pressure[:, part], "Pa")
        label = f"contact pressure ({unit})"
        place: Literal["right", "top"] = "right" if wide else _place_of_bar(options)
        figures.field_image(axes[0], fields.x, fields.y[part], pressure, "magma_r", label, place=place, vmin=0)
        _hertz_strip(axes[0], contact.half_width, options)
        axes[0].axhline(fields.y[row] * 1e6, color=figures.GREEN, lw=0.8, ls=":")
        title += "" if options.is_narrow else part_in_words(fields.y, part, "its line")
    elif panels[0]:
        no_field = "no field of the dry contact\n(separated, or read from a contact curve)"
        axes[0].text(0.5, 0.5, no_field, ha="center", va="center", transform=axes[0].transAxes)
        axes[0].set_axis_off()
    title += "; dashed: Hertz strip" if panels[0] else ": no contact"
    _title(figure, title, options)
    if fields is not None and in_section:
        _section(axes[-1], fields, row, touching=touching)
        if options.width is not None and not options.is_narrow and not wide:
            _key_below(figure, axes[-1])  # one above the section would leave an empty band above the map
        else:
            figures.key_above(axes[-1], 1 if options.is_narrow else 2)
        _hertz_strip(axes[-1], contact.half_width, options)
        if touching:
            axes[-1].set_xlabel(f"x (µm) at y = {worded(float(fields.y[row]), 'm')} (dotted)")
    return figure


def _panels(count: int, options: PictureOptions, *, slender: bool, ratio: float) -> tuple[Figure, list[Axes]]:
    """Return a figure with ``count`` panels: beside each other, or in a narrow picture below each other. ``ratio``:
    height over width of the map, which is no lower than the section needs."""
    ratios = [0.55 if slender else 1.0, 1.0][:count]
    (width, height) = SECTION_SIZE
    height = min(height, ABOVE_SECTION + MAP_IN_SECTION * ratio)
    size = (width * sum(ratios), height)
    heights = [PANEL_RATIO] * count
    if options.is_narrow and not slender:
        heights[0] = min(PANEL_RATIO, ratio + ABOVE_NARROW_MAP)
    if options.width is not None:
        whole = options.width / INCH
        size = (whole, whole * sum(heights) if options.is_narrow else max(whole * height / size[0], LEAST_HEIGHT))
    figure = figures.new_figure(figsize=size, layout=_layout(options))
    if options.is_narrow:
        shown = figure.subplots(count, 1, squeeze=False, height_ratios=heights)
    else:
        shown = figure.subplots(1, count, squeeze=False, width_ratios=ratios)
    return figure, list(shown.flat)


def _stacked(count: int, ratio: float, options: PictureOptions) -> tuple[Figure, list[Axes]]:
    """Return a figure of a map whose height over width is the ``ratio``, and, where ``count`` is 2, a section below
    it."""
    usual = STACKED_WIDTH + MAP_BESIDE
    whole = usual if options.width is None else options.width / INCH
    heights = [(whole - MAP_BESIDE) * ratio + MAP_ABOVE, SECTION_SIZE[1] * whole / usual][:count]
    figure = figures.new_figure(figsize=(whole, sum(heights)), layout=_layout(options))
    return figure, list(figure.subplots(count, 1, squeeze=False, height_ratios=heights).flat)


def _hertz_strip(axes: Axes, half_width: float, options: PictureOptions) -> None:
    """Draw the edges of the Hertz strip, and label the axis along the motion."""
    figures.hertz_strip(axes, half_width)
    axes.set_xlabel("x (µm), U →" if options.is_narrow else "x (µm), along the motion, U →")


def _key_below(figure: Figure, axes: Axes) -> None:
    """Write the key of ``axes`` below ``figure``."""
    handles, labels = axes.get_legend_handles_labels()
    letters: dict[str, Any] = {"fontsize": figures.KEY_SIZE, "handlelength": figures.KEY_LINE}
    figure.legend(handles, labels, loc="outside lower center", ncols=2, frameon=False, **letters)


def _section(axes: Axes, fields: Any, row: int, *, touching: bool) -> None:
    """Draw heights above the mean of the rough surface, as high as the thinnest film and the summits need."""
    micro = fields.x * 1e6
    surface = fields.heights[:, row]
    smooth = fields.film[:, row]
    drawn = [surface]
    axes.plot(micro, smooth * 1e9, color=figures.GREEN, label="film of smooth surfaces under $F_H$")
    axes.plot(micro, surface * 1e9, color=figures.GREY, lw=0.8, ls="--", label="rough surface, undeformed")
    if touching:
        deflection = fields.deflection[:, row]
        drawn.append(surface - deflection + deflection.mean())
        axes.plot(micro, drawn[-1] * 1e9, color=figures.GREY, lw=1, label="rough surface, deformed")
        axes.plot(micro, (fields.gap[:, row] + drawn[-1]) * 1e9, color=figures.RED, label="counterface")
    low = 1e9 * min(z.min() for z in drawn)
    high = 1e9 * max(*(z.max() for z in drawn), 1.2 * smooth.min())
    room = 0.15 * (high - low)
    axes.set(ylim=(low - room, high + room), ylabel="height above the mean (nm)")
