// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The work folder of a run of several processes.
#pragma once

#include <filesystem>
#include <optional>

#include "engine/store/journal/workdir.h"
#include "engine/team/team.h"

namespace mw::engine {

/// A folder that all ranks see, with
///     epochs                what counts: lines "name = value" of generation, ranks and epochs,
///                           then the identity of the run
///     gen-0002/rank-0007/   a Workdir of each rank
/// A run that goes on from another one is its next generation, with any number of ranks: it copies
/// what is needed, counts an epoch, and only then the generation before goes.
class TeamWork {
 public:
  /// REQUIRES: all ranks make one with the same arguments.
  /// ERRORS: mw::Error(kUsage) when Workdir has it; kInput when the file `epochs` is damaged.
  TeamWork(Team& team, const std::filesystem::path& folder, bool resume,
           const std::string& identity);
  /// Removes the folders of this generation if they are empty.
  ~TeamWork();
  TeamWork(const TeamWork&) = delete;
  TeamWork& operator=(const TeamWork&) = delete;

  [[nodiscard]] Workdir& own() { return *own_; }
  [[nodiscard]] const std::filesystem::path& own_folder() const { return own_folder_; }

  /// Returns the folders that the generation before left; empty if there is none.
  [[nodiscard]] std::vector<std::filesystem::path> folders_before() const;
  [[nodiscard]] std::uint64_t epochs_before() const { return before_ ? before_->epochs : 0; }

  /// Makes the first `epochs` epochs of this generation count.  To be called by rank 0 only.
  void count(std::uint64_t epochs);
  /// True if there is anything to go on from.
  [[nodiscard]] bool has_saved_work() const { return before_.has_value() || counted_ > 0; }
  /// To be called by all ranks, before the last of them ends, when the mesh is complete, so that no
  /// run will go on from this one.
  void discard();

 private:
  struct State {
    std::uint64_t generation = 0;
    std::uint64_t ranks = 0;
    std::uint64_t epochs = 0;
    std::string identity;
  };

  [[nodiscard]] std::optional<State> read_state(const std::string& text) const;
  [[nodiscard]] std::filesystem::path folder_of(std::uint64_t generation) const;
  [[nodiscard]] std::filesystem::path folder_of(std::uint64_t generation, std::uint64_t rank) const;

  Team& team_;
  std::filesystem::path folder_;
  std::string identity_;
  std::optional<State> before_;
  std::uint64_t generation_ = 1;
  std::uint64_t counted_ = 0;
  std::filesystem::path own_folder_;
  std::optional<Workdir> own_;
};

}  // namespace mw::engine
