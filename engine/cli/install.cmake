# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# `cmake --install`: the programs, their manual page and what shells complete.  The texts are made by the
# program itself.
include(GNUInstallDirs)

function(mw_generated what folder name)
  set(file ${CMAKE_BINARY_DIR}/share/${folder}/${name})
  add_custom_command(OUTPUT ${file}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/share/${folder}
    COMMAND $<TARGET_FILE:mwmesh> generate ${what} > ${file}
    DEPENDS mwmesh VERBATIM)
  add_custom_target(mwmesh_${what} ALL DEPENDS ${file})
  install(FILES ${file} DESTINATION ${ARGV3} COMPONENT program)
endfunction()

mw_generated(man man/man1 mwmesh.1 ${CMAKE_INSTALL_MANDIR}/man1)
mw_generated(bash bash-completion/completions mwmesh
  ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
mw_generated(zsh zsh/site-functions _mwmesh ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
mw_generated(fish fish/vendor_completions.d mwmesh.fish
  ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(TARGETS mwmesh DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
if(TARGET mwmesh-mpi)
  install(TARGETS mwmesh-mpi DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi)
endif()
if(TARGET mwmesh-codt)
  install(TARGETS mwmesh-codt DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT worker)
endif()
