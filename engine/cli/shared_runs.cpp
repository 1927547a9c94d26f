// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/cli/shared_runs.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

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

std::filesystem::path folder_of_rank(const std::filesystem::path& workdir, int rank) {
  char name[16];
  std::snprintf(name, sizeof name, "rank-%04d", rank);
  return workdir / name;
}

}  // namespace

engine::Team* shared_team() {
  return team_of_program;
}

void share_runs_with(engine::Team* team) {
  team_of_program = team;
}

void take_part(MeshRequest& request, const engine::Team& team) {
  if (request.resume) {
    throw Error(ErrorKind::kUsage,
                "--resume: a run of several processes cannot go on from what it left; start it "
                "again without --resume, or mesh with mwmesh");
  }
  const auto here = static_cast<std::uint64_t>(team.ranks_here());
  request.memory = *request.memory / here;
  request.threads = threads_of_rank(request.threads, team.ranks_here());
  request.workdir = folder_of_rank(request.workdir, team.rank());
  if (team.is_first()) return;
  request.certify = engine::Certify::kOff;
  request.progress = ProgressKind::kNone;
  request.report.clear();
  request.html.clear();
  request.trace.clear();
}

RankFolders::RankFolders(const MeshRequest& request, const engine::Team* team) {
  if (team == nullptr) return;
  folder_ = request.workdir.parent_path();
  std::filesystem::create_directories(folder_);
}

RankFolders::~RankFolders() {
  std::error_code others_are_at_work;
  if (!folder_.empty()) std::filesystem::remove(folder_, others_are_at_work);
}

}  // namespace mw::cli
