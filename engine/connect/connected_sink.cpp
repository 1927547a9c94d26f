// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Passes a mesh straight through, or by way of temporary files.
#include "engine/connect/connected_sink.h"

#include <algorithm>
#include <bit>
#include <set>

namespace mw::engine {
namespace {

constexpr std::size_t kBatchTets = 4096;
/// Set in a row that is the number of a copy.
constexpr std::uint64_t kCopyBit = std::uint64_t{1} << 63;

}  // namespace

std::size_t ConnectTask::memory_of(std::uint64_t budget) {
  constexpr std::uint64_t kMin = 1 << 18;
  return std::clamp<std::uint64_t>(budget / 64, kMin, kMaxMemoryBytes);
}

ConnectedSink::ConnectedSink(io::MeshSink& below, ConnectTask task)
    : below_(below),
      task_(std::move(task)),
      positions_(task_.folder),
      tets_(task_.folder),
      values_(task_.folder) {}

void ConnectedSink::begin(const io::MeshHeader& header) {
  header_ = header;
  header_.record.cohesive = task_.options.cohesive;
  finder_.emplace(task_.options, task_.folder, task_.memory_bytes);
  if (!task_.options.change_mesh()) below_.begin(header);
}

void ConnectedSink::write_vertices(std::span<const io::Position> positions) {
  positions_.append(std::as_bytes(positions));
  if (!task_.options.change_mesh()) below_.write_vertices(positions);
}

void ConnectedSink::write_tets(std::span<const io::TetRows> tets,
                               std::span<const RawLabel> labels) {
  finder_->add(tets, labels);
  if (!task_.options.change_mesh()) return below_.write_tets(tets, labels);
  io::append_tets(tets_, tets, labels);
}

void ConnectedSink::write_values(std::span<const double> rows) {
  if (!task_.options.change_mesh()) return below_.write_values(rows);
  values_.append(std::as_bytes(rows));
}

void ConnectedSink::finish() {
  finder_->find();
  find_places();
  if (task_.options.change_mesh()) write_changed();
  facts_ = finder_->facts();
  finder_.reset();
  below_.finish();
}

std::uint64_t ConnectedSink::buffer_bytes() const {
  constexpr std::uint64_t kBuffers = 5 << 18, kBuffersOfValue = 2 * kBatchTets * sizeof(double);
  return below_.buffer_bytes() + 2 * std::uint64_t{task_.memory_bytes} + kBuffers +
         kBuffersOfValue * header_.values.size();
}

io::Position ConnectedSink::position(std::uint64_t row) {
  io::Position out{};
  positions_.read_at(row * sizeof out, std::as_writable_bytes(std::span(out)));
  return out;
}

void ConnectedSink::find_places() {
  ConnectFacts& facts = finder_->facts();
  facts.vertices = positions_.size() / sizeof(io::Position);
  for (PartPlace& part : facts.others) part.place = position(part.row);
  for (HingePlace& hinge : facts.hinges) {
    for (std::size_t end = 0; end < 2; ++end) hinge.places[end] = position(hinge.rows[end]);
  }
}

/// Marks the vertices of kept tets, and notes the labels of tets that are left out.
void ConnectedSink::mark_used() {
  std::set<RawLabel> partial;
  used_.resize(positions_.size() / sizeof(io::Position) / 64 + 1);
  std::uint64_t number = 0;
  tets_.each_batch<io::TetRecord>([&](std::span<const io::TetRecord> batch) {
    for (const io::TetRecord& tet : batch) {
      if (!finder_->keeps(number++)) {
        partial.insert(tet[4]);
        continue;
      }
      for (std::size_t i = 0; i < 4; ++i) {
        used_[tet[i] / 64].bits |= std::uint64_t{1} << (tet[i] % 64);
      }
    }
  });
  used_count_ = 0;
  for (UsedWord& word : used_) {
    word.before = used_count_;
    used_count_ += static_cast<std::uint64_t>(std::popcount(word.bits));
  }
  header_.record.partial_labels.assign(partial.begin(), partial.end());
}

bool ConnectedSink::is_used(std::uint64_t row) const {
  return used_.empty() || (used_[row / 64].bits >> (row % 64) & 1) != 0;
}

std::uint64_t ConnectedSink::new_row(std::uint64_t row) const {
  if (used_.empty()) return row;
  const UsedWord& word = used_[row / 64];
  const std::uint64_t lower = word.bits & ((std::uint64_t{1} << (row % 64)) - 1);
  return word.before + static_cast<std::uint64_t>(std::popcount(lower));
}

void ConnectedSink::write_changed() {
  ConnectFacts& facts = finder_->facts();
  used_count_ = facts.vertices;
  if (task_.options.parts.leaves_out() && facts.parts < facts.found) mark_used();
  facts.vertices = used_count_ + facts.copies;
  header_.tets = facts.tets;
  header_.record.has_doubles = facts.copies > 0;
  below_.begin(header_);
  pass_vertices();
  pass_tets();
}

void ConnectedSink::pass_vertices() {
  std::uint64_t row = 0;
  positions_.each_batch<io::Position>([&](std::span<const io::Position> batch) {
    std::vector<io::Position> used;
    for (const io::Position& p : batch) {
      if (is_used(row++)) used.push_back(p);
    }
    below_.write_vertices(used);
  });
  finder_->copies().each_batch<std::uint64_t>([&](std::span<const std::uint64_t> rows) {
    std::vector<io::Position> copies;
    for (const std::uint64_t copied : rows) copies.push_back(position(copied));
    below_.write_vertices(copies);
  });
}

void ConnectedSink::pass_tets() {
  finder_->each_copied_corner([&](const CopiedCorner& corner) {
    pass_tets_before(corner.tet);
    io::TetRecord& tet = next_tet();
    *std::find(tet.begin(), tet.begin() + 4, corner.row) = kCopyBit | corner.copy;
  });
  pass_tets_before(tets_.size() / sizeof(io::TetRecord));
  flush();
}

void ConnectedSink::pass_tets_before(std::uint64_t end) {
  for (; next_ < end; ++next_) {
    const io::TetRecord& tet = next_tet();
    if (finder_->keeps(next_)) pass(tet);
  }
}

/// Returns the next tet, which a caller may change until it is passed on.
io::TetRecord& ConnectedSink::next_tet() {
  if (next_ == loaded_first_ + loaded_.size()) {
    const std::uint64_t left = tets_.size() / sizeof(io::TetRecord) - next_;
    loaded_first_ = next_;
    loaded_.resize(std::min<std::uint64_t>(kBatchTets, left));
    tets_.read_at(next_ * sizeof(io::TetRecord), std::as_writable_bytes(std::span(loaded_)));
    const std::size_t width = header_.values.size();
    loaded_values_.resize(width * loaded_.size());
    if (width == 0) return loaded_.front();
    values_.read_at(next_ * width * sizeof(double),
                    std::as_writable_bytes(std::span(loaded_values_)));
  }
  return loaded_[next_ - loaded_first_];
}

void ConnectedSink::pass(const io::TetRecord& tet) {
  io::TetRows& rows = batch_.emplace_back();
  for (std::size_t i = 0; i < 4; ++i) {
    const bool is_copy = (tet[i] & kCopyBit) != 0;
    rows[i] = is_copy ? used_count_ + (tet[i] & ~kCopyBit) : new_row(tet[i]);
  }
  batch_labels_.push_back(tet[4]);
  const auto width = static_cast<std::ptrdiff_t>(header_.values.size());
  const auto values =
      loaded_values_.begin() + width * static_cast<std::ptrdiff_t>(next_ - loaded_first_);
  batch_values_.insert(batch_values_.end(), values, values + width);
  if (batch_.size() == kBatchTets) flush();
}

void ConnectedSink::flush() {
  below_.write_tets(batch_, batch_labels_);
  if (!header_.values.empty()) below_.write_values(batch_values_);
  batch_.clear();
  batch_labels_.clear();
  batch_values_.clear();
}

}  // namespace mw::engine
