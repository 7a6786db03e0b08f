#!/usr/bin/python3
"""Linear theory of a soft disc that oscillates in a round vessel: the numbers of oscillation_test.cpp.

    exact.py MODE [mu_f [mu_s [rho_s]]]

Radius of the disc, G and rho are 1, the radius of the vessel is R = 3. With the streamfunction
f(r) sin(m theta) of displacement and velocity, Galerkin's method with Hermite cubics in r has the traction
continuous at r = 1 by itself. f = r^m (1 - r^2 / R^2)^2 at the start, and no strain. It prints the slowest
roots s of exp(s t), which agree to 1e-5 with those of the determinant of Bessel functions, and q at
t = 1, 2, ..., the projection of the velocity on that of the start.
"""
import sys

import numpy as np

R = 3.0


def matrices(m, mu_f, mu_s, rho_s, inner=24, outer=40):
    """Mass, viscosity, elasticity, weight of 1, and f of the start; f = f' = 0 at both ends is left out."""
    r = np.concatenate([1 - np.linspace(1, 0, inner + 1) ** 1.8,
                        (1 + (R - 1) * (0.5 - 0.5 * np.cos(np.pi * np.linspace(0, 1, outer + 1))))[1:]])
    n = 2 * len(r)
    mass, viscous, elastic, weight = np.zeros((4, n, n))
    at, part = np.polynomial.legendre.leggauss(6)
    t = (at + 1) / 2
    for e, h in enumerate(np.diff(r)):
        x, w = r[e] + h * t, part * h / 2
        H = np.array([1 - 3 * t**2 + 2 * t**3, h * (t - 2 * t**2 + t**3), 3 * t**2 - 2 * t**3, h * (t**3 - t**2)])
        H1 = np.array([6 * t**2 - 6 * t, h * (1 - 4 * t + 3 * t**2), 6 * t - 6 * t**2, h * (3 * t**2 - 2 * t)]) / h
        H2 = np.array([12 * t - 6, h * (6 * t - 4), 6 - 12 * t, h * (6 * t - 2)]) / h**2
        D_rr, D_rt = m * (H1 / x - H / x**2), (H1 / x - m * m * H / x**2 - H2) / 2
        one = np.pi * ((m * H / x * w * x) @ (m * H / x).T + (H1 * w * x) @ H1.T)
        strain = 4 * np.pi * ((D_rr * w * x) @ D_rr.T + (D_rt * w * x) @ D_rt.T)
        block = np.ix_(range(2 * e, 2 * e + 4), range(2 * e, 2 * e + 4))
        solid = x.mean() < 1
        weight[block] += one
        mass[block] += (rho_s if solid else 1) * one
        viscous[block] += (mu_s if solid else mu_f) * strain
        elastic[block] += strain if solid else 0
    q = 1 - r * r / R**2
    f = np.zeros(n)
    f[0::2], f[1::2] = r**m * q**2, m * r ** (m - 1) * q**2 - 4 * r ** (m + 1) * q / R**2
    keep = np.arange(2, n - 2)
    block = np.ix_(keep, keep)
    return mass[block], viscous[block], elastic[block], weight[block], f[keep]


def main():
    m = int(sys.argv[1])
    mu_f, mu_s, rho_s = (float(sys.argv[i]) if len(sys.argv) > i else v for i, v in ((2, 0.05), (3, 0.05), (4, 1)))
    mass, viscous, elastic, weight, f = matrices(m, mu_f, mu_s, rho_s)
    n = len(f)
    rate = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(mass, elastic), -np.linalg.solve(mass, viscous)]])
    roots = np.linalg.eigvals(rate)
    roots = roots[roots.imag > 1e-6]
    print("s:", roots[np.argsort(-roots.real)][:3])
    dt, one = 1 / 600, np.eye(2 * n)
    square = dt * dt / 12 * rate @ rate  # Gauss's method of order 4
    step = np.linalg.solve(one - dt / 2 * rate + square, one + dt / 2 * rate + square)
    second = np.linalg.matrix_power(step, 600)
    state = np.concatenate([np.zeros(n), f])
    for t in range(1, 9):
        state = second @ state
        print(f"q({t}) = {state[n:] @ weight @ f / (f @ weight @ f):.5f}")


if __name__ == "__main__":
    main()
