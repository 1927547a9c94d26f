// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A run that is divided among several processes ("ranks").
#pragma once

#include "engine/run/processes.h"
#include "engine/team/team.h"

namespace mw::engine {

/// One rank's view.  Rank 0 speaks.
class TeamProcesses : public Processes {
 public:
  /// team outlives it.
  explicit TeamProcesses(Team& team) : team_(team) {}

  [[nodiscard]] int count() const override { return team_.ranks(); }
  [[nodiscard]] int count_here() const override { return team_.ranks_here(); }
  [[nodiscard]] bool speaks() const override { return team_.is_first(); }
  /// ERRORS: those of collect_together().
  [[nodiscard]] io::LabelTable collect_labels(FingerprintVolume& volume, int threads) override;
  /// No rank knows yet what it will visit, so this is what any of them takes.
  [[nodiscard]] std::uint64_t least_bytes(const RunLayout& layout, const io::DenseVolume& volume,
                                          const MeshSettings& settings) const override;
  [[nodiscard]] std::unique_ptr<RunPart> take_part(const RunLayout& layout, const RunHooks& hooks,
                                                   const std::string& identity) override;
  void fail(const std::exception_ptr& error) override { team_.fail(error); }

 private:
  Team& team_;
};

}  // namespace mw::engine
