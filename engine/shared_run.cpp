// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/shared_run.h"

#include "engine/team_output.h"

namespace mw::engine {

SharedRun::SharedRun(Team& team, const RunLayout& layout, RunHooks& hooks,
                     const std::string& identity)
    : team_(team),
      layout_(layout),
      every_(hooks.store.group.age),
      stop_(hooks.stop_after_epoch),
      together_(hooks.together),
      traffic_(layout, team) {
  agree(team, identity);
  StoreOptions& store = hooks.store;
  if (store.workdir.empty()) return;
  work_.emplace(team, store.workdir, store.resume, identity);
  store.workdir = work_->own_folder();
}

void SharedRun::begin(RunStore& store, Partition partition) {
  if (join_output(team_, together_)) {
    traffic_.deal(std::move(partition), FinalBlocksGo::kToOwners);
    const std::uint32_t last = layout_.marches() - 1;
    own_lines_.emplace(layout_.grid(last).blocks(), traffic_.line_owners(),
                       static_cast<std::uint32_t>(team_.rank()));
  } else {
    traffic_.deal(std::move(partition), FinalBlocksGo::kToFirst);
  }
  if (!work_) return;
  epochs_.emplace(team_, traffic_, store,
                  Epochs::Options{.every = every_,
                                  .count = [this](std::uint64_t epochs) { work_->count(epochs); },
                                  .stop = stop_});
  const auto folders = work_->folders_before();
  if (!folders.empty()) {
    store.take_up(SavedRun(layout_, folders, work_->epochs_before()),
                  [this](const WindowKey& key) { return traffic_.is_mine(key); });
    epochs_->save_now();
  }
  epochs_->start();
}

void SharedRun::end_marches() {
  if (epochs_) epochs_->end();
}

std::exception_ptr SharedRun::fail(const std::exception_ptr& error) {
  team_.fail(error);
  epochs_.reset();
  const std::exception_ptr first = traffic_.arrivals().error();
  return first ? first : error;
}

std::vector<RankFacts> SharedRun::end(RankFacts mine) {
  epochs_.reset();
  if (work_) work_->discard();
  mine.sent = traffic_.facts();
  return facts_of_all(team_, mine);
}

}  // namespace mw::engine
