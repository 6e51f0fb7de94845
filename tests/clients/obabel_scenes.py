"""A molecule that Open Babel writes for POV-Ray, with its include file."""
import glob
import subprocess

with open("1.xyz", "w") as file:
    file.write("4\n\nC -0.6 0 0\nO 0.6 0 0\nH -1.2 0.9 0\nH -1.2 -0.9 0\n")
subprocess.run(["obabel", "1.xyz", "-opov", "-O", "1.pov"], check=True)
folder = glob.glob("/usr/share/openbabel/*/babel_povray3.inc")[0].rsplit("/", 1)[0]
subprocess.run(["povray", "+I1.pov", f"+L{folder}", "+W160", "+H120", "-D"], check=True)
