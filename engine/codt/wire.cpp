// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Turns arrays into bytes and back; counts that are read are not trusted.
#include "engine/codt/wire.h"

#include <fcntl.h>
#include <unistd.h>
#include <boost/interprocess/shared_memory_object.hpp>

#include <algorithm>
#include <cstring>

namespace mw::engine::codt {
namespace {

constexpr std::size_t kCounts = 3;  // the number of arrays of a Plc, and of a Triangulation
using Counts = std::array<std::uint64_t, kCounts>;

template <typename Item>
std::size_t array_bytes(const std::vector<Item>& items) {
  return items.size() * sizeof(Item);
}

/// Puts items at the beginning of `to`, which then is what is left behind them.
template <typename Items>
void put_items(const Items& items, std::span<std::byte>& to) {
  const auto bytes = std::as_bytes(std::span(items));
  std::copy(bytes.begin(), bytes.end(), to.begin());
  to = to.subspan(bytes.size());
}

class Reader {
 public:
  explicit Reader(std::span<const std::byte> from) : from_(from) {}

  /// Returns false when fewer items are there.
  template <typename Item>
  bool items(Item* first, std::size_t count) {
    if (count > from_.size() / sizeof(Item)) return false;
    if (count != 0) std::memcpy(first, from_.data(), count * sizeof(Item));
    from_ = from_.subspan(count * sizeof(Item));
    return true;
  }
  template <typename Item>
  bool array(std::vector<Item>& out, std::uint64_t count) {
    if (count > from_.size() / sizeof(Item)) return false;
    out.resize(static_cast<std::size_t>(count));
    return items(out.data(), out.size());
  }

 private:
  std::span<const std::byte> from_;
};

}  // namespace

std::size_t bytes_of(const Plc& plc) {
  return sizeof(Counts) + array_bytes(plc.points) + array_bytes(plc.facets) +
         array_bytes(plc.seeds);
}

std::size_t bytes_of(const Triangulation& made) {
  return sizeof(Counts) + array_bytes(made.added) + array_bytes(made.tets) +
         array_bytes(made.regions);
}

void put(const Plc& plc, std::span<std::byte> to) {
  const Counts counts{plc.points.size(), plc.facets.size(), plc.seeds.size()};
  put_items(counts, to);
  put_items(plc.points, to);
  put_items(plc.facets, to);
  put_items(plc.seeds, to);
}

void put(const Triangulation& made, std::span<std::byte> to) {
  const Counts counts{made.added.size(), made.tets.size(), made.regions.size()};
  put_items(counts, to);
  put_items(made.added, to);
  put_items(made.tets, to);
  put_items(made.regions, to);
}

std::optional<Plc> get_plc(std::span<const std::byte> from) {
  Reader reader(from);
  Counts counts{};
  Plc plc;
  const bool whole = reader.items(counts.data(), counts.size()) &&
                     reader.array(plc.points, counts[0]) && reader.array(plc.facets, counts[1]) &&
                     reader.array(plc.seeds, counts[2]);
  return whole ? std::optional(std::move(plc)) : std::nullopt;
}

std::optional<Triangulation> get_triangulation(std::span<const std::byte> from) {
  Reader reader(from);
  Counts counts{};
  Triangulation made;
  const bool whole = reader.items(counts.data(), counts.size()) &&
                     reader.array(made.added, counts[0]) && reader.array(made.tets, counts[1]) &&
                     reader.array(made.regions, counts[2]);
  return whole ? std::optional(std::move(made)) : std::nullopt;
}

}  // namespace mw::engine::codt
