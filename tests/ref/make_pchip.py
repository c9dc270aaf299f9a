"""Write pchip.txt: SciPy's shape-preserving cubic (PchipInterpolator) on sets with steps, turns and plateaus.

Run: python make_pchip.py > pchip.txt   (needs numpy and scipy)
"""

import numpy as np
from scipy.interpolate import PchipInterpolator

SETS = (
    # even spacing, monotone
    ([0.0, 1.0, 2.0, 3.0, 4.0], [0.0, 1.0, 8.0, 27.0, 64.0]),
    # uneven spacing, turns and a plateau
    ([0.0, 0.5, 2.0, 2.25, 3.0, 5.0, 5.5, 7.0], [1.0, 3.0, 2.0, 2.0, 2.0, -1.0, 4.0, 4.5]),
    # two samples: a straight line
    ([1.0, 3.0], [2.0, -4.0]),
    # the three-point end slope points the wrong way at the left end
    ([0.0, 1.0, 1.25, 3.0], [0.0, 0.5, 4.0, 5.0]),
    # a turn right after each end, end slopes steeper than three secants
    ([0.0, 1.0, 1.1, 3.0, 3.2, 5.0], [0.0, 0.2, -3.0, -3.5, 9.0, 8.5]),
    # a falling pressure in SI units: times in ms, values in Pa, a sharp knee
    ([0.5, 0.50150, 0.50175, 0.5022, 0.503, 0.510], [60000.0, 58500.0, 41000.0, 9500.0, 1200.0, 0.0]),
)

print("# PchipInterpolator of SciPy on the sets of make_pchip.py, values and slopes at the samples and between them")
print("# set sample(1)/between(0) x value slope")
for number, (x, y) in enumerate(SETS, start=1):
    curve = PchipInterpolator(x, y)
    slope = curve.derivative()
    for xi, yi in zip(x, y, strict=True):
        print(f"{number} 1 {xi:.17g} {yi:.17g} {float(slope(xi)):.16e}")
    for fraction in (0.125, 0.5, 0.8125):
        for xi in np.array(x[:-1]) + fraction * np.diff(x):
            print(f"{number} 0 {xi:.17g} {float(curve(xi)):.16e} {float(slope(xi)):.16e}")
