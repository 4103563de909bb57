#!/usr/bin/python3
"""DFG 2D-2 in dolfinx: the splitting scheme (IPCS, Crank-Nicolson with Adams-Bashforth convection) of its tutorial, P2P1
on curved cells. Run: dfg_2d2.py MESH.msh STEP END FROM (second order, format 2.2; seconds). Prints one line of JSON with
the forces from the time FROM on."""

import json
import sys
from math import pi, sin

import ufl
from dolfinx import fem
from dolfinx.fem.petsc import (apply_lifting, assemble_matrix, assemble_vector, create_vector, set_bc)
from petsc4py import PETSc

import channel

NU, MEAN = 1e-3, 1.0
path, step, end, measured_from = sys.argv[1], *map(float, sys.argv[2:5])

domain = channel.read_mesh(path)
facets = channel.facets(domain)
velocities = fem.FunctionSpace(domain, ufl.VectorElement("CG", domain.ufl_cell(), 2))
pressures = fem.FunctionSpace(domain, ("CG", 1))

inlet = fem.Function(velocities)
inlet.interpolate(channel.inflow(1.5))
parabola = inlet.x.array[0::2].copy()
zero = fem.Constant(domain, PETSc.ScalarType((0, 0)))


def dofs(space, part):
    return fem.locate_dofs_topological(space, 1, facets[part])


held = [fem.dirichletbc(inlet, dofs(velocities, "inlet")),
        fem.dirichletbc(zero, dofs(velocities, "walls"), velocities),
        fem.dirichletbc(zero, dofs(velocities, "cylinder"), velocities)]
open_end = [fem.dirichletbc(PETSc.ScalarType(0), dofs(pressures, "outlet"), pressures)]

u, v = ufl.TrialFunction(velocities), ufl.TestFunction(velocities)
p, q = ufl.TrialFunction(pressures), ufl.TestFunction(pressures)
now, before, tentative = (fem.Function(velocities) for _ in range(3))
pressure, correction = fem.Function(pressures), fem.Function(pressures)
k, nu = (fem.Constant(domain, PETSc.ScalarType(value)) for value in (step, NU))
dx = ufl.dx

tentative_form = (ufl.dot((u - now) / k, v) + ufl.inner(ufl.dot(1.5 * now - 0.5 * before, 0.5 * ufl.nabla_grad(u + now)), v)
                  + 0.5 * nu * ufl.inner(ufl.grad(u + now), ufl.grad(v)) - pressure * ufl.div(v)) * dx
stages = []  # left, right, result, conditions, solver, matrix, vector, is the matrix constant
for left, right, result, conditions, solver, preconditioner in (
        (ufl.lhs(tentative_form), ufl.rhs(tentative_form), tentative, held, "bcgs", "jacobi"),
        (ufl.inner(ufl.grad(p), ufl.grad(q)) * dx, -ufl.div(tentative) * q / k * dx, correction, open_end,
         "minres", "hypre"),
        (ufl.dot(u, v) * dx, ufl.dot(tentative - k * ufl.nabla_grad(correction), v) * dx, now, [], "cg", "sor")):
    left, right = fem.form(left), fem.form(right)
    matrix = assemble_matrix(left, bcs=conditions)
    matrix.assemble()
    ksp = PETSc.KSP().create(domain.comm)
    ksp.setOperators(matrix)
    ksp.setType(solver)
    ksp.getPC().setType(preconditioner)
    stages.append((left, right, result, conditions, ksp, matrix, create_vector(right)))


def solve(stage: int, refresh: bool) -> None:
    left, right, result, conditions, ksp, matrix, vector = stages[stage]
    if refresh:
        matrix.zeroEntries()
        assemble_matrix(matrix, left, bcs=conditions)
        matrix.assemble()
    with vector.localForm() as local:
        local.set(0)
    assemble_vector(vector, right)
    if conditions:
        apply_lifting(vector, [left], [conditions])
    vector.ghostUpdate(PETSc.InsertMode.ADD_VALUES, PETSc.ScatterMode.REVERSE)
    set_bc(vector, conditions)
    ksp.solve(vector, result.vector)
    result.x.scatter_forward()


def force_form(axis: int):
    """The weak form tested with a field that is 1 on the cylinder; the inertia is that of the last step."""
    test = channel.unit_on_cylinder(velocities, facets["cylinder"], axis)
    return fem.form(-(ufl.dot((now - before) / k, test) + ufl.inner(ufl.dot(ufl.grad(now), now), test)
                      + nu * ufl.inner(ufl.grad(now), ufl.grad(test)) - pressure * ufl.div(test)) * dx)


forces = [force_form(0), force_form(1)]
series = []
n_steps = round(end / step)
for n in range(1, n_steps + 1):
    last = now.x.array.copy()
    inlet.x.array[0::2] = parabola * sin(pi * min(n * step, 0.5))**2
    inlet.x.array[1::2] = parabola * sin(pi * min(n * step, 1))**2 / 2  # stirs the wake
    solve(0, refresh=True)
    solve(1, refresh=False)
    pressure.x.array[:] += correction.x.array
    solve(2, refresh=False)
    before.x.array[:] = last
    if n * step >= measured_from - 1e-9:
        series.append([n * step] + [2 * fem.assemble_scalar(force) / (MEAN**2 * 0.1) for force in forces])

unknowns = sum(s.dofmap.index_map.size_global * s.dofmap.index_map_bs for s in (velocities, pressures))
print(json.dumps({"unknowns": unknowns, "steps": n_steps, "series": series}))
