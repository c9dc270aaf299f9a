"""How far the linear beam may bend: held against an inextensible beam of any slope, as docs/theory.md has it."""

import numpy as np
import pytest

POINTS = 1201
ROOT, FAR_EDGE = 2.5 / 7.5, 6.5 / 7.5  # of Table II's hole, over the length


def from_root(f):
    """The integral of f from the clamp to each point; trapezoidal rule."""
    return np.concatenate([[0.0], np.cumsum(0.5 * (f[1:] + f[:-1]))]) / (POINTS - 1)


def to_tip(f):
    integral = from_root(f)
    return integral[-1] - integral


def overstated(linear_tip, follows):
    """Linear over true tip displacement, less 1, of a beam of length 1 under a load known by its linear displacement.

    theta'' = -(shear force across the beam): the load's share in the normal's direction, which either turns with the
    beam or stays upright.
    """
    s = np.linspace(0.0, 1.0, POINTS)
    load = ((s > ROOT) & (s < FAR_EDGE)) + 0.5 * (np.isclose(s, ROOT) | np.isclose(s, FAR_EDGE))
    load *= linear_tip / from_root(from_root(to_tip(to_tip(load))))[-1]
    theta = from_root(to_tip(to_tip(load)))
    for _ in range(200):
        lift = to_tip(load * np.cos(theta)) if follows else to_tip(load)
        drag = to_tip(load * np.sin(theta)) if follows else 0.0
        new = from_root(to_tip(lift * np.cos(theta) + drag * np.sin(theta)))
        change = np.abs(new - theta).max()
        theta = 0.5 * (theta + new)
        if change < 1e-12:
            return linear_tip / from_root(np.sin(theta))[-1] - 1.0
    raise RuntimeError(f"no shape found at {linear_tip}")


@pytest.mark.parametrize(("follows", "percent"), [(True, [0.07, 0.28, 1.13, 2.54]), (False, [0.19, 0.77, 3.04, 6.67])])
def test_error_of_small_slopes(follows, percent):
    """The table of the theory page, to its last digit."""
    found = [100.0 * overstated(u, follows) for u in (0.05, 0.1, 0.2, 0.3)]
    assert found == pytest.approx(percent, abs=0.006)


def test_known_beam():
    """A tip load P L^2/(E I) = 1 that keeps its direction: 0.30172 for 1/3 (Bisshopp and Drucker 1945)."""
    s = np.linspace(0.0, 1.0, POINTS)
    theta = s - 0.5 * s**2
    for _ in range(200):
        theta = 0.5 * (theta + from_root(to_tip(np.cos(theta))))
    assert from_root(np.sin(theta))[-1] == pytest.approx(0.30172, abs=1e-5)
