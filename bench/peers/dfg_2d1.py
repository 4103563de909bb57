#!/usr/bin/python3
"""DFG 2D-1 in dolfinx: P2P1 on curved cells, Newton with MUMPS, drag and lift by the variational residual.
Run: dfg_2d1.py MESH.msh (second order, format 2.2). Prints one line of JSON."""

import json
import sys

import ufl
from dolfinx import fem, nls
from dolfinx.fem.petsc import NonlinearProblem
from mpi4py import MPI
from petsc4py import PETSc

import channel

NU, MEAN = 1e-3, 0.2

domain = channel.read_mesh(sys.argv[1])
facets = channel.facets(domain)
triangle = domain.ufl_cell()
space = fem.FunctionSpace(domain, ufl.MixedElement(ufl.VectorElement("CG", triangle, 2),
                                                   ufl.FiniteElement("CG", triangle, 1)))
velocities, to_mixed = space.sub(0).collapse()

inlet = fem.Function(velocities)
inlet.interpolate(channel.inflow(0.3))
held = fem.Function(velocities)


def prescribe(value, facets_of_part):
    dofs = fem.locate_dofs_topological((space.sub(0), velocities), 1, facets_of_part)
    return fem.dirichletbc(value, dofs, space.sub(0))


conditions = [prescribe(held, facets["walls"]), prescribe(held, facets["cylinder"]), prescribe(inlet, facets["inlet"])]

solution = fem.Function(space)
u, p = ufl.split(solution)


def residual(v, q):
    return (NU * ufl.inner(ufl.grad(u), ufl.grad(v)) + ufl.inner(ufl.dot(ufl.grad(u), u), v)
            - p * ufl.div(v) - q * ufl.div(u)) * ufl.dx


solution.x.array[to_mixed] = inlet.x.array
newton = nls.petsc.NewtonSolver(MPI.COMM_WORLD,
                                NonlinearProblem(residual(*ufl.TestFunctions(space)), solution, bcs=conditions))
newton.rtol, newton.atol = 1e-9, 1e-12
newton.convergence_criterion = "incremental"
options = PETSc.Options()
prefix = newton.krylov_solver.getOptionsPrefix()
for key, value in {"ksp_type": "preonly", "pc_type": "lu", "pc_factor_mat_solver_type": "mumps"}.items():
    options[prefix + key] = value
newton.krylov_solver.setFromOptions()
iterations, _ = newton.solve(solution)


def coefficient(axis: int) -> float:
    test = channel.unit_on_cylinder(velocities, facets["cylinder"], axis)
    zero = fem.Constant(domain, PETSc.ScalarType(0))
    force = -fem.assemble_scalar(fem.form(residual(test, zero)))
    return 2 * force / (MEAN**2 * 0.1)


unknowns = space.dofmap.index_map.size_global * space.dofmap.index_map_bs
print(json.dumps({"unknowns": unknowns, "newton_iterations": iterations, "drag": coefficient(0), "lift": coefficient(1)}))
