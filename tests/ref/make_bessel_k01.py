"""Write bessel_k01.txt: exp(z) K0(z) and exp(z) K1(z) in the right half plane.

Run: python make_bessel_k01.py > bessel_k01.txt   (needs mpmath)
"""

import cmath
import math

import mpmath

mpmath.mp.dps = 50

SWITCH = 2.0  # |z| where the code changes from series to continued fraction
ARGUMENTS_DEG = (-45.0, 0.0, 45.0, 20.0, -70.0, 80.0)


def moduli(angle_deg):
    """|z| from 1e-3 to 1e2 (fine on Sader's ray, coarse elsewhere) and both sides of the switch."""
    steps = 50 if angle_deg == -45.0 else 10
    spread = [10.0 ** (-3.0 + 5.0 * i / steps) for i in range(steps + 1)]
    return sorted(spread + [SWITCH * (1.0 - 1e-9), SWITCH * (1.0 + 1e-9), 1.9, 2.1])


print("# exp(z) K0(z) and exp(z) K1(z) by mpmath with 50 digits, rounded to 17; made by make_bessel_k01.py")
print("# re(z) im(z) re(k0) im(k0) re(k1) im(k1)")
for angle in ARGUMENTS_DEG:
    print(f"# arg z = {angle:g} degrees")
    for modulus in moduli(angle):
        z = cmath.rect(modulus, math.radians(angle))
        exact = mpmath.mpc(z.real, z.imag)
        row = [z.real, z.imag]
        for order in (0, 1):
            k = mpmath.exp(exact) * mpmath.besselk(order, exact)
            row += [float(k.real), float(k.imag)]
        print(" ".join(f"{value:.16e}" for value in row))
