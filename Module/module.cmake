# The library, in the directory scope of vtk.module: by itself and inside a VTK tree alike.

set(core_sources
  Amr/AmrHierarchy.cxx
  Image/Lattice/Ray.cxx
  Kernels/InstructionSets.cxx
  Field/BoundsTree.cxx
  Field/FieldSet.cxx
  Field/TracedField.cxx
  Image/Cells/BoxFaces.cxx
  Image/Cells/CellsOnRay.cxx
  Image/Cells/LargestValue.cxx
  Image/Cells/TricubicCell.cxx
  Image/Cells/TricubicRoots.cxx
  Image/Cells/TrilinearRoots.cxx
  Image/ImageField.cxx
  Image/Samples/FilePages.cxx
  Image/Tracers/RootTracing.cxx
  Image/Tracers/SurfaceTracer.cxx
  Image/Traversal/Caps.cxx
  Image/Traversal/CellQueueTracer.cxx
  Image/Traversal/FirstHitTracer.cxx
  Image/Traversal/PacketTracer.cxx
  Image/Traversal/RayFollower.cxx
  Mesh/BeamFrame.cxx
  Mesh/BeamTracer.cxx
  Mesh/CellBoxes.cxx
  Mesh/CellHits.cxx
  Mesh/CellSubdivision.cxx
  Mesh/CellTree.cxx
  Mesh/FaceCrossing.cxx
  Mesh/HitOrder.cxx
  Mesh/MeshBeam.cxx
  Mesh/MeshCaps.cxx
  Mesh/MeshCells.cxx
  Mesh/MeshCloud.cxx
  Mesh/MeshField.cxx
  Mesh/MeshRay.cxx
  Mesh/PointGradients.cxx
  Mesh/RayHitsInCells.cxx
  Mesh/ShapeFunctions.cxx
  Mesh/SurfacePieces.cxx
  Mesh/TrilinearSystem.cxx
  Picture/CastRays.cxx
  Picture/CloudFinder.cxx
  Picture/CloudTileRenderer.cxx
  Picture/CloudTransfer.cxx
  Picture/PixelBlockRenderer.cxx
  Picture/RenderSharedTiles.cxx
  Picture/RenderTiles.cxx
  Picture/SecondaryRays.cxx
  Picture/Shader.cxx)
list(TRANSFORM core_sources PREPEND "Module/Core/")

# What depends on the type of the samples, compiled for each type by itself: in parallel.
foreach (sample_type IN ITEMS
    std::int8_t std::uint8_t std::int16_t std::uint16_t std::int32_t std::uint32_t std::int64_t
    std::uint64_t float double)
  string(REPLACE "std::" "" name "${sample_type}")
  set(source "${CMAKE_CURRENT_BINARY_DIR}/Core/TypedImageStructures_${name}.cxx")
  configure_file("Module/Core/Image/TypedImageStructures.cxx.in" "${source}" @ONLY)
  list(APPEND core_sources "${source}")
endforeach ()

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
  Filters/vtkIsosurfaceComparisonInterpolant
  Filters/vtkIsosurfaceComparisonMethods
  Filters/vtkIsosurfaceComparisonPictures
  Filters/vtkIsosurfaceComparisonRays
  Filters/vtkIsosurfaceComparisonRow
  Filters/vtkIsosurfaceComparisonTime
  Filters/vtkIsosurfaceComparisonTopology
  Rendering/vtkIsosurfaceRayTraceAccumulation
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
  Rendering/vtkIsosurfaceRayTraceGridPart
  Rendering/vtkIsosurfaceRayTraceHints
  Rendering/vtkIsosurfaceRayTraceHits
  Rendering/vtkIsosurfaceRayTraceHolder
  Rendering/vtkIsosurfaceRayTraceImageDisplay
  Rendering/vtkIsosurfaceRayTraceInput
  Rendering/vtkIsosurfaceRayTraceInputs
  Rendering/vtkIsosurfaceRayTraceLattices
  Rendering/vtkIsosurfaceRayTraceLeaves
  Rendering/vtkIsosurfaceRayTraceMacrocellCache
  Rendering/vtkIsosurfaceRayTraceMesh
  Rendering/vtkIsosurfaceRayTraceOutput
  Rendering/vtkIsosurfaceRayTracePicture
  Rendering/vtkIsosurfaceRayTraceProblems
  Rendering/vtkIsosurfaceRayTraceRequest
  Rendering/vtkIsosurfaceRayTraceScalars
  Rendering/vtkIsosurfaceRayTraceScene
  Rendering/vtkIsosurfaceRayTraceSelection
  Rendering/vtkIsosurfaceRayTraceSnapshot
  Rendering/vtkIsosurfaceRayTraceSource
  Rendering/vtkIsosurfaceRayTraceUse
  Rendering/vtkIsosurfaceRayTraceValueColors)

set(private_headers
  Rendering/vtkIsosurfaceRayTraceLatticeSampling.h
  Rendering/vtkIsosurfaceRayTracePart.h
  Rendering/vtkIsosurfaceRayTraceSettings.h
  Rendering/vtkIsosurfaceRayTraceSharedSettings.h)

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

# Fusing a*b+c, or not, is the compiler's choice: it would make results differ between compilers and
# instruction sets. Much of the core is in headers, so all who include them do the same.
set(no_contraction "$<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off>")

# The inner loops, once for every instruction set; the program takes what the processor has. Only
# these files may be compiled for more than the baseline. (GCC 12 takes the undefined registers of
# its own intrinsics for variables that were forgotten: bug 105593.)
set(kernels "Module/Core/Kernels/Kernels")
set(kernel_options
  "$<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-O3>" "$<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-fno-math-errno>"
  "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>" "$<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized>")
list(APPEND core_sources "${kernels}Baseline.cxx")
set_source_files_properties("${kernels}Baseline.cxx" PROPERTIES COMPILE_OPTIONS "${kernel_options}")
if (CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND core_sources "${kernels}Avx2.cxx" "${kernels}Avx512.cxx")
  set_source_files_properties("${kernels}Avx2.cxx"
    PROPERTIES COMPILE_OPTIONS "${kernel_options};-mavx2;-mfma")
  set_source_files_properties("${kernels}Avx512.cxx"
    PROPERTIES COMPILE_OPTIONS "${kernel_options};-mavx512f;-mavx512dq;-mavx512bw;-mavx512vl")
endif ()

# The core is compiled by itself, without VTK's include folder: a VTK header there does not compile.
# The library and the unit tests take the same objects.
add_library(vtkIsosurfaceRayTracingCore OBJECT ${core_sources})
target_include_directories(vtkIsosurfaceRayTracingCore
  PUBLIC "${CMAKE_CURRENT_SOURCE_DIR}/Module/Core")
target_compile_features(vtkIsosurfaceRayTracingCore PUBLIC cxx_std_17)
target_compile_options(vtkIsosurfaceRayTracingCore
  PRIVATE
    ${vtkIsosurfaceRayTracing_COMPILE_OPTIONS}
  PUBLIC
    ${no_contraction})
target_link_libraries(vtkIsosurfaceRayTracingCore PUBLIC OpenMP::OpenMP_CXX)
set_target_properties(vtkIsosurfaceRayTracingCore
  PROPERTIES
    POSITION_INDEPENDENT_CODE ON
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)

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
if (vtkIsosurfaceRayTracing_COMPILE_OPTIONS)
  vtk_module_compile_options(VTK::IsosurfaceRayTracing
    PRIVATE ${vtkIsosurfaceRayTracing_COMPILE_OPTIONS} ${no_contraction})
endif ()
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
