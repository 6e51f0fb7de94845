"""A scene of fdray, as pixels with a transparent background."""
from PIL import Image
from fdray import Box, Camera, Color, Curve, LightSource, Renderer, Scene, Sphere

scene = Scene(
    Camera(30, 30, view_scale=2),
    LightSource(0, (1, 1, 1), shadowless=True),
    Sphere((0, 0, 0), 0.8, Color("red", 0.5)),
    Box((-0.5, -0.5, -0.5), (0.2, 0.2, 1), Color("blue")),
    Curve([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 1)], 0.1, Color("green")),
)
Image.fromarray(Renderer(width=160, height=120).render(scene)).save("1.png")
