// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An HDF5 file that is written, whole or not at all.
#include "io/mesh/vtkhdf/hdf5_output.h"

#include "io/hdf5/hdf5_tree.h"

namespace mw::io {

void Hdf5Output::write_at(std::uint64_t address, std::span<const std::byte> bytes) {
  file_.write_at(address, bytes);
}

Hdf5DataSet Hdf5Output::add(Hdf5DataSet set, std::span<const std::byte> bytes) {
  set.address = reserve(bytes.size());
  write_at(set.address, bytes);
  return set;
}

Hdf5DataSet Hdf5Output::add_texts(const std::string& name, std::span<const std::string> texts) {
  const Hdf5Texts all = hdf5_texts(texts, rooms_.next());
  write_at(reserve(all.heap.size()), std::as_bytes(std::span(all.heap)));
  return add({.name = name, .kind = Hdf5Kind::kText, .shape = {texts.size()}},
             std::as_bytes(std::span(all.positions)));
}

AtomicFile& Hdf5Output::finish(const Hdf5Group& root) {
  const Hdf5Metadata metadata = hdf5_metadata(root, rooms_.next());
  write_at(rooms_.next(), std::as_bytes(std::span(metadata.tail)));
  write_at(0, std::as_bytes(std::span(metadata.head)));
  return file_;
}

}  // namespace mw::io
