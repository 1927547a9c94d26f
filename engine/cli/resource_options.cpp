// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options about the machine.
#include "engine/cli/resource_options.h"

#include <algorithm>

#include "engine/cli/values.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

constexpr int kMaxThreads = 1024;

int parse_threads(const std::string& text) {
  const std::int64_t threads = parse_integer(text);
  if (threads >= 0 && threads <= kMaxThreads) return static_cast<int>(threads);
  throw Error(ErrorKind::kUsage,
              "must be from 1 to " + std::to_string(kMaxThreads) + ", or 0 for all cores");
}

}  // namespace

void add_resource_options(OptionSet& options, int& threads, std::optional<std::uint64_t>& memory,
                          const std::string& budget) {
  options.add({.name = "threads",
               .value = "N",
               .help = "worker threads; 0: all cores",
               .kind = ValueKind::kInteger,
               .fallback = "0",
               .assign = [&](const std::string& text) { threads = parse_threads(text); }});
  options.add(
      {.name = "memory",
       .value = "SIZE",
       .help = budget +
               ", e.g. 512M, 1.5G or 4GiB; K M G T, also with iB, are powers of 1024, KB MB "
               "GB TB of 1000, in any case [half of the memory that is available]",
       .kind = ValueKind::kSize,
       .assign = [&](const std::string& text) {
         if (!text.empty()) memory = parse_size(text);
       }});
}

std::uint64_t cache_bytes(std::uint64_t memory) {
  constexpr std::uint64_t kMax = 1ULL << 30U;
  return std::min(memory / 4, kMax);
}

}  // namespace mw::cli
