"""The one table of numbers agrees with what results and scenes have."""

from dataclasses import fields

import lubfric
from lubfric import quantities as q
from lubfric.sampling import Uncertainty
from lubfric.scene import SECTIONS, short_keys


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
    assert q.axis_label("coefficient") == "friction coefficient f (-)"
    assert q.axis_label("surface.seed") == "surface.seed"
    assert q.short_label("film_load") == "F_H (N)" and q.short_label("coefficient") == "f"
    assert q.described("bodies.load") == {"units": "N", "long_name": "total load"}
    assert q.described("surface.seed") == {"long_name": "seed"}
    assert q.depending_on("heat") == ("inlet_film_factor", "flash_temperature_rise", "film_temperature_rise")
