// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What control groups of Linux, version 1 or 2, leave to a process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>

namespace mw::engine {

// `own_groups` is like /proc/self/cgroup, `root` like /sys/fs/cgroup.

/// Returns the least limit of memory, in bytes, of the groups that a process is in; the largest
/// number if there is none.
[[nodiscard]] std::uint64_t cgroup_limit(const std::filesystem::path& root,
                                         std::istream& own_groups);

/// Returns the least number of cores, rounded up, whose time the groups that a process is in let it
/// have; nothing if they do not say.
[[nodiscard]] std::optional<int> cgroup_cores(const std::filesystem::path& root,
                                              std::istream& own_groups);

}  // namespace mw::engine
