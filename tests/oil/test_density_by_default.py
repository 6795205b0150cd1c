"""The density of an oil that is described follows Dowson and Higginson."""

import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH, paper_scene

import lubfric
from lubfric.oil import named_oil
from lubfric.scene import write_template

PAPER = paper_scene()
OILS = (
    {"grade": "ISO VG 68", "viscosity_index": 95},
    {"nu40": 68e-6, "nu100": 8.6e-6},
    {"oil": "mineral-100"},
    {"oil": named_oil("pao-220")},
    {"viscosity_table": [[313.15, 68e-6], [373.15, 8.6e-6]]},
)


@pytest.mark.parametrize("given", OILS, ids=lambda given: next(iter(given)))
def test_a_described_oil_is_compressed(tmp_path, given):
    scene = PAPER.with_(lubricant=given | {"temperature": 343.15})
    assert scene.lubricant.density_law == "dowson-higginson"
    path = tmp_path / "scene.toml"
    path.write_text(scene.to_toml(), encoding="utf-8")
    assert lubfric.load_scene(path).lubricant == scene.lubricant
    stated = PAPER.with_(lubricant=given | {"temperature": 343.15, "density_law": "constant"})
    assert stated.lubricant.density_law == "constant"
    path.write_text(stated.to_toml(), encoding="utf-8")
    assert lubfric.load_scene(path).lubricant == stated.lubricant
    assert stated.with_(lubricant={"temperature": 350.0}).lubricant.density_law == "constant"  # it was given


def test_a_viscosity_in_numbers_and_the_built_in_scenes_are_not(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.1\n" + SMALL_PATCH, encoding="utf-8")
    assert lubfric.load_scene(path).lubricant.density_law == "constant"
    for name in ("paper", "flat"):
        assert lubfric.load_scene(name).lubricant.density_law == "constant"
        assert 'density_law = "constant"' in (lubfric.scene.file.SCENES / f"{name}.toml").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def bearing(tmp_path_factory):
    """The scene of `lubfric init`, at 0.51 GPa."""
    path = tmp_path_factory.mktemp("init") / "bearing.toml"
    write_template(path)
    assert 'density_law = "dowson-higginson"' in path.read_text(encoding="utf-8")
    scene = lubfric.load_scene(path).with_(bodies={"hertz_pressure": 0.51e9}, surface={"sq": 2e-8})
    return scene.with_(numerics={"model": "paper", "sampling": "patch", "tolerance": 0.05})


def test_the_warning_on_a_pressure_spike_names_the_density(bearing):
    def told(law):
        flow = {"density_law": law, "eyring_stress": None}  # shear that thins the flow takes the spike away too
        point = lubfric.friction(bearing.with_(lubricant=flow), 5.0)
        return [entry.text for entry in point.validity if "film pressure" in entry.what]

    assert not told("dowson-higginson")
    (text,) = told("constant")
    assert "the peak Hertz pressure is 0.51 GPa" in text and "lubricant.density_law = 'dowson-higginson'" in text
