"""How rough the strain of a solid is: psi less a parabola through its neighbours, as part of psi.

    strain_roughness.py OUTPUT_FOLDER CHECKPOINT RADIUS

The folder holds fields_mesh.hdf (tetrahedra or hexahedra) and the checkpoint of a run on one rank.
For each cell that is more than half solid, a parabola in x, y, z is fitted to the psi of all such
cells within RADIUS, weighted by their volume of solid. Prints the root mean square over the solid of
what psi differs from its parabola, divided by that of psi.
"""

import sys

import h5py
import numpy as np


def read(folder, checkpoint):
    """Centres and volumes of the cells, alpha and psi (xx, xy, xz, yy, yz, zz)."""
    with h5py.File(f"{folder}/fields_mesh.hdf") as file:
        mesh = file["VTKHDF"]
        corners = np.diff(mesh["Offsets"][:2])[0]
        x = mesh["Points"][:][mesh["Connectivity"][:].reshape(-1, corners)]
    centre = x.mean(axis=1)
    if corners == 4:
        parts = [(0, 1, 2, 3)]
    elif corners == 8:
        parts = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
    else:
        sys.exit(f"strain_roughness.py: cells of {corners} corners; it takes 4 or 8")
    volume = sum(
        np.abs(np.linalg.det(x[:, [b, c, d]] - x[:, [a]])) / 6 for a, b, c, d in parts
    )
    with h5py.File(f"{folder}/{checkpoint}") as file:
        return centre, volume, file["fields/alpha"][:], file["fields/psi"][:]


def parabola(r):
    x, y, z = r.T
    return np.stack([np.ones(len(r)), x, y, z, x * x, y * y, z * z, x * y, x * z, y * z], axis=1)


def main(folder, checkpoint, radius):
    centre, volume, alpha, psi = read(folder, checkpoint)
    solid = alpha > 0.5
    centre, weight, psi = centre[solid], (alpha * volume)[solid], psi[solid]
    psi = psi * np.sqrt([1, 2, 2, 1, 2, 1])  # the norm of a row is that of the tensor
    rest, cells = np.zeros(len(psi)), []
    for i, here in enumerate(centre):
        near = np.flatnonzero(np.sum((centre - here) ** 2, axis=1) < radius**2)
        root = np.sqrt(weight[near])[:, None]
        fit = np.linalg.lstsq(root * parabola(centre[near] - here), root * psi[near], rcond=1e-10)[0]
        rest[i] = np.sum((psi[i] - fit[0]) ** 2)
        cells.append(len(near))
    size = np.sum(psi**2, axis=1)
    part = np.sqrt(np.sum(rest * weight) / np.sum(size * weight))
    print(f"{len(psi)} cells, {np.median(cells):.0f} in a fit: {part:.3f} of psi is rough")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], float(sys.argv[3]))
