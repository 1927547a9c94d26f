// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/saved/team_work.h"

#include <charconv>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "engine/store/journal/folder_lock.h"
#include "engine/store/journal/work_file.h"
#include "io/file/errors.h"
#include "io/file/sink/atomic_file.h"
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

/// Returns the file's text, or nothing if this rank sees no such file.
std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Takes "name = 12\n" from the front of the text.
bool take_number(std::string_view& text, std::string_view name, std::uint64_t& out) {
  constexpr std::string_view kIs = " = ";
  if (!text.starts_with(name)) return false;
  text.remove_prefix(name.size());
  if (!text.starts_with(kIs)) return false;
  text.remove_prefix(kIs.size());
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc{} || end == text.data() + text.size() || *end != '\n') return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
  return true;
}

bool is_ours(const std::string& name) {
  return name == kLockFile || name == kEpochsFile || name.starts_with("gen-") ||
         name.starts_with(io::text(".", kEpochsFile, ".partial-"));
}

/// Returns the name of a file that no run has made, or nothing.
std::string file_of_others(const fs::path& folder) {
  const bool may_be_ours = is_of_runs(folder);
  std::error_code error;
  const fs::directory_iterator entries(folder, error);
  if (error) io::fail_output(folder.string(), "read the work folder", error.value());
  for (const auto& entry : entries) {
    std::string name = entry.path().filename().string();
    if (!may_be_ours || !is_ours(name)) return name;
  }
  return {};
}

[[noreturn]] void refuse(const fs::path& folder, const std::string& why) {
  io::fail_usage(folder.string() + ": " + why);
}

/// Makes the folder, and those above it, unless it is there.
void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error == std::errc::not_a_directory || error == std::errc::file_exists) {
    refuse(folder, "is not a folder, or lies in what is none; give another --workdir");
  }
  if (error) io::fail_output(folder.string(), "create the work folder", error.value());
}

}  // namespace

fs::path TeamWork::folder_of(std::uint64_t generation) const {
  return folder_ / numbered("gen", generation);
}

fs::path TeamWork::folder_of(std::uint64_t generation, std::uint64_t rank) const {
  return folder_of(generation) / numbered("rank", rank);
}

std::optional<TeamWork::State> TeamWork::read_state(const std::string& text) const {
  if (text.empty()) return std::nullopt;
  State out;
  std::string_view rest = text;
  if (!take_number(rest, "generation", out.generation) || !take_number(rest, "ranks", out.ranks) ||
      !take_number(rest, "epochs", out.epochs) || out.ranks == 0 || out.epochs == 0) {
    throw DamagedWork(kEpochsFile, "it does not say which epochs count");
  }
  out.identity = rest;
  return out;
}

TeamWork::TeamWork(Team& team, const fs::path& folder, bool resume, const std::string& identity)
    : team_(team), folder_(folder), identity_(identity) {
  make_folder(folder_);
  // All ranks throw what the first one finds.
  const std::string foreign = team.gather(team.is_first() ? file_of_others(folder_) : "").at(0);
  if (!foreign.empty()) {
    refuse(folder_,
           "is no work folder of mwmesh-mpi: it holds " + foreign + "; give an empty or a new one");
  }
  lock_for_all();
  const std::string seen = team.is_first() ? text_of(folder_ / kEpochsFile) : std::string();
  before_ = read_state(team.gather(seen).at(0));
  if (before_ && !resume) {
    refuse(folder_,
           "holds the saved work of a run that did not end; add --resume to go on with it, or "
           "delete the folder to start again; --force replaces outputs, not this work");
  }
  if (before_ && before_->identity != identity) {
    refuse(folder_, "cannot go on, its work is that of another run: " +
                        differences(before_->identity, identity) +
                        "; give the same input and settings, or delete the folder to start again");
  }
  if (before_) generation_ = before_->generation + 1;
  // A run that was killed before it counted an epoch may have left this folder.
  if (team.is_first()) fs::remove_all(folder_of(generation_));
  (void)team.gather(std::string());
  own_folder_ = folder_of(generation_, static_cast<std::uint64_t>(team.rank()));
  make_folder(own_folder_.parent_path());
  own_.emplace(own_folder_, false, identity);
}

/// The first rank holds the lock of the folder.
void TeamWork::lock_for_all() {
  std::optional<io::FileDescriptor> locked;
  if (team_.is_first()) locked = lock_folder(folder_);
  const bool is_held = locked && locked->valid();
  if (team_.gather(is_held ? "held" : "").at(0).empty()) {
    refuse(folder_, "another mwmesh is at work here; wait for it or give another --workdir");
  }
  if (is_held) lock_ = std::move(*locked);
}

TeamWork::~TeamWork() {
  std::error_code others_are_there;
  own_.reset();
  fs::remove(folder_of(generation_), others_are_there);
  if (lock_.valid() && !fs::exists(folder_ / kEpochsFile, others_are_there)) {
    // Without the lock a file that a power cut brings back would look like somebody else's.
    io::sync_folder(folder_);
    fs::remove(folder_ / kLockFile, others_are_there);
  }
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
  io::AtomicFile file(folder_ / kEpochsFile);
  file.append(io::text("generation = ", generation_, "\nranks = ", team_.ranks(),
                       "\nepochs = ", epochs, "\n", identity_));
  file.commit();
  counted_ = epochs;
  if (!before_) return;
  std::error_code ignored;  // what stays of that generation does not count
  fs::remove_all(folder_of(before_->generation), ignored);
}

void TeamWork::discard() {
  own_->discard();
  if (!team_.is_first()) return;
  std::error_code ignored;
  fs::remove(folder_ / kEpochsFile, ignored);
  // If a power cut brought it back without the folders that it counts, they would look damaged.
  io::sync_folder(folder_);
  if (before_) fs::remove_all(folder_of(before_->generation), ignored);
}

}  // namespace mw::engine
