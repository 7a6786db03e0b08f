#!/usr/bin/python3
"""Where a soft body lodges in a throat: contact.py [BODY [CELLS [PENALTY]]] > reference.csv

Equilibria of a neo-Hookean body at smooth frictionless walls, by finite elements in the undeformed body. BODY is disc
(in plane strain between two walls) or sphere (in a round vessel, y being the radius). This is no code of the library,
and solves for rest at once: without fluid, friction and time. The pressure p acts on the surface upstream of the
contact, none acts downstream.

  minimise  int G/2 (F : F - I : I) dV + kappa/2 int (J - 1)^2 dV + k/2 int <g>^2 dS,   g = |y| - w(x),

with the work of p, which follows the surface. Elements are quadrilaterals of nine nodes with a linear pressure that may
jump between them. Where the surface touches the wall its normal stress is the pressure plus that of the contact, so it
does not matter where within the contact the pressure ends: here at the deepest point. x of the centroid is given and p
is solved for, so that the curve goes on past the largest pressure that the throat holds.

CELLS: elements along an eighth of the circle (4). PENALTY: k in units of G / radius (6000). Columns: x of the centroid,
p, elastic energy of the disc.
"""
import math
import sys

import numpy as np

G = 5.0
KAPPA = 2000 * G
TURN = np.array([[0.0, 1.0], [-1.0, 0.0]])
GAUSS = np.array([-math.sqrt(0.6), 0.0, math.sqrt(0.6)]), np.array([5, 8, 5]) / 9
NODES = ((0, 0), (1, 0), (1, 1), (0, 1), (2, 0), (1, 2), (2, 1), (0, 2), (2, 2))


class Scene:
    """Body and walls; throat: its width over that of the vessel, which is 1; half: half of its length."""

    def __init__(self, radius, throat, half, middle, first, last, axis):
        self.radius, self.throat, self.half, self.middle = radius, throat, half, middle
        self.first, self.last = first, last  # x of the centroid; at the first the body hardly touches the walls
        self.axis = axis  # whether it turns about y = 0

    def half_height(self, x):
        """w of the mesh, and its first and second derivative."""
        s, a = (x - self.middle) / self.half, (1 - self.throat) / 4
        if abs(s) >= 1:
            return 0.5, 0.0, 0.0
        slope = a * math.pi / self.half
        return (0.5 - a * (1 + math.cos(math.pi * s)), slope * math.sin(math.pi * s),
                slope * math.pi / self.half * math.cos(math.pi * s))


SCENES = {"disc": Scene(0.3, 0.4, 1.0, 2.0, 1.545, 1.86, False),      # meshes/throat.geo
          "sphere": Scene(0.35, 0.5, 1.5, 3.0, 2.295, 2.775, True)}      # meshes/stenosis.geo, throat 3


def line(s):
    """Quadratic shape functions at -1, 1, 0 and their derivatives."""
    return np.array([s * (s - 1) / 2, s * (s + 1) / 2, 1 - s * s]), np.array([s - 0.5, s + 0.5, -2 * s])


def half_disc(cells, radius):
    """Nodes, elements and edges of the upper half: a rectangle with three blocks around it."""
    core, found, nodes, elements, edges = 0.55 * radius, {}, [], [], []

    def node(x, y):
        key = (round(x * 1e7), round(y * 1e7))
        if key not in found:
            found[key] = len(nodes)
            nodes.append((x, y))
        return found[key]

    def block(place, m, n, outer):
        grid = [[node(*place(i / (2 * m), j / (2 * n))) for j in range(2 * n + 1)] for i in range(2 * m + 1)]
        for i in range(m):
            for j in range(n):
                at = [grid[2 * i + (0, 2, 1)[p]][2 * j + (0, 2, 1)[q]] for p, q in NODES]
                if outer:  # from the core outwards these turn clockwise
                    at = [at[k] for k in (0, 3, 2, 1, 7, 6, 5, 4, 8)]
                elements.append(at)
            if outer:
                edges.append([grid[2 * i][-1], grid[2 * i + 2][-1], grid[2 * i + 1][-1]])

    def ring(p, q, begin, end):
        def place(s, t):
            angle = begin + (end - begin) * s
            inner = np.array(p) + (np.array(q) - p) * s
            return inner + (radius * np.array([math.cos(angle), math.sin(angle)]) - inner) * t
        return place

    quarter = math.pi / 4
    block(lambda s, t: (core * (2 * s - 1), core * t), 2 * cells, cells, False)
    block(ring((core, 0), (core, core), 0, quarter), cells, cells, True)
    block(ring((core, core), (-core, core), quarter, 3 * quarter), 2 * cells, cells, True)
    block(ring((-core, core), (-core, 0), 3 * quarter, 4 * quarter), cells, cells, True)
    return np.array(nodes), np.array(elements), np.array(edges)


class Body:
    def __init__(self, scene, cells, penalty):
        self.scene = scene
        self.X, self.elements, self.edges = half_disc(cells, scene.radius)
        self.k = penalty * G / scene.radius
        self.free = np.ones(2 * len(self.X), bool)
        self.free[1::2] = np.abs(self.X[:, 1]) > 1e-9  # the other half is the mirror image
        self.seal = math.radians(80)  # undeformed angle where the pressure ends
        self.points, self.mass = [], np.zeros(len(self.X))
        for element in self.elements:
            of_element = []
            for s, ws in zip(*GAUSS):
                for t, wt in zip(*GAUSS):
                    (a, da), (b, db) = line(s), line(t)
                    N = np.array([a[i] * b[j] for i, j in NODES])
                    D = np.array([(da[i] * b[j], a[i] * db[j]) for i, j in NODES])
                    jacobian = self.X[element].T @ D
                    R = N @ self.X[element][:, 1] if scene.axis else 1.0
                    volume = ws * wt * np.linalg.det(jacobian) * R
                    # the stretch about the axis is hoop . (values at the nodes)
                    hoop = np.kron(N / R, [0.0, 1.0]) if scene.axis else np.zeros(18)
                    of_element.append((D @ np.linalg.inv(jacobian), volume, np.array([1, s, t]), hoop))
                    self.mass[element] += N * volume
            self.points.append(of_element)
        self.mass /= self.mass.sum()

    def add_elastic(self, K, F, x):
        """Adds the elastic force and its derivative; returns the energy."""
        energy = 0.0
        for element, points in zip(self.elements, self.points):
            M, defect, dJ = np.zeros((3, 3)), np.zeros(3), np.zeros((3, 18))
            force, stiffness, bends = np.zeros(18), np.zeros((18, 18)), []
            for dN, volume, phi, hoop in points:
                deformation = x[element].T @ dN
                plane, stretch = np.linalg.det(deformation), 1.0
                if self.scene.axis:
                    stretch = hoop @ x[element].ravel()
                J = plane * stretch
                cofactor = TURN @ deformation @ TURN.T
                of_plane = (dN @ cofactor.T).ravel()
                of_J = stretch * of_plane + plane * hoop
                M += np.outer(phi, phi) * volume
                defect += phi * (J - 1) * volume
                dJ += np.outer(phi, of_J) * volume
                energy += (G / 2 * (np.sum(deformation**2) + stretch**2 - 3) - G * (J - 1)) * volume
                force += G * ((dN @ deformation.T).ravel() + stretch * hoop - of_J) * volume
                stiffness += G * (np.kron(dN @ dN.T, np.eye(2)) + np.outer(hoop, hoop)) * volume
                bends.append((phi, volume * (stretch * np.kron(dN @ TURN @ dN.T, TURN) +
                                             np.outer(of_plane, hoop) + np.outer(hoop, of_plane))))
            pressure = np.linalg.solve(M, defect)
            force += KAPPA * dJ.T @ pressure
            stiffness += KAPPA * dJ.T @ np.linalg.solve(M, dJ)
            for phi, bend in bends:
                stiffness += (KAPPA * phi @ pressure - G) * bend
            at = np.stack([2 * element, 2 * element + 1], 1).ravel()
            F[at] += force
            K[np.ix_(at, at)] += stiffness
        return energy

    def add_surface(self, K, F, x, p):
        """Adds contact and pressure; returns the force for p = 1 and the deepest point's angle."""
        per_p, deepest, angle_there = np.zeros_like(F), 0.0, self.seal
        for edge in self.edges:
            at = np.stack([2 * edge, 2 * edge + 1], 1).ravel()
            for s, weight in zip(*GAUSS):
                N, D = line(s)
                X, here, along = N @ self.X[edge], N @ x[edge], D @ x[edge]
                length = weight * np.linalg.norm(D @ self.X[edge]) * (X[1] if self.scene.axis else 1)
                w, slope, curvature = self.scene.half_height(here[0])
                depth, angle = here[1] - w, math.atan2(X[1], X[0])
                if depth > 0:
                    inward, along_x = np.kron(N, [-slope, 1.0]), np.kron(N, [1.0, 0.0])
                    F[at] += self.k * length * depth * inward
                    K[np.ix_(at, at)] += self.k * length * (
                        np.outer(inward, inward) - depth * curvature * np.outer(along_x, along_x))
                if depth > deepest:
                    deepest, angle_there = depth, angle
                if angle > self.seal:  # with n dS = (y', -x') ds outwards
                    push = weight * self.outwards(edge) * np.kron(N, TURN @ along)
                    bend = weight * self.outwards(edge) * np.kron(np.outer(N, D), TURN)
                    if self.scene.axis:
                        bend = here[1] * bend + np.outer(push, np.kron(N, [0.0, 1.0]))
                        push = here[1] * push
                    per_p[at] -= push
                    K[np.ix_(at, at)] -= p * bend
        F += p * per_p
        return per_p, angle_there

    def outwards(self, edge):
        """-1 where an edge runs anticlockwise: then (y', -x') points outwards, and p acts against it."""
        (ax, ay), (bx, by) = self.X[edge[0]], self.X[edge[1]]
        return -1.0 if ax * by - ay * bx > 0 else 1.0

    def rest(self, x, p, centroid):
        """The equilibrium with that x of the centroid, by Newton's method from x and p."""
        free, size = np.where(self.free)[0], self.free.sum()
        for _ in range(60):
            n = 2 * len(x)
            K, F, mean = np.zeros((n, n)), np.zeros(n), np.zeros(n)
            energy = self.add_elastic(K, F, x)
            per_p, deepest = self.add_surface(K, F, x, p)
            mean[0::2] = self.mass
            A, b = np.zeros((size + 1, size + 1)), np.zeros(size + 1)
            A[:-1, :-1], A[:-1, -1], A[-1, :-1] = K[np.ix_(free, free)], per_p[free], mean[free]
            b[:-1], b[-1] = -F[free], centroid - mean @ x.ravel()
            change = np.linalg.solve(A, b)
            largest = np.abs(change[:-1]).max()
            change *= min(1, 0.02 / max(largest, 1e-30))
            x = x.ravel()
            x[free] += change[:-1]
            x, p = x.reshape(-1, 2), p + change[-1]
            if largest < 1e-9:
                self.seal = deepest
                return x, p, (2 * math.pi if self.scene.axis else 2) * energy
        raise SystemExit(f"no equilibrium at x = {centroid}")


def main():
    name, cells, penalty = (sys.argv[1:] + ["disc", "4", "6000"][len(sys.argv) - 1:])
    scene = SCENES[name]
    body, step, p = Body(scene, int(cells), int(penalty)), 0.0025, 0.0
    x = body.X + np.array([scene.first, 0])
    print("x,pressure,elastic_energy")
    for i in range(int(round((scene.last - scene.first) / step)) + 1):
        x, p, energy = body.rest(x, p, scene.first + i * step)
        if i % 2 == 0:
            print(f"{scene.first + i * step:.4f},{p:.5f},{energy:.6f}", flush=True)


if __name__ == "__main__":
    main()
