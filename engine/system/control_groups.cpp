// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The limits of a group hold for the groups below it, so the least one on the way counts.
#include "engine/system/control_groups.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <string>

namespace mw::engine {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

/// Visits the folders of the groups that a process is in, from the root on; `controller` is that of
/// version 1.
void each_group(const fs::path& root, std::istream& own_groups, const std::string& controller,
                const std::function<void(const fs::path& group)>& visit) {
  const fs::path version_1 = root / controller;
  visit(root);
  visit(version_1);
  for (std::string line; std::getline(own_groups, line);) {
    const std::size_t at = line.find(":/");
    if (at == line.npos) continue;
    const std::string controllers = line.substr(line.find(':'), at - line.find(':')) + ",";
    const bool is_version_2 = line.starts_with("0:");
    const bool is_of_it = controllers.find(":" + controller + ",") != line.npos ||
                          controllers.find("," + controller + ",") != line.npos;
    if (!is_version_2 && !is_of_it) continue;
    fs::path group = is_version_2 ? root : version_1;
    for (const fs::path& part : fs::path(line.substr(at + 2))) visit(group /= part);
  }
}

/// Returns the number in a file, or kNoLimit if there is no file or it says "max".
std::uint64_t limit_in(const fs::path& path) {
  std::uint64_t bytes = kNoLimit;
  return std::ifstream(path) >> bytes ? bytes : kNoLimit;
}

/// Returns the share of time, in cores, that one group sets, or infinity.
double cores_of(const fs::path& group) {
  double quota = 0, period = 0;
  const bool is_set = (std::ifstream(group / "cpu.max") >> quota >> period) ||
                      ((std::ifstream(group / "cpu.cfs_quota_us") >> quota) &&
                       (std::ifstream(group / "cpu.cfs_period_us") >> period));
  return is_set && quota > 0 && period > 0 ? quota / period
                                           : std::numeric_limits<double>::infinity();
}

}  // namespace

std::uint64_t cgroup_limit(const fs::path& root, std::istream& own_groups) {
  std::uint64_t min = kNoLimit;
  each_group(root, own_groups, "memory", [&](const fs::path& group) {
    min =
        std::min({min, limit_in(group / "memory.max"), limit_in(group / "memory.limit_in_bytes")});
  });
  return min;
}

std::optional<int> cgroup_cores(const fs::path& root, std::istream& own_groups) {
  double min = std::numeric_limits<double>::infinity();
  each_group(root, own_groups, "cpu",
             [&](const fs::path& group) { min = std::min(min, cores_of(group)); });
  if (!(min < std::numeric_limits<int>::max())) return std::nullopt;
  return std::max(1, static_cast<int>(std::ceil(min)));
}

}  // namespace mw::engine
