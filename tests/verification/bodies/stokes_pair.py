"""Two equal rigid discs, free of force and torque, in a periodic Stokes shear flow between walls.

Units: radius, shear rate, viscosity. The box is [-height/2, height/2]^2, periodic in x, and its walls move
with u = (y, 0). The discs lie at c and -c, so that the flow is odd under half a turn: u(-x) = -u(x).

The disturbance is that of point forces f on a ring inside each disc (the method of fundamental solutions).
Each acts with its periodic copies between walls at rest. The velocity due to it has three parts:
  * the periodic row of Stokeslets in closed form [Pozrikidis92];
  * for each wave number q > 0, four solutions with the stream functions exp(-q d) and d exp(-q d),
    d the distance from a wall, which cancel the row's Fourier modes on the walls exactly;
  * a shear flow a + b y, which cancels its mean there, without any mean pressure gradient.

The reflections of one disc in another pile up at the radius r = D - sqrt(D^2 - 1), 2 D the distance of the
centres. With n forces and as many points on the disc the error falls about like r^(n / 2) while the ring's
radius lies between r and sqrt(r) (compare [BarnettBetcke08]). The ring is at sqrt(r); the error sets n.

[Pozrikidis92] Boundary Integral and Singularity Methods for Linearized Viscous Flow, Cambridge, 1992.
[BarnettBetcke08] J. Comput. Phys. 227 (2008) 7003: the method of fundamental solutions on analytic domains.
"""
import argparse

import numpy as np


def row(x, y, period):
    """Velocities (xx, xy, yy) at (x, y) of a row of unit forces, one at the origin [Pozrikidis92]."""
    k = 2 * np.pi / period
    d = 2 * (np.sinh(k * y / 2) ** 2 + np.sin(k * x / 2) ** 2)  # cosh(k y) - cos(k x), free of cancellation
    a = np.log(2 * d) / 2
    ax, ay = k / 2 * np.sin(k * x) / d, k / 2 * np.sinh(k * y) / d
    return np.array([-a - y * ay, y * ax, -a + y * ay]) / (4 * np.pi)


def strip(q, y, half):
    """Amplitudes [q, y, (u, v), solution] of the four solutions for each wave number, to go with exp(i q x)."""
    top, bottom = np.outer(q, half - y), np.outer(q, half + y)
    e, f = np.exp(-top), np.exp(-bottom)
    u = np.stack([e, (top - 1) * e, -f, (1 - bottom) * f], -1)
    v = np.stack([e, top * e, f, bottom * f], -1) * -1j
    return np.stack([u, v], 2)


def row_on_walls(q, s, half, period):
    """Fourier modes [q, (u, v on the top, then the bottom), (fx, fy), source] of rows of unit forces at s."""
    modes = []
    for wall in (half, -half):
        d = q[:, None] * (wall - s[None, :, 1])
        scale = np.exp(-abs(d) - 1j * q[:, None] * s[None, :, 0]) / (2 * q[:, None] * period)
        xx, xy, yy = (1 - abs(d)) * scale, -1j * d * scale, (1 + abs(d)) * scale
        modes += [np.stack([xx, xy], 1), np.stack([xy, yy], 1)]
    return np.stack(modes, 1)


def green(p, s, height):
    """Matrix from the forces (all fx, then all fy) at s to the velocities (all u, then all v) at p."""
    half, n, m = height / 2, len(s), len(p)
    xx, xy, yy = row(p[:, None, 0] - s[None, :, 0], p[:, None, 1] - s[None, :, 1], height)
    xx = xx + (half - np.outer(p[:, 1], s[:, 1]) / half) / (2 * height)
    clear = 2 * half - abs(p[:, 1]).max() - abs(s[:, 1]).max()  # the modes fall like exp(-q clear)
    count = max(4, int(np.ceil(40 / max(clear, 0.05) * height / (2 * np.pi))))
    q = 2 * np.pi / height * np.arange(1, count + 1)
    walls = strip(q, np.array([half, -half]), half).reshape(count, 4, 4)
    modes = -np.linalg.solve(walls, row_on_walls(q, s, half, height).reshape(count, 4, 2 * n))
    field = strip(q, p[:, 1], half) * np.exp(1j * np.outer(q, p[:, 0]))[:, :, None, None]
    field, modes = field.transpose(2, 1, 0, 3).reshape(2 * m, 4 * count), modes.reshape(4 * count, 2 * n)
    return np.block([[xx, xy], [xy, yy]]) + field.real @ modes.real - field.imag @ modes.imag


def gap(centre, height):
    """The least distance of the discs at centre and -centre from each other, over all the periodic copies."""
    x = (2 * centre[0] + height / 2) % height - height / 2
    return np.hypot(x, 2 * centre[1]) - 2


def circle(count, shift=0.0):
    """Unit vectors at equal angles, turned by a part `shift` of their spacing."""
    turn = np.exp(2j * np.pi * (np.arange(count) + shift) / count)
    return np.stack([turn.real, turn.imag], 1)


class Flow:
    """The flow about a disc at `centre` and, if `mirrored`, its twin at -centre with the opposite forces."""
    def __init__(self, centre, height, mirrored=True, error=1e-11, finer=1):
        """Solve for no slip, total force or torque; `finer` multiplies the forces and moves them outwards."""
        self.centre, self.height, self.mirrored = np.array(centre, float), height, mirrored
        room = [height - 2, 2 * (height / 2 - 1 - abs(self.centre[1]))]  # to the copies and the walls' mirror
        near = 1 + min(room + [gap(self.centre, height)] * mirrored) / 2
        assert near > 1, "The discs overlap one another or a wall."
        r = near - np.sqrt(near * near - 1)
        n = self.count = finer * max(24, int(np.ceil(2 * np.log(error) / np.log(r))))
        unit = circle(n)
        self.arms = unit * r ** (0.5 / finer)
        rigid, total = (np.block([[np.ones((n, 1)), np.zeros((n, 1)), -a[:, 1:]],
                                  [np.zeros((n, 1)), np.ones((n, 1)), a[:, :1]]]) for a in (unit, self.arms))
        # Equal radial forces only press: the outer product leaves them out.
        slip = self.induced(self.centre + unit) + np.outer(unit.T, unit.T) / n
        matrix = np.block([[slip, -rigid], [total.T, np.zeros((3, 3))]])
        right = np.append(-(self.centre[1] + unit[:, 1]), np.zeros(n + 3))
        found = np.linalg.solve(matrix, right)
        self.force, self.velocity, self.spin = found[:-3], found[-3:-1], found[-1]

    def induced(self, p):
        """Matrix from the forces of the disc at `centre` to the disturbance at p."""
        matrix = green(p, self.centre + self.arms, self.height)
        return matrix - green(p, -self.centre - self.arms, self.height) if self.mirrored else matrix

    def at(self, p):
        """The fluid's velocity at the points p."""
        return (self.induced(p) @ self.force).reshape(2, -1).T + np.stack([p[:, 1], 0 * p[:, 1]], 1)

    def slip(self):
        """The largest slip halfway between the points of the disc and along the walls."""
        r, half = circle(self.count, 0.5), self.height / 2
        disc = self.at(self.centre + r) - self.velocity - self.spin * r[:, ::-1] * [-1, 1]
        top = np.stack([np.linspace(-half, half, 101), np.full(101, half)], 1)
        return max(abs(disc).max(), abs(self.at(top) - [half, 0]).max(), abs(self.at(-top) + [half, 0]).max())


def velocities(centres, height, error=1e-11, finer=1):
    """Velocities (2, 2) and anticlockwise spins (2) of discs at the two centres, which must be c and -c."""
    assert abs(np.sum(centres, 0)).max() < 1e-12, "The centres must be c and -c."
    flow = Flow(centres[0], height, True, error, finer)
    return np.array([flow.velocity, -flow.velocity]), np.array([flow.spin, flow.spin])


def advance(c, height, dt):
    """The left disc's centre after one step of the classical Runge-Kutta method."""
    k1 = Flow(c, height).velocity
    k2 = Flow(c + dt / 2 * k1, height).velocity
    k3 = Flow(c + dt / 2 * k2, height).velocity
    return c + dt / 6 * (k1 + 2 * k2 + 2 * k3 + Flow(c + dt * k3, height).velocity)


def path(start, height, end, dt):
    """Times and the left disc's x and y, at equal steps of at most dt from 0 to end."""
    count = int(np.ceil(end / dt - 1e-9))
    c = [np.array(start, float)]
    for _ in range(count):
        c.append(advance(c[-1], height, end / count))
    return np.linspace(0, end, count + 1), np.array(c)[:, 0], np.array(c)[:, 1]


def passing(start, height, end, dt, x):
    """Time and y when the left disc first passes x; it must do so before the time `end`."""
    t, xs, ys = path(start, height, end, dt)
    last = np.argmax(xs > x) - 1
    assert last >= 0, "The disc does not pass x, or starts beyond it."
    c, t = np.array([xs[last], ys[last]]), t[last]
    for _ in range(4):  # Newton's method for the length of the last step
        h = (x - c[0]) / Flow(c, height).velocity[0]
        c, t = advance(c, height, h), t + h
    return t, c[1]


def checks():
    """Names, errors and bounds: exact results for one disc, finer solutions and the symmetry of the paths."""
    lone, name = Flow((0, 0), 2000, False), "lone disc in a box of 2000: "
    yield name + "velocity", abs(lone.velocity).max(), 1e-9
    yield name + "spin and -1/2", abs(lone.spin + 0.5), 1e-6
    yield name + "sum of f_x y and -2 pi", abs(lone.force[:lone.count] @ lone.arms[:, 1] + 2 * np.pi), 1e-4
    p = np.concatenate([circle(7) * r for r in (1.1, 1.5, 3)])
    x, y, r2 = p[:, :1], p[:, 1:], (p * p).sum(1, keepdims=True)
    exact = p[:, ::-1] / 2 * (1 - r2 ** -2) - 2 * p * x * y * (r2 ** -2 - r2 ** -3) + np.hstack([y, -x]) / 2
    yield name + "flow and the exact one without walls", abs(lone.at(p) - exact).max(), 1e-5
    for centre in ((-1.5, 0.4), (-0.3, 1.0057), (-0.3, 0.957), (3.97, 0.25)):
        flow, fine = Flow(centre, 10), Flow(centre, 10, finer=2)
        name = "gap %.4f, %d forces: " % (gap(centre, 10), flow.count)
        change = np.append(fine.velocity - flow.velocity, fine.spin - flow.spin)
        yield name + "change with twice the forces", abs(change).max(), 1e-9
        yield name + "slip on the disc and the walls", flow.slip(), 1e-6
        yield name + "the same with twice the forces", fine.slip(), 1e-8
    for offset in (0.4, 0.8):
        found, fine = (np.array(passing((-2, offset), 10, 11, dt, 2)) for dt in (0.05, 0.025))
        yield "path from y = %.1f: y at x = 2 and at x = -2" % offset, abs(found[1] - offset), 1e-6
        yield "path from y = %.1f: change with half the step" % offset, abs(fine - found).max(), 1e-6


def main():
    """Print one path as comma-separated values, or the checks."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--offset", type=float, default=0.8, help="y of the left disc, which starts at x = -2")
    parser.add_argument("--height", type=float, default=10.0, help="height and period of the box")
    parser.add_argument("--end", type=float, default=12.0, help="last time")
    parser.add_argument("--every", type=float, default=0.5, help="time between the lines")
    parser.add_argument("--check", action="store_true", help="check the method instead")
    args = parser.parse_args()
    if args.check:
        for name, error, bound in checks():
            print("%-65s %8.1e < %.0e" % (name, error, bound))
            assert error < bound
        return
    parts, lines = int(np.ceil(args.every / 0.05 - 1e-9)), int(args.end / args.every + 1e-9)
    found = path((-2, args.offset), args.height, lines * args.every, args.every / parts)
    print("t,x,y,gap")
    for t, x, y in np.transpose(found)[::parts]:
        print("%.6g,%.9f,%.9f,%.9f" % (t, x, y, gap((x, y), args.height)))


if __name__ == "__main__":
    main()
