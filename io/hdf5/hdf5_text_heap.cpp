// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Collections of strings, each small enough for two-byte indices.
#include "io/hdf5/hdf5_text_heap.h"

#include <algorithm>
#include <cstdint>

#include "io/hdf5/little_bytes.h"

namespace mw::io {
namespace {

constexpr std::size_t kMaxObjects = 1000;
constexpr std::size_t kHeadBytes = 16;        ///< of a collection, and of an object in it
constexpr std::size_t kMinCollection = 4096;  ///< what the library reads at once

std::size_t padded(std::size_t bytes) {
  return (bytes + 7) / 8 * 8;
}

/// One collection; object 0, the last, is what is free.
LittleBytes collection_of(std::span<const std::string> strings) {
  LittleBytes objects;
  for (std::size_t i = 0; i < strings.size(); ++i) {
    objects.number(i + 1, 2).number(1, 2).number(0, 4).number(strings[i].size(), 8);
    objects.text(strings[i]).pad_to(padded(objects.size()));
  }
  const std::size_t size = std::max(kMinCollection, 2 * kHeadBytes + objects.size());
  LittleBytes out;
  out.text("GCOL").number(1, 4).number(size, 8).text(objects.bytes());
  out.number(0, 8).number(size - kHeadBytes - objects.size(), 8).pad_to(size);
  return out;
}

}  // namespace

Hdf5Texts hdf5_texts(std::span<const std::string> strings, std::uint64_t address) {
  Hdf5Texts out;
  LittleBytes positions;
  for (; !strings.empty(); strings = strings.subspan(std::min(kMaxObjects, strings.size()))) {
    const auto some = strings.first(std::min(kMaxObjects, strings.size()));
    for (std::size_t i = 0; i < some.size(); ++i) {
      const bool empty = some[i].empty();  // which is nowhere
      positions.number(some[i].size(), 4).number(empty ? 0 : address + out.heap.size(), 8);
      positions.number(empty ? 0 : i + 1, 4);
    }
    out.heap += collection_of(some).bytes();
  }
  out.positions = positions.bytes();
  return out;
}

}  // namespace mw::io
