"""Heat and validity of a run in time: steady motion held, slow changes, reversal; what is refused and told."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.output import command_line as cli
from lubfric.scene import Harmonic, Ramp

BASE = lubfric.load_scene("flat").with_(
    bodies={"load": 3000.0, "radius": 1e-2, "width": 1e-2},
    lubricant={
        "grade": "ISO VG 68",
        "viscosity_index": 95,
        "density_law": "constant",  # with the spike of pressure, which heats most
        "temperature": 330.0,
        "eyring_stress": 5e6,
        "limiting_stress_coefficient": 0.06,
    },
    motion={"entrainment_speed": 2.0, "slide_roll_ratio": 0.2, "speeds": ()},
    surface={"sq": 2e-7, "correlation_length": 8e-6, "acf": "gaussian"},
    contact={"shape": (48, 48), "spacing": 2e-6},
    numerics={"film_deflection": "hydrodynamic", "accept": True},
)


def in_time(scene, **plan):
    return lubfric.transient(scene.with_(transient=lubfric.Transient(**({"duration": 1e-4, "outputs": 1} | plan))))


@pytest.mark.parametrize("speed, ratio", [pytest.param(2.0, 0.2, marks=pytest.mark.slow), (-2.0, -1.0)])
def test_steady_motion_is_as_hot_in_time_as_without(speed, ratio):
    scene = BASE.with_(motion={"entrainment_speed": speed, "slide_roll_ratio": ratio})
    steady = lubfric.friction(scene)
    cold = lubfric.friction(scene.with_(numerics={"heat": "off"}))
    result = in_time(scene)
    assert result.coefficient[-1] == pytest.approx(steady.coefficient, rel=5e-3)
    assert abs(cold.coefficient / steady.coefficient - 1) > 0.08
    assert result.inlet_film_factor[-1] == pytest.approx(steady.inlet_film_factor, rel=1e-6) and steady.decision
    assert result.flash_temperature_rise[-1] == pytest.approx(steady.flash_temperature_rise, rel=0.05)
    assert result.central_film[-1] == pytest.approx(steady.central_film, rel=0.01)
    off = in_time(scene.with_(numerics={"heat": "off"}))
    assert off.coefficient[-1] == pytest.approx(cold.coefficient, rel=5e-3) and np.isnan(off.flash_temperature_rise[-1])


@pytest.mark.parametrize("speed, ratio", [(5.0, 20.0), (-20.0, -2.0)])
def test_the_film_far_before_a_hot_contact_is_as_thin_as_that_of_steady_motion(speed, ratio):
    """Cold, the film beyond the ends of the grid alone would raise f by 5 to 30 %."""
    scene = paper_scene(
        lubricant={"grade": "ISO VG 220", "viscosity_index": 95, "temperature_celsius": 40},
        motion={"entrainment_speed": speed, "slide_roll_ratio": ratio},
        numerics={"sampling": "patch", "film_deflection": "hydrodynamic", "accept": True},
    )
    steady = lubfric.friction(scene)
    result = in_time(scene, duration=1e-3)
    assert steady.inlet_film_factor < 0.1
    assert result.couette_force[-1] == pytest.approx(math.copysign(steady.couette_force, speed * ratio), rel=8e-3)
    assert abs(result.coefficient[-1] - steady.coefficient) < 8e-3 * steady.couette_force / scene.bodies.load


def test_a_slow_ramp_is_as_hot_as_every_speed_it_passes():
    result = in_time(BASE, duration=1.0, outputs=2, tolerance=1e-3, speed=Ramp(start=1.0, end=3.0, until=1.0))
    steady = [lubfric.friction(BASE, float(u)) for u in result.entrainment_speed]
    np.testing.assert_allclose(result.coefficient, [p.coefficient for p in steady], rtol=0.01)
    np.testing.assert_allclose(result.inlet_film_factor, [p.inlet_film_factor for p in steady], rtol=1e-6)
    assert result.inlet_film_factor[-1] < result.inlet_film_factor[0] < 1


def test_a_viscosity_history_is_the_cold_one():
    oil = {name: getattr(BASE.lubricant, name) for name in BASE.lubricant.__dataclass_fields__ if name != "oil"}
    thin = {"viscosity": BASE.lubricant.viscosity / 2}
    steady = lubfric.friction(replace(BASE, lubricant=lubfric.Lubricant(**oil | thin)))
    assert in_time(BASE, **thin).coefficient[-1] == pytest.approx(steady.coefficient, rel=5e-3)


def test_a_reversal_is_warm_on_both_sides_and_cold_at_rest():
    result = in_time(
        BASE.with_(bodies={"load": 200.0}, numerics={"tolerance": 0.05}),
        duration=0.02,
        outputs=8,
        tolerance=3e-3,
        speed=Harmonic(amplitude=2.0, frequency=50.0, phase=math.pi / 2),
        sliding=0.4,
    )
    assert np.all(np.isfinite(result.coefficient))
    fast = np.abs(result.entrainment_speed) > 1.9
    still = np.abs(result.entrainment_speed) < 1e-9
    assert np.all(result.inlet_film_factor[fast] < 0.96) and np.all(result.inlet_film_factor[still] == 1.0)
    assert np.all(result.flash_temperature_rise[fast] > 0.2) and still.sum() == 2 and fast.sum() == 3
    assert any("slide-roll ratio" in text and "outputs" in text for text in result.validity)


def test_heat_that_a_plain_viscosity_omits_is_reported_with_its_size():
    """Of the size, at most, that an oil has which says how its viscosity falls: 3.5 % per K at 70 °C."""
    oil = {"pressure_viscosity_coefficient": 2e-8, "eyring_stress": 5e6}
    plain = BASE.with_(lubricant=lubfric.Lubricant(BASE.lubricant.viscosity, **oil))
    steady = lubfric.friction(plain)
    moving = in_time(plain)
    assert moving.coefficient[-1] == pytest.approx(steady.coefficient, rel=5e-3)
    known = {"temperature": 343.15, "temperature_coefficient": 0.035} | oil
    warm = lubfric.friction(BASE.with_(lubricant=lubfric.Lubricant(BASE.lubricant.viscosity, **known)))
    share = 1 - warm.coefficient / steady.coefficient
    off = in_time(plain.with_(numerics={"heat": "off"}))
    for violations in (steady.validity, moving.violations[-1], off.violations[-1]):
        stated = [e.value / 100 for e in violations if e.what == "reduction of f by the heat of the film"]
        assert (stated == []) if violations is off.violations[-1] else (0.02 < share < stated[0] < 2 * share), (
            share,
            stated,
        )
    with pytest.raises(lubfric.InputError, match="heat = 'on' needs"):
        plain.with_(numerics={"heat": "on"})


NEWTONIAN = BASE.with_(
    lubricant={"eyring_stress": None, "limiting_stress_coefficient": None}, numerics={"accept": False, "heat": "off"}
)


def test_what_no_oil_carries_is_refused_with_the_run_attached():
    with pytest.raises(lubfric.ValidityError, match="No oil carries") as caught:
        in_time(NEWTONIAN)
    result = caught.value.result
    assert result.coefficient[-1] > 0.5 and any(entry.severe for entry in result.violations[-1])
    stated = in_time(NEWTONIAN.with_(numerics={"accept": True}))
    assert stated.coefficient[-1] == result.coefficient[-1] and stated.validity == result.validity


def test_the_command_writes_a_refused_run_marked(tmp_path, capsys):
    scene = NEWTONIAN.with_(transient=lubfric.Transient(1e-4, outputs=1))
    path = tmp_path / "scene.toml"
    path.write_text(scene.to_toml())
    assert cli.main(["run", str(path), "--out", str(tmp_path / "out")]) != 0
    assert "No oil carries" in capsys.readouterr().err
    record = json.loads((tmp_path / "out" / "result.json").read_text())
    assert any("No oil carries" in text for text in record["validity"])
    assert "not valid" in (tmp_path / "out" / "history.csv").read_text().splitlines()[-1]
    assert cli.main(["run", str(path), "--accept", "--out", str(tmp_path / "kept")]) == 0
    assert cli.main(["plot", str(tmp_path / "kept")]) == 0


def test_an_unresolved_spike_is_reported():
    """A Newtonian film at 1 GPa has f in its spike alone, which the grid of a run does not hold; Eyring's is no more
    off than it says."""
    scene = BASE.with_(
        bodies={"load": 500.0},
        motion={"entrainment_speed": 1.0, "slide_roll_ratio": 0.02},
        surface={"sq": 1e-8},
        numerics={"heat": "off"},
    )
    eyring = in_time(scene)
    steady = lubfric.friction(scene).coefficient
    assert abs(eyring.coefficient[-1] / steady - 1) < 2 * eyring.shear_error[-1] + 5e-3
    assert not any("sum of the film's shear stress" in text for text in eyring.validity)
    newtonian = scene.with_(lubricant={"eyring_stress": None, "limiting_stress_coefficient": None})
    result = in_time(newtonian)
    assert abs(result.coefficient[-1] / lubfric.friction(newtonian).coefficient - 1) > 1
    assert result.shear_error[-1] > 0.3 and any("sum of the film's shear stress" in text for text in result.validity)
