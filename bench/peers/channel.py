"""What the dolfinx peers share: a Gmsh mesh of second order as curved cells, the channel's boundaries, and the force on
its cylinder by the variational residual."""

import numpy as np
import ufl
from dolfinx import cpp, fem, mesh
from mpi4py import MPI
from petsc4py import PETSc

HEIGHT = 0.41
NEAR = 1e-6


def read_mesh(path: str) -> mesh.Mesh:
    """The six-node triangles of a Gmsh file in format 2.2."""
    with open(path, encoding="ascii") as file:
        lines = iter(file.read().splitlines())
    for line in lines:
        if line == "$Nodes":
            points = np.array([next(lines).split()[1:3] for _ in range(int(next(lines)))], dtype=float)
        elif line == "$Elements":
            rows = [next(lines).split() for _ in range(int(next(lines)))]
    cells = np.array([row[-6:] for row in rows if row[1] == "9"], dtype=np.int64) - 1
    cells = cells[:, cpp.io.perm_gmsh(cpp.mesh.CellType.triangle, 6)]
    used, cells = np.unique(cells, return_inverse=True)
    element = ufl.VectorElement("Lagrange", ufl.triangle, 2)
    return mesh.create_mesh(MPI.COMM_WORLD, cells.reshape(-1, 6), points[used], ufl.Mesh(element))


def facets(domain: mesh.Mesh) -> dict[str, np.ndarray]:
    def on(marker):
        return mesh.locate_entities_boundary(domain, 1, marker)

    return {
        "inlet": on(lambda x: x[0] < NEAR),
        "outlet": on(lambda x: x[0] > 2.2 - NEAR),
        "walls": on(lambda x: (x[1] < NEAR) | (x[1] > HEIGHT - NEAR)),
        "cylinder": on(lambda x: np.hypot(x[0] - 0.2, x[1] - 0.2) < 0.05 + NEAR),
    }


def inflow(maximum: float):
    """The inlet parabola with this velocity in the middle [m/s]."""
    return lambda x: np.stack((4 * maximum * x[1] * (HEIGHT - x[1]) / HEIGHT**2, np.zeros_like(x[0])))


def unit_on_cylinder(space: fem.FunctionSpace, cylinder: np.ndarray, axis: int) -> fem.Function:
    """1 along `axis` at the cylinder's nodes, 0 at all others: the test function that picks the force."""
    values = np.zeros(2, dtype=PETSc.ScalarType)
    values[axis] = 1
    field = fem.Function(space)
    fem.set_bc(field.x.array, [fem.dirichletbc(values, fem.locate_dofs_topological(space, 1, cylinder), space)])
    return field
