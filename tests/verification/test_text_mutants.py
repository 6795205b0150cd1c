"""The table of mistakes in the text of `lubfric`: every line still applies, names tests that are there, and a trial
tells a catch from a survivor and from a test that cannot be loaded."""

import ast
from pathlib import Path

import pytest

from verification.studies.mutants import FAILED, PASSED, Mutant, judged, table, trial

TABLE = table()


@pytest.mark.parametrize("mutant", TABLE, ids=[mutant.name for mutant in TABLE])
def test_a_mutant_applies_to_one_place_and_names_its_tests(mutant, root):
    broken = mutant.broken(root / "lubfric")
    assert ast.dump(ast.parse(broken)) != ast.dump(ast.parse((root / "lubfric" / mutant.file).read_text("utf-8")))
    assert mutant.tests
    for test in mutant.tests:
        file, _, name = test.partition("::")
        assert f"def {name}" in (root / "tests" / file).read_text("utf-8"), test


def test_a_line_that_no_longer_applies_is_told(tmp_path):
    (tmp_path / "a.py").write_text("x = 1\ny = 1\n")
    for text, times in (("z", 0), (" = 1", 2)):
        with pytest.raises(ValueError, match=f"{times} times"):
            Mutant("a.py", text, "0", ()).broken(tmp_path)
    (mutant,) = table("# file | text\n\na.py | x = 1 | x = 2 | oil/test_oil.py film/test_ehl.py::test_hertz\n")
    assert mutant.broken(tmp_path) == "x = 2\ny = 1\n" and len(mutant.tests) == 2


def test_a_trial_tells_a_catch_from_a_survivor_and_from_a_test_that_does_not_load():
    mutant, test = TABLE[0], TABLE[0].tests
    idle = Mutant(mutant.file, mutant.text, f"{mutant.text} ", test)
    broken = Mutant("oil/oil.py", "from __future__", "from __past__", test)
    codes = [trial(each, test) for each in (mutant, idle, broken)]
    assert codes[:2] == [FAILED, PASSED]
    assert [judged("m", code, FAILED).passed for code in codes] == [True, False, False]
    assert judged("m", codes[2], FAILED).refused and not judged("m", FAILED, PASSED).passed


def test_the_table_covers_the_rooms():
    rooms = {Path(mutant.file).parts[0] for mutant in TABLE}
    assert len(TABLE) >= 25 and {"oil", "film"} <= rooms
