"""numerics.model = "deterministic" in friction and stribeck: the same words, what is refused, grids by the
tolerance."""

from dataclasses import replace

import numpy as np
import pytest

import lubfric
from lubfric.output import main
from lubfric.studies import classes_of, decode, encode

SCENE = lubfric.load_scene("paper").with_(
    contact={"shape": (48, 48), "spacing": 90e-6 / 48},
    numerics={"model": "deterministic", "grid": "given", "sampling": "patch"},
)
MODEL = lubfric.prepare(SCENE)


@pytest.fixture(scope="module")
def point():
    return lubfric.friction(MODEL, 0.01)


def test_the_words_of_a_result_keep_their_meaning(point):
    result = point.deterministic
    b = SCENE.bodies
    assert point.contact_load + point.film_load == pytest.approx(b.load)
    assert point.coefficient * b.load == pytest.approx(point.boundary_force + point.shear_force)
    assert point.boundary_force == pytest.approx(0.09 * point.contact_load)
    (dx, dy) = result.spacing
    ny = result.pressure.shape[1]
    rubbing = result.pressure[result.rubbing].sum() * dx * dy * b.width / (ny * dy)
    assert rubbing == pytest.approx(point.contact_load)
    assert point.real_contact_area == pytest.approx(result.rubbing.sum() * dx * dy * b.width / (ny * dy))
    inside = np.abs(result.x) <= np.sqrt(8 * b.load / b.width * b.radius / (np.pi * b.e_prime))
    assert point.real_contact_area_fraction == pytest.approx(result.rubbing[inside].mean())
    assert result.rubbing[~inside].any()  # so that A_c over the area of the strip is another number
    assert point.balance is None and np.isnan(point.volume_residual) and point.report.converged
    assert point.decision.model == "deterministic" and "solved together with the contact" in point.report.notes[0]


def test_no_entrainment_and_the_other_way_round(point):
    still = lubfric.friction(MODEL, 0.0)
    assert still.coefficient == pytest.approx(0.09) and still.film_load == 0
    surface = MODEL.surface
    turned = lubfric.prepare(SCENE, surface=replace(surface, heights=surface.heights[::-1]))
    assert lubfric.friction(turned, -0.01).coefficient == pytest.approx(point.coefficient, rel=1e-6)


def test_a_sweep_keeps_fields_only_where_requested(point):
    curve = lubfric.stribeck(MODEL, [0.03, 0.01], fields=[0.01])
    assert np.all(np.diff(curve.contact_load) > 0) and np.all(np.isfinite(curve.mean_gap))
    assert curve.coefficient[1] == point.coefficient
    assert curve.points[0].deterministic is None and curve.points[1].deterministic.pressure.shape[1] == 48


def test_a_picture_names_the_pressure_that_its_fields_hold(point):
    """Whatever the model that solved them keeps."""
    axes = replace(point, details={}).plot_contact()
    labels = [other.get_ylabel() for other in axes.figure.axes]
    assert any(label.startswith("film and contact pressure") for label in labels) and point.smooth_film is None


def test_a_result_can_be_stored(point):
    again = decode(b"".join(encode(point)), classes_of(lubfric.FrictionResult))
    assert np.array_equal(again.deterministic.pressure, point.deterministic.pressure)
    assert repr(again) == repr(point) and again.report == point.report


@pytest.mark.parametrize(
    "change",
    [
        {"contact": {"geometry": "flat"}},
        {"contact": {"model": "summits"}},
        {"contact": {"region": "box"}},
        {"numerics": {"cavitated_shear": "striated"}},
    ],
    ids=lambda change: ".".join([*change, *next(iter(change.values()))]),
)
def test_what_it_does_not_take_is_refused_before_any_work(change):
    key = next(iter(next(iter(change.values()))))
    with pytest.raises(lubfric.InputError, match=f"{key}.*deterministic"):
        lubfric.prepare(SCENE.with_(**change))
    with pytest.raises(lubfric.InputError, match=key):
        lubfric.stribeck(SCENE.with_(**change), [0.01])


def test_a_newtonian_film_beyond_its_range_is_reported():
    heavy = SCENE.with_(bodies={"load": 60.0}, contact={"shape": (32, 32), "spacing": 90e-6 / 32})
    stated = {entry.what for entry in lubfric.friction(heavy, 0.1).validity}
    assert "share of the load on a saturated film (strips of the deterministic model)" in stated and any(
        "pressure" in what for what in stated
    )


def test_the_command_writes_its_fields(tmp_path, draws):
    draws("contact.png")
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE.with_(contact={"shape": (32, 32), "spacing": 90e-6 / 32}).to_toml())
    assert main(["run", str(scene), "--out", str(tmp_path / "out"), "--speeds", "0.01,0.003", "--fields", "0.003"]) == 0
    with np.load(tmp_path / "out" / "fields.npz") as fields:
        assert fields["pressure_0"].shape == fields["gap_0"].shape and fields["speed"] == 0.003
    assert (tmp_path / "out" / "contact.png").stat().st_size > 10_000
