"""Studies whose curves choose their own speeds: each as it is alone, the same bits anywhere and after a cut, tables."""

from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
import small_study
from small_study import same

import lubfric
from lubfric.studies import points

SCENE = small_study.SCENE.with_(numerics={"tolerance": 0.02})
VARY = {"lubricant.viscosity": [0.1, 0.4]}


@pytest.fixture(scope="module")
def study():
    return lubfric.study(SCENE, VARY, "auto")


def test_each_curve_is_that_of_the_scene_alone(study):
    alone = lubfric.stribeck(SCENE.with_(lubricant={"viscosity": 0.4}), "auto")
    n = alone.speed.size
    order = np.argsort(study["speed"][1, :n])
    np.testing.assert_array_equal(study["speed"][1, :n][order], alone.speed)
    np.testing.assert_array_equal(study["coefficient"][1, :n][order], alone.coefficient)
    assert study.dims == ("lubricant.viscosity", "point") and study.missing == study.failed == 0
    assert set(study.status[1, n:]) <= {"not needed"} and study.solved <= 2 * 12
    speeds = np.geomspace(2e-4, 0.9, 7)
    np.testing.assert_allclose(study.at(speeds)[1], alone.at(speeds), rtol=1e-12)
    assert study.at(0.1).shape == (2,) and np.isnan(study.at(5.0)).all()
    assert study.lift_off[1] == pytest.approx(alone.lift_off, rel=1e-12)


def test_lift_off_goes_with_the_film(study):
    """The film is a function of viscosity x speed where pressure does not raise the viscosity further: so is
    lift-off."""
    assert study.lift_off[0] / study.lift_off[1] == pytest.approx(4.0, rel=0.02)


@pytest.mark.parametrize("cut", [5, pytest.param(None, marks=pytest.mark.slow)])
def test_the_same_bits_on_a_pool_and_after_a_cut(study, tmp_path, monkeypatch, cut):
    class Cut(BaseException):
        pass

    real = points.friction
    solved = []

    def friction(*arguments, **options):
        if len(solved) == cut:
            raise Cut
        solved.append(arguments)
        return real(*arguments, **options)

    if cut is not None:
        monkeypatch.setattr(points, "friction", friction)
        with pytest.raises(Cut):
            lubfric.study(SCENE, VARY, "auto", store=tmp_path)
        monkeypatch.setattr(points, "friction", real)
        half = lubfric.open_study(tmp_path)
        assert (half.solved, half.missing) == (cut, 2) and half["speed"][0, 0] == 1.0
    with ProcessPoolExecutor(2) as executor:
        same(lubfric.study(SCENE, VARY, "auto", executor=executor, store=tmp_path), study)
    same(lubfric.open_study(tmp_path), study)
    assert len(list((tmp_path / "points").iterdir())) == study.solved + 3  # points, speeds of each curve, plan
    monkeypatch.setattr(points, "prepare", None)  # nothing is left to do
    same(lubfric.study(SCENE, VARY, "auto", store=tmp_path), study)


def test_a_curve_that_cannot_be_begun_is_one_row(tmp_path):
    result = lubfric.study(SCENE, {"contact.spacing": [1e-4]}, "auto", store=tmp_path)
    assert result.failed == 1 and result.missing == 0 and "InputError: correlation_length" in result.status[0, 0]
    same(lubfric.open_study(tmp_path), result)
    assert np.isnan(result.lift_off).all() and np.isnan(result.at(0.1)).all()


def test_tables_leave_out_what_was_not_needed(study, tmp_path):
    pytest.importorskip("xarray"), pytest.importorskip("pandas")
    data = study.to_xarray()
    frame = study.to_frame()
    assert data.speed.dims == ("lubricant.viscosity", "point") and data.speed.attrs["units"] == "m/s"
    assert len(frame) == study.solved and frame["speed"].notna().all() and list(frame)[:2] == [*VARY, "speed"]
    study.to_csv(tmp_path / "study.csv")
    heading, *rows = (tmp_path / "study.csv").read_text().splitlines()
    assert heading.startswith("lubricant.viscosity [Pa s],speed [m/s],coefficient [-]") and len(rows) == study.solved


def test_a_study_shows_itself(study):
    """Lines, points and labels are those of its numbers."""
    plt = pytest.importorskip("matplotlib.pyplot")
    assert repr(study).startswith("<StudyResult: 2 lubricant.viscosity x ") and repr(study).count("\n") == 0
    axes = study.plot()
    lines = axes.get_lines()
    assert len(lines) == 4 and lines[0].get_label() == "viscosity at ambient pressure 100 mPa s"
    solved = study["coefficient"][0]
    np.testing.assert_array_equal(np.sort(lines[1].get_ydata()), np.sort(solved[np.isfinite(solved)]))
    np.testing.assert_allclose(lines[0].get_ydata(), study.at(lines[0].get_xdata())[0])
    plt.close(axes.figure)
