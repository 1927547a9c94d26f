# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Licence, notes on what is linked, and changes go into share/doc/mwmesh.
install(FILES engine/install/THIRD_PARTY.md engine/CHANGELOG.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
# Debian's packages have a file `copyright` instead.
if(NOT MW_PACKAGING)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
endif()
