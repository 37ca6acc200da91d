# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Settings of the mapper by their names, which not every build has."""

from vtkIsosurfaceRayTracing import vtkIsosurfaceRayTraceMapper

# FAST is in old builds only.
SOLVERS = ("ROBUST", "ANALYTIC", "MARMITT", "LINEAR")


class NotInThisBuild(Exception):
    """A setting, or a value of one, that the mapper of this build does not have."""


def apply_settings(mapper, settings):
    """A value that is a string is a name of the mapper's enumerations."""
    for name, value in settings.items():
        try:
            set_value = getattr(mapper, "Set" + name)
            if isinstance(value, str):
                value = getattr(vtkIsosurfaceRayTraceMapper, value)
        except AttributeError as error:
            raise NotInThisBuild(str(error)) from error
        set_value(*(value if isinstance(value, tuple) else (value,)))
