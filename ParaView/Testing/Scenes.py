# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""The scenes that the tests draw: each function shows something in a view.

The sources are those of ParaView that give every process its piece, so that a scene needs no files.
"""

from paraview.simple import (
    AMRGaussianPulseSource,
    AppendDatasets,
    Calculator,
    CreateRenderView,
    GetColorTransferFunction,
    GroupDatasets,
    PointDatatoCellData,
    ProgrammableFilter,
    ProgrammableSource,
    Show,
    Sphere,
    Tetrahedralize,
    Transform,
    Wavelet,
)

REPRESENTATION = "Isosurface (ray traced)"
ISOVALUE = 157.0
POINTS = ("POINTS", "RTData")
CELLS = ("CELLS", "RTData")


def make_view(size=240):
    view = CreateRenderView(ViewSize=[size, size], OrientationAxesVisibility=0)
    view.UseColorPaletteForBackground = 0
    view.Background = [0.2, 0.22, 0.28]
    place_camera(view)
    return view


def place_camera(view):
    view.CameraPosition = [32.0, 24.0, 42.0]
    view.CameraFocalPoint = [0.0, 0.0, 0.0]


def make_wavelet(cells=24):
    return Wavelet(WholeExtent=[-cells // 2, cells // 2] * 3)


def show(source, view, array=POINTS, isovalues=(ISOVALUE,), **settings):
    display = Show(source, view)
    display.SetRepresentationType(REPRESENTATION)
    display.IsosurfaceArray = list(array)
    display.Isovalues = list(isovalues)
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = [0.9, 0.75, 0.55]
    display.Specular = 0.4
    display.SpecularPower = 30.0
    for name, value in settings.items():
        setattr(display, name, value)
    return display


def color_by(display, association, name):
    """As ColorBy() of paraview.simple, which asks the user in some cases."""
    table = GetColorTransferFunction(name)
    display.ColorArrayName = [association, name]
    display.LookupTable = table
    return table


def show_ball(view, opacity, **settings):
    ball = Show(Sphere(ThetaResolution=48, PhiResolution=48, **settings), view)
    ball.ColorArrayName = ["POINTS", ""]
    ball.Opacity = opacity


def rectilinear(view):
    """Planes that come nearer to each other along x."""
    grid = ProgrammableFilter(Input=make_wavelet(), OutputDataSetType="vtkRectilinearGrid")
    grid.Script = """
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
image = inputs[0].VTKObject
output.SetExtent(image.GetExtent())
for axis, name in enumerate("XYZ"):
    low, high = image.GetExtent()[2 * axis:2 * axis + 2]
    steps = numpy.arange(low, high + 1, dtype=float)
    coordinates = steps - 0.015 * steps ** 2 if axis == 0 else steps
    getattr(output, f"Set{name}Coordinates")(numpy_to_vtk(coordinates, deep=True))
output.VTKObject.GetPointData().ShallowCopy(image.GetPointData())
output.VTKObject.GetCellData().ShallowCopy(image.GetCellData())
"""
    return show(grid, view)


def curvilinear(view):
    """A structured grid, as which ParaView passes on an image that is turned."""
    turned = Transform(Input=make_wavelet())
    turned.Transform.Rotate = [0.0, 0.0, 30.0]
    return show(turned, view)


def tetrahedra(view):
    return show(Tetrahedralize(Input=make_wavelet()), view)


def hexahedra(view):
    """An unstructured grid of voxels."""
    return show(AppendDatasets(Input=make_wavelet()), view)


def make_blocks():
    """An image, a grid and a mesh."""
    turned = Transform(Input=make_wavelet(16))
    turned.Transform.Rotate = [0.0, 0.0, 30.0]
    turned.Transform.Translate = [0.0, 12.0, 0.0]
    voxels = AppendDatasets(Input=turned)
    return [make_wavelet(), turned, voxels]


def blocks(view):
    """An image and two meshes in each other, as blocks of one data set."""
    return show(GroupDatasets(Input=make_blocks()), view)


def make_named_blocks():
    """Blocks in each other: an image, a pair of a grid and a mesh in the same place, and another image."""
    image, grid, mesh = make_blocks()
    pair = GroupDatasets(Input=[grid, mesh], BlockNames=["grid", "mesh"])
    above = Wavelet(WholeExtent=[-6, 6, -4, 8, 4, 16])
    return GroupDatasets(Input=[image, pair, above], BlockNames=["image", "pair", "above"])


def styled_blocks(view):
    """As the multiblock inspector sets them: one translucent, one of another colour, one hidden."""
    view.UseFXAA = 0  # on several processes ParaView smooths before it composites
    return show(
        make_named_blocks(),
        view,
        BlockSelectors=["/Root/image", "/Root/pair/grid", "/Root/above"],
        BlockColors=["/Root/pair", "0.2", "0.5", "0.9"],
        BlockOpacities=["/Root/image", "0.4"],
    )


def cell_blocks(view):
    """Blocks of arrays of cells: ParaView gives blocks a layer of ghost cells anyway; these need another one."""
    cells = PointDatatoCellData(Input=make_wavelet(), ProcessAllArrays=1)
    above = Transform(Input=cells)
    above.Transform.Translate = [0.0, 12.0, 0.0]
    return show(GroupDatasets(Input=[cells, above]), view, array=CELLS)


def show_amr(source, view):
    view.CameraPosition = [2.0, 2.0, 6.0]
    view.CameraFocalPoint = [-0.75, -0.75, 1.25]
    return show(source, view, array=("CELLS", "Gaussian-Pulse"), isovalues=(0.2,))


def make_pulse():
    return AMRGaussianPulseSource(XPulseOrigin=-0.75, YPulseOrigin=-0.75, ZPulseOrigin=1.25)


def amr(view):
    """Cells of several levels."""
    return show_amr(make_pulse(), view)


def shared_out_amr(view):
    """Each process has some of the blocks (the source gives all to all), without ghost cells, as readers of AMR do."""
    blocks = ProgrammableFilter(Input=make_pulse())
    blocks.Script = """
from vtkmodules.vtkParallelCore import vtkMultiProcessController
controller = vtkMultiProcessController.GetGlobalController()
whole, own = self.GetInputDataObject(0, 0), self.GetOutputDataObject(0)
own.CopyStructure(whole)
for level in range(whole.GetNumberOfLevels()):
    for block in range(whole.GetNumberOfDataSets(level)):
        if (level + block) % controller.GetNumberOfProcesses() == controller.GetLocalProcessId():
            own.SetDataSet(level, block, whole.GetDataSet(level, block))
"""
    return show_amr(blocks, view)


def colored_by_isovalue(view):
    display = show(make_wavelet(), view, isovalues=(120.0, 200.0))
    color_by(display, *POINTS).RescaleTransferFunction(100.0, 220.0)
    return display


def colored_by_array(view):
    source = Calculator(Input=make_wavelet(), ResultArrayName="height", Function="coordsY")
    display = show(source, view)
    color_by(display, "POINTS", "height").RescaleTransferFunction(-12.0, 12.0)
    return display


def translucent(view):
    view.UseFXAA = 0  # on several processes ParaView smooths before it composites
    return show(make_wavelet(), view, isovalues=(120.0, ISOVALUE, 200.0), Opacity=0.4)


def unordered_grid(view):
    """Translucent, of a structured grid: the bounds of its pieces overlap, so they have no order."""
    view.UseFXAA = 0  # on several processes ParaView smooths before it composites
    turned = Transform(Input=make_wavelet())
    turned.Transform.Rotate = [30.0, 20.0, 30.0]
    return show(turned, view, isovalues=(120.0, ISOVALUE, 200.0), Opacity=0.4)


def make_cubes(first=0):
    """A mesh of which each process, from one on if there are more, has cubes of cells between those of the others."""
    mesh = ProgrammableSource(OutputDataSetType="vtkUnstructuredGrid")
    mesh.Script = f"""
import numpy
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkFiltersCore import vtkExtractCells
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkParallelCore import vtkMultiProcessController
wavelet = vtkRTAnalyticSource()
wavelet.SetWholeExtent(-12, 12, -12, 12, -12, 12)
controller = vtkMultiProcessController.GetGlobalController()
first = {first} if controller.GetNumberOfProcesses() > {first} else 0
z, y, x = numpy.meshgrid(*[numpy.arange(24) // 6] * 3, indexing="ij")
owners = (x + y + z).ravel() % (controller.GetNumberOfProcesses() - first) + first
ids = vtkIdList()
for cell in numpy.flatnonzero(owners == controller.GetLocalProcessId()):
    ids.InsertNextId(cell)
if ids.GetNumberOfIds() > 0:
    cells = vtkExtractCells()
    cells.SetInputConnection(wavelet.GetOutputPort())
    cells.SetCellList(ids)
    cells.Update()
    self.GetUnstructuredGridOutput().ShallowCopy(cells.GetOutput())
"""
    return mesh


def unordered_mesh(view):
    view.UseFXAA = 0  # on several processes ParaView smooths before it composites
    # There are no ghost cells, which smooth normals need.
    return show(make_cubes(), view, isovalues=(120.0, ISOVALUE, 200.0), Opacity=0.4, IsosurfaceNormals="Exact")


def unordered_vectors(view):
    """The magnitude of vectors, cut and capped; the process that shows the picture has no data."""
    view.UseFXAA = 0  # on several processes ParaView smooths before it composites
    vectors = Calculator(
        Input=make_cubes(first=1), ResultArrayName="vectors", Function="coordsX * iHat + coordsY * jHat + coordsZ * kHat"
    )
    display = show(
        vectors, view, array=("POINTS", "vectors"), isovalues=(8.0, 12.0), Opacity=0.5, IsosurfaceNormals="Exact"
    )
    display.IsosurfaceComponent = 3
    display.IsosurfaceClippingPlane = "Plane"
    display.IsosurfaceClippingPlane.Origin = [1.0, 0.0, 2.0]
    display.IsosurfaceClippingPlane.Normal = [-1.0, 0.0, -1.0]
    return display


def unordered_in_glass(view):
    """Opaque surfaces, in a sphere for which ParaView composites all in order."""
    display = unordered_grid(view)
    display.Isovalues = [ISOVALUE]
    display.Opacity = 1.0
    show_ball(view, 0.3, Radius=13.0)
    return display


def unordered_around_glass(view):
    show_ball(view, 0.3, Radius=13.0)
    return unordered_grid(view)


def unordered_around_ball(view):
    show_ball(view, 1.0, Radius=6.0, Center=[0.0, 0.0, 10.0])
    return unordered_grid(view)


def make_two_sets():
    """A grid and an image, one in the other; the pieces of a process overlap those of others."""
    turned = Transform(Input=make_wavelet())
    turned.Transform.Rotate = [30.0, 20.0, 30.0]
    image = Wavelet(WholeExtent=[-8, 14, -9, 9, -6, 13])
    return turned, image


def translucent_sets(view):
    """Two sets of data, as two representations."""
    view.UseFXAA = 0  # on several processes ParaView smooths before it composites
    for source in make_two_sets():
        display = show(source, view, isovalues=(120.0, ISOVALUE), Opacity=0.4)
    return display


def translucent_sets_as_blocks(view):
    """The same by one representation, which knows the order of its blocks."""
    view.UseFXAA = 0
    return show(GroupDatasets(Input=make_two_sets()), view, isovalues=(120.0, ISOVALUE), Opacity=0.4)


def opaque_set_in_translucent(view):
    view.UseFXAA = 0
    turned, image = make_two_sets()
    show(turned, view, isovalues=(120.0, ISOVALUE), Opacity=0.4)
    return show(image, view, DiffuseColor=[0.4, 0.6, 0.9])


def sets_around_ball(view):
    """Two translucent sets of data, a ball of polygons, and a third set that is hidden."""
    show_ball(view, 1.0, Radius=6.0, Center=[0.0, 0.0, 10.0])
    display = translucent_sets(view)
    hidden = show(make_wavelet(), view, isovalues=(200.0,))
    hidden.Visibility = 0
    return display


def unordered_interactive(view):
    """As while the view is moved: with fewer rays, and on several processes fewer pixels."""
    display = unordered_grid(view)
    view.SMProxy.InteractiveRender()
    view.UseInteractiveRenderingForScreenshots = 1
    return display


def moved(view):
    """Translucent, and elsewhere than the data: by the transformation of the display."""
    display = translucent(view)
    display.Position = [2.0, -3.0, 1.0]
    display.Orientation = [0.0, 0.0, 90.0]
    display.Scale = [0.8, 1.0, 0.6]
    return display


def opacity_function(view):
    view.UseFXAA = 0  # on several processes ParaView smooths before it composites
    display = show(make_wavelet(), view, isovalues=(120.0, 200.0))
    table = color_by(display, *POINTS)
    table.RescaleTransferFunction(100.0, 220.0)
    # Value, opacity, midpoint, sharpness.
    below = [100.0, 0.2, 0.5, 0.0, 160.0, 0.2, 0.5, 0.0]
    above = [161.0, 1.0, 0.5, 0.0, 220.0, 1.0, 0.5, 0.0]
    table.ScalarOpacityFunction.Points = below + above
    display.IsosurfaceUseOpacityFunction = 1
    return display


def beside_glass(view):
    """Opaque surfaces in a translucent sphere of polygons, which ParaView peels."""
    view.UseFXAA = 0
    show_ball(view, 0.3, Radius=13.0)
    return show(make_wavelet(), view)


def clipped(view):
    display = show(make_wavelet(), view)
    color_by(display, *POINTS).RescaleTransferFunction(100.0, 260.0)
    display.IsosurfaceClippingPlane = "Plane"
    display.IsosurfaceClippingPlane.Origin = [1.0, 0.0, 2.0]
    display.IsosurfaceClippingPlane.Normal = [-1.0, 0.0, -1.0]
    return display


def shadows(view):
    return show(make_wavelet(), view, IsosurfaceShadows=1)


def occlusion(view):
    return show(make_wavelet(), view, IsosurfaceAmbientOcclusion=1, Ambient=0.6, Diffuse=0.4)


def trilinear(view):
    return show(make_wavelet(), view)


def exact_normals(view):
    return show(make_wavelet(), view, IsosurfaceNormals="Exact")


def nearest(view):
    return show(make_wavelet(), view, IsosurfaceInterpolation="Nearest")


def cubic(view):
    return show(make_wavelet(), view, IsosurfaceInterpolation="Cubic")


def cells(view):
    source = PointDatatoCellData(Input=make_wavelet(), ProcessAllArrays=1)
    return show(source, view, array=CELLS)


def smooth_edges(view):
    return show(make_wavelet(), view, IsosurfaceImageSampleDistance=0.5)


def vectors(view):
    source = Calculator(
        Input=make_wavelet(), ResultArrayName="RTData", Function="coordsX * iHat + coordsY * jHat + 2 * coordsZ * kHat"
    )
    return show(source, view, isovalues=(10.0,), IsosurfaceComponent=3)


def few_cells(view):
    """Two cells: there are processes without any."""
    view.CameraPosition = [3.0, 2.0, 4.0]
    return show(Wavelet(WholeExtent=[-1, 1, 0, 1, 0, 1]), view, isovalues=(220.0,))
