// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Output files that belong together and get their names together.
#pragma once

#include <functional>
#include <initializer_list>

#include "io/file/atomic_file.h"

namespace mw::io {

/// Commits all, in an order in which each may need those before it: what is opened by its name
/// comes last.  All are whole on the disk before the first name changes; then the old files go,
/// from the last to the second, and the new ones get their names from the first to the last.
/// ENSURES: at any instant, also after a kill or a power cut, the names hold the first few files of
/// the old set or the first few of the new one, and never some of both.
/// ERRORS: those of AtomicFile; before the first name changes the old files stay, afterwards none
/// of the new ones is left.
void commit_together(std::initializer_list<std::reference_wrapper<AtomicFile>> files);

}  // namespace mw::io
