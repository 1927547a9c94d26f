// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Output files that belong together and get their names together.
#include "io/file/commit_together.h"

#include <span>

#include "kernels/core/error.h"

namespace mw::io {
namespace {

using Files = std::span<const std::reference_wrapper<AtomicFile>>;

/// Down to the first, which is replaced in one step when it stands alone.
void remove_old(Files files) {
  for (std::size_t i = files.size(); i-- > 1;) files[i].get().remove_named();
}

/// After an error: what cannot be removed either stays, the error is told already.
void take_back(Files files) {
  try {
    for (std::size_t i = files.size(); i-- > 0;) files[i].get().remove_named();
  } catch (const Error&) {
    return;
  }
}

}  // namespace

void commit_together(std::initializer_list<std::reference_wrapper<AtomicFile>> list) {
  const Files files(list.begin(), list.size());
  for (AtomicFile& file : files) file.sync();
  remove_old(files);
  std::size_t named = 0;
  try {
    for (; named < files.size(); ++named) files[named].get().give_name();
  } catch (const Error&) {
    take_back(files.first(named));
    throw;
  }
}

}  // namespace mw::io
