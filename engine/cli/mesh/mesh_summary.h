// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run of `mwmesh mesh` says at its end.
#pragma once

#include <map>

#include "engine/cli/requests.h"
#include "engine/report/run_report.h"
#include "io/mesh/mesh_sink.h"

namespace mw::cli {

/// Counts the tets of each label that pass by.
class LabelTets : public io::NoSink {
 public:
  void write_tets(std::span<const io::TetRows> tets, std::span<const RawLabel> labels) override;

  /// Empty where the mesh was written by several processes.
  [[nodiscard]] const std::map<RawLabel, std::uint64_t>& counts() const { return counts_; }

 private:
  std::map<RawLabel, std::uint64_t> counts_;
};

/// Prints figures for people, a line each, on stdout.
void print_summary(const report::FinishedRun& run, const MeshRequest& request,
                   const LabelTets& tets);

}  // namespace mw::cli
