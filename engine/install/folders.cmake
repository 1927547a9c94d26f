# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Which folders an installed mwmesh has, below the prefix.
include(GNUInstallDirs)

# Where python3 looks below the prefix by itself (Debian: dist-packages of /usr and /usr/local), else
# where it would if it were installed there.
set(mw_python_place [[
import site, sys, sysconfig
prefix = sys.argv[1].rstrip("/")
known = [p[len(prefix) + 1:] for p in site.getsitepackages() if p.startswith(prefix + "/")]
known = [p for p in known if p.startswith("lib")]
bases = {"base": ""}
print(known[0] if known else sysconfig.get_path("purelib", "posix_prefix", bases).lstrip("/"))
]])
set(MW_PYTHON_DIR "" CACHE STRING
  "Folder below the prefix that gets the Python package (empty: where python3 looks)")
set(mw_python_folder "${MW_PYTHON_DIR}")
if(MW_BUILD_PYTHON)
  # That of Debian's packages, unless another one is asked for.
  if(NOT Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python3_EXECUTABLE /usr/bin/python3)
  endif()
  find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)
endif()
if(MW_BUILD_PYTHON AND NOT mw_python_folder)
  execute_process(COMMAND ${Python3_EXECUTABLE} -c "${mw_python_place}" "${CMAKE_INSTALL_PREFIX}"
    OUTPUT_VARIABLE mw_python_folder OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
endif()

# For engine/codt/find_worker.cpp and its test.
set(mw_folder_definitions
  MW_INSTALL_PREFIX="${CMAKE_INSTALL_PREFIX}"
  MW_INSTALLED_PROGRAMS="${CMAKE_INSTALL_BINDIR}"
  MW_INSTALLED_LIBRARY="${CMAKE_INSTALL_LIBDIR}")
