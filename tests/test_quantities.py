"""The one table of numbers agrees with what results and scenes have."""

from dataclasses import fields

import pytest

import lubfric
from lubfric import quantities as q
from lubfric.estimate import Uncertainty
from lubfric.models.load_sharing import PaperModel
from lubfric.scene import SECTIONS, short_keys
from lubfric.units import worded


def test_results_have_the_numbers_of_the_table_and_no_others():
    numbers = {f.name for f in fields(lubfric.FrictionResult) if f.type == "float"} | set(q.NUMBERS)
    assert numbers == set(q.NUMBERS)
    assert set(q.NUMBERS) <= {f.name for f in fields(lubfric.FrictionResult)}
    assert set(q.NUMBERS) <= {f.name for f in fields(lubfric.StribeckResult)}
    assert set(q.ESTIMATED) == {name for name, row in q.QUANTITIES.items() if row.error}
    assert set(q.OF_UNCERTAINTY) <= {f.name for f in fields(Uncertainty)}


def test_a_number_has_one_unit_in_steady_motion_and_in_time():
    for name in set(q.OF_MOMENT) & set(q.QUANTITIES):
        assert q.OF_MOMENT[name].unit == q.QUANTITIES[name].unit, name


def test_every_key_of_the_table_is_a_key_of_a_scene():
    for key in set(q.KEYS) - {"speed"}:
        section, _, name = key.partition(".")
        assert name in [*(f.name for f in fields(SECTIONS[section])), *short_keys(section)], key


def test_words_for_columns_axes_tables_and_lines():
    assert q.heading("contact_load") == "contact_load [N]" and q.heading("line_length") == "line_length [m]"
    assert q.axis_label("coefficient") == "friction coefficient $f$ (-)"
    assert q.axis_label("boundary_force", "kN").endswith(r" $f_{b}\,F_{C}$ (kN)")
    assert q.axis_label("surface.seed") == "surface.seed"
    assert q.described("bodies.load") == {"units": "N", "long_name": "total load"}
    assert q.described("surface.seed") == {"long_name": "seed"}
    assert q.depending_on("heat") == ("inlet_film_factor", "flash_temperature_rise", "film_temperature_rise")


@pytest.mark.parametrize(
    "value, unit, text",
    [(3e-7, "m", "300 nm"), (0.0124, "m", "12.4 mm"), (1.25e9, "Pa", "1.25 GPa")]
    + [((2e-8, 2.1e-8), "1/Pa", "20 and 21 1/GPa"), (0.0168, "Pa s", "16.8 mPa s"), (143e3, "N/m", "143 N/mm")]
    + [(2000.0, "N", "2 kN"), (0.3, "N", "0.3 N"), (0.0, "m", "0 m"), ((0.0, 0.0, 2e-3), "m", "0 and 0 and 2 mm")]
    + [(float("nan"), "m", "nan m"), (3.6e6, "J/(m3 K)", "3.6 MJ/(m³ K)"), (0.05, "-", "0.05")]
    + [([1e-3, 2e-3, 3e-3, 4e-3], "m", "4 values, 1 to 4 mm"), ("roelands", "-", "roelands"), (True, "-", "True")],
)
def test_numbers_are_reported_in_units_of_people(value, unit, text):
    assert worded(value, unit) == text


@pytest.mark.parametrize(
    "count, plural, text", [(1, "passes", "1 pass"), (1, "speeds", "1 speed"), (2, "passes", "2 passes")]
)
def test_what_is_counted_is_one_or_several(count, plural, text):
    assert q.counted(count, plural) == text


def test_another_quantity_that_depends_on_the_area_has_its_error(monkeypatch):
    """The error of a column is by what it depends on, not by its place among the others."""
    home = "lubfric.models.load_sharing.errors_of.depending_on"
    monkeypatch.setattr(home, lambda error: (*q.depending_on(error), *["another area"] * (error == "area")))
    prepared = lubfric.prepare(lubfric.load_scene("paper"))
    errors = PaperModel().solve(prepared, prepared.sample, 2, 0.0).answer().errors.of_numbers
    assert errors["another area"] == errors["real_contact_area_fraction"] > 0
    assert errors["real_contact_area"] > 0


def test_a_number_is_corrected_by_the_control_or_said_here_not_to_be():
    """So a new quantity with an error of its own cannot be forgotten where strips are compared with their line."""
    left = {"power_loss", "plastic_area_fraction", *q.depending_on("area"), *q.depending_on("heat")}
    left |= {"min_film", "central_film", "film_to_roughness_ratio"}  # those of a smooth film
    prepared = lubfric.prepare(lubfric.load_scene("paper"))
    control = PaperModel().solve(prepared, prepared.sample, prepared.sample.first_strips, 0.01).control()
    assert set(control.numbers) | left == set(q.ESTIMATED) and not set(control.numbers) & left


def test_a_force_is_a_load_a_part_of_friction_or_resists_the_entrainment():
    """In time only parts of friction have the sign of the force on surface 2: a new force says whether it is
    one."""
    forces = {name for name, row in q.QUANTITIES.items() if row.unit == "N"}
    loads = {name for name in forces if name.endswith("_load")}
    assert forces == {*loads, *q.FRICTION_FORCES, "rolling_resistance"}
    assert {"boundary_force", "couette_force", "rolling_force", "shear_force"} <= set(q.FRICTION_FORCES)
