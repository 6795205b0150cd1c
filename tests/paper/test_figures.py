"""The figures of the paper: their models against the library and closed forms, and the command that writes them."""

import csv
import json
import math

import numpy as np
import pytest

from lubfric.contact import solve_contact
from verification.__main__ import main
from verification.campaigns.figures import FIGURES, deviation, spheres

pytest.importorskip("PIL")


def test_the_mean_of_the_box_is_loves_kernel_summed_over_it():
    from lubfric.contact import love_coefficients

    count = 201
    step = 1e-6
    kernel = love_coefficients((count, count), (step, step), spheres.E_PRIME)
    half = kernel[: count // 2 + 1, : count // 2 + 1]
    whole = 4 * half.sum() - 2 * half[0].sum() - 2 * half[:, 0].sum() + half[0, 0]
    assert whole * spheres.E_PRIME / (count * step) == pytest.approx(spheres.MEAN_OF_BOX, rel=1e-3)


def test_one_period_of_the_array_stands_for_many():
    heights, step = spheres.unit_cell(14e-6, 4 * spheres.CELL)
    one = solve_contact(spheres.HEIGHT - heights, step, spheres.E_PRIME, mean_pressure=2e7, tolerance=1e-8)
    many = solve_contact(
        spheres.HEIGHT - np.tile(heights, (2, 3)), step, spheres.E_PRIME, mean_pressure=2e7, tolerance=1e-8
    )
    assert many.approach == pytest.approx(one.approach, rel=1e-6)


def test_both_gauges_of_the_sphere_array():
    loads = [2e-3]
    result = [spheres.approaches(d, loads, 2 * spheres.CELL) for d in spheres.SPACINGS]
    left_out, kept = np.array(result)[:, :, 0].T
    alone = (loads[0] / (2 / 3 * spheres.E_PRIME * math.sqrt(spheres.RADIUS))) ** (2 / 3)
    assert np.all(np.diff(left_out) > 0) and np.all(np.diff(kept) < 0)
    assert abs(left_out[-1] / alone - 1) < 0.06
    # the next term for a square array: -3.9002 F/(lambda) of the potential of a point load and its background
    expected = alone - 2 / (math.pi * spheres.E_PRIME) * loads[0] * 3.9002 / np.array(spheres.SPACINGS)
    assert np.allclose(left_out, expected, rtol=0.03)


def test_deviation_is_eq_13_with_the_sign_of_the_asperities():
    d, at = deviation.signed_deviation(np.array([0.1, 0.08, 0.02]), np.array([0.1, 0.05, 0.015]))
    assert d == pytest.approx(0.03 / 0.08) and at == 1
    d, at = deviation.signed_deviation(np.array([math.nan, 0.08]), np.array([0.1, 0.1]))
    assert d == pytest.approx(-0.02 / 0.08) and at == 1
    assert deviation.signed_deviation(np.array([math.nan]), np.array([1.0]))[1] == -1


@pytest.mark.parametrize("name", ["fig2", "fig4", "fig9", "fig10"])
def test_the_command_writes_picture_data_and_page(name, tmp_path):
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "paper.md").write_text("# A page\n<!-- figures -->\nold\n<!-- end of figures -->\nkept\n")
    assert main(["figures", "--only", name, "--quick", "--out", str(tmp_path), "--docs", str(tmp_path / "docs")]) == 0
    picture = (tmp_path / f"{name}.png").read_bytes()
    assert picture.startswith(b"\x89PNG") and 5_000 < len(picture) < 150_000
    with (tmp_path / f"{name}.csv").open() as file:
        heading, *rows = csv.reader(file)
    assert len(rows) >= 2 and all(len(row) == len(heading) for row in rows)
    page = (tmp_path / "docs" / "paper.md").read_text()
    assert "**Agrees.**" in page and "**Differs, and why.**" in page and "nan" not in page
    assert page.startswith("# A page\n") and "old" not in page and page.endswith("<!-- end of figures -->\nkept\n")
    assert f"images/{name}.png" in page and (tmp_path / "docs" / "images" / f"{name}.png").read_bytes() == picture
    (study,) = json.loads((tmp_path / "report.json").read_text())["studies"]
    assert study["checks"] and study["passed"]


def test_an_unknown_figure_is_refused(tmp_path):
    with pytest.raises(SystemExit) as refused:
        main(["figures", "--only", "fig3", "--out", str(tmp_path)])
    assert refused.value.code == 2 and "fig6" in FIGURES
