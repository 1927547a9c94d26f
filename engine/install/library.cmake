# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# libmwmesh, shared and static, and how CMake and pkg-config find it.
include(CMakePackageConfigHelpers)

# Before 1.0 each minor version has an interface of its own.
set(mw_soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(mw_parts mw_api mw_request mw_engine mw_codt mw_audit mw_io mw_kernels)

add_library(mwmesh_shared SHARED $<TARGET_OBJECTS:mw_api>)
set(exports ${CMAKE_CURRENT_LIST_DIR}/exports.map)
target_link_libraries(mwmesh_shared PRIVATE mw_request)
# A symbol that is missing is an error here, not in programs.
target_link_options(mwmesh_shared PRIVATE -Wl,--version-script=${exports} -Wl,-z,defs)
set_target_properties(mwmesh_shared PROPERTIES VERSION ${PROJECT_VERSION}
  SOVERSION ${mw_soversion} EXPORT_NAME mwmesh LINK_DEPENDS ${exports})

# One archive of all our objects.  What they need, by its names in pkg-config, and libbz2 and DCMTK,
# which have none there; Debian's hdf5 is named after what it was built for.
set(mw_needed_modules blosc draco libcrypto libcurl liblz4 liblzma libpng libtiff-4 libzstd pugixml tbb zlib)
pkg_check_modules(mw_serial_hdf5 QUIET hdf5-serial)
if(mw_serial_hdf5_FOUND)
  list(APPEND mw_needed_modules hdf5-serial)
else()
  list(APPEND mw_needed_modules hdf5)
endif()
pkg_check_modules(mwmesh_needs REQUIRED IMPORTED_TARGET ${mw_needed_modules})
add_library(mwmesh_static STATIC)
foreach(part ${mw_parts})
  target_sources(mwmesh_static PRIVATE $<TARGET_OBJECTS:${part}>)
endforeach()
target_link_libraries(mwmesh_static PRIVATE PkgConfig::mwmesh_needs ${mw_dcmtk} BZip2::BZip2 Threads::Threads)
set_target_properties(mwmesh_static PROPERTIES LINKER_LANGUAGE CXX)

foreach(library mwmesh_shared mwmesh_static)
  set_target_properties(${library} PROPERTIES OUTPUT_NAME mwmesh
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib
    ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
  # mwmesh.h is C++20; mwmesh_c.h is all that there is for C.
  target_compile_features(${library} INTERFACE c_std_11 cxx_std_20)
  target_include_directories(${library} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endforeach()

set(mw_cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/mwmesh)
install(TARGETS mwmesh_shared EXPORT mwmeshTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
install(TARGETS mwmesh_static EXPORT mwmeshStaticTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(FILES engine/mwmesh_c.h engine/mwmesh.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
foreach(set mwmeshTargets mwmeshStaticTargets)
  install(EXPORT ${set} NAMESPACE mwmesh:: DESTINATION ${mw_cmake_folder} COMPONENT development)
endforeach()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/mwmeshConfig.cmake.in
  ${CMAKE_BINARY_DIR}/install/mwmeshConfig.cmake INSTALL_DESTINATION ${mw_cmake_folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/install/mwmeshConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/install/mwmeshConfig.cmake
  ${CMAKE_BINARY_DIR}/install/mwmeshConfigVersion.cmake
  DESTINATION ${mw_cmake_folder} COMPONENT development)

# The prefix is found from where the file lies, so that the whole can be moved.
file(RELATIVE_PATH mw_prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" mw_prefix_from_pc ${mw_prefix_from_pc})
list(JOIN mwmesh_needs_LDFLAGS " " mw_private_libraries)
configure_file(${CMAKE_CURRENT_LIST_DIR}/mwmesh.pc.in ${CMAKE_BINARY_DIR}/install/mwmesh.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/install/mwmesh.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
