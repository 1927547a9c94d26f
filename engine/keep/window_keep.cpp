// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/keep/window_keep.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "engine/keep/required_visits.h"
#include "engine/keep/window_pack.h"
#include "io/file/errors.h"
#include "kernels/core/assert.h"

namespace mw::engine {
namespace {

constexpr int kPackLevel = 1;

std::uint64_t index_bytes_of(const RunLayout& layout) {
  return layout.slots() * sizeof(KeptVersion) + layout.windows() * sizeof(std::uint64_t) +
         label_digest_bytes(layout.grid(0).volume());
}

std::array<std::int32_t, 6> numbers_of(const Box3& box) {
  const auto number = [](std::int64_t v) { return static_cast<std::int32_t>(v); };
  return {number(box.lo.x), number(box.lo.y), number(box.lo.z),
          number(box.hi.x), number(box.hi.y), number(box.hi.z)};
}

std::uint32_t sum_of(const io::ContentDigest& digest) {
  return static_cast<std::uint32_t>(digest.first);
}

std::shared_ptr<KeepFolder> opened(const KeepOptions& options, const std::string& settings) {
  std::shared_ptr<KeepFolder> folder = options.opened;
  if (folder == nullptr) folder = std::make_shared<KeepFolder>(options.folder, options.use);
  folder->settle(settings);
  if (options.begin) options.begin();
  return folder;
}

}  // namespace

// More than five parameters: each is an object of another room, which the keep refers to.
WindowKeep::WindowKeep(const KeepOptions& options, const std::string& settings,
                       const RunLayout& layout, MemoryBudget& budget, const io::LabelTable& table,
                       const GroupCommit& limits)
    : layout_(layout),
      options_(options),
      keys_(table),
      folder_(opened(options, settings)),
      room_(budget.reserve(Purpose::kIndex, index_bytes_of(layout))),
      kept_(*folder_, layout, limits),
      versions_(layout.slots()) {
  facts_.marches.resize(layout.marches());
  kept_.take_over_parts();
}

void WindowKeep::begin(const PreparedLabels& labels, const MeshSettings& settings,
                       double inner_quality, int threads) {
  digests_.emplace(labels, keys_, settings, layout_.grid(0), threads);
  // The choice is a part of every fact, so with another one no fact fits.
  const std::string chosen = io::text("inner-quality = ", inner_quality, "\n");
  const std::string before = folder_->text(kChosenFile);
  if (!before.empty() && before != chosen && options_.say) {
    options_.say(folder_->path().string() + ": this volume has another inner-quality (auto), now " +
                 io::text(inner_quality) + ": all windows are visited again");
  }
  if (before != chosen) folder_->put_text(kChosenFile, chosen);
  io::DigestMaker scope;
  scope.add(chosen);
  scope_ = scope.finish();
  if (kept_.has_dropped()) find_required();
}

/// Looks windows up in their order, as if each that can be recalled is recalled.
void WindowKeep::find_required() {
  const Recalls recalls = [this](const WindowKey& key) {
    const Known known = look_up(key);
    if (known.record) leave(key, *known.record);
    return known.record.has_value();
  };
  required_ = required_visits(layout_, recalls,
                              [this](std::uint64_t window) { return kept_.is_dropped(window); });
  std::fill(versions_.begin(), versions_.end(), KeptVersion{});
}

WindowKeep::Known WindowKeep::look_up(const WindowKey& key) const {
  return look_up(key, [this](const BlockKey& block) -> const KeptVersion* {
    const KeptVersion& version = versions_[layout_.slot(block)];
    return version.digest.is_none() ? nullptr : &version;
  });
}

WindowKeep::Known WindowKeep::look_up(const WindowKey& key, const VersionOf& version_of) const {
  Known out;
  io::DigestMaker blocks;
  blocks.add(scope_);
  blocks.add(layout_.window(key));
  const auto add = [&](const BlockKey& part, const BlockKey& block) {
    const KeptVersion* const version = version_of(part);
    if (version == nullptr) return false;
    blocks.add(version->digest);
    const Index3 by = layout_.way(part, block);
    const Box3 box = version->box();
    out.seen.content = hull(out.seen.content, {box.lo + by, box.hi + by});
    return true;
  };
  for (const BlockKey& block : layout_.blocks_of(key)) {
    if (add(block, block)) continue;
    blocks.add(std::uint64_t{block.march > 0});
    if (block.march > 0) {
      for (const BlockKey& part : layout_.parts(block)) {
        if (!add(part, block)) blocks.add(std::uint64_t{0});
      }
      continue;
    }
    out.seen.starts.push_back(block.block);
    Box3 box = layout_.grid(0).block_box(block.block);
    box.hi = box.hi + Index3{1, 1, 1};  // vertices lie on its far sides, too
    out.seen.content = hull(out.seen.content, box);
  }
  out.input.blocks = blocks.finish();
  out.input.bricks = digests_->of_bricks(out.seen);
  const std::optional<WindowRecord> record = kept_.of(layout_.window(key));
  if (!record || !(record->input.blocks == out.input.blocks)) return out;
  if (!(record->input.bricks == out.input.bricks)) {
    out.input.labels = digests_->exact(out.seen);
    if (!(record->input.labels == out.input.labels)) return out;
  }
  out.record = record;
  return out;
}

/// True if the window comes before all that share a block with it.
bool WindowKeep::is_first(const WindowKey& key) const {
  return key.march == 0 && layout_.order(0).step(key.window) == 0;
}

/// Returns the window that takes a block right after a window that is first, or nothing where there
/// is none.  In colour order it is the neighbour along x.
std::optional<WindowKey> WindowKeep::follower(const WindowKey& key, const Index3& block) const {
  WindowKey next = key;
  next.window.x += block.x == key.window.x ? -1 : 1;
  const bool is_there = next.window.x >= 0 && next.window.x < layout_.grid(0).windows().x;
  return is_there ? std::optional(next) : std::nullopt;
}

/// True if a follower's fact will fit, as far as that can be told before any window is visited: if
/// the windows before it, which are first, leave what their facts say.
bool WindowKeep::will_recall(const WindowKey& follower) const {
  std::map<std::uint64_t, KeptVersion> left;  // by slot
  for (const std::int64_t step : {-1, 1}) {
    WindowKey before = follower;
    before.window.x += step;
    if (before.window.x >= layout_.grid(0).windows().x) continue;
    const Known known = look_up(before, [](const BlockKey&) { return nullptr; });
    if (!known.record) return false;
    const std::vector<BlockKey> blocks = layout_.blocks_of(before);
    for (std::size_t i = 0; i < blocks.size() && i < known.record->blocks.size(); ++i) {
      left.emplace(layout_.slot(blocks[i]), known.record->blocks[i].version);
    }
  }
  const Known known = look_up(follower, [&](const BlockKey& block) -> const KeptVersion* {
    const auto version = left.find(layout_.slot(block));
    return version == left.end() ? nullptr : &version->second;
  });
  return known.record.has_value();
}

/// True if a window that is visited may take a block of this first one which is not kept.
bool WindowKeep::is_needed(const WindowKey& key) const {
  for (const std::int64_t step : {0, 1}) {
    const auto next = follower(key, {key.window.x + step, key.window.y, key.window.z});
    if (next && (is_required(*next) || !will_recall(*next))) return true;
  }
  return false;
}

bool WindowKeep::recalls(const WindowKey& key) {
  const std::uint64_t window = layout_.window(key);
  {
    const std::lock_guard lock(mutex_);
    const auto known = known_.find(window);
    if (known != known_.end()) return known->second.record.has_value();
  }
  Known known = look_up(key);
  if (is_required(key) || (known.record && is_first(key) && is_needed(key))) known.record.reset();
  const bool out = known.record.has_value();
  const std::lock_guard lock(mutex_);
  known_.emplace(window, std::move(known));
  return out;
}

std::optional<std::vector<KeptPlace>> WindowKeep::recalled(const WindowKey& key) {
  std::optional<WindowRecord> record;
  {
    const std::lock_guard lock(mutex_);
    const auto known = known_.find(layout_.window(key));
    if (known == known_.end() || !known->second.record) return std::nullopt;
    record = std::move(known->second.record);
    known_.erase(known);
    ++facts_.marches[key.march].skipped;
  }
  leave(key, *record);
  return places_of(*record);
}

/// Makes what the window left the present versions of its blocks.
void WindowKeep::leave(const WindowKey& key, const WindowRecord& record) {
  const std::vector<BlockKey> blocks = layout_.blocks_of(key);
  if (blocks.size() != record.blocks.size()) {
    throw DamagedWork("records of windows", "one has another number of blocks");
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    versions_[layout_.slot(blocks[i])] = record.blocks[i].version;
  }
}

std::vector<KeptPlace> WindowKeep::places_of(const WindowRecord& record) {
  const auto size = static_cast<std::uint32_t>(record.extent.size);
  std::vector<KeptPlace> out;
  std::uint8_t part = 0;
  for (const KeptBlock& block : record.blocks) {
    KeptPlace place{.sum = sum_of(block.version.digest), .memory_kib = block.memory_kib};
    if (block.is_kept) {
      place.offset = record.extent.offset;
      place.size = size;
      place.part = part++;
    }
    out.push_back(place);
  }
  return out;
}

/// Packers are used again, since to make one costs more than to pack a window of one label.
std::unique_ptr<io::ZstdPacker> WindowKeep::take_packer() {
  const std::lock_guard lock(mutex_);
  if (packers_.empty()) return std::make_unique<io::ZstdPacker>(kPackLevel);
  std::unique_ptr<io::ZstdPacker> out = std::move(packers_.back());
  packers_.pop_back();
  return out;
}

void WindowKeep::give_back(std::unique_ptr<io::ZstdPacker> packer) {
  const std::lock_guard lock(mutex_);
  packers_.push_back(std::move(packer));
}

std::vector<KeptPlace> WindowKeep::keep(const WindowKey& key, std::span<const LeftBlock> blocks) {
  WindowRecord record{.window = layout_.window(key), .input = {}, .extent = {}, .blocks = {}};
  SeenLabels seen;
  {
    const std::lock_guard lock(mutex_);
    const auto known = known_.find(record.window);
    MW_ASSERT(known != known_.end());
    record.input = known->second.input;
    seen = std::move(known->second.seen);
    known_.erase(known);
  }
  if (record.input.labels.is_none()) record.input.labels = digests_->exact(seen);
  const bool first = is_first(key);
  std::vector<std::vector<std::byte>> kept;
  for (const BlockKey& at : layout_.blocks_of(key)) {
    const LeftBlock& block = blocks[record.blocks.size()];
    std::vector<std::byte> bytes = to_kept(block.bytes, keys_);
    record.blocks.push_back(
        {.version = {io::content_digest(bytes), numbers_of(block.voxels)},
         .is_kept = !first || !follower(key, at.block),
         .memory_kib = static_cast<std::uint32_t>((block.memory_bytes + 1023) / 1024)});
    if (record.blocks.back().is_kept) kept.push_back(std::move(bytes));
  }
  std::vector<std::byte> packed;
  if (!kept.empty()) {
    std::unique_ptr<io::ZstdPacker> packer = take_packer();
    packed = pack_blocks(kept, *packer);
    give_back(std::move(packer));
  }
  record = kept_.add(std::move(record), packed);
  leave(key, record);
  const std::lock_guard lock(mutex_);
  ++facts_.marches[key.march].visited;
  facts_.bytes_written += packed.size();
  return places_of(record);
}

void WindowKeep::receive(const BlockKey& key, const LeftBlock& block) {
  const std::vector<std::byte> bytes = to_kept(block.bytes, keys_);
  versions_[layout_.slot(key)] = {io::content_digest(bytes), numbers_of(block.voxels)};
}

std::vector<std::byte> WindowKeep::read(const BlockKey& key, const KeptPlace& place) const {
  if (place.size == 0) throw Error(ErrorKind::kInternal, name(key) + " is needed and not kept");
  std::vector<std::byte> kept;
  kept_.read({place.offset, place.size}, [&](std::span<const std::byte> packed) {
    try {
      kept = unpack_block(packed, place.part);
    } catch (const BadBytes& bad) {
      throw DamagedWork(name(key), bad.reason);
    } catch (const Error& error) {
      throw DamagedWork(name(key), error.what());
    }
  });
  if (sum_of(io::content_digest(kept)) != place.sum) {
    throw DamagedWork(name(key), "these are not the bytes that were kept");
  }
  return from_kept(key, kept, keys_);
}

void WindowKeep::take_over_parts() {
  const std::vector<std::uint64_t> by_march = kept_.take_over_parts();
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < by_march.size(); ++i) facts_.marches[i].visited += by_march[i];
}

/// A limit is saved, since it holds for later runs that name none.
void WindowKeep::shrink() {
  std::uint64_t limit = 0;
  if (options_.bytes) {
    limit = *options_.bytes;
    folder_->put_text(kLimitFile, io::text(limit, "\n"));
  } else if (!(std::istringstream(folder_->text(kLimitFile)) >> limit)) {
    return;
  }
  kept_.shrink_to(limit);
  const std::uint64_t taken = folder_->bytes();
  if (taken <= limit || !options_.say) return;
  options_.say(io::text(folder_->path().string(), ": takes ", (taken >> 20U) + 1,
                        " MiB, more than --keep-bytes says: blocks that every later run reads, "
                        "labels and records have to stay"));
}

void WindowKeep::finish() {
  // Lists of windows, which the shrinking makes, get the memory of what no visit asks for any more.
  versions_ = {};
  packers_.clear();
  shrink();
  kept_.finish();
  const std::lock_guard lock(mutex_);
  facts_.bytes_kept = folder_->bytes();
}

KeepFacts WindowKeep::facts() const {
  const std::lock_guard lock(mutex_);
  return facts_;
}

}  // namespace mw::engine
