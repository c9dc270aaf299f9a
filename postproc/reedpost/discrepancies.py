"""What does not fit, in the paper and between the paper and us, in plain words."""

from __future__ import annotations

from reedpost.film_discrepancies import film_discrepancies
from reedpost.results import Result

DISCREPANCIES = (
    (
        "The squeeze factor is rounded in print",
        "Table II prints k_s = 0.008. With 0.0075, which rounds to it, all sixteen published values"
        " of the proposed model are met; with 0.008 to the letter every time comes out 4 to 9 % above"
        " the published one. The decks for the paper's tables use 0.0075.",
    ),
    (
        "Nothing is tuned to the finite elements or the experiment",
        "The paper leaves open the Reynolds number, the frequency and the length that its hydrodynamic"
        " load acts on. The choice made here ('published') is the one that reproduces the paper's own"
        " model curves; k_a and k_s are the paper's. The same values hold for every pressure, gap and"
        " trace. The errors against finite elements and experiment are what they are.",
    ),
    (
        "One published value breaks its own column",
        "The proposed model's closing time at 10 kPa (5.00 ms, Table IV) lies off the smooth line"
        " through its neighbours. Ours is 2.9 % above it there and within 2 % everywhere else.",
    ),
    (
        "Misprints",
        "Eq. (17) integrates the deflection shape where Eq. (16) demands its square. Eq. (26) carries"
        " a factor 8 where the integral of Eq. (25) gives 1. Eqs. (24) to (26) divide by u(L)^3, which"
        " has no meaning at rest; the film there is u(L) + g0 thick, with g0 the gap at rest. The"
        " equations are used here as corrected.",
    ),
    (
        "The pressure traces of Table V are reconstructed, not measured",
        "The measured traces are not published, only their mean fall rates. Each trace is a straight"
        " fall at that rate, capped at an assumed open pressure difference of 60 kPa, with its zero"
        " placed such that the traditional model closes at its published time. So the traditional"
        " model's agreement in Table V is by construction and says nothing; the squeeze model's times"
        " are predictions, and they differ from those the paper found with the measured traces.",
    ),
    (
        "The text contradicts Table V",
        "Sec. V B 2 says that the valve closes after 3.4 ms in the first condition (Fig. 14), Table V"
        " and Sec. V B 3 say 3.9 ms for it and 3.4 ms for the third. Table V is used here.",
    ),
    (
        "The lumped models' steady displacement is 2 % below the finite elements'",
        "The lumped models open to 0.0933 mm at 20 kPa, the finite elements to 0.0951 mm (Table I).",
    ),
    (
        "The lumped film lets go earlier",
        "The finite elements swing below the rest position from a gap of 0.15 mm on, the squeeze model"
        " from about 0.09 mm on.",
    ),
    (
        "Differences below the finite elements' own scatter mean nothing",
        "Their four meshes (Table I) differ by 5 % in fall time and by 4 % in closing time.",
    ),
    (
        "The paper's percentages are from unrounded times",
        "Errors here are taken from the printed times, so those of the published models differ from"
        " the paper's parentheses by a few tenths of a per cent.",
    ),
)


def discrepancies(results: list[Result]) -> list[tuple[str, str]]:
    """Title and text of each; the film models' with figures from the results, where these hold them."""
    return [*film_discrepancies(results), *DISCREPANCIES]
