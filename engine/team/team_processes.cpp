// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/team_processes.h"

#include "engine/run/label_readers.h"
#include "engine/team/shared_scan.h"
#include "engine/team/team_part.h"

namespace mw::engine {

io::LabelTable TeamProcesses::collect_labels(FingerprintVolume& volume, int threads) {
  return collect_together(team_, volume, threads);
}

std::uint64_t TeamProcesses::least_bytes(const RunLayout& layout, const io::DenseVolume& volume,
                                         const MeshSettings& settings) const {
  const LabelNeed nothing;
  return least_index_bytes(layout) + prepared_bytes(volume, settings, &nothing);
}

std::unique_ptr<RunPart> TeamProcesses::take_part(const RunLayout& layout, const RunHooks& hooks,
                                                  const std::string& identity) {
  return std::make_unique<TeamPart>(team_, layout, hooks, identity);
}

}  // namespace mw::engine
