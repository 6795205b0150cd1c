"""A result cites what it used, and nothing else; the command tells its version."""

import importlib.metadata

import pytest

import lubfric
from lubfric.cli import main


def test_the_papers_are_those_of_what_was_used():
    scene = lubfric.load_scene("paper").with_(numerics={"sampling": "patch"})
    film, mixed = lubfric.friction(scene, 1.0).cite(), lubfric.friction(scene, 0.01, fields=True).cite()
    assert film.startswith("A. Akchurin") and "10.1007/s11249-015-0536-z" in film and "Polonsky" not in film
    assert "Polonsky" in mixed and "Gupta" not in mixed


def test_the_command_tells_its_version(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["--version"])
    assert ended.value.code == 0 and capsys.readouterr().out.strip() == f"lubfric {lubfric.__version__}"
    assert importlib.metadata.version("lubfric")
