option(vtkIsosurfaceRayTracing_WARNINGS_AS_ERRORS "Let a compiler warning stop the build" OFF)

# Warnings are for our own code: Module/module.cmake and Testing/ take these options, the generated
# wrappers do not. (-Wpedantic objects to the semicolon after VTK's macros.)
set(vtkIsosurfaceRayTracing_COMPILE_OPTIONS)
if (CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  list(APPEND vtkIsosurfaceRayTracing_COMPILE_OPTIONS
    -Wall -Wextra -Wshadow -Wcast-align -Wcast-qual -Wformat=2
    -Wnon-virtual-dtor -Woverloaded-virtual -Wundef)
  if (vtkIsosurfaceRayTracing_WARNINGS_AS_ERRORS)
    list(APPEND vtkIsosurfaceRayTracing_COMPILE_OPTIONS -Werror)
  endif ()
endif ()
