"""Laws of friction by the speed of the slip, as text for the coefficient of a `Mechanism`.

On Sigma the speed is 0: limit directions and critical sets are those of Coulomb's law with the static coefficient. The
slope there acts once the contact slips: it slides steadily at a speed v where the other forces balance friction, and
loses that to stick-slip where mu'(v) N outweighs the damping.
"""

from __future__ import annotations

import math

from .formula_reading import as_text


def stribeck(
    static: float | str, kinetic: float | str, speed: float | str, exponent: float | str = 2.0,
    viscous: float | str = 0.0,
) -> str:  # fmt: skip
    """Return Stribeck's coefficient of friction, which falls with the speed v = |(x, y)| of the slip, as text.

    ``mu(v) = kinetic + (static - kinetic) exp(-(v/speed)^exponent) + viscous v``. After R. Stribeck, Z. VDI 46 (1902)
    1341-1348, who measured that it falls; the exponential is that of L. C. Bo and D. Pavelescu, Wear 82 (1982) 277-289,
    who find exponents from 0.5 to 1; with 2 it is that of B. Armstrong-Hélouvry, Control of Machines with Friction
    (1991), smooth where the slip stops.

    Parameters
    ----------
    static, kinetic : float or text
        Coefficients at rest and at speed; a number, or a formula in names that the mechanism knows.
    speed : float or text
        Speed at which it falls.
    exponent : float or text
    viscous : float or text
        Its rise with the speed, in units of 1/speed.

    Returns
    -------
    str
        For `Mechanism` and `contact` as mu.

    Raises
    ------
    ValueError
        What is given is no finite number and no text, or speed or exponent is not positive.

    Examples
    --------
    A block pulled at constant force sticks until static friction gives way:

    >>> from codim2_core.systems.mechanics import Mechanism, stribeck
    >>> stribeck(0.6, "mu", 0.01)
    '(mu) + ((0.6) - (mu))*exp(-((x**2 + y**2)/(0.01)**2)**(1.0))'
    >>> block = Mechanism(((1, 0), (0, 1)), ((1, 0), (0, 1)), ("F", 0), stribeck(0.6, "mu", 0.01), 10, ("vx", "vy"),
    ...                   parameters={"F": 5.0, "mu": 0.4})
    >>> block.grip().sentence
    'It cannot start to slip: sticking needs a friction of 5, and 6 is available in that direction.'
    """
    given = {"static": static, "kinetic": kinetic, "speed": speed, "exponent": exponent, "viscous": viscous}
    texts = {name: as_text(value, name) for name, value in given.items()}
    for name in (name for name, value in given.items() if not isinstance(value, str)):
        value, positive = float(texts[name]), name in ("speed", "exponent")
        if not (0.0 if positive else -math.inf) < value < math.inf:
            raise ValueError(f"{name} is {value:g}; give a {'positive' if positive else 'finite'} number, or text.")
    power = f"({exponent})/2" if isinstance(exponent, str) else repr(float(exponent) / 2.0)
    falls = f"exp(-((x**2 + y**2)/({texts['speed']})**2)**({power}))"
    found = f"({texts['kinetic']}) + (({texts['static']}) - ({texts['kinetic']}))*{falls}"
    return found if texts["viscous"] == "0.0" else f"{found} + ({texts['viscous']})*sqrt(x**2 + y**2)"
