"""Small files as instruments write them: .x3p (ISO 25178-72), .sur (Digital Surf) and .sdf (ISO 25178-71); and the
optional package that reads the last two, or where it is not installed a stand-in that reads these."""

import hashlib
import struct
import zipfile
from types import SimpleNamespace

import numpy as np

SUR = "<12s4H30s30s5H2IH4iI3f16s16s16s16s16s16s16s16s16s3f3H3I7hf2I3H128s3f34s"
SDF = "<8s10s12s12s2H4d3B"
UNMEASURED = -(2**31) + 10


def write_sur(path, heights, steps, unit="mm", name=b"Height"):
    """A .sur file of ``heights[ix, iy]`` [m], NaN where unmeasured; ``steps`` (dx, dy) [m]. x runs fastest."""
    scale = {"m": 1.0, "mm": 1e3, "um": 1e6}[unit]
    fine = np.nanmax(np.abs(heights)) * scale / 2**30
    counts = np.where(np.isnan(heights), UNMEASURED, np.rint(np.nan_to_num(heights) * scale / fine)).astype("<i4")
    (nx, ny) = heights.shape
    words = [b"X", b"Y", name, *(6 * [unit.encode()])]
    lowest = UNMEASURED + 2
    highest = int(counts.max())
    head = (b"DIGITAL SURF", 0, 1, 1, 2, b"map", b"instrument", 0, 0, 0, int(np.isnan(heights).any()), 0, 0, 0, 32)
    size = (lowest, highest, nx, ny, nx * ny, *(step * scale for step in steps), fine)
    rest = (1.0, 1.0, 1.0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 2020, 3, 0.0, 0, 0, 0, 0, 0, b"", 0.0, 0.0, 0.0, b"")
    path.write_bytes(struct.pack(SUR, *head, *size, *words, *rest) + counts.T.tobytes())
    return path


def write_sdf(path, heights, steps):
    """A binary .sdf file of ``heights[ix, iy]`` [m], NaN where unmeasured; ``steps`` (dx, dy) [m]."""
    nx, ny = heights.shape
    head = (b"bISO-1.0", b"instrument", b"010120200000", b"010120200000", nx, ny, *steps, 1.0, -1.0, 0, 7, 0)
    path.write_bytes(struct.pack(SDF, *head) + heights.T.astype("<f8").tobytes())
    return path


def write_x3p(
    path,
    z,
    kind="D",
    *,
    steps=(1e-6, 2.5e-6),
    mask=None,
    increment=None,
    offset=0.0,
    size=None,
    data=None,
    xml=None,
    data_name="bindata/data.bin",
    stored_name=None,
    skip=(),
    extra=(),
):
    """An X3P file of z[ix, iy] [m] with ``steps`` (dx, dy) [m]; the other keywords override single parts of a correct
    file."""
    types = {"I": "<i2", "L": "<i4", "F": "<f4", "D": "<f8"}
    raw = z if increment is None else np.rint((z - offset) / increment)
    data = raw.T.astype(types[kind]).tobytes() if data is None else data
    nx, ny = z.shape if size is None else size
    valid = None if mask is None else np.packbits(mask.T.ravel(), bitorder="little").tobytes()
    z_axis = "" if increment is None else f"<Increment>{increment!r}</Increment>"
    links = f"<PointDataLink>{data_name}</PointDataLink>"
    links += f"<MD5ChecksumPointData>{hashlib.md5(data).hexdigest().upper()}</MD5ChecksumPointData>"
    if valid is not None:
        links += "<ValidPointsLink>bindata/valid.bin</ValidPointsLink>"
        links += f"<MD5ChecksumValidPoints>{hashlib.md5(valid).hexdigest()}</MD5ChecksumValidPoints>"
    text = f"""<?xml version="1.0" encoding="UTF-8"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">
 <Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>
  <CX><AxisType>I</AxisType><DataType>L</DataType><Increment>{steps[0]!r}</Increment><Offset>1e-3</Offset></CX>
  <CY><AxisType>I</AxisType><DataType>L</DataType><Increment>{steps[1]!r}</Increment><Offset>0</Offset></CY>
  <CZ><AxisType>A</AxisType><DataType>{kind}</DataType>{z_axis}<Offset>{offset!r}</Offset></CZ>
 </Axes></Record1>
 <Record3><MatrixDimension><SizeX>{nx}</SizeX><SizeY>{ny}</SizeY><SizeZ>1</SizeZ></MatrixDimension>
  <DataLink>{links}</DataLink></Record3>
 <Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4></p:ISO5436_2>"""
    text = text.encode() if xml is None else xml(text)
    members = [
        ("main.xml", text),
        (stored_name or data_name, data),
        ("md5checksum.hex", f"{hashlib.md5(text).hexdigest()} *main.xml".encode()),
    ]
    members += [("bindata/valid.bin", valid)] if valid is not None else []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in [m for m in members if m[0] not in skip] + list(extra):
            archive.writestr(name, content)
    return path


def _read_sur(raw):
    head = struct.unpack_from(SUR, raw)
    nx, ny = head[17:19]
    heights = np.frombuffer(raw, "<i4", nx * ny, struct.calcsize(SUR)).reshape(ny, nx).T
    unit = head[28].rstrip(b"\0").decode()
    mask = heights == head[15] - 2
    return np.ma.masked_array(heights * head[22], mask if head[10] else False), (nx * head[20], ny * head[21]), unit


def _read_sdf(raw):
    *_, nx, ny, dx, dy, scale, _, _, _, _ = struct.unpack_from(SDF, raw)
    heights = np.frombuffer(raw, "<f8", nx * ny, struct.calcsize(SDF)).reshape(ny, nx).T * scale
    return np.ma.masked_invalid(heights), (nx * dx, ny * dy), "m"


def open_topography(path):
    """The reader of a .sur or .sdf file, with what `lubfric` asks of SurfaceTopography's."""
    with open(path, "rb") as file:
        raw = file.read()
    heights, sizes, unit = (_read_sur if raw.startswith(b"DIGITAL SURF") else _read_sdf)(raw)
    channels = [SimpleNamespace(name="Default")]
    result = SimpleNamespace(heights=lambda: heights, physical_sizes=sizes, unit=unit)
    return SimpleNamespace(channels=channels, topography=lambda channel_index: [result][channel_index])


def metres_after(words, text):
    """The length [m] that follows these ``words`` in a message, with its unit."""
    number, unit = text.split(words)[1].split()[:2]
    return float(number) * {"m": 1.0, "mm": 1e-3, "µm": 1e-6, "nm": 1e-9}[unit.strip(",;.()")]
