"""Files that lie or are damaged: height maps of every kind, histories, and results to be drawn again."""

import io
import zipfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import lubfric
from lubfric.scene import read_history

from . import HAND
from .case import HostileCase

MAP = 1e-7 * np.random.default_rng(0).standard_normal((24, 16))
HISTORY = "time [s],speed [m/s]\n0,1\n0.5,2\n1,0\n"
LONG = "9" * 5000 + " 1\n2 3\n"


def npy(array: np.ndarray) -> bytes:
    """Return the bytes of a .npy file."""
    stream = io.BytesIO()
    np.save(stream, array)
    return stream.getvalue()


def archive(members: dict[str, str | bytes]) -> bytes:
    """Return the bytes of a zip file."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as file:
        for name, content in members.items():
            file.writestr(name, content)
    return stream.getvalue()


def x3p(points: bytes = MAP.T.tobytes(), old: str = "", new: str = "") -> bytes:
    """Return the bytes of an X3P file, with ``new`` for ``old`` in its main.xml."""
    axis = "<{0}><AxisType>I</AxisType><DataType>D</DataType><Increment>1e-6</Increment></{0}>"
    document = (
        "<p:ISO5436_2 xmlns:p='http://www.opengps.eu/2008/ISO5436_2'><Record1><FeatureType>SUR</FeatureType><Axes>"
        + axis.format("CX")
        + axis.format("CY")
        + "<CZ><AxisType>A</AxisType><DataType>D</DataType></CZ></Axes></Record1><Record3><MatrixDimension>"
        "<SizeX>24</SizeX><SizeY>16</SizeY><SizeZ>1</SizeZ></MatrixDimension><DataLink><PointDataLink>bin/data.bin</PointDataLink></DataLink></Record3></p:ISO5436_2>"
    )
    return archive({"main.xml": document.replace(old, new) if old else document, "bin/data.bin": points})


def damaged(rng: np.random.Generator, content: bytes) -> tuple[bytes, str]:
    """Return ``content`` cut, or with some bytes overwritten, or with a piece taken out."""
    kind = int(rng.integers(3))
    size = len(content)
    if kind == 0:
        at = int(rng.integers(size))
        return content[:at], f"cut at {at}"
    if kind == 1:
        bad = bytearray(content)
        for place in rng.integers(size, size=int(rng.integers(1, 9))):
            bad[place] = int(rng.integers(256))
        return bytes(bad), "bytes overwritten"
    first, last = sorted(int(i) for i in rng.integers(size, size=2))
    return content[:first] + content[last:], f"{first} to {last} taken out"


def cases(rng: np.random.Generator, count: int) -> Iterator[HostileCase]:
    """Yield at least ``count`` files: those written by hand, then damaged ones of each kind in turn."""
    by_hand = list(_by_hand())
    yield from by_hand
    good = {
        "map.npy": npy(MAP),
        "map.x3p": x3p(),
        "map.txt": b"\n".join(b" ".join(b"%.6e" % v for v in row) for row in MAP.tolist()),
        "map.xyz": b"\n".join(b"%d %d %.6e" % (i, j, v) for (i, j), v in np.ndenumerate(MAP)),
        "run.csv": HISTORY.encode("utf-8"),
    }
    names = list(good)
    for i in range(max(0, count - len(by_hand))):
        name = names[i % len(names)]
        content, what = damaged(rng, good[name])
        yield _case(name, what, content, may_pass=True)


def _by_hand() -> Iterator[HostileCase]:
    for text in (*HAND["files"]["grid"], LONG):
        for name in ("map.txt", "map.csv", "map.asc"):
            yield _case(name, repr(text[:30]), text.encode("utf-8"))
    for text in HAND["files"]["points"]:
        yield _case("map.xyz", repr(text[:30]), text.encode("utf-8"))
    for text in HAND["files"]["history"]:
        yield _case("run.csv", repr(text[:30]), text.encode("utf-8"))
    for name in ("map.npy", "map.txt", "map.xyz", "map.x3p", "run.csv", "map.foo", "map.sur", "map"):
        yield _case(name, "no such file", None)
        yield _case(name, "random bytes", b"\0" + bytes(np.random.default_rng(1).integers(0, 256, 999, dtype=np.uint8)))
    for array in (np.zeros(5), np.zeros((2, 2, 2)), np.zeros((0, 3)), np.ones((2, 2), complex), np.ones((2, 2), bool)):
        yield _case("map.npy", f"{array.dtype} {array.shape}", npy(array))
    for array in (np.full((3, 3), np.nan), np.full((3, 3), np.inf), np.array([["a", "b"]]), np.full((3, 3), 1e308)):
        yield _case("map.npy", f"{array.dtype} of {array.flat[0]}", npy(array))
    huge = npy(MAP).replace(b"(24, 16)", b"(24000000, 16000000)")
    yield _case("map.npy", "huge shape", huge.replace(b"                \n", b"\n", 1))
    wrong = {what: x3p(old=old, new=new) for what, (old, new) in HAND["x3p"].items()}
    for what, points in (
        ("no points", np.zeros(0)),
        ("NaN only", MAP * np.nan),
        ("infinite", np.full(MAP.shape, np.inf)),
    ):
        wrong[what] = x3p(points.tobytes())
    wrong["entities"] = archive({"main.xml": "<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>"})
    wrong |= {"no XML": archive({"main.xml": "hello"}), "no member": archive({"other.xml": "<a/>"})}
    for what, content in wrong.items():
        yield _case("map.x3p", what, content)


def _case(name: str, what: str, content: bytes | None, *, may_pass: bool = False) -> HostileCase:
    def run(folder: Path) -> object:
        path = folder / name
        if content is not None:
            path.write_bytes(content)
        if name.endswith("run.csv"):
            return read_history(path, "speed", unit="m/s").range(1.0)
        carries_its_own = name.endswith((".xyz", ".x3p", ".sur"))
        return lubfric.read_surface(path, spacing=None if carries_its_own else 1e-6).describe()

    return HostileCase("file", f"{name}, {what}", run, may_pass)
