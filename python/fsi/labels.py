"""Names and units of what a run writes, for the labels of pictures.

A case is in any consistent units, so that a label has a unit only where the units are given:
Units("m", "s", "kg"), or Units("mm", "s", "mg"). Where lengths are in metres, small and large values get a
prefix: 0.0002 m is 0.2 mm.
"""
from dataclasses import dataclass

import numpy as np

# The powers of length, time and mass in each unit of doc/reference/files.md.
POWERS = {
    "length": (1, 0, 0), "time": (0, 1, 0), "volume": (3, 0, 0), "velocity": (1, -1, 0),
    "volume / time": (3, -1, 0), "pressure": (-1, -2, 1), "force / volume": (-2, -2, 1),
    "energy": (2, -2, 1), "1 / time": (0, -1, 0), "1 / time²": (0, -2, 0), "area": (2, 0, 0),
    "energy / time": (2, -3, 1),
}
PER_DEPTH = ("volume", "volume / time", "energy", "area", "energy / time")  # in two dimensions
SI = {(-1, -2, 1): "Pa", (-2, -2, 1): "Pa/m", (2, -2, 1): "J", (1, -2, 1): "J/m", (2, -3, 1): "W", (1, -3, 1): "W/m"}
PREFIXES = {-15: "f", -12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}

COLUMNS = {  # of the csv files, apart from those with a panel
    "pressure_drop": "pressure", "pressure_span": "pressure", "mean_velocity": "velocity", "work": "energy",
    "dissipation": "energy / time", "volume": "volume", "volume_out": "volume", "volume_returned": "volume", "area": "area",
    "turned": "degrees", "long_angle": "degrees", "taylor_angle": "degrees", "shape_energy": "energy",
}

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

    def prefixed(self, kind, size, dim=3):
        """(factor, unit): the unit in which a value of this size is neither small nor large, and what turns
        values into it. Where lengths are not in metres the factor is 1."""
        unit, (length, _, mass) = self(kind, dim), POWERS.get(kind, (0, 0, 0))
        power = length - (dim == 2 and kind in PER_DEPTH)
        if self.length != "m" or not np.isfinite(size) or not (0 < size < 0.1 or size >= 1e4):
            return 1.0, unit
        if unit.startswith(("Pa", "J", "W")):
            power, most = 1, 9
        elif mass == 0 and power > 0:
            most = 0  # no kilometres
        else:
            return 1.0, unit
        above = min(power, 2) * (size < 1)  # 0.1 mm is as good as 100 µm, and 0.01 mm³
        step = int(np.clip(3 * np.floor((np.log10(size) + above) / (3 * power) + 1e-9), -15, most))
        return float(f"1e{-step * power}"), PREFIXES[step] + unit

    def label(self, words, kind, dim=3, size=1.0):
        """The words with the unit behind them, where there is one; size: of the largest value."""
        _, unit = self.prefixed(kind, size, dim)
        return f"{words} [{unit}]" if unit else words

    def number(self, value, kind, size=None):
        """A number with its unit; size: the size of the values around it."""
        factor, unit = self.prefixed(kind, abs(value) if size is None else size)
        return f"{value * factor:.4g}" + (f" {unit}" if unit else "")

    def field(self, name, size=1.0):
        """The label of a colour bar."""
        words, symbol, kind = FIELDS.get(name, (name, "", "1"))
        return self.label(f"{words} {symbol}".strip(), kind, size=size)

    def ticks(self, axis, kind, size, dim=3):
        """The ticks of an axis of a plot, in the unit of the label of this size."""
        factor, _ = self.prefixed(kind, size, dim)
        if factor != 1:
            axis.set_major_formatter(lambda value, _: f"{value * factor:.6g}".replace("-", "\N{MINUS SIGN}"))


def _power(unit, power):
    return unit + ("" if power == 1 else "⁰¹²³"[power])
