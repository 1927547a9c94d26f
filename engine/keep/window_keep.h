// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Recalls visits that an earlier run has made, so that they are not made again.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/keep/keep_folder.h"
#include "engine/keep/keep_options.h"
#include "engine/keep/kept_block.h"
#include "engine/keep/kept_facts.h"
#include "engine/keep/label_digests.h"
#include "engine/store/block_keeper.h"
#include "engine/store/memory_budget.h"
#include "io/codec/codec.h"

namespace mw::engine {

/// Remembers, across runs, what visits made from which input.
///
/// A visit is a function of its blocks, of the labels that it sees, and of settings.  A fact says
/// what went into a visit and what came out; the folder holds the last one of each window.  So it
/// is never wrong, whatever happens to the volume or the run.  A window whose input is that of its
/// fact is not visited: the store refers to the blocks that came out then.
///
/// A window that no other comes before makes its blocks from labels alone.  Those of its blocks
/// that another window takes next would be a quarter of all bytes, so they are not kept: such a
/// window is visited again where one that takes them is visited.
///
/// Blocks and labels are digested by the labels' own numbers, and visits depend on nothing but the
/// order of these (kernels/README.md, "Determinism").
///
/// Where the folder has a limit below that, bytes of some windows are given up
/// (KeptFacts::shrink_to()).  These windows are visited again, too, where windows that are visited
/// may take their blocks.
///
/// Each process of a run keeps its own visits, in a folder of its own.
///
/// Thread safety: windows that share no block may be asked for and kept at the same time.
class WindowKeep : public BlockKeeper {
 public:
  /// settings are lines "name = value" that every fact depends on.  limits says when facts become
  /// durable.  The references outlive it.
  /// ERRORS: those of KeepFolder; DamagedWork; mw::Error(kResource) when the index exceeds the
  /// budget.
  WindowKeep(const KeepOptions& options, const std::string& settings, const RunLayout& layout,
             MemoryBudget& budget, const io::LabelTable& table, const GroupCommit& limits);

  /// Must be called before the first march.  inner_quality is the one that the run uses
  /// (MeshSettings).  labels outlive it.
  void begin(const PreparedLabels& labels, const MeshSettings& settings, double inner_quality,
             int threads);

  /// True if the window need not be visited.  REQUIRES: its predecessors are done.
  [[nodiscard]] bool recalls(const WindowKey& key);
  /// Returns the blocks of a window that need not be visited, and notes that it has left them;
  /// nothing for a window that must be visited.
  /// REQUIRES: recalls() was asked, and nothing that it depends on has changed since.
  [[nodiscard]] std::optional<std::vector<KeptPlace>> recalled(const WindowKey& key);

  [[nodiscard]] std::vector<KeptPlace> keep(const WindowKey& window,
                                            std::span<const LeftBlock> blocks) override;
  void receive(const BlockKey& key, const LeftBlock& block) override;
  [[nodiscard]] std::vector<std::byte> read(const BlockKey& key,
                                            const KeptPlace& place) const override;
  [[nodiscard]] std::unique_ptr<WorkFile> open_spill() override { return folder_->open_scratch(); }

  /// ENSURES: what was kept so far survives a power cut.
  void save() { kept_.save(); }
  /// Adds what other processes of the run kept in folders beside this one's files (kept_part()),
  /// and removes these folders.  REQUIRES: no process is at work in them.  ERRORS: DamagedWork.
  void take_over_parts();
  /// Shrinks the folder to its limit when the run is complete.  No window is asked for afterwards.
  void finish();
  /// True if a later run finds anything.
  [[nodiscard]] bool has_facts() const { return kept_.any(); }

  [[nodiscard]] KeepFacts facts() const;
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_->path(); }

 private:
  struct Known {
    VisitInput input;
    SeenLabels seen;
    std::optional<WindowRecord> record;  ///< the fact with the outcome; none if it must be visited
  };

  /// Returns the version of a block that a window takes, or null if there is none yet.
  using VersionOf = std::function<const KeptVersion*(const BlockKey& block)>;
  [[nodiscard]] Known look_up(const WindowKey& key, const VersionOf& version_of) const;
  [[nodiscard]] Known look_up(const WindowKey& key) const;
  [[nodiscard]] bool is_first(const WindowKey& key) const;
  [[nodiscard]] std::optional<WindowKey> follower(const WindowKey& key, const Index3& block) const;
  [[nodiscard]] bool is_required(const WindowKey& key) const {
    return !required_.empty() && required_[layout_.window(key)];
  }
  [[nodiscard]] bool will_recall(const WindowKey& follower) const;
  [[nodiscard]] bool is_needed(const WindowKey& key) const;
  void leave(const WindowKey& key, const WindowRecord& record);
  [[nodiscard]] std::unique_ptr<io::ZstdPacker> take_packer();
  void give_back(std::unique_ptr<io::ZstdPacker> packer);
  [[nodiscard]] static std::vector<KeptPlace> places_of(const WindowRecord& record);
  void find_required();
  void shrink();

  const RunLayout& layout_;
  KeepOptions options_;
  LabelKeys keys_;
  std::shared_ptr<KeepFolder> folder_;
  MemoryBudget::Reservation room_;
  KeptFacts kept_;
  std::optional<LabelDigests> digests_;
  io::ContentDigest scope_;            ///< digest of what is settled for the run
  std::vector<KeptVersion> versions_;  ///< by slot: the present version of the block
  std::vector<bool> required_;         ///< by window: it must be visited; empty if none must

  mutable std::mutex mutex_;              ///< guards the next lines
  std::map<std::uint64_t, Known> known_;  ///< by window: those asked for that are not done
  std::vector<std::unique_ptr<io::ZstdPacker>> packers_;  ///< those that no thread uses
  KeepFacts facts_;
};

}  // namespace mw::engine
