"""A speed whose contact had to be solved on shorter cells than the others is drawn and kept on its own cells."""

import numpy as np

import lubfric
from lubfric.output import main

SCENE = """
[bodies]
radius = 6e-3
width = 8e-3
load = 1500.0
material = "steel"
boundary_friction_coefficient = 0.12
[lubricant]
viscosity = 0.012
pressure_viscosity_coefficient = 1.6e-8
eyring_stress = 5e6
limiting_stress_coefficient = 0.06
[motion]
entrainment_speed = 3.5
slip_percent = 4
[surface]
file = "map.npy"
spacing = [0.32e-6, 0.16e-6]
extension = "mirror"
"""


def test_the_fields_of_a_speed_are_those_of_its_own_cells(tmp_path):
    """Sharp summits just below lift-off, which the cells of the line cut off (as `tests/sampling` has them)."""
    made = lubfric.generate_surface(
        (320, 240), (0.32e-6, 0.16e-6), sq=77e-9, correlation_length=(20e-6, 2.2e-6), acf="exponential", seed=4
    )
    np.save(tmp_path / "map.npy", made.heights)
    (tmp_path / "sharp.toml").write_text(SCENE)
    out = tmp_path / "out"
    assert main(["run", str(tmp_path / "sharp.toml"), "--speeds", "3.5", "--out", str(out)]) == 0
    assert (out / "contact.png").stat().st_size > 10_000
    with np.load(out / "fields.npz") as fields:
        pressure, gap, heights, x = (fields[n] for n in ("contact_pressure_0", "gap_0", "heights", "contact_x"))
        first = lubfric.prepare(lubfric.load_scene(tmp_path / "sharp.toml")).surface
        assert pressure.shape == gap.shape == heights.shape > first.shape
        assert np.allclose(np.diff(x), fields["spacing"][0]) and x.size == heights.shape[0]
        touched = pressure > 0
        assert touched.any() and heights[touched].min() > np.median(
            heights
        )  # summits carry: the map is that of the contact
        assert np.abs(gap[touched]).max() < 1e-3 * heights.std()
