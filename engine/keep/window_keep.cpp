// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/keep/window_keep.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "engine/keep/window_pack.h"
#include "engine/store/journal/mapped_file.h"
#include "io/file/errors.h"
#include "kernels/core/assert.h"

namespace mw::engine {
namespace {

constexpr int kPackLevel = 1;
constexpr const char* kCompactedFile = ".windows.partial-compacted";

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
  return folder;
}

}  // namespace

WindowKeep::WindowKeep(const KeepOptions& options, const std::string& settings,
                       const RunLayout& layout, MemoryBudget& budget, const io::LabelTable& table,
                       const GroupCommit& limits)
    : layout_(layout),
      options_(options),
      limits_(limits),
      keys_(table),
      folder_(opened(options, settings)),
      room_(budget.reserve(Purpose::kIndex, index_bytes_of(layout))),
      versions_(layout.slots()),
      bytes_(folder_->open(kVersionsFile)),
      record_at_(layout.windows(), 0),
      log_(std::make_unique<RecordLog>(folder_->open(kWindowsFile))) {
  facts_.marches.resize(layout.marches());
  replay();
  take_over_parts();
  facts_ = {.marches = std::vector<KeepFacts::March>(layout.marches())};  // nothing by this run
}

WindowRecord WindowKeep::checked_record(std::span<const std::byte> bytes) const {
  try {
    WindowRecord record = decode_window_record(bytes);
    if (record.window >= record_at_.size()) throw BadBytes{"there is no such window"};
    return record;
  } catch (const BadBytes& bad) {
    throw DamagedWork("records of windows", bad.reason);
  }
}

/// The last fact of each window counts.
void WindowKeep::replay() {
  log_->replay([&](std::uint64_t at, std::span<const std::byte> bytes) {
    record_at_[checked_record(bytes).window] = at + 1;
    ++records_;
  });
  for (std::uint64_t window = 0; window < record_at_.size(); ++window) {
    const std::optional<WindowRecord> record = record_of(window);
    if (!record) continue;
    ++live_;
    if (record->extent.size > 0 && !bytes_.take(record->extent)) {
      throw DamagedWork("records of windows", "two point to the same bytes, or to none");
    }
  }
}

std::optional<WindowRecord> WindowKeep::record_of(std::uint64_t window) const {
  std::uint64_t at = 0;
  {
    const std::lock_guard lock(mutex_);
    at = record_at_[window];
  }
  if (at == 0) return std::nullopt;
  std::optional<WindowRecord> out;
  log_->read(at - 1, [&](std::span<const std::byte> bytes) { out = checked_record(bytes); });
  return out;
}

void WindowKeep::begin(const PreparedLabels& labels, const MeshSettings& settings,
                       double inner_quality, int threads) {
  digests_.emplace(labels, keys_, settings, layout_.grid(0), threads);
  // Nothing was ever made with another choice, so no fact fits.
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
}

std::vector<BlockKey> WindowKeep::blocks_of(const WindowKey& key) const {
  std::vector<BlockKey> out;
  for (Index3 block : layout_.grid(key.march).blocks_of(key.window)) {
    out.push_back({key.march, block});
  }
  return out;
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
  const auto add = [&](const BlockKey& block) {
    const KeptVersion* const version = version_of(block);
    if (version == nullptr) return false;
    blocks.add(version->digest);
    out.seen.content = hull(out.seen.content, version->box());
    return true;
  };
  for (const BlockKey& block : blocks_of(key)) {
    if (add(block)) continue;
    blocks.add(std::uint64_t{block.march > 0});
    if (block.march > 0) {
      for (const BlockKey& part : layout_.parts(block)) {
        if (!add(part)) blocks.add(std::uint64_t{0});
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
  const std::optional<WindowRecord> record = record_of(layout_.window(key));
  if (!record || !(record->input.blocks == out.input.blocks)) return out;
  if (!(record->input.bricks == out.input.bricks)) {
    out.input.labels = digests_->exact(out.seen);
    if (!(record->input.labels == out.input.labels)) return out;
  }
  out.record = record;
  return out;
}

/// Whether the window comes before all that share a block with it.
bool WindowKeep::is_first(const WindowKey& key) const {
  return key.march == 0 && layout_.order(0).step(key.window) == 0;
}

/// The window that takes a block right after a window that is first; nothing where there is none.
/// In colour order it is the neighbour along x.
std::optional<WindowKey> WindowKeep::follower(const WindowKey& key, const Index3& block) const {
  WindowKey next = key;
  next.window.x += block.x == key.window.x ? -1 : 1;
  const bool is_there = next.window.x >= 0 && next.window.x < layout_.grid(0).windows().x;
  return is_there ? std::optional(next) : std::nullopt;
}

/// Whether a follower will find what it knows, as far as can be told before any window is visited:
/// if the windows before it, which are first, leave what their facts say.
bool WindowKeep::will_recall(const WindowKey& follower) const {
  std::map<std::uint64_t, KeptVersion> left;  // by slot
  for (const std::int64_t step : {-1, 1}) {
    WindowKey before = follower;
    before.window.x += step;
    if (before.window.x >= layout_.grid(0).windows().x) continue;
    const Known known = look_up(before, [](const BlockKey&) { return nullptr; });
    if (!known.record) return false;
    const std::vector<BlockKey> blocks = blocks_of(before);
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

/// Whether a window may take a block of this first one, whose bytes are nowhere.
bool WindowKeep::is_needed(const WindowKey& key) const {
  for (const std::int64_t step : {0, 1}) {
    const auto next = follower(key, {key.window.x + step, key.window.y, key.window.z});
    if (next && !will_recall(*next)) return true;
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
  if (known.record && is_first(key) && is_needed(key)) known.record.reset();
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

/// What the window left is there now.
void WindowKeep::leave(const WindowKey& key, const WindowRecord& record) {
  const std::vector<BlockKey> blocks = blocks_of(key);
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

/// To make one costs more than to pack a window of one label.
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
  for (const BlockKey& at : blocks_of(key)) {
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
  const WindowRecord added = add(std::move(record), packed);
  leave(key, added);
  return places_of(added);
}

/// Writes the bytes of a fact, and the records of its group once that is full.
WindowRecord WindowKeep::add(WindowRecord record, std::span<const std::byte> packed) {
  bool full = false;
  {
    const std::optional<WindowRecord> old = record_of(record.window);
    const std::lock_guard lock(mutex_);
    if (!packed.empty()) record.extent = bytes_.write(packed);
    if (old && old->extent.size > 0) superseded_.push_back(old->extent);
    if (!old) ++live_;
    group_.push_back(record);
    ++facts_.marches[layout_.march_of(record.window)].visited;
    facts_.bytes_written += packed.size();
    full = group_.size() >= limits_.windows || Clock::now() - group_since_ >= limits_.age;
  }
  if (full) {
    const std::unique_lock turn(saving_, std::try_to_lock);  // else another thread is at it
    if (turn.owns_lock()) write_group();
  }
  return record;
}

void WindowKeep::receive(const BlockKey& key, const LeftBlock& block) {
  const std::vector<std::byte> bytes = to_kept(block.bytes, keys_);
  versions_[layout_.slot(key)] = {io::content_digest(bytes), numbers_of(block.voxels)};
}

std::vector<std::byte> WindowKeep::read(const BlockKey& key, const KeptPlace& place) const {
  if (place.size == 0) throw Error(ErrorKind::kInternal, name(key) + " is needed and not kept");
  std::vector<std::byte> kept;
  bytes_.read({place.offset, place.size}, [&](std::span<const std::byte> packed) {
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

/// Bytes first, then the records that point to them; then what these replace is free.
void WindowKeep::write_group() {
  std::vector<WindowRecord> group;
  std::vector<Extent> superseded;
  {
    const std::lock_guard lock(mutex_);
    group = std::exchange(group_, {});
    superseded = std::exchange(superseded_, {});
    group_since_ = Clock::now();
  }
  if (group.empty()) return;
  bytes_.sync();
  std::vector<std::uint64_t> places;
  for (const WindowRecord& record : group) places.push_back(log_->append(encode(record).written()));
  log_->sync();
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < group.size(); ++i) record_at_[group[i].window] = places[i] + 1;
  records_ += group.size();
  for (const Extent& extent : superseded) bytes_.release(extent);
}

void WindowKeep::save() {
  const std::lock_guard turn(saving_);
  write_group();
}

void WindowKeep::take_over_parts() {
  for (const std::filesystem::path& part : folder_->parts()) take_over(part);
}

/// Its records go first, so that a folder which is half gone after a kill holds no fact.
void WindowKeep::take_over(const std::filesystem::path& part) {
  const std::filesystem::path records = part / kWindowsFile;
  if (std::filesystem::exists(records)) {
    RecordLog log(std::make_unique<MappedFile>(records));
    SegmentFile bytes(std::make_unique<MappedFile>(part / kVersionsFile));
    log.replay([&](std::uint64_t /*at*/, std::span<const std::byte> record) {
      take_over(checked_record(record), bytes);
    });
    save();
    std::filesystem::remove(records);
  }
  std::error_code ignored;  // what stays holds no facts, and goes next time
  std::filesystem::remove_all(part, ignored);
}

void WindowKeep::take_over(const WindowRecord& record, SegmentFile& from) {
  if (record.extent.size == 0) {
    static_cast<void>(add(record, {}));
    return;
  }
  if (!from.take(record.extent)) {
    throw DamagedWork("records of windows", "two point to the same bytes, or to none");
  }
  from.read(record.extent,
            [&](std::span<const std::byte> packed) { static_cast<void>(add(record, packed)); });
}

/// Most records are of windows that have newer ones: the others alone are written again.
void WindowKeep::compact_log() {
  const std::filesystem::path file = folder_->path() / kCompactedFile;
  std::filesystem::remove(file);
  {
    RecordLog compacted(folder_->open(kCompactedFile));
    for (std::uint64_t window = 0; window < record_at_.size(); ++window) {
      if (record_at_[window] == 0) continue;
      log_->read(record_at_[window] - 1, [&](std::span<const std::byte> bytes) {
        static_cast<void>(compacted.append(bytes));
      });
    }
    compacted.sync();
    compacted.trim();
  }
  std::filesystem::rename(file, folder_->path() / kWindowsFile);
}

void WindowKeep::finish() {
  const std::lock_guard turn(saving_);
  write_group();
  if (records_ > 2 * live_) compact_log();
  log_->trim();
  const std::lock_guard lock(mutex_);
  bytes_.trim();
  facts_.bytes_kept = folder_->bytes();
}

bool WindowKeep::has_facts() const {
  const std::lock_guard lock(mutex_);
  return live_ > 0;
}

KeepFacts WindowKeep::facts() const {
  const std::lock_guard lock(mutex_);
  return facts_;
}

}  // namespace mw::engine
