# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# `cpack`: Debian packages, one a component.  configs/package.sh configures, builds and tests them.
set(MW_MAINTAINER "" CACHE STRING
  "Who made the packages (empty: DEBFULLNAME and DEBEMAIL of the environment)")
# The maker of packages answers for them; without an address lintian rejects them.
if(MW_MAINTAINER)
  set(mw_maintainer ${MW_MAINTAINER})
elseif(DEFINED ENV{DEBEMAIL} AND DEFINED ENV{DEBFULLNAME})
  set(mw_maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
else()
  set(mw_maintainer "The mwmesh authors <mwmesh@localhost>")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME mwmesh)
set(CPACK_PACKAGE_CONTACT ${mw_maintainer})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENTS_ALL)

set(mw_what [[
A window marches over a volume of labelled voxels (EM connectomics, CT and
MRI segmentations, polycrystals) and leaves one conforming tetrahedral mesh in
which every label keeps its topology, whatever the size of the volume.]])

# What only the library's package has: how others come to depend on it, and that the linker's cache is
# renewed when it comes and goes.
set(mw_control ${CMAKE_BINARY_DIR}/package/control)
file(WRITE ${mw_control}/shlibs
  "libmwmesh ${mw_soversion} libmwmesh${mw_soversion} (= ${PROJECT_VERSION})\n")
file(WRITE ${mw_control}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${mw_control}/shlibs ${mw_control}/triggers)
set(CPACK_POST_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/drop_scripts.cmake)

# Paths that only a package has: copyright and changelog.
set(folder ${CMAKE_BINARY_DIR}/package)
if(MW_PACKAGING)
  string(TIMESTAMP mw_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
  configure_file(engine/install/changelog.in ${folder}/changelog @ONLY)
  execute_process(COMMAND gzip -9nc ${folder}/changelog OUTPUT_FILE ${folder}/changelog.gz
    COMMAND_ERROR_IS_FATAL ANY)
endif()

# component, name of the package, its first line, and what else there is to say.
function(mw_package component name summary text)
  string(TOUPPER ${component} upper)
  set(prefix CPACK_DEBIAN_${upper}_PACKAGE)
  set(${prefix}_NAME ${name} PARENT_SCOPE)
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}\n${mw_what}\n\n${text}" PARENT_SCOPE)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
  if(MW_PACKAGING)
    install(FILES engine/install/copyright ${folder}/changelog.gz
      DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component})
  endif()
endfunction()

set(library_name libmwmesh${mw_soversion})
mw_package(program mwmesh "labelled voxels to tetrahedral meshes, topology kept"
  "This package has the program, its manual page and what shells complete.")
mw_package(library ${library_name} "labelled voxels to tetrahedral meshes - shared library"
  "This package has the library for C and C++.")
mw_package(development libmwmesh-dev "labelled voxels to tetrahedral meshes - development files"
  "This package has the headers, the static library, and what CMake and\npkg-config need.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS mwmesh-codt)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS mwmesh-codt)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library_name} (= ${PROJECT_VERSION})")
# What the static library is linked with.
string(JOIN ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS libblosc-dev libbz2-dev libcurl4-openssl-dev libdcmtk-dev libdraco-dev
  libhdf5-dev liblz4-dev liblzma-dev libpng-dev libpugixml-dev libssl-dev
  libtbb-dev libtiff-dev libzstd-dev zlib1g-dev pkgconf)
if(TARGET mwmesh-codt)
  mw_package(worker mwmesh-codt "labelled voxels to tetrahedral meshes - TetGen worker"
    "This package has the program that --optimizer tetgen starts. It is linked\nwith TetGen and so under the AGPL, version 3 or later.")
endif()
if(TARGET mwmesh-mpi)
  mw_package(mpi mwmesh-mpi "labelled voxels to tetrahedral meshes - several machines"
    "This package has the program mwmesh-mpi, which mpirun starts on each of them.")
  set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS openmpi-bin)
  set(CPACK_DEBIAN_MPI_PACKAGE_RECOMMENDS mwmesh)
  set(CPACK_DEBIAN_MPI_PACKAGE_SUGGESTS mwmesh-codt)
endif()
if(TARGET mwmesh_python)
  mw_package(python python3-mwmesh "labelled voxels to tetrahedral meshes - Python package"
    "This package has the Python module: numpy arrays in, numpy arrays out.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.9), python3-numpy, ${library_name} (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS
    "mwmesh-codt, python3-nibabel, python3-tqdm, python3-meshio")
endif()
include(CPack)
