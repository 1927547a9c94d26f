// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Memory that the engine and one worker both have mapped.
#pragma once

#include <boost/interprocess/mapped_region.hpp>
#include <cstddef>
#include <span>
#include <string>

namespace mw::engine::codt {

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
