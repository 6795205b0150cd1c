"""The table of mistakes in the text of `lubfric`: every line applies and names tests or studies that are there, and a
trial tells a catch from a survivor and from a test that cannot be loaded."""

import ast
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

from verification.studies import STUDIES
from verification.studies.mutants import BROKEN, FAILED, PASSED, Mutant, is_test, judged, table, trial

TABLE = table()
STUDIES_BY_NAME = {study.name for study in STUDIES}


@pytest.mark.parametrize("mutant", TABLE, ids=[mutant.name for mutant in TABLE])
def test_a_mutant_applies_to_one_place_and_names_its_tests(mutant, root):
    file, broken = mutant.broken(root / "lubfric")
    read = tomllib.loads if file.suffix == ".toml" else lambda text: ast.dump(ast.parse(text))
    assert read(broken) != read(file.read_text("utf-8"))
    assert mutant.noticed_by and len({is_test(name) for name in mutant.noticed_by}) == 1
    for each in mutant.noticed_by:
        file, _, name = each.partition("::")
        known = (
            f"def {name}" in (root / "tests" / file).read_text("utf-8") if is_test(each) else each in STUDIES_BY_NAME
        )
        assert known, each


def test_a_line_that_no_longer_applies_is_told(tmp_path):
    (tmp_path / "a.py").write_text("x = 1\ny = 1\n")
    for text, times in (("z", 0), (" = 1", 2)):
        with pytest.raises(ValueError, match=f"{times} times"):
            Mutant("a.py", text, "0", ()).broken(tmp_path)
    (mutant,) = table("# file | text\n\na.py | x = 1 | x = 2 | oil/test_oil.py film/test_ehl.py::test_hertz\n")
    for place in ("a.py", ""):
        assert replace(mutant, place=place).broken(tmp_path) == (tmp_path / "a.py", "x = 2\ny = 1\n")
    assert len(mutant.noticed_by) == 2


def test_a_trial_tells_a_catch_from_a_survivor_and_from_a_test_that_does_not_load():
    mutant, test = TABLE[0], TABLE[0].noticed_by
    idle = Mutant(mutant.place, mutant.text, f"{mutant.text} ", test)
    broken = Mutant("oil/oil.py", "from __future__", "from __past__", test)
    codes = [trial(each, test) for each in (mutant, idle, broken)]
    assert codes == [FAILED, PASSED, BROKEN]
    assert [judged("m", code, FAILED).passed for code in codes] == [True, False, False]
    assert judged("m", codes[2], FAILED).refused and not judged("m", FAILED, PASSED).passed


def test_the_table_covers_the_rooms():
    tested = [mutant for mutant in TABLE if is_test(mutant.noticed_by[0])]
    rooms = {Path(mutant.place).parts[0] for mutant in tested}
    assert len(tested) >= 60 and len({mutant.name for mutant in TABLE}) == len(TABLE)
    assert {"oil", "film", "sampling", "deterministic", "studies", "surface", "output", "sharing"} <= rooms
