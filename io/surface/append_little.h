// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers at the end of a file, least significant byte first.
#pragma once

#include "io/file/atomic_file.h"
#include "io/file/byte_order.h"

namespace mw::io {

template <class T>
void append_little(AtomicFile& file, T value) {
  std::array<std::byte, sizeof value> bytes;
  store_little(value, bytes.data());
  file.append(bytes);
}

}  // namespace mw::io
