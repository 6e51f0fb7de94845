"""A scene of vapory, as a file and as pixels from standard output."""
from PIL import Image
from vapory import Background, Box, Camera, Finish, LightSource, Pigment, Plane, Scene, Sphere, Texture

objects = [
    Background("color", [0.1, 0.2, 0.4]),
    LightSource([2, 4, -3], "color", [1, 1, 1]),
    Plane([0, 1, 0], -1, Texture(Pigment("color", [0.8, 0.8, 0.7]))),
    Sphere([0, 1, 2], 2, Texture(Pigment("color", [1, 0, 1]), Finish("phong", 0.8))),
    Box([-3, -1, 0], [-2, 0, 1], Texture(Pigment("color", [0, 0.6, 0.2]))),
]
scene = Scene(Camera("location", [0, 2, -5], "look_at", [0, 1, 2]), objects=objects, included=["colors.inc"])
scene.render("1.png", width=160, height=120, antialiasing=0.01)
Image.fromarray(scene.render(width=160, height=120)).save("2.png")
