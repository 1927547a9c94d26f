# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# `cmake --install`: the programs, their manual pages and what shells complete.  The texts are made by the
# program itself.
include(GNUInstallDirs)

# A text about a program, below share/ in the build tree and then where Debian has its kind.
function(mw_generated program component what place folder)
  set(file ${CMAKE_BINARY_DIR}/share/${place})
  get_filename_component(parent ${file} DIRECTORY)
  add_custom_command(OUTPUT ${file}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${parent}
    COMMAND $<TARGET_FILE:mwmesh> generate ${what} ${program} > ${file}
    DEPENDS mwmesh VERBATIM)
  add_custom_target(${program}_${what} ALL DEPENDS ${file})
  install(FILES ${file} DESTINATION ${folder} COMPONENT ${component})
endfunction()

function(mw_manual program component)
  mw_generated(${program} ${component} man man/man1/${program}.1 ${CMAKE_INSTALL_MANDIR}/man1)
  # Debian packs manual pages.
  if(MW_PACKAGING)
    install(CODE "execute_process(COMMAND gzip -9nf
        \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man1/${program}.1\"
      COMMAND_ERROR_IS_FATAL ANY)" COMPONENT ${component})
  endif()
endfunction()

function(mw_completions program component)
  set(data ${CMAKE_INSTALL_DATADIR})
  mw_generated(${program} ${component} bash bash-completion/completions/${program}
    ${data}/bash-completion/completions)
  # Where zsh looks: below /usr/local and elsewhere, and for Debian's packages.
  set(zsh_folder site-functions)
  if(MW_PACKAGING)
    set(zsh_folder vendor-completions)
  endif()
  mw_generated(${program} ${component} zsh zsh/site-functions/_${program}
    ${data}/zsh/${zsh_folder})
  mw_generated(${program} ${component} fish fish/vendor_completions.d/${program}.fish
    ${data}/fish/vendor_completions.d)
endfunction()

mw_manual(mwmesh program)
mw_completions(mwmesh program)
install(TARGETS mwmesh DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
if(TARGET mwmesh-mpi)
  install(TARGETS mwmesh-mpi DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi)
  mw_manual(mwmesh-mpi mpi)
  mw_completions(mwmesh-mpi mpi)
endif()
if(TARGET mwmesh-codt)
  install(TARGETS mwmesh-codt DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT worker)
  mw_manual(mwmesh-codt worker)
endif()
