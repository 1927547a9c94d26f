// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A run of one process: all windows, labels and blocks are here, and nobody has to be told.
#include "engine/labels/label_scan.h"
#include "engine/run/processes.h"
#include "engine/run/run.h"
#include "engine/run/run_context.h"
#include "engine/store/journal/run_folder.h"

namespace mw::engine {
namespace {

class WholeRun : public RunPart {
 public:
  WholeRun(const StoreOptions& options, const std::string& identity) : folder_(options.workdir) {
    if (folder_.empty()) return;
    workdir_ = std::make_shared<Workdir>(folder_, options.resume, identity);
  }

  [[nodiscard]] WorkFiles* work_files() override { return workdir_.get(); }
  [[nodiscard]] std::filesystem::path work_folder() const override { return folder_; }
  [[nodiscard]] BlockRouter* router() override { return nullptr; }
  [[nodiscard]] std::unique_ptr<WindowKeep> open_keep(const OpenKeep& open) override {
    return open(0);
  }
  [[nodiscard]] std::shared_ptr<void> attach(RunStore& /*store*/) override { return nullptr; }
  [[nodiscard]] LabelPlan plan_labels(const io::DenseVolume& /*volume*/,
                                      const MeshSettings& /*settings*/, const RunHooks& /*hooks*/,
                                      RunStore& /*store*/) override {
    return {};
  }
  void begin_marches(RunStore& /*store*/) override {}
  [[nodiscard]] bool visits(const WindowKey& /*key*/) const override { return true; }
  [[nodiscard]] std::optional<PartialMarch> part_of_march(std::uint32_t /*march*/) override {
    return std::nullopt;
  }
  [[nodiscard]] VisitStats end_marches(const VisitStats& own) override { return own; }
  [[nodiscard]] bool await_output() override { return true; }
  void finish_keep(WindowKeep& keep) override { keep.finish(); }
  [[nodiscard]] std::shared_ptr<Workdir> keep_for_rest(RunStore& store) override {
    try {
      store.save();
    } catch (const Error&) {
      // The disk is full or broken, and the mesh is complete nevertheless.
    }
    stays_ = keep_work(store);
    return stays_ ? workdir_ : nullptr;
  }
  [[nodiscard]] std::vector<ProcessFacts> end(const ProcessFacts& /*own*/) override {
    if (workdir_ != nullptr && !stays_) workdir_->discard();
    return {};
  }
  [[nodiscard]] std::exception_ptr fail(const std::exception_ptr& error) override { return error; }
  [[nodiscard]] bool keep_work(const RunStore& store) override {
    if (workdir_ == nullptr || !store.has_saved_work()) return false;
    workdir_->stay();
    return true;
  }

 private:
  std::filesystem::path folder_;
  std::shared_ptr<Workdir> workdir_;
  bool stays_ = false;
};

class OneProcess : public Processes {
 public:
  [[nodiscard]] int count() const override { return 1; }
  [[nodiscard]] int count_here() const override { return 1; }
  [[nodiscard]] bool speaks() const override { return true; }
  [[nodiscard]] io::LabelTable collect_labels(FingerprintVolume& volume, int threads) override {
    return engine::collect_labels(volume, threads);
  }
  [[nodiscard]] std::uint64_t least_bytes(const RunLayout& layout, const io::DenseVolume& volume,
                                          const MeshSettings& settings) const override {
    return index_bytes(layout) + prepared_bytes(volume, settings, nullptr);
  }
  [[nodiscard]] std::unique_ptr<RunPart> take_part(const RunLayout& /*layout*/,
                                                   const RunHooks& hooks,
                                                   const std::string& identity) override {
    return std::make_unique<WholeRun>(hooks.store, identity);
  }
  void fail(const std::exception_ptr& /*error*/) override {}
};

}  // namespace

Processes& one_process() {
  static OneProcess process;
  return process;
}

}  // namespace mw::engine
