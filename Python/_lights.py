# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The lights of pictures: one for the shape, others that no side is dark."""

import math

from vtkmodules.vtkRenderingCore import vtkLight

# Azimuth and elevation about the surface, seen from the camera, in degrees; colour, multiplied by the intensity.
LIGHTS = (
    (-30.0, 45.0, (1.00, 0.97, 0.92)),
    (45.0, -25.0, (0.27, 0.29, 0.32)),
    (115.0, 10.0, (0.28, 0.28, 0.28)),
    (-115.0, 0.0, (0.28, 0.28, 0.28)),
)


def make_lights():
    """Lights that stay where they are, seen from the camera."""
    return [_make_light(*light) for light in LIGHTS]


def _make_light(azimuth, elevation, color):
    azimuth, elevation = math.radians(azimuth), math.radians(elevation)
    light = vtkLight()
    light.SetLightTypeToCameraLight()
    light.SetFocalPoint(0.0, 0.0, 0.0)
    light.SetPosition(
        math.sin(azimuth) * math.cos(elevation), math.sin(elevation), math.cos(azimuth) * math.cos(elevation))
    light.SetColor(color)
    return light
