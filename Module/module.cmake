# The library, in the directory scope of vtk.module: by itself and inside a VTK tree alike.

set(classes
  Filters/vtkIsosurfaceComparisonFilter
  IO/vtkMappedImageReader
  Rendering/vtkCellProjectionMapper
  Rendering/vtkIsosurfacePicker
  Rendering/vtkIsosurfacePicture
  Rendering/vtkIsosurfaceRayTraceFactory
  Rendering/vtkIsosurfaceRayTraceMapper
  Rendering/vtkIsosurfaceRayTraceMeshMapper
  Rendering/vtkIsosurfaceVolume)

set(private_classes
  Filters/vtkIsosurfaceComparisonErrors
  Filters/vtkIsosurfaceComparisonExecution
  Filters/vtkIsosurfaceComparisonInterpolant
  Filters/vtkIsosurfaceComparisonMethods
  Filters/vtkIsosurfaceComparisonPictures
  Filters/vtkIsosurfaceComparisonRays
  Filters/vtkIsosurfaceComparisonRow
  Filters/vtkIsosurfaceComparisonTime
  Filters/vtkIsosurfaceComparisonTopology
  Rendering/vtkIsosurfaceRayTraceAccumulation
  Rendering/vtkIsosurfaceRayTraceAmrBlocks
  Rendering/vtkIsosurfaceRayTraceAmrLevels
  Rendering/vtkIsosurfaceRayTraceAmrPart
  Rendering/vtkIsosurfaceRayTraceArrayColors
  Rendering/vtkIsosurfaceRayTraceBlock
  Rendering/vtkIsosurfaceRayTraceBlockDisplay
  Rendering/vtkIsosurfaceRayTraceBlockJoin
  Rendering/vtkIsosurfaceRayTraceBlocks
  Rendering/vtkIsosurfaceRayTraceClouds
  Rendering/vtkIsosurfaceRayTraceColors
  Rendering/vtkIsosurfaceRayTraceCropping
  Rendering/vtkIsosurfaceRayTraceEngine
  Rendering/vtkIsosurfaceRayTraceEnumerators
  Rendering/vtkIsosurfaceRayTraceFrame
  Rendering/vtkIsosurfaceRayTraceGeometry
  Rendering/vtkIsosurfaceRayTraceGhosts
  Rendering/vtkIsosurfaceRayTraceGridLists
  Rendering/vtkIsosurfaceRayTraceGridPart
  Rendering/vtkIsosurfaceRayTraceHints
  Rendering/vtkIsosurfaceRayTraceHits
  Rendering/vtkIsosurfaceRayTraceHolder
  Rendering/vtkIsosurfaceRayTraceImageDisplay
  Rendering/vtkIsosurfaceRayTraceInput
  Rendering/vtkIsosurfaceRayTraceInputBounds
  Rendering/vtkIsosurfaceRayTraceInputs
  Rendering/vtkIsosurfaceRayTraceLattices
  Rendering/vtkIsosurfaceRayTraceLayers
  Rendering/vtkIsosurfaceRayTraceLeaves
  Rendering/vtkIsosurfaceRayTraceMacrocellCache
  Rendering/vtkIsosurfaceRayTraceMeshPart
  Rendering/vtkIsosurfaceRayTraceOutput
  Rendering/vtkIsosurfaceRayTracePartSet
  Rendering/vtkIsosurfaceRayTracePicture
  Rendering/vtkIsosurfaceRayTracePolyhedron
  Rendering/vtkIsosurfaceRayTraceProblems
  Rendering/vtkIsosurfaceRayTraceReporter
  Rendering/vtkIsosurfaceRayTraceRequest
  Rendering/vtkIsosurfaceRayTraceScalars
  Rendering/vtkIsosurfaceRayTraceScene
  Rendering/vtkIsosurfaceRayTraceSelection
  Rendering/vtkIsosurfaceRayTraceSnapshot
  Rendering/vtkIsosurfaceRayTraceSource
  Rendering/vtkIsosurfaceRayTraceSubdividedCells
  Rendering/vtkIsosurfaceRayTraceSubdivision
  Rendering/vtkIsosurfaceRayTraceTracedCells
  Rendering/vtkIsosurfaceRayTraceUse
  Rendering/vtkIsosurfaceRayTraceValueColors)

set(private_headers
  Rendering/vtkIsosurfaceRayTraceLatticeSampling.h
  Rendering/vtkIsosurfaceRayTracePart.h
  Rendering/vtkIsosurfaceRayTraceReadArrays.h
  Rendering/vtkIsosurfaceRayTraceSettings.h
  Rendering/vtkIsosurfaceRayTraceSharedSettings.h
  Rendering/vtkIsosurfaceRayTraceThreads.h)

find_package(OpenMP COMPONENTS CXX)
if (NOT OpenMP_CXX_FOUND)
  message(FATAL_ERROR
    "VTK::IsosurfaceRayTracing needs OpenMP, and the C++ compiler has none. Install it (Debian's clang: "
    "libomp-dev), or build VTK without this module (-DVTK_MODULE_ENABLE_VTK_IsosurfaceRayTracing=NO).")
endif ()
if (NOT BUILD_SHARED_LIBS)
  # Who links a static VTK needs OpenMP, too: VTK's package will look for it.
  vtk_module_find_package(PACKAGE OpenMP COMPONENTS CXX)
endif ()

include("${CMAKE_CURRENT_LIST_DIR}/core.cmake")

# Headers are installed in their folders, as file sets (VTK 9.4 and newer) do it in any case; includes
# name no folder.
set(header_destination "${_vtk_build_HEADERS_DESTINATION}/vtkIsosurfaceRayTracing")
set(include_folders "$<INSTALL_INTERFACE:${header_destination}>")
foreach (folder IN ITEMS Filters IO Module Rendering)
  list(APPEND include_folders
    "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/${folder}>"
    "$<INSTALL_INTERFACE:${header_destination}/${folder}>")
endforeach ()

vtk_module_add_module(VTK::IsosurfaceRayTracing
  HEADER_DIRECTORIES
  HEADERS_SUBDIR  vtkIsosurfaceRayTracing
  CLASSES         ${classes}
  PRIVATE_CLASSES ${private_classes}
  PRIVATE_HEADERS ${private_headers}
  NOWRAP_HEADERS
    Module/vtkIsosurfaceRayTracingCompat.h
    Rendering/vtkIsosurfaceRayTraceSetMacros.h
  SOURCES         IO/AppendedSamples.cxx
                  IO/FileMapping.cxx
                  IO/FilePrefetch.cxx
                  IO/FileState.cxx
                  IO/ImageFormats.cxx
                  IO/MappableImage.cxx
                  IO/MappingsInUse.cxx
                  IO/MetaImageHeader.cxx
                  IO/NiftiHeader.cxx
                  IO/NrrdHeader.cxx
                  IO/OwnPages.cxx
                  Rendering/vtkIsosurfaceRayTraceMapperSettings.cxx
                  $<TARGET_OBJECTS:vtkIsosurfaceRayTracingCore>)
vtk_module_compile_features(VTK::IsosurfaceRayTracing PRIVATE cxx_std_17)
vtk_module_compile_options(VTK::IsosurfaceRayTracing
  PRIVATE ${vtkIsosurfaceRayTracing_COMPILE_OPTIONS} ${no_contraction})
vtk_module_include(VTK::IsosurfaceRayTracing
  PUBLIC
    ${include_folders}
  PRIVATE
    "${CMAKE_CURRENT_SOURCE_DIR}/Module/Core")
vtk_module_link(VTK::IsosurfaceRayTracing PRIVATE OpenMP::OpenMP_CXX)

# Who wraps the installed module looks for its headers by this property, in which VTK leaves out folders.
list(TRANSFORM classes REPLACE "(.+)"
  "\${_vtk_module_import_prefix}/${header_destination}/\\1.h" OUTPUT_VARIABLE installed_headers)
vtk_module_set_property(VTK::IsosurfaceRayTracing
  PROPERTY  INTERFACE_vtk_module_headers_install
  VALUE     ${installed_headers})
