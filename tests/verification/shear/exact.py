"""A neo-Hookean disc or sphere in unbounded Stokes shear u = (y, 0, 0): Taylor deformation and angle.

Units: radius, shear rate, viscosity of the fluid; shear modulus 1 / Ca, viscosity of the solid `ratio`.

The particle is fluid with an extra stress T = 2 (ratio - 1) D + dev(B) / Ca within an ellipsoid
x = F X, |X| < 1, uniform like the velocity gradient L there, so B = F F^T and F_t = L F [Roscoe67],
[Gao11]. In Fourier space Stokes flow answers a force div T with
    L'_ij(k) = -(delta_im - n_i n_m) n_j n_l T_ml(k),  n = k / |k|,
a symbol of degree zero: inside the ellipsoid its mean over n = F^-T z / |F^-T z|, z on the unit sphere,
    L_ij = (L of the shear)_ij - <(delta_im - n_i n_m) n_j n_l> T_ml.                            (1)

Disc: with e = (a - b) / (a + b) exp(2 i angle), d = D_11 + i D_12, s = T_11 + i T_12 the means are
<exp(2 i p)> = -e and <exp(4 i p)> = e^2, p the angle of n, so (1) becomes
    d = i/2 - (s - e^2 conj(s)) / 4,   w = -1/2 + Im(s conj(e)) / 2   (w = (L_21 - L_12) / 2),
and dev(B) = 2 e / (1 - |e|^2). With k = (ratio - 1) / 2 and s = 4 k d + 2 e / (Ca (1 - |e|^2)),
    (1 + k) d - k e^2 conj(d) = i/2 - e / (2 Ca) = r,
    w = -1/2 + 2 k Im(d conj(e)),
and an ellipse in the gradient (d, w) obeys
    e_t = d - conj(d) e^2 + 2 i w e.                                                             (2)
"""
import numpy as np


def runge_kutta(rate, y, times, step):
    """y at each of the ascending times, from y at 0."""
    found, t = [], 0.0
    for end in times:
        count = int(np.ceil((end - t) / step - 1e-9))
        h = (end - t) / max(count, 1)
        for _ in range(count):
            k1 = rate(y)
            k2 = rate(y + h / 2 * k1)
            k3 = rate(y + h / 2 * k2)
            y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(y + h * k3))
        t = end
        found.append(y)
    return found


def disc(times, ca, ratio):
    """Deformation and angle in degrees at times > 0."""
    k = (ratio - 1) / 2

    def rate(e):
        e2, r = e * e, 0.5j - e / (2 * ca)
        d = ((1 + k) * r + k * e2 * r.conjugate()) / ((1 + k) ** 2 - k ** 2 * abs(e2) ** 2)
        w = -0.5 + 2 * k * (d * e.conjugate()).imag
        return d - d.conjugate() * e2 + 2j * w * e
    e = np.array(runge_kutta(rate, 0j, times, 0.005))
    return abs(e), np.degrees(np.angle(e)) / 2


def sphere(times, ca, ratio):
    """The same of the section across the vorticity."""
    z, weight = np.polynomial.legendre.leggauss(24)
    p = np.pi * (np.arange(24) + 0.5) / 24  # half the azimuth: z and -z give one n n
    z, p = (x.ravel() for x in np.meshgrid(z, p, indexing="ij"))
    s = np.sqrt(1 - z * z)
    ball = np.stack([s * np.cos(p), s * np.sin(p), z], 1)
    weight = np.repeat(weight / 48, 24)
    unit, shear = np.eye(3), np.zeros((3, 3))
    shear[0, 1] = 1

    def rate(f):
        n = ball @ np.linalg.inv(f)
        n /= np.linalg.norm(n, axis=1)[:, None]
        two = np.einsum("q,qj,ql->jl", weight, n, n)
        four = np.einsum("q,qi,qj,qm,ql->ijml", weight, n, n, n, n)
        mean = np.einsum("im,jl->ijml", unit, two) - four
        b = f @ f.T
        elastic = (b - np.trace(b) / 3 * unit) / ca
        # L + mean : (ratio - 1) (L + L^T) = shear - mean : elastic
        matrix = (ratio - 1) * (mean + mean.swapaxes(2, 3)).reshape(9, 9) + np.eye(9)
        right = (shear - np.einsum("ijml,ml->ij", mean, elastic)).ravel()
        return np.linalg.solve(matrix, right).reshape(3, 3) @ f
    result = []
    for f in runge_kutta(rate, unit, times, 0.02):
        b = f @ f.T
        mean, half = (b[0, 0] + b[1, 1]) / 2, np.hypot((b[0, 0] - b[1, 1]) / 2, b[0, 1])
        long, short = np.sqrt(mean + half), np.sqrt(mean - half)
        result.append(((long - short) / (long + short),
                       np.degrees(np.arctan2(2 * b[0, 1], b[0, 0] - b[1, 1])) / 2))
    return np.array(result).T
