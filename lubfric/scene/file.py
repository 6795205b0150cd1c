"""Scenes as TOML: strict reading; a commented one to begin with."""

import os
import re
import tomllib
from collections.abc import Mapping
from difflib import get_close_matches
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from .._base import validate, with_default_errors, write_whole
from ..errors import InputError
from ..surface import PER_SQ
from ..units import without_unit
from .plausible import doubtful_values
from .roughness import GENERATED, check_fields, named
from .scene import Scene, as_ranges
from .sections import (
    ROUGH_SECTIONS,
    SECTIONS,
    check_complete,
    check_keys,
    keys_elsewhere,
    made_section,
    meant,
    ranges_of,
    read_value,
)
from .transient import HISTORIES, UNITS_OF_HISTORIES, Transient, history, is_angle, times_of_angles

# Limits by choice: a longer file or path is no scene, and a less alike name is another one.
MOST_SCENE_BYTES = 2**24  # of a scene
LONGEST_PATH = 300  # characters of a path that is compared with the files there
NEAR_FILE = 0.6  # likeness of two file names, 0 to 1, from which one may be meant by the other
TOML_NUMBERS = "write numbers with a decimal point; put names and numbers with a unit in quotes: 'mineral', '12 mm'"
TOML_TWICE = "this section or key is there for the second time; put the keys of both into one, and remove the other"
TOML_FAULTS = {  # begin of what Python's reader of TOML says: what it means, and what to do
    "Illegal character '\\n'": "a text has no closing quotation mark; add it",
    "Cannot declare": TOML_TWICE,
    "Cannot overwrite": TOML_TWICE,
    "Unclosed array": "a list has no closing bracket; add ]",
    "Unclosed inline table": "a table has no closing brace; add }",
    "Invalid hex value": "in double quotes a backslash begins an escape sequence; write a path with / or in single quotes",
    "Unescaped '\\'": "in double quotes a backslash begins an escape sequence; write a path with / or in single quotes",
}
SCENES = resources.files(__package__) / "scenes"

# Entry of a scene file with options of ``lubfric run`` that no key of a scene holds, and these. They change no number
# of a point: a `Scene` has none.
OPTIONS_KEY = "options"
OPTIONS_IN_FILES = ("ratios", "speeds", "fields")


@with_default_errors
def load_scene(
    source: str | Path | Mapping[str, Any],
    *,
    surface_file: str | Path | None = None,
    counterface_file: str | Path | None = None,
) -> Scene:
    """Read a scene from a TOML file, from a dict of its tables, or one of the two built in.

    Parameters
    ----------
    source : path of a file; a dict; "paper" (Tables 1 and 2 of the paper) or "flat" (its Sec. 3.1). A ``surface.file``
        is relative to the folder of the scene; that of a dict is relative to the working folder
    surface_file, counterface_file : height maps to use instead of the scene's own. A map instead of a generated
        surface keeps its own grid

    Returns
    -------
    Scene

    Raises
    ------
    InputError : a file is missing, a key is unknown (the message names the nearest valid one), a value is missing or
        out of range
    """
    if isinstance(source, dict):
        table = dict(source)
        folder = Path()
        name = "unnamed"
    else:
        table, folder, name = _read(source)
    for section, path in zip(ROUGH_SECTIONS, (surface_file, counterface_file)):
        if path is not None:
            _put_map(table, section, path)
    return scene_from_table(table, folder, name)


def given_tables(source: str) -> dict[str, Any]:
    """Return the tables of a scene file, or of a built-in scene, as they are written; ``source`` as in `load_scene`."""
    return dict(source) if isinstance(source, dict) else _read(source)[0]


def options_of(source: str) -> dict[str, str]:
    """Return the options of ``lubfric run`` that a scene file holds, by name: ``options = ["--ratios=0:0.5:11"]``, as
    resolved.toml of a traction run has them. ``source`` as in `load_scene`. Raises `InputError` for anything else."""
    given = given_tables(source).get(OPTIONS_KEY, [])
    options = {}
    for option in given if isinstance(given, list) else [given]:
        (name, _, value) = str(option).removeprefix("--").partition("=")
        if name not in OPTIONS_IN_FILES or not value or not isinstance(option, str):
            allowed = ", ".join(f'"--{each}=..."' for each in OPTIONS_IN_FILES)
            raise InputError(f" = {validate.shown(given)}", OPTIONS_KEY, f"a list of {allowed}")
        options[name] = value
    return options


def read_toml(path: Path | Traversable, what: str) -> dict[str, Any]:
    """Return the tables of a TOML file; raises `InputError`, which says ``what`` it should be, where it cannot be
    read."""
    try:
        size = path.stat().st_size if isinstance(path, Path) else 0
        if size > MOST_SCENE_BYTES:
            raise InputError(
                f"{what} {validate.shown(str(path))} has {size:.3g} bytes; allowed: up to {MOST_SCENE_BYTES:.3g}"
            )
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except FileNotFoundError:
        raise InputError(f"{what} {validate.shown(str(path))}: no such file") from None
    except (UnicodeDecodeError, OSError) as error:
        raise InputError(f"{what} {validate.shown(str(path))} cannot be read as UTF-8 text: {error}") from None
    except InputError:
        raise
    except (ValueError, RecursionError) as error:  # tomllib's own, integers too long, tables too deep
        message = f"{what} {path} is not valid TOML: {validate.shown(str(error))}"
        raise InputError(f"{message} ({_fault_in_words(str(error))})") from None


def _fault_in_words(message: str) -> str:
    """Return what is wrong with a file of TOML, and what to do, by the ``message`` of its reader."""
    line = re.search(r"at line (\d+)", message)
    where = f"line {line[1]}: " if line else ""
    return where + next((words for begin, words in TOML_FAULTS.items() if message.startswith(begin)), TOML_NUMBERS)


def _put_map(table: dict[str, Any], section: str, path: str | Path) -> None:
    """Put the map at ``path`` instead of the roughness in ``section`` of a scene's ``table``."""
    path = _map_path(f"{section}.file", path, Path())
    if not all(isinstance(table.get(name, {}), dict) for name in (section, "contact")):
        return  # refused by what reads the tables
    rough, contact = ({**table.get(name, {})} for name in (section, "contact"))
    if "file" not in rough:
        for key in ("sq", *PER_SQ, *GENERATED):
            rough.pop(key, None)
        if section == "surface":
            contact.pop("shape", None), contact.pop("spacing", None)
    table |= {section: rough | {"file": str(path)}, "contact": contact}


def _map_path(name: str, given: str | Path, folder: Path) -> Path:
    """Return an existing file, its path absolute."""
    try:
        path = (folder / given).absolute()
        if path.is_file():
            return path
    except (TypeError, ValueError, OSError):
        pass
    near = get_close_matches(
        str(given)[:LONGEST_PATH], [path.name for path in folder.iterdir()] if folder.is_dir() else [], 3, 0.5
    )
    meant = f" (did you mean {' or '.join(map(repr, near))}?)" if near else ""
    where = f" in {folder}" if folder.name else ""
    message = f" = {validate.shown(str(given))}: no such file{where}{meant}"
    raise InputError(message, name, recommendation=f"give its complete path, or its path from {folder.resolve()}")


def builtin_scenes() -> tuple[str, ...]:
    """Return the names that `lubfric.load_scene` knows without a file."""
    return tuple(sorted(f.name.removesuffix(".toml") for f in SCENES.iterdir() if f.name.endswith(".toml")))


def scene_from_table(table: dict[str, Any], folder: Path, name: str) -> Scene:
    """Return a validated `Scene` from the tables of a TOML file."""
    table = {key: value for key, value in table.items() if key != OPTIONS_KEY}
    if "scene" in table:
        recommendation = "use 'lubfric study FILE', with --explain for its points and its time"
        raise InputError("the key 'scene' belongs to the file of a study", recommendation=recommendation)
    validate.keys("scene", table, ("name", *SECTIONS), lambda: keys_elsewhere() | meant("scene"))
    for section in SECTIONS:
        if not isinstance(table.get(section, {}), dict):
            raise InputError(f"scene entry {section!r} must be a table [{section}]")
    table, plan = _plan(table, folder)
    for section in (s for s in SECTIONS if s in table and s != "transient"):
        check_keys(section, table[section], ("sliding_speed",) if section == "motion" else ())
    check_complete(name, table)
    parts = {}
    for section in SECTIONS:
        given = dict(table.get(section, {}))
        if section in ROUGH_SECTIONS and section in table:
            if isinstance(given.get("file"), str):
                given["file"] = str(_map_path(f"{section}.file", given["file"], folder.resolve()))
            with named(section):
                check_fields(given)  # refuses keys that do not apply, whatever their value
        if section != "transient" and (section in table or section != "counterface"):
            parts[section] = made_section(section, given)
    ranges = {k: ends for s in SECTIONS if s in table for k, ends in ranges_of(s, table[s]).items()}
    return Scene(
        **parts,
        name=table.get("name", name),
        transient=plan,
        ranges=as_ranges(ranges),
        doubtful=tuple(row for section in SECTIONS for row in doubtful_values(section, table.get(section))),
    )


def _plan(table: dict[str, Any], folder: Path) -> tuple[dict[str, Any], Transient | None]:
    """Return the `Transient` of a scene, and the table without its histories.

    Histories are in [transient] or, as inline tables, in the sections they belong to. In their place the table gets a
    plain value: the largest load at any time, also after the end of the run, else the value at the start.
    """
    table = {k: dict(v) if isinstance(v, dict) else v for k, v in table.items()}
    given = table.get("transient", {})
    rotational_speed = _rotational_speed(given)
    for name in ("duration", "first_output"):
        if is_angle(given.get(name)):
            given[name] = times_of_angles([without_unit(f"transient.{name}", given[name], "°")], rotational_speed)[0]
    places = {name: key.split(".") for name, key in HISTORIES.items()}
    histories = {
        n: history(f"transient.{n}", given.pop(n), UNITS_OF_HISTORIES[n], folder, rotational_speed)
        for n in HISTORIES
        if n in given
    }
    in_plan = set(histories)
    for name, (section, key) in places.items():
        value = table.get(section, {}).get(key)
        if value is None and name == "sliding":
            table.get(section, {}).pop(key, None)
        if isinstance(value, dict) or (value is not None and name == "sliding"):
            if name in histories:
                raise InputError(f"[transient] {name} and [{section}] {key} are both histories; give one of them")
            value = table[section].pop(key)
            histories[name] = history(f"{section}.{key}", value, UNITS_OF_HISTORIES[name], folder, rotational_speed)
    if not histories and "transient" not in table:
        return table, None
    if "duration" not in given:
        raise InputError("a scene with a history needs [transient] with duration in s")
    elsewhere = {f"transient.{name}": ".".join(places[name]) for name in histories if name not in in_plan}
    try:
        plan = made_section("transient", {**given, **histories})
    except InputError as error:  # by the key that was written
        word, space, rest = error.quantity.partition(" ")
        error.quantity = f"{elsewhere.get(word, word)}{space}{rest}"
        raise
    for name, (section, key) in places.items():
        if name in histories and name != "sliding" and key not in table.get(section, {}):
            value = histories[name].range(histories[name].horizon)[1] if name == "load" else histories[name].before(0.0)
            table.setdefault(section, {})[key] = value
    return table, plan


def _rotational_speed(given: dict[str, Any]) -> float | None:
    """Return the rotational speed [Hz] in the keys ``given`` for [transient]; None without one."""
    if given.get("rotational_speed") is None:
        return None
    name = "transient.rotational_speed"
    return validate.positive(name, read_value("transient", "rotational_speed", given["rotational_speed"])[0], "Hz")


def _read(source: object) -> tuple[dict[str, Any], Path, str]:
    """Return its tables, the folder that its files are relative to, and its name."""
    names = builtin_scenes()
    if not isinstance(source, (str, os.PathLike)):
        message = f"scene {validate.shown(source)} is a {type(source).__name__}"
        raise InputError(message, allowed=f"a path, or one of {names}")
    if str(source) in names:
        return read_toml(SCENES / f"{source}.toml", "scene"), Path(), str(source)
    path = validate.folder("scene", source) if isinstance(source, os.PathLike) else Path(source)
    if not os.path.isfile(path):
        message = f"scene {validate.shown(str(source))} is neither a file nor a built-in scene"
        raise InputError(f"{message}{_nearest_scene(path, names)}; built in: {', '.join(names)}")
    return read_toml(path, "scene"), path.parent, os.fsencode(path.stem).decode("utf-8", "replace")


def _nearest_scene(path: Path, names: tuple[str, ...]) -> str:
    """Return, as `validate.nearest` does, the file next to ``path`` that it may mean, or the built-in scene of
    ``names`` where it is a bare word."""
    if path.suffix or len(path.parts) > 1:
        try:
            names = tuple(file.name for file in path.parent.iterdir() if file.suffix == ".toml")
        except OSError:
            return ""
        stems = {name.removesuffix(".toml"): name for name in names}
        near = get_close_matches(path.stem, stems, 1, NEAR_FILE)  # all end alike
        return f" (did you mean {stems[near[0]]!r}?)" if near else ""
    return validate.nearest(str(path), names)


def write_template(path: Path) -> None:
    """Write a scene that is complete, commented and ready to run to ``path``; raises `InputError` if something is there
    already."""
    path = validate.folder("file", path)
    if os.path.lexists(path):
        raise InputError(f"{path} exists already; give another name (init replaces no file)")
    if not path.parent.is_dir():
        raise InputError(f"{path.parent} is not a folder; give a file in an existing one")
    write_whole(path, (resources.files(__package__) / "template.toml").read_bytes())
