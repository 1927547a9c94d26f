// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The work folder of a run of several processes.
#pragma once

#include <filesystem>
#include <optional>

#include "engine/store/journal/run_folder.h"
#include "engine/team/team.h"

namespace mw::engine {

/// A RunFolder of the first rank that all ranks see, with
///     epochs                saved work, which is what counts: generation, ranks and epochs
///     gen-0002/rank-0007/   a Workdir of each rank
/// A run that goes on from another one is its next generation, and may have any number of ranks.
/// It copies the blocks that it needs, counts an epoch, and only then removes the one before.
class TeamWork {
 public:
  /// REQUIRES: all ranks make one with the same arguments; one that fails tells the others
  /// (Team::fail()).
  /// ERRORS: mw::Error(kUsage) in the cases of Workdir; kInput when the file `epochs` is damaged.
  TeamWork(Team& team, const std::filesystem::path& folder, bool resume,
           const std::string& identity);
  /// Removes this rank's Workdir unless it is kept, and the folders above if they are empty.
  ~TeamWork();
  TeamWork(const TeamWork&) = delete;
  TeamWork& operator=(const TeamWork&) = delete;

  [[nodiscard]] Workdir& own() { return *own_; }
  [[nodiscard]] const std::filesystem::path& own_folder() const { return own_folder_; }

  /// Returns the folders that the generation before left; empty if there is none.
  [[nodiscard]] std::vector<std::filesystem::path> folders_before() const;
  [[nodiscard]] std::uint64_t epochs_before() const { return before_ ? before_->epochs : 0; }

  /// Makes the first `epochs` epochs of this generation count.  Only rank 0 may call it.
  void count(std::uint64_t epochs);
  /// True if there is anything to go on from.
  [[nodiscard]] bool has_saved_work() const { return before_.has_value() || counted_ > 0; }
  /// Gives the saved work up when the mesh is complete.  All ranks must call it before the last of
  /// them ends.
  void discard();

 private:
  struct State {
    std::uint64_t generation = 0;
    std::uint64_t ranks = 0;
    std::uint64_t epochs = 0;
  };

  void read_state(const std::string& text);
  [[nodiscard]] std::filesystem::path folder_of(std::uint64_t generation) const;
  [[nodiscard]] std::filesystem::path folder_of(std::uint64_t generation, std::uint64_t rank) const;

  Team& team_;
  std::filesystem::path folder_;
  std::optional<RunFolder> shared_;  ///< on the first rank
  std::optional<State> before_;
  std::uint64_t generation_ = 1;
  std::uint64_t counted_ = 0;
  std::filesystem::path own_folder_;
  std::optional<Workdir> own_;
};

}  // namespace mw::engine
