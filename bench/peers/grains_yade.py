"""Steps of a packing of grains in Yade; run by `yade -n -x -j1 grains_yade.py TASK.json`. The last line of output is JSON."""

import csv
import json
import math
import sys
import time

from yade import (Bo1_Sphere_Aabb, Bo1_Wall_Aabb, ForceResetter, FrictMat, Ig2_Sphere_Sphere_ScGeom,
                  Ig2_Wall_Sphere_ScGeom, InsertionSortCollider, InteractionLoop, Ip2_FrictMat_FrictMat_MindlinPhys,
                  Law2_ScGeom_MindlinPhys_Mindlin, NewtonIntegrator, O, utils)

with open(sys.argv[-1], encoding="ascii") as text:
    task = json.load(text)
O.materials.append(FrictMat(young=task["young"], poisson=task["poisson"], density=task["density"],
                            frictionAngle=math.atan(task["friction"])))
with open(task["packing"], newline="") as text:
    rows = [tuple(map(float, row.values())) for row in csv.DictReader(text)]
for x, y, z, radius, *velocity in rows:
    sphere = utils.sphere((x, y, z), radius)
    if task["discs"]:
        sphere.state.blockedDOFs = "zXY"
    sphere.state.vel = velocity
    O.bodies.append(sphere)
for k, bound in enumerate(task["bounds"]):
    if bound is not None:
        O.bodies.append(utils.wall(bound, axis=k // 2, sense=-1 if k % 2 else 1))

down = (0, -task["gravity"], 0) if task["discs"] else (0, 0, -task["gravity"])
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=1.2e-4),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_MindlinPhys(en=task["restitution"], es=task["restitution"])],
                    [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0, gravity=down),
]
O.dt = task["step"]
O.run(1, True)  # what only the first step does is not timed
start = time.monotonic()
O.run(task["steps"] - 1, True)
seconds = (time.monotonic() - start) * task["steps"] / max(task["steps"] - 1, 1)
with open(task["end"], "w", newline="") as out:
    writer = csv.writer(out)
    writer.writerow(("x", "y", "z", "radius", "vx", "vy", "vz"))
    for body in (O.bodies[i] for i in range(len(rows))):
        writer.writerow((*body.state.pos, body.shape.radius, *body.state.vel))
print(json.dumps({"seconds": seconds}), flush=True)
