"""An elastic disc thrown against a smooth wall, by finite elements: what two equal discs do to each other.

The plane of symmetry between them is the wall. Linear triangles, explicit central differences, nodes stop at the wall
and may leave it; the logarithmic law of the solver, ``sigma = lambda tr(ln V) 1 + 2 mu ln V``. Nothing is shared with
the material point method but the physics, and contact is neither felt early nor sticky.
"""

import numpy as np
from scipy.spatial import Delaunay


def mesh_of_rings(rings, radius):
    """Return nodes (n, 2) in m and triangles (e, 3) of a disc around the origin."""
    ring = np.repeat(np.arange(rings + 1), np.maximum(6 * np.arange(rings + 1), 1))
    first = np.searchsorted(ring, ring)
    angle = 2.0 * np.pi * (np.arange(ring.size) - first) / np.maximum(6 * ring, 1)
    nodes = radius * ring[:, None] / rings * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    triangles = Delaunay(nodes).simplices
    area = 0.5 * np.linalg.det(nodes[triangles[:, 1:]] - nodes[triangles[:, :1]])
    triangles = np.where(area[:, None] < 0.0, triangles[:, ::-1], triangles)
    return nodes, triangles[np.abs(area) > 1e-9 * radius**2]


def logarithmic_stress(F, lame, shear):
    """Return the Cauchy stress (e, 2, 2) in Pa of deformation gradients ``F`` (e, 2, 2)."""
    squares, directions = np.linalg.eigh(F @ F.transpose(0, 2, 1))
    strain = 0.5 * np.log(squares)
    stress = lame * strain.sum(axis=1, keepdims=True) + 2.0 * shear * strain
    return (directions * stress[:, None, :]) @ directions.transpose(0, 2, 1)


def throw(rings, radius, speed, density, lame, shear, end):
    """Return rebound speed over ``speed``, and kinetic energy after over before, its mean over vibrations.

    The disc starts at a distance of a twentieth of its radius, and the last third of ``end`` (s) counts as after.
    """
    nodes, triangles = mesh_of_rings(rings, radius)
    edges = (nodes[triangles[:, 1:]] - nodes[triangles[:, :1]]).transpose(0, 2, 1)
    area = 0.5 * np.linalg.det(edges)
    gradients = np.linalg.inv(edges)
    gradients = np.concatenate([-gradients.sum(axis=1, keepdims=True), gradients], axis=1)
    mass = np.bincount(triangles.ravel(), np.repeat(density * area / 3.0, 3))
    dt = 0.15 * radius / rings / np.sqrt((lame + 2.0 * shear) / density)
    place = nodes + np.array([1.05 * radius, 0.0])
    velocity = np.tile([-speed, 0.0], (mass.size, 1))
    kinetic = np.empty(int(end / dt))
    for step in range(kinetic.size):
        F = place[triangles].transpose(0, 2, 1) @ gradients
        stress = logarithmic_stress(F, lame, shear) * np.linalg.det(F)[:, None, None]
        nodal = -area[:, None, None] * gradients @ np.linalg.inv(F) @ stress  # first Piola-Kirchhoff, transposed
        force = np.stack([np.bincount(triangles.ravel(), nodal[:, :, axis].ravel()) for axis in range(2)], axis=1)
        velocity += dt * force / mass[:, None]
        velocity[:, 0] = np.maximum(velocity[:, 0], -place[:, 0] / dt)
        place += dt * velocity
        kinetic[step] = 0.5 * np.sum(mass[:, None] * velocity**2)
    rebound = np.sum(mass * velocity[:, 0]) / (mass.sum() * speed)
    return rebound, kinetic[-kinetic.size // 3 :].mean() / (0.5 * mass.sum() * speed**2)
