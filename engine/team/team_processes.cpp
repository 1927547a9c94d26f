// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/team_processes.h"

#include "engine/run/run_context.h"
#include "engine/team/saved/saved_run.h"
#include "engine/team/team_run.h"
#include "io/file/errors.h"

namespace mw::engine {

TeamPart::TeamPart(Team& team, const RunLayout& layout, const RunHooks& hooks,
                   const std::string& identity)
    : team_(team), layout_(layout), hooks_(hooks), traffic_(layout, team) {
  agree(team, identity);
  if (hooks.store.workdir.empty()) return;
  work_.emplace(team, hooks.store.workdir, hooks.store.resume, identity);
}

std::filesystem::path TeamPart::work_folder() const {
  return work_ ? work_->own_folder() : std::filesystem::path();
}

std::unique_ptr<WindowKeep> TeamPart::open_keep(const OpenKeep& open) {
  std::unique_ptr<WindowKeep> keep;
  if (team_.is_first()) keep = open(team_.rank());
  if (keep != nullptr && keep->has_facts()) {
    io::fail_usage(keep->folder().string() +
                   ": holds what an earlier run has kept, which one process alone goes on from; "
                   "run mwmesh without mpirun, or delete the folder");
  }
  wait_for_all(team_);
  if (!team_.is_first()) keep = open(team_.rank());
  return keep;
}

void TeamPart::finish_keep(WindowKeep& keep) {
  if (!team_.is_first()) keep.finish();
  wait_for_all(team_);
  if (!team_.is_first()) return;
  keep.take_over_parts();
  keep.finish();
}

std::shared_ptr<void> TeamPart::attach(RunStore& store) {
  return std::make_shared<BlockTraffic::Attached>(traffic_, store);
}

LabelPlan TeamPart::plan_labels(const io::DenseVolume& volume, const MeshSettings& settings,
                                const RunHooks& hooks, RunStore& store) {
  const LabelNeed nothing;
  const auto room = store.reserve(Purpose::kLabels, prepared_bytes(volume, settings, &nothing));
  const LabelReaders readers(volume, settings, hooks, store);
  LabelPlan plan{.counts = count_together(team_, volume, readers.threads)};
  partition_ = deal_windows(team_, layout_, settings, plan.counts->faces);
  // A cell that repeats itself is prepared as a whole, with its copies around it.
  if (settings.periodic == 0) {
    plan.need = labels_needed(layout_, partition_, team_.rank(), settings);
  }
  return plan;
}

void TeamPart::begin_marches(RunStore& store) {
  traffic_.deal(std::move(partition_));
  wait_for_all(team_);  // all have reserved the room of their labels
  if (!work_) return;
  epochs_.emplace(team_, traffic_, store,
                  Epochs::Options{.every = hooks_.store.group.age,
                                  .count = [this](std::uint64_t epochs) { work_->count(epochs); },
                                  .stop = hooks_.stop_after_save});
  take_up(store);
  epochs_->start();
}

/// Notes which windows are done, and copies the blocks whose next user is this rank.
void TeamPart::take_up(RunStore& store) {
  const auto folders = work_->folders_before();
  if (folders.empty()) return;
  const SavedRun saved(layout_, folders, work_->epochs_before());
  for (std::uint32_t march = 0; march < layout_.marches(); ++march) {
    for_each_index(layout_.grid(march).windows(), [&](Index3 w) {
      const WindowKey key{march, w};
      if (saved.done().contains(layout_.window(key))) store.note_done(key, visits(key));
    });
  }
  saved.for_each_block([&](const SavedBlock& block) {
    if (!traffic_.stays(block.version)) return;
    store.receive(block.version, saved.read(block), block.place.memory_bytes);
    traffic_.committed({&block.version, 1});
  });
  epochs_->save_now();
}

std::optional<PartialMarch> TeamPart::part_of_march(std::uint32_t march) {
  return PartialMarch{.march = march,
                      .is_mine =
                          [this, march](Index3 w) {
                            return traffic_.is_mine({march, w});
                          },
                      .inputs =
                          [this, march](Index3 w) {
                            return traffic_.inputs({march, w});
                          },
                      .arrivals = &traffic_.arrivals()};
}

VisitStats TeamPart::end_marches(const VisitStats& own) {
  const VisitStats sum = sum_of_all(team_, own);
  if (epochs_) epochs_->end();
  return sum;
}

bool TeamPart::await_output() {
  if (!team_.is_first()) return false;
  traffic_.wait_for_output();
  return true;
}

std::vector<ProcessFacts> TeamPart::end(const ProcessFacts& own) {
  epochs_.reset();
  if (work_) work_->discard();
  ProcessFacts mine = own;
  mine.blocks_sent = traffic_.facts().blocks;
  mine.bytes_sent = traffic_.facts().bytes;
  return facts_of_all(team_, mine);
}

std::exception_ptr TeamPart::fail(const std::exception_ptr& error) {
  team_.fail(error);
  epochs_.reset();
  const std::exception_ptr first = traffic_.arrivals().error();
  return first ? first : error;
}

bool TeamPart::keep_work(const RunStore& store) {
  if (!work_) return false;
  if (store.has_saved_work()) work_->own().stay();
  return work_->has_saved_work();
}

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
