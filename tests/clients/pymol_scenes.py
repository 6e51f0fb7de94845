"""Sticks and spheres of PyMOL, by its ray tracing with POV-Ray."""
import shutil

import pymol

ATOMS = [("C", -0.75, 0, 0), ("C", 0.75, 0, 0), ("H", -1.15, 1, 0), ("H", -1.15, -0.5, 0.87), ("O", 1.3, -1, 0.5)]
with open("1.xyz", "w") as file:
    file.write(f"{len(ATOMS)}\n\n")
    file.writelines("{} {} {} {}\n".format(*atom) for atom in ATOMS)
pymol.finish_launching(["pymol", "-cq"])
pymol.cmd.load("1.xyz")
pymol.cmd.show("sticks")
pymol.cmd.show("spheres")
pymol.cmd.set("sphere_scale", 0.3)
pymol.cmd.ray(160, 120, renderer=1)
# What `povray` wrote.
shutil.copy("tmp_pymol.png", "1.png")
pymol.cmd.quit()
