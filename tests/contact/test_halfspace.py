"""Half-space operators against quadrature, closed forms, each other, and their own symmetries."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import dblquad, quad
from scipy.special import k0

from lubfric import InputError
from lubfric.contact import bessel_cells, half_space, line_coefficients, love_coefficients, semiperiodic_coefficients
from lubfric.contact.operator import filtered

BOUNDARIES = [(a, b) for a in ("periodic", "free") for b in ("periodic", "free")]


def dense(operator):
    """The operator as a matrix."""
    basis = np.eye(operator.shape[0] * operator.shape[1])
    return np.array([operator.apply(row.reshape(operator.shape)).ravel() for row in basis]).T


def reciprocity_error(operator, seed):
    """Relative difference of q·Kp and p·Kq for random p, q (Maxwell-Betti)."""
    p, q = np.random.default_rng(seed).standard_normal((2, *operator.shape))
    kp, kq = (np.asarray(operator.apply(f), dtype=float) for f in (p, q))
    scale = np.linalg.norm(q) * np.linalg.norm(kp) + np.linalg.norm(p) * np.linalg.norm(kq)
    return abs(np.vdot(q, kp) - np.vdot(p, kq)) / scale if scale > 0 else 0.0


def test_love_coefficients_match_quadrature():
    dx = 1.5
    dy = 0.7
    e_prime = 3.0
    table = love_coefficients((4, 5), (dx, dy), e_prime)
    for i, j in ((1, 0), (0, 2), (3, 4), (1, 1)):
        value, _ = dblquad(
            lambda y, x, i=i, j=j: 1 / np.hypot(i * dx - x, j * dy - y), -dx / 2, dx / 2, -dy / 2, dy / 2, epsabs=1e-11
        )
        assert table[i, j] == pytest.approx(2 / (np.pi * e_prime) * value, rel=1e-8)
    inner, _ = quad(lambda t: 4 * (dx / 2) / np.cos(t), 0, np.arctan(dy / dx))  # polar, around the centre
    outer, _ = quad(lambda t: 4 * (dy / 2) / np.cos(t), 0, np.arctan(dx / dy))
    assert table[0, 0] == pytest.approx(2 / (np.pi * e_prime) * (inner + outer), rel=1e-12)


def test_line_coefficients_match_quadrature():
    dx = 0.3
    e_prime = 2.0
    far = 7.0
    table = line_coefficients(6, dx, e_prime, far)
    for i in range(6):
        pieces = [
            quad(lambda s, i=i: np.log(abs(i * dx - s) / far), *ends, epsabs=1e-13)[0]
            for ends in ((-dx / 2, 0.0), (0.0, dx / 2))
        ]
        assert table[i] == pytest.approx(-4 / (np.pi * e_prime) * sum(pieces), rel=1e-9)


def test_semiperiodic_coefficients_match_quadrature():
    shape = (9, 8)
    (dx, dy) = (0.4, 0.3)
    e_prime = 2.0
    table = semiperiodic_coefficients(shape, (dx, dy), e_prime)
    for m in (1, 2, 4):
        k = 2 * np.pi * m / (shape[1] * dy)
        for i in range(shape[0]):
            low = (i - 0.5) * dx
            high = (i + 0.5) * dx
            value = (
                2 * quad(lambda s, k=k: k0(k * s), 0, high, epsrel=1e-12)[0]
                if i == 0
                else quad(lambda s, k=k: k0(k * s), low, high, epsrel=1e-12)[0]
            )
            assert table[i, m] == pytest.approx(4 / (np.pi * e_prime) * value, abs=1e-13 * table[0, m])
    assert table[:, 0] == pytest.approx(line_coefficients(9, dx, e_prime, 9 * dx))


@pytest.mark.parametrize("cells_per_wavelength", [1e3, 40, 3, 0.2])
def test_bessel_cells_over_all_scales(cells_per_wavelength):
    k = 2 * np.pi / cells_per_wavelength
    cells = bessel_cells(np.arange(12), np.full(12, k))
    for i in range(1, 12):
        assert cells[i] == pytest.approx(quad(lambda s: k0(k * s), i - 0.5, i + 0.5, epsabs=1e-16)[0], abs=2e-14)


@settings(max_examples=40)
@given(
    shape=st.tuples(st.integers(1, 13), st.integers(1, 13)),
    boundary=st.sampled_from(BOUNDARIES),
    spacing=st.tuples(st.floats(0.02, 50), st.floats(0.02, 50)),
    seed=st.integers(0, 99),
)
def test_reciprocity_and_positivity(shape, boundary, spacing, seed):
    operator = half_space(shape, spacing, 2.0, boundary)
    assert reciprocity_error(operator, seed) < 1e-14
    assert reciprocity_error(operator.single, seed) < 1e-6
    matrix = dense(operator)
    eigenvalues = np.linalg.eigvalsh(0.5 * (matrix + matrix.T))
    assert eigenvalues.min() >= -1e-12 * eigenvalues.max()
    if "free" in boundary:
        assert eigenvalues.min() > 0


@pytest.mark.parametrize("shape", [(12, 10), (11, 9), (1, 8), (7, 1)])
def test_periodic_deflection_of_a_wave(shape):
    dx = 0.5
    dy = 0.8
    e_prime = 3.0
    kx = 2 * np.pi / (shape[0] * dx) * (shape[0] > 1)
    ky = 2 * np.pi / (shape[1] * dy) * (shape[1] > 1)
    phase = kx * dx * np.arange(shape[0])[:, None] + ky * dy * np.arange(shape[1])
    u = half_space(shape, (dx, dy), e_prime).apply(5.0 + np.cos(phase))
    assert u == pytest.approx(4 / (e_prime * np.hypot(kx, ky)) * np.cos(phase), abs=1e-13)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_fft_equals_direct_sum(boundary):
    """Padding leaves no image: a single loaded cell reproduces the kernel in every corner."""
    shape = (6, 7)
    spacing = (0.4, 0.9)
    operator = half_space(shape, spacing, 2.0, boundary)
    p = np.zeros(shape)
    p[0, 0] = 1.0
    u = operator.apply(p)
    if boundary == ("free", "free"):
        assert u == pytest.approx(love_coefficients(shape, spacing, 2.0), rel=1e-12)
    q = np.zeros(shape)
    q[-1, -1] = 1.0
    assert operator.apply(q)[::-1, ::-1] == pytest.approx(u, rel=1e-12, abs=1e-13 * abs(u).max())


def test_transposed_semiperiodic():
    p = np.random.default_rng(0).random((10, 6))
    u = half_space((10, 6), (0.3, 0.5), 2.0, ("free", "periodic")).apply(p)
    v = half_space((6, 10), (0.5, 0.3), 2.0, ("periodic", "free")).apply(p.T)
    assert v.T == pytest.approx(u, rel=1e-12)


def test_single_precision():
    p = np.random.default_rng(3).random((30, 20))
    for boundary in BOUNDARIES:
        operator = half_space((30, 20), 0.1, 2.0, boundary)
        single = operator.single.apply(p.astype(np.float32))
        u = operator.apply(p)
        assert single.dtype == np.float32
        assert np.abs(single - u).max() < 2e-6 * np.abs(u).max()


@pytest.mark.parametrize(
    "arguments, word",
    [({"shape": (0, 4)}, "shape"), ({"spacing": 0.0}, "spacing"), ({"spacing": (1, 2, 3)}, "spacing")]
    + [({"e_prime": 0.0}, "e_prime"), ({"boundary": ("periodic",)}, "boundary")]
    + [({"boundary": ("periodic", "fre")}, "free"), ({"workers": 0}, "workers")],
)
def test_bad_input(arguments, word):
    with pytest.raises(InputError, match=word):
        half_space(**({"shape": (4, 4), "spacing": 1.0, "e_prime": 1.0} | arguments))
    with pytest.raises(InputError, match="shape"):
        half_space((4, 5), 1.0, 1.0).apply(np.zeros((5, 4)))


@settings(max_examples=30)
@given(
    nx=st.integers(8, 60),
    ny=st.integers(1, 40),
    spacing=st.tuples(st.floats(0.05, 20), st.floats(0.05, 20)),
    first=st.integers(0, 59),
    count=st.integers(1, 20),
)
def test_a_loaded_strip_deflects_as_in_the_whole_patch(nx, ny, spacing, first, count):
    """Waves cut off where they end: to rounding the same as transforms of the whole patch, in either precision."""
    operator = half_space((nx, ny), spacing, 2.0, ("free", "periodic"))
    first = min(first, nx - 1)
    pressure = np.zeros((nx, ny))
    pressure[first : first + count] = np.random.default_rng(0).random(pressure[first : first + count].shape)
    whole = filtered(pressure, operator.symbol, operator.padded, None)
    tiny = abs(whole).max()
    rows = min(count, nx - first)
    for some, error in ((operator, 1e-14), (operator.single, 2e-6)):
        loaded = pressure[first : first + rows].astype(some.symbol.dtype)
        assert some.window(rows)(loaded) == pytest.approx(whole[first : first + rows], abs=error * tiny)


def test_coarse_cells_of_a_strip_keep_the_gauge():
    operator = half_space((24, 12), (0.3, 0.5), 2.0, ("free", "periodic"))
    coarse = operator.coarsened((2, 1))
    pressure = np.zeros((12, 12))
    pressure[3] = 1.0
    expected = operator.apply(pressure.repeat(2, axis=0))
    assert coarse.apply(pressure)[9:] == pytest.approx(
        expected.reshape(12, 2, 12).mean(axis=1)[9:], abs=1e-3 * expected.max()
    )
