"""What holds for the whole tree: how many names a user imports, and that every test listed as slow exists."""

from importlib import import_module
from pathlib import Path

ROOT = Path(__file__).parents[1]


def test_what_a_user_imports_is_fifty_names():
    assert len(import_module("lubfric").__all__) <= 50


def test_every_slow_test_exists():
    for name in (ROOT / "tests" / "slow_tests.txt").read_text(encoding="utf-8").split():
        path, test = name.split("::")
        assert f"def {test}(" in (ROOT / "tests" / path).read_text(encoding="utf-8"), name


def test_no_two_test_files_have_one_name(root):
    """pytest takes the second for the first, and collects neither."""
    names = [path.name for path in (root / "tests").rglob("test_*.py")]
    assert sorted(names) == sorted(set(names))
