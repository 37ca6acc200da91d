# What Debian's packages of the library and of the plugin for ParaView share.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME vtkisosurfaceraytracing)
set(CPACK_PACKAGE_CONTACT "The vtkIsosurfaceRayTracing developers <developers@vtkisosurfaceraytracing.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_OUTPUT_FILE_PREFIX "${CMAKE_BINARY_DIR}/packages")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

# What Debian asks of each package.
set(root_folder "${CMAKE_CURRENT_LIST_DIR}/../..")
foreach (file IN ITEMS CHANGELOG.md Packages/Debian/changelog)
  get_filename_component(name "${file}" NAME)
  execute_process(
    COMMAND gzip --best --no-name --stdout "${root_folder}/${file}"
    OUTPUT_FILE "${CMAKE_CURRENT_BINARY_DIR}/${name}.gz"
    COMMAND_ERROR_IS_FATAL ANY)
endforeach ()

# The first line of the description is its summary.
macro (add_package component name section description)
  cmake_parse_arguments(package "" "" "NEEDS;DEPENDS" ${ARGN})
  string(TOUPPER "${component}" key)
  list(APPEND CPACK_COMPONENTS_ALL "${component}")
  set("CPACK_COMPONENT_${key}_DEPENDS" ${package_NEEDS})
  list(JOIN package_DEPENDS ", " "CPACK_DEBIAN_${key}_PACKAGE_DEPENDS")
  set("CPACK_DEBIAN_${key}_DESCRIPTION" "${description}")
  set("CPACK_DEBIAN_${key}_PACKAGE_NAME" "${name}")
  set("CPACK_DEBIAN_${key}_PACKAGE_SECTION" "${section}")
  set(documents "${CMAKE_INSTALL_DATADIR}/doc/${name}")
  install(FILES "${root_folder}/LICENSE"
    DESTINATION "${documents}" COMPONENT "${component}" RENAME copyright)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/CHANGELOG.md.gz"
    DESTINATION "${documents}" COMPONENT "${component}" RENAME changelog.gz)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/changelog.gz"
    DESTINATION "${documents}" COMPONENT "${component}" RENAME changelog.Debian.gz)
endmacro ()
