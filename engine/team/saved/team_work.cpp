// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/saved/team_work.h"

#include <array>
#include <cstdio>
#include <sstream>

#include "engine/store/journal/folder_lock.h"
#include "engine/store/journal/identity.h"
#include "engine/store/journal/work_file.h"
#include "io/file/errors.h"
#include "io/file/sink/partial_file.h"

namespace mw::engine {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEpochsFile = "epochs";

std::string numbered(const char* name, std::uint64_t number) {
  char out[40];
  std::snprintf(out, sizeof out, "%s-%04llu", name, static_cast<unsigned long long>(number));
  return out;
}

bool is_generation(const fs::path& entry) {
  return entry.filename().string().starts_with("gen-");
}

constexpr std::array kTeamFiles{kEpochsFile, kSettingsFile, kLockFile};
constexpr FolderKind kTeamFolder{
    .files = kTeamFiles, .is_part = is_generation, .foreign = "is no work folder of mwmesh-mpi"};

}  // namespace

fs::path TeamWork::folder_of(std::uint64_t generation) const {
  return folder_ / numbered("gen", generation);
}

fs::path TeamWork::folder_of(std::uint64_t generation, std::uint64_t rank) const {
  return folder_of(generation) / numbered("rank", rank);
}

TeamWork::TeamWork(Team& team, const fs::path& folder, bool resume, const std::string& identity)
    : team_(team), folder_(folder) {
  std::error_code error;
  std::string counted;
  if (team.is_first()) {
    fs::create_directories(folder_.parent_path(), error);  // if it fails, the folder cannot be made
    shared_.emplace(folder_, kTeamFolder, resume);
    shared_->settle(identity);
    counted = shared_->text(kEpochsFile);
  }
  read_state(team.gather(counted).at(0));
  // A run that was killed before it counted an epoch may have left this folder.
  if (team.is_first()) fs::remove_all(folder_of(generation_));
  (void)team.gather(std::string());
  own_folder_ = folder_of(generation_, static_cast<std::uint64_t>(team.rank()));
  fs::create_directories(own_folder_.parent_path(), error);
  if (error) io::fail_output(folder_.string(), "create the work folder", error.value());
  own_.emplace(own_folder_, false, identity);
}

void TeamWork::read_state(const std::string& text) {
  if (text.empty()) return;
  State& before = before_.emplace();
  std::istringstream in(text);
  in >> before.generation >> before.ranks >> before.epochs;
  if (!in || before.ranks == 0 || before.epochs == 0) {
    throw DamagedWork(kEpochsFile, "it does not say which epochs count");
  }
  generation_ = before.generation + 1;
}

TeamWork::~TeamWork() {
  std::error_code others_are_there;
  own_.reset();
  fs::remove(folder_of(generation_), others_are_there);
  shared_.reset();
  fs::remove(folder_, others_are_there);
}

std::vector<fs::path> TeamWork::folders_before() const {
  std::vector<fs::path> out;
  for (std::uint64_t rank = 0; before_ && rank < before_->ranks; ++rank) {
    out.push_back(folder_of(before_->generation, rank));
  }
  return out;
}

void TeamWork::count(std::uint64_t epochs) {
  shared_->put_text(kEpochsFile, io::text(generation_, " ", team_.ranks(), " ", epochs, "\n"));
  shared_->stay();
  counted_ = epochs;
  if (!before_) return;
  std::error_code ignored;  // what stays of that generation does not count
  fs::remove_all(folder_of(before_->generation), ignored);
}

void TeamWork::discard() {
  own_->discard();
  if (!shared_) return;
  shared_->discard();
  std::error_code ignored;
  if (before_) fs::remove_all(folder_of(before_->generation), ignored);
}

}  // namespace mw::engine
