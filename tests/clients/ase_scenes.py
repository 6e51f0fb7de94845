"""Atoms of ASE, with bonds and a cell, as its writer of POV-Ray files renders them."""
from ase.build import bulk, molecule
from ase.io import write
from ase.io.pov import get_bondpairs

ethanol = molecule("CH3CH2OH")
settings = {"textures": ["ase3"] * len(ethanol), "bondatoms": get_bondpairs(ethanol), "canvas_width": 160}
write("1.pov", ethanol, rotation="10z,-80x", povray_settings=settings).render()
copper = bulk("Cu", cubic=True) * (3, 3, 3)
settings = {"textures": ["jmol", "glass", "simple", "pale"] * 27, "transparent": True, "canvas_width": 160}
write("2.pov", copper, rotation="-70x,-20y", povray_settings=settings).render()
