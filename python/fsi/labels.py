"""Names and units of what a run writes, for the labels of pictures.

A case is in any consistent units, so that a label has a unit only where the units are given:
Units("m", "s", "kg"), or Units("mm", "s", "mg").
"""
from dataclasses import dataclass

# The powers of length, time and mass in each unit of doc/reference/files.md.
POWERS = {
    "length": (1, 0, 0), "time": (0, 1, 0), "volume": (3, 0, 0), "velocity": (1, -1, 0),
    "volume / time": (3, -1, 0), "pressure": (-1, -2, 1), "force / volume": (-2, -2, 1),
    "energy": (2, -2, 1), "1 / time": (0, -1, 0), "1 / time²": (0, -2, 0),
}
PER_DEPTH = ("volume", "volume / time", "energy")  # in two dimensions
SI = {(-1, -2, 1): "Pa", (-2, -2, 1): "Pa/m", (2, -2, 1): "J", (1, -2, 1): "J/m"}

FIELDS = {  # name: (words, symbol, unit)
    "speed": ("speed", "|u|", "velocity"), "p": ("pressure", "p", "pressure"),
    "stretch": ("largest stretch", r"$\lambda_1$", "1"), "traction": ("traction", r"$|\sigma n|$", "pressure"),
}


@dataclass
class Units:
    """The units of a case; empty where it has none."""

    length: str = ""
    time: str = ""
    mass: str = ""

    def __call__(self, kind, dim=3):
        """The unit of a kind, as text; empty where there is none."""
        if kind == "degrees":
            return "°"
        if kind == "s":
            return "s"
        if kind not in POWERS or not self.length:
            return ""
        length, time, mass = POWERS[kind]
        powers = (length - (dim == 2 and kind in PER_DEPTH), time, mass)
        if (self.length, self.time, self.mass) == ("m", "s", "kg") and powers in SI:
            return SI[powers]
        above = [_power(u, p) for u, p in zip((self.mass, self.length, self.time),
                                              (powers[2], powers[0], powers[1])) if p > 0]
        below = [_power(u, -p) for u, p in zip((self.mass, self.length, self.time),
                                               (powers[2], powers[0], powers[1])) if p < 0]
        top = " ".join(above) or "1"
        return top if not below else f"{top}/{below[0]}" if len(below) == 1 else \
            f"{top}/({' '.join(below)})"

    def label(self, words, kind, dim=3):
        """The words with the unit behind them, where there is one."""
        unit = self(kind, dim)
        return f"{words} [{unit}]" if unit else words

    def number(self, value, kind):
        """A number with its unit."""
        unit = self(kind)
        return f"{value:.4g}" + (f" {unit}" if unit else "")

    def field(self, name):
        """The label of a colour bar."""
        words, symbol, kind = FIELDS.get(name, (name, "", "1"))
        return self.label(f"{words} {symbol}".strip(), kind)


def _power(unit, power):
    return unit + ("" if power == 1 else "⁰¹²³"[power])
