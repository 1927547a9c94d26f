# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# `cmake --install`: the programs.
include(GNUInstallDirs)

install(TARGETS mwmesh DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
if(TARGET mwmesh-mpi)
  install(TARGETS mwmesh-mpi DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi)
endif()
if(TARGET mwmesh-codt)
  install(TARGETS mwmesh-codt DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT worker)
endif()
