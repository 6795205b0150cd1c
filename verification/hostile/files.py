"""Files that lie or are damaged: height maps of every kind, histories, and results to be drawn again."""

import io
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import MappingProxyType

import numpy as np

import lubfric
from lubfric.scene import read_history

from .case import Case

MAP = 1e-7 * np.random.default_rng(0).standard_normal((24, 16))
HISTORY = "time [s],speed [m/s]\n0,1\n0.5,2\n1,0\n"
HOSTILE_TEXT = (
    "", "\n\n", "# only a comment\n", "x y z\n", "1 2\n3\n", "1 2\n3 four\n", "1,5 2.5\n3,5 4.5\n", "1e999 2\n3 4\n",
    "nan nan\nnan nan\n", "inf 1\n2 3\n", "1\x002\n3 4\n", "[mm]\n1 2\n3 4\n", "1 2\n3 4\nend\n", "1;2;3\n1;2\n",
    "0x10 0x11\n0x12 0x13\n", "1_0 2\n3 4\n", "true false\nfalse true\n", "1+2j 1\n2 3\n",
    "1e308 -1e308\n-1e308 1e308\n", "# spacing = a b\n1 2\n3 4\n", "# spacing = -1e-6\n1 2\n3 4\n",
    "# spacing = 0\n1 2\n3 4\n", "# spacing = 1e-6 1e-6 1e-6\n1 2\n3 4\n", "9" * 5000 + " 1\n2 3\n",
    "<html><body>404</body></html>", '{"heights": [[1, 2], [3, 4]]}',
)  # fmt: skip
HOSTILE_POINTS = (
    "", "0 0\n0 1\n1 0\n", "0 0 1\n", "0 0 1\n0 1 1\n0 2 1\n", "0 0 1\n0 0 2\n1 0 1\n1 1 1\n",
    "0 0 1\n0 1 1\n1 0 1\n1 1.3 1\n2 0 1\n2 1 1\n", "1e308 0 1\n-1e308 1 1\n0 0 1\n0 1 1\n",
    "0 0 1e308\n0 1 -1e308\n1 0 0\n1 1 0\n", "0 0 1\n0 1 1\n1 0 1\n1e-300 1 1\n", "nan 0 1\n0 1 1\n1 0 1\n1 1 1\n",
    "0 0 inf\n0 1 1\n1 0 1\n1 1 1\n", "0 0 1\n0 1e9 1\n1e9 0 1\n1 1 1\n0.001 0.001 1\n",
)  # fmt: skip
HOSTILE_HISTORIES = (
    "", "time,speed\n", "time,speed\n0,1\n", "time,speed\n0,1\n1,x\n", "time,speed\n0,1\n1\n",
    "time,speed\n1,1\n0,2\n", "time,speed\n0,nan\n1,2\n", "time,speed\n0,1e999\n1,2\n",
    "time [parsec],speed\n0,1\n1,2\n", "time,speed [N]\n0,1\n1,2\n", "time,spead\n0,1\n1,2\n",
    "time,speed,speed\n0,1,1\n1,2,2\n", "time;speed\n0;1,5.0\n1;2\n", "time,speed\n5,1\n6,2\n",
    "time,speed\n0,1\n0,2\n0,3\n1,1\n", "\x00\x01\x02",
)  # fmt: skip


def npy(array: np.ndarray) -> bytes:
    """The bytes of a .npy file."""
    stream = io.BytesIO()
    np.save(stream, array)
    return stream.getvalue()


def archive(**members: str) -> bytes:
    """The bytes of a zip file."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as file:
        for name, text in members.items():
            file.writestr(name.replace("__", "."), text)
    return stream.getvalue()


def x3p(size: str = "24", points: bytes | None = None, changes: Mapping[str, str] = MappingProxyType({})) -> bytes:
    """The bytes of an X3P file; ``changes`` replaces text in its main.xml."""
    axis = "<{0}><AxisType>I</AxisType><DataType>D</DataType><Increment>1e-6</Increment></{0}>"
    document = (
        "<p:ISO5436_2 xmlns:p='http://www.opengps.eu/2008/ISO5436_2'><Record1><FeatureType>SUR</FeatureType><Axes>"
        + axis.format("CX")
        + axis.format("CY")
        + "<CZ><AxisType>A</AxisType><DataType>D</DataType></CZ></Axes></Record1><Record3><MatrixDimension>"
        f"<SizeX>{size}</SizeX><SizeY>16</SizeY><SizeZ>1</SizeZ></MatrixDimension><DataLink><PointDataLink>bin/data.bin"
        "</PointDataLink></DataLink></Record3></p:ISO5436_2>"
    )
    for old, new in changes.items():
        document = document.replace(old, new)
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as file:
        file.writestr("main.xml", document)
        file.writestr("bin/data.bin", MAP.T.tobytes() if points is None else points)
    return stream.getvalue()


def damaged(rng: np.random.Generator, content: bytes) -> tuple[bytes, str]:
    """``content`` cut, or with some bytes overwritten, or with a piece taken out."""
    kind, size = int(rng.integers(3)), len(content)
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


def cases(rng: np.random.Generator, count: int) -> Iterator[Case]:
    """At least ``count`` files: those made by hand, then damaged ones of each kind in turn."""
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


def _by_hand() -> Iterator[Case]:
    for text in HOSTILE_TEXT:
        for name in ("map.txt", "map.csv", "map.asc"):
            yield _case(name, repr(text[:30]), text.encode("utf-8"))
    for text in HOSTILE_POINTS:
        yield _case("map.xyz", repr(text[:30]), text.encode("utf-8"))
    for text in HOSTILE_HISTORIES:
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
    wrong = {
        "size 0": x3p("0"),
        "size -1": x3p("-1"),
        "size 1e8 x 16": x3p("100000000"),
        "another size": x3p("25"),
        "no points": x3p(points=b""),
        "NaN only": x3p(points=np.full(MAP.shape, np.nan).tobytes()),
        "infinite": x3p(points=np.full(MAP.shape, np.inf).tobytes()),
        "a path outside": x3p(changes={"bin/data.bin": "../../etc/passwd"}),
        "spacing 0": x3p(changes={"1e-6": "0"}),
        "spacing NaN": x3p(changes={"1e-6": "nan"}),
        "spacing 1e308": x3p(changes={"1e-6": "1e308"}),
        "no axes": x3p(changes={"Axes": "Axis"}),
        "a profile": x3p(changes={"SUR": "PRF"}),
        "entities": archive(main__xml="<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>"),
        "no XML": archive(main__xml="hello"),
        "no member": archive(other__xml="<a/>"),
    }
    for what, content in wrong.items():
        yield _case("map.x3p", what, content)


def _case(name: str, what: str, content: bytes | None, may_pass: bool = False) -> Case:
    def run(folder: Path) -> object:
        path = folder / name
        if content is not None:
            path.write_bytes(content)
        if name.endswith("run.csv"):
            return read_history(path, "speed", unit="m/s").range(1.0)
        carries_its_own = name.endswith((".xyz", ".x3p", ".sur"))
        return lubfric.read_surface(path, **({} if carries_its_own else {"spacing": 1e-6})).describe()

    return Case("file", f"{name}, {what}", run, may_pass)
