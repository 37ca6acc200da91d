# The core, the ray tracer without VTK, for the library (module.cmake) and for projects without VTK. OpenMP must have been
# found.

set(core_sources
  Amr/AmrHiddenCells.cxx
  Amr/AmrHierarchy.cxx
  Amr/AmrNodes.cxx
  Amr/AmrPatches.cxx
  Amr/AmrRanges.cxx
  Amr/AmrRegions.cxx
  Field/BoundsTree.cxx
  Field/FieldSet.cxx
  Field/PacketInSet.cxx
  Field/SetMembers.cxx
  Field/TracedField.cxx
  Image/Cells/BoxFaces.cxx
  Image/Cells/CellsOnRay.cxx
  Image/Cells/LargestValue.cxx
  Image/Cells/TricubicRoots.cxx
  Image/Cells/TrilinearRoots.cxx
  Image/CoarseLevel.cxx
  Image/ImageField.cxx
  Image/Lattice/Ray.cxx
  Image/Samples/FilePages.cxx
  Image/Tracers/AllHitsTracer.cxx
  Image/Tracers/CandidateTracer.cxx
  Image/Tracers/RootTracing.cxx
  Image/Tracers/StopTracer.cxx
  Image/Tracers/SurfaceTracer.cxx
  Image/Traversal/Caps.cxx
  Image/Traversal/CellQueueTracer.cxx
  Image/Traversal/FirstHitTracer.cxx
  Image/Traversal/PacketTracer.cxx
  Image/Traversal/RayFollower.cxx
  Kernels/InstructionSets.cxx
  Mesh/BeamFrame.cxx
  Mesh/BeamTracer.cxx
  Mesh/CellBoxes.cxx
  Mesh/CellHits.cxx
  Mesh/CellSubdivision.cxx
  Mesh/CellTree.cxx
  Mesh/CodeOrder.cxx
  Mesh/CutPlace.cxx
  Mesh/FaceCrossing.cxx
  Mesh/HitOrder.cxx
  Mesh/MeshBeam.cxx
  Mesh/MeshCaps.cxx
  Mesh/MeshCells.cxx
  Mesh/MeshCloud.cxx
  Mesh/MeshField.cxx
  Mesh/MeshRay.cxx
  Mesh/NearestNodes.cxx
  Mesh/PairSolver.cxx
  Mesh/PieceMaker.cxx
  Mesh/PieceTree.cxx
  Mesh/PointGradients.cxx
  Mesh/RayHitsInCells.cxx
  Mesh/ShapeFunctions.cxx
  Mesh/ScatteredRayTracer.cxx
  Mesh/SurfacePieces.cxx
  Mesh/Tetrahedralization.cxx
  Mesh/TrilinearSystem.cxx
  Picture/CastRays.cxx
  Picture/CloudFinder.cxx
  Picture/CloudTileRenderer.cxx
  Picture/CloudTransfer.cxx
  Picture/PartFinder.cxx
  Picture/PendingSegments.cxx
  Picture/PixelBlockRenderer.cxx
  Picture/RenderSharedTiles.cxx
  Picture/RenderTiles.cxx
  Picture/SecondaryRays.cxx
  Picture/Shader.cxx
  Picture/SharedNotes.cxx)
list(TRANSFORM core_sources PREPEND "${CMAKE_CURRENT_LIST_DIR}/Core/")

# What depends on the type of the samples, compiled for each type by itself: in parallel.
foreach (sample_type IN ITEMS
    std::int8_t std::uint8_t std::int16_t std::uint16_t std::int32_t std::uint32_t std::int64_t
    std::uint64_t float double)
  string(REPLACE "std::" "" name "${sample_type}")
  set(source "${CMAKE_BINARY_DIR}/vtkIsosurfaceRayTracing/TypedImageStructures_${name}.cxx")
  configure_file("${CMAKE_CURRENT_LIST_DIR}/Core/Image/TypedImageStructures.cxx.in" "${source}" @ONLY)
  list(APPEND core_sources "${source}")
endforeach ()

# Fusing a*b+c, or not, is the compiler's choice: it would make results differ between compilers and
# instruction sets. Much of the core is in headers, so all who include them do the same.
set(no_contraction "$<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off>")

# The inner loops, once for every instruction set; the program takes what the processor has. Only
# these files may be compiled for more than the baseline. They need all of the optimizer, but in debug
# builds. (GCC 12 takes the undefined registers of its own intrinsics for variables that were
# forgotten: bug 105593.)
set(kernels "${CMAKE_CURRENT_LIST_DIR}/Core/Kernels/Kernels")
set(kernel_options
  "$<$<AND:$<CXX_COMPILER_ID:GNU,Clang,AppleClang>,$<NOT:$<CONFIG:Debug>>>:-O3>"
  "$<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-fno-math-errno>"
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

# (GCC 16 believes that std::sort of up to 16 elements, all that the array has, sorts more.)
set_source_files_properties(
  "${CMAKE_CURRENT_LIST_DIR}/Core/Mesh/MeshBeam.cxx" "${CMAKE_CURRENT_LIST_DIR}/Core/Mesh/MeshRay.cxx"
  PROPERTIES COMPILE_OPTIONS "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>")

# The core is compiled by itself, without VTK's include folder: a VTK header there does not compile.
# The library and the unit tests take the same objects.
add_library(vtkIsosurfaceRayTracingCore OBJECT ${core_sources})
target_include_directories(vtkIsosurfaceRayTracingCore
  PUBLIC "${CMAKE_CURRENT_LIST_DIR}/Core")
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
