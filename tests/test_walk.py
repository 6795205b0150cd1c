"""A scene's walk through `friction`, call by call: how often it comes back to a module that it had left."""

import sys
from pathlib import Path

import lubfric

HOME = str(Path(lubfric.__file__).parent)
MOST = 22
VALUES = ("_base", "errors", "scene", "oil")  # rooms of values and checks
SCENE = lubfric.load_scene("paper").with_(numerics={"sampling": "patch"})


def rooms_on_the_way(call) -> list[str]:
    """Modules in the order in which functions that take the scene, or what was made of it, are first called; a call
    on the way back up is no step."""
    seen, rooms = set(), []

    def watch(frame, event, _):
        code = frame.f_code
        if event != "call" or not code.co_filename.startswith(HOME) or code in seen:
            return
        taken = [frame.f_locals.get(name) for name in code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]]
        if any(isinstance(t, (lubfric.Scene, lubfric.Prepared)) or hasattr(t, "prepared") for t in taken):
            seen.add(code)
            room = Path(code.co_filename).relative_to(HOME).with_suffix("").as_posix()
            if room.split("/")[0] not in VALUES and (not rooms or rooms[-1] != room):
                rooms.append(room)

    sys.setprofile(watch)
    try:
        call()
    finally:
        sys.setprofile(None)
    return rooms


def returns(rooms: list[str]) -> int:
    """How often a room stands again that stood before."""
    return len(rooms) - len(set(rooms))


def test_the_scene_seldom_comes_back_to_a_module_it_had_left():
    lubfric.friction(SCENE, 0.01)  # modules that load on first use are there now
    rooms = rooms_on_the_way(lambda: lubfric.friction(SCENE, 0.01))
    assert {
        "estimate/friction",
        "estimate/sample",
        "models/load_sharing/prepared",
        "models/load_sharing/balance",
        "estimate/cells",
    } <= set(rooms)
    assert returns(rooms) <= MOST, rooms
