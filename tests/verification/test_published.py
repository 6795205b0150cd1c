"""Publications: where their numbers stand, the grades of checks, and that the command tells who differs."""

import json

import numpy as np
import pytest

from verification import page
from verification.__main__ import main
from verification.catalogue import PUBLISHED, STUDIES, Study
from verification.check import Check, beside, listed_near
from verification.fem import references
from verification.fem.published import against
from verification.fem.published.cavitation import Pad
from verification.run import quiet, run_one


def test_both_errors_are_summed_by_squares_and_the_deviation_is_reported_in_them():
    one = beside("f", 1.10, 1.00, (0.06, 0.08), "somebody")
    assert one.grade == "A" and one.units == pytest.approx(1.0) and one.tolerance == pytest.approx(0.1)
    assert not beside("f", 1.11, 1.00, (0.06, 0.08), "somebody").passed
    with pytest.raises(ValueError, match="cause = 'mine'"):
        listed_near(1.0, "mine", "a reason")
    named = against("grubin", "film", 2.0, 2.5, 0.01, listed=listed_near(2.0, "theirs", "a dry inlet"))
    assert named.deviates_as_listed and not named.failed
    assert named.errors == pytest.approx((0.02, 0.125)) and "A. N. Grubin" in named.source


def test_a_check_has_the_grade_of_its_study_unless_it_has_its_own(monkeypatch):
    import verification.fem.studies.sampling as module

    def made(level):
        yield Check("mine", 1.0, expected=1.0, tolerance=0.1, source="x", grade="A")
        yield Check("of the study", 1.0, expected=1.0, tolerance=0.1, source="x")

    monkeypatch.setattr(module, "sampling", made)
    outcome = run_one(Study("s", "verification.fem.studies.sampling:sampling", title="s", grade="B"), "quick", quiet)
    assert [c.grade for c in outcome.checks] == ["A", "B"]
    with pytest.raises(ValueError, match="grade = 'D'"):
        Check("x", 1.0, expected=1.0, tolerance=0.1, source="x", grade="D")


def test_oils_and_heat_agree_and_their_page_shows_both_values(tmp_path):
    assert main(["published", "--only", "oils", "heat", "--out", str(tmp_path)]) == 0
    data = json.loads((tmp_path / "report.json").read_text())
    checks = [c for study in data["studies"] for c in study["checks"]]
    assert len(checks) > 50 and {c["grade"] for c in checks} == {"A"}
    page = (tmp_path / "report.html").read_text()
    for word in ("Published", "lubfric", "Deviation", "Over both errors", "R. Nahme", "naphthenic"):
        assert word in page


def test_the_page_shows_a_published_zero_without_a_relative_deviation():
    shown = page.beside_table([beside("load ratio", 0.001, 0.0, (0.01, 0.02), "somebody")])
    assert "load ratio" in shown and "%" not in shown


def test_one_that_differs_ends_with_1_and_is_listed(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(references, "FLASH_HERTZ", 1.2)
    assert main(["published", "--only", "heat", "--out", str(tmp_path)]) == 1
    out = capsys.readouterr().out
    assert "0 of 12 have bounds wider than 25%" in out
    assert "Failed:\n  flash temperature, Hertz band: 1.11" in out and "1.2 ± " in out


@pytest.mark.slow
def test_the_patch_of_xu_et_al_has_their_elastic_energy():
    """Full contact is linear, so a wave stores E* q |h|²/4; another size of patch has another energy."""
    solved = {patch: references.self_affine_full_contact(patch) for patch in (4, 8, 16, 32)}
    assert min(solved, key=lambda patch: abs(solved[patch][1] - references.SELF_AFFINE_ENERGY)) == 16
    slope, energy = solved[references.SELF_AFFINE_PATCH]
    assert slope == pytest.approx(0.27513, abs=1e-5) and energy == pytest.approx(
        references.SELF_AFFINE_ENERGY, rel=5e-5
    )


def test_what_the_plain_command_has_of_the_publications_is_a_part_of_them():
    plain = {s.target for s in STUDIES if "published" in s.target}
    assert plain and plain < {s.target for s in PUBLISHED}


def test_every_source_says_how_it_was_got_and_how_good_it_is():
    for source in references.SOURCES.values():
        assert source.words and source.place and source.got and 0 <= source.error <= 0.3
    assert len(references.SOURCES) >= 12


def test_a_film_that_ruptures_and_fills_again_is_that_of_the_closed_form():
    """lubfric finds its gap under its load, and what it carries in front of the pocket flows behind it."""
    pocket = references.BANDS[0]
    load, refill, peak = references.refilled(pocket)
    gap, (x, p) = Pad(pocket, (400, 1)).solved(load)
    assert gap == pytest.approx(pocket.end, rel=3e-3) and p.max() * 1e6 == pytest.approx(peak, rel=0.08)
    ruptured = pocket.inside(x * pocket.length) & (p == 0)
    assert x[ruptured].max() * pocket.length == pytest.approx(refill, abs=5e-5)
    carried = 2 * pocket.start * pocket.wedge(pocket.begins) / (pocket.start + pocket.wedge(pocket.begins))
    rising = x > 0.7
    slope = np.gradient(p[rising] * 1e6, x[rising] * pocket.length)
    film = pocket.wedge(x[rising] * pocket.length)
    flow = film - film**3 / (12 * pocket.viscosity * pocket.speed) * slope
    assert flow[2:-2] == pytest.approx(carried, rel=2e-3)
