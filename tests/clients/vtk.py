"""A smooth and a clear mesh of VTK's exporter."""
import subprocess
import sys

# This file has the name of the package.
sys.path.pop(0)
import vtk

renderer = vtk.vtkRenderer()
renderer.SetBackground(0.1, 0.2, 0.4)
sphere = vtk.vtkSphereSource()
sphere.SetThetaResolution(24)
sphere.SetPhiResolution(16)
cone = vtk.vtkConeSource()
cone.SetCenter(1, 0, 0)
for source, color, opacity in [(sphere, (0.8, 0.3, 0.2), 1.0), (cone, (0.9, 0.9, 0.6), 0.6)]:
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*color)
    actor.GetProperty().SetSpecular(0.5)
    actor.GetProperty().SetOpacity(opacity)
    renderer.AddActor(actor)
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
window.AddRenderer(renderer)
window.SetSize(160, 120)
renderer.ResetCamera()
window.Render()
exporter = vtk.vtkPOVExporter()
exporter.SetRenderWindow(window)
exporter.SetFileName("1.pov")
exporter.Write()
subprocess.run(["povray", "+I1.pov", "+W160", "+H120", "-D"], check=True)
