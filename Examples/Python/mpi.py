#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""One picture of data that lie in many processes: mpirun -n 4 mpi.py PICTURE.png"""

import sys

import numpy as np
from mpi4py import MPI
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.vtkParallelMPI import vtkMPIController
from vtkmodules.vtkParallelMPI4Py import vtkMPI4PyCommunicator
from vtkmodules.vtkRenderingCore import vtkCamera
from vtkIsosurfaceRayTracing import Picture, isosurface
from vtkIsosurfaceRayTracing.vtkIsosurfaceRayTracingParallel import vtkIsosurfaceRayTraceCompositor

if len(sys.argv) != 2:
    sys.exit(__doc__)
controller = vtkMPIController()
controller.SetCommunicator(vtkMPI4PyCommunicator.ConvertToVTK(MPI.COMM_WORLD))
vtkMultiProcessController.SetGlobalController(controller)

rank, size = MPI.COMM_WORLD.Get_rank(), MPI.COMM_WORLD.Get_size()
first, last = 96 * rank // size, 96 * (rank + 1) // size  # the cells of this process along x
x, y, z = 0.1 * np.mgrid[first:last + 1, :97, :97]
values = np.cos(x) * np.sin(y) + np.cos(y) * np.sin(z) + np.cos(z) * np.sin(x)
volume = isosurface(values, 0.2, origin=(first, 0, 0))
volume.GetMapper().SetNormalModeToInterpolantGradient()  # which needs no samples of other processes

camera = vtkCamera()
camera.SetPosition(250, 200, -180)
camera.SetFocalPoint(48, 48, 48)
camera.SetClippingRange(1, 1000)
picture = vtkImageData()
vtkIsosurfaceRayTraceCompositor().RenderToImage(volume, camera, None, 600, 600, picture)
if rank == 0:
    Picture(picture).save(sys.argv[1])
