// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The protocol of the engine and a worker process: orders and replies go over a socket, bulk data
// goes as bytes through shared memory.
#pragma once

#include <boost/interprocess/mapped_region.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "kernels/odt/triangulation.h"

namespace mw::engine::codt {

/// Descriptor of the worker's end of the socket.  It is a SOCK_SEQPACKET; a message is one struct.
inline constexpr int kControlDescriptor = 3;

enum class OrderKind : std::uint32_t {
  kMap = 1,    ///< map the named shared memory in place of what was mapped before
  kRun = 2,    ///< triangulate the request in the memory; the reply has the answer's size
  kFetch = 3,  ///< put the answer into the memory
};

struct Order {
  OrderKind kind = OrderKind::kMap;
  std::array<char, 60> name{};  ///< name of the memory to map, ending in 0
};

enum class ReplyKind : std::uint32_t {
  kDone = 1,
  kNoTriangulation = 2,  ///< the request cannot be triangulated
};

struct Reply {
  ReplyKind kind = ReplyKind::kDone;
  std::uint32_t unused = 0;
  std::uint64_t bytes = 0;
};

// Bulk data has counts (u64), then arrays in the order of the struct's members, all native bytes.

[[nodiscard]] std::size_t bytes_of(const Plc& plc);
[[nodiscard]] std::size_t bytes_of(const Triangulation& made);
/// REQUIRES: room for bytes_of().
void put(const Plc& plc, std::span<std::byte> to);
void put(const Triangulation& made, std::span<std::byte> to);
/// Return nothing when the counts do not fit the bytes.
[[nodiscard]] std::optional<Plc> get_plc(std::span<const std::byte> from);
[[nodiscard]] std::optional<Triangulation> get_triangulation(std::span<const std::byte> from);

/// Mapped shared memory.  It outlives its name, which is needed only until the other side has
/// opened it.
class SharedMemory {
 public:
  SharedMemory() = default;

  /// Makes memory under a new name, with all pages reserved (a hole would raise SIGBUS later).
  /// ERRORS: kResource.
  [[nodiscard]] static SharedMemory create(std::size_t bytes);
  /// Maps the memory of that name.  ERRORS: kInternal when it is not there.
  [[nodiscard]] static SharedMemory open(const std::string& name);

  [[nodiscard]] const std::string& name() const { return name_; }
  void remove_name() const;
  [[nodiscard]] std::span<std::byte> bytes() const {
    return {static_cast<std::byte*>(region_.get_address()), region_.get_size()};
  }

 private:
  std::string name_;
  boost::interprocess::mapped_region region_;
};

}  // namespace mw::engine::codt
