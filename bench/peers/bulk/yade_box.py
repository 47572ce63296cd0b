# SPDX-License-Identifier: BSD-3-Clause
"""The settled box by Yade; run.py starts it: `yade -n -x -j THREADS yade_box.py`, the task in the file $BOX."""
import json
import math
import os
import pathlib
import time

task = json.loads(pathlib.Path(os.environ["BOX"]).read_text())
glass = O.materials.append(FrictMat(young=task["young"], poisson=task["poisson"], density=task["density"],
                                    frictionAngle=math.atan(task["friction"])))
for axis in (0, 1):
    O.bodies.append(utils.wall(0.0, axis=axis, sense=1, material=glass))
    O.bodies.append(utils.wall(task["side"], axis=axis, sense=-1, material=glass))
O.bodies.append(utils.wall(0.0, axis=2, sense=1, material=glass))
spheres = O.bodies.append([utils.sphere(place, task["radius"], material=glass) for place in task["points"]])
O.engines = [
    ForceResetter(),
    # Both boxes of a pair grow by it.
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.5 * task["skin"]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_MindlinPhys(en=task["restitution"])],
                    [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0.0, gravity=(0.0, 0.0, -9.81)),
]
O.dt = task["step"]
O.run(200, True)
pathlib.Path(task["after"]).write_text("".join("{:.17g},{:.17g},{:.17g}\n".format(*O.bodies[b].state.pos) for b in spheres))
for _ in range(task["runs"]):
    start = time.perf_counter()
    O.run(task["steps"], True)
    print("Loop time of", time.perf_counter() - start, flush=True)
