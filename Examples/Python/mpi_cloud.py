#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""A cloud whose cells lie in many processes: mpirun -n 4 mpi_cloud.py PICTURE.png"""

import sys

from mpi4py import MPI
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.vtkParallelMPI import vtkMPIController
from vtkmodules.vtkParallelMPI4Py import vtkMPI4PyCommunicator
from vtkmodules.vtkRenderingCore import vtkCamera, vtkVolume
from vtkIsosurfaceRayTracing import Picture, vtkCellProjectionMapper
from vtkIsosurfaceRayTracing.vtkIsosurfaceRayTracingParallel import vtkIsosurfaceRayTraceCompositor

if len(sys.argv) != 2:
    sys.exit(__doc__)
controller = vtkMPIController()
controller.SetCommunicator(vtkMPI4PyCommunicator.ConvertToVTK(MPI.COMM_WORLD))
vtkMultiProcessController.SetGlobalController(controller)

rank, size = MPI.COMM_WORLD.Get_rank(), MPI.COMM_WORLD.Get_size()
source = vtkRTAnalyticSource()  # or a reader of .pvtu files, and reader.UpdatePiece(rank, size, 0)
source.SetWholeExtent(-24, 24, -24, 24, -24, 24)
source.UpdateExtent((48 * rank // size - 24, 48 * (rank + 1) // size - 24, -24, 24, -24, 24))
mesh = vtkAppendFilter()  # makes a mesh of an image
mesh.AddInputData(source.GetOutput())
mesh.Update()

volume = vtkVolume()
volume.SetMapper(vtkCellProjectionMapper())
volume.GetMapper().SetInputDataObject(mesh.GetOutput())
cloud = volume.GetProperty()
cloud.SetScalarOpacityUnitDistance(1.0)
cloud.GetRGBTransferFunction().RemoveAllPoints()  # The default is from black to white.
cloud.GetScalarOpacity().RemoveAllPoints()
for value, opacity, color in ((150, 0.0, (0.2, 0.4, 0.9)), (200, 0.1, (1.0, 0.8, 0.5)), (250, 0.9, (0.9, 0.2, 0.1))):
    cloud.GetScalarOpacity().AddPoint(value, opacity)
    cloud.GetRGBTransferFunction().AddRGBPoint(value, *color)

camera = vtkCamera()
camera.SetPosition(90, 60, 80)
camera.SetClippingRange(1, 500)
picture = vtkImageData()
vtkIsosurfaceRayTraceCompositor().RenderToImage(volume, camera, None, 600, 600, picture)
if rank == 0:
    Picture(picture, "black").save(sys.argv[1])
