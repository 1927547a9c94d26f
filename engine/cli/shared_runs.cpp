// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/cli/shared_runs.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>

#include "engine/march/march.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

engine::Team* team_of_program = nullptr;

/// Cores of the machine; those that this process may use can be fewer.
int cores_of_machine() {
  return static_cast<int>(std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN)));
}

int threads_of_rank(int asked, int ranks_here) {
  if (asked > 0) return std::max(1, asked / ranks_here);
  const int own = engine::thread_count(0), machine = cores_of_machine();
  const int share = std::max(1, machine / ranks_here);
  if (own == machine) return share;
  if (own < share) {
    spdlog::warn(
        "this process may use {} of {} cores, and its share of them is {}: let mpirun bind "
        "less tightly (--bind-to none, or --map-by ppr:{}:node:PE={})",
        own, machine, share, ranks_here, share);
  }
  return own;
}

}  // namespace

engine::Team* shared_team() {
  return team_of_program;
}

void share_runs_with(engine::Team* team) {
  team_of_program = team;
}

void take_part(MeshRequest& request, const engine::Team& team) {
  const auto here = static_cast<std::uint64_t>(team.ranks_here());
  request.memory = *request.memory / here;
  request.threads = threads_of_rank(request.threads, team.ranks_here());
  if (team.is_first()) return;
  request.certify = engine::Certify::kOff;
  request.progress = ProgressKind::kNone;
  request.report.clear();
  request.html.clear();
  request.trace.clear();
}

}  // namespace mw::cli
