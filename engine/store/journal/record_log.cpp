// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A file of records, of which the last may be cut off.
#include "engine/store/journal/journal.h"

#include <array>
#include <utility>

#include "engine/store/codec/byte_codes.h"
#include "io/codec/checksums.h"
#include "io/file/byte_order.h"

namespace mw::engine {
namespace {

constexpr std::uint64_t kMagicBytes = 8;
constexpr std::uint64_t kHeadBytes = 8;  ///< length and checksum of a record
constexpr std::uint64_t kGrowBytes = 1 << 20;

template <class T>
T number_at(const WorkFile& file, std::uint64_t offset) {
  T value = 0;
  file.read(offset, sizeof(T), [&](std::span<const std::byte> bytes) {
    value = io::load<T>(bytes.data(), io::ByteOrder::kLittle);
  });
  return value;
}

/// True for some first bytes of the magic, or none, then zeros: a run was stopped in begin().  A
/// magic that itself ends with zeros is whole.
bool is_unfinished(std::uint64_t found, std::uint64_t magic) {
  if (found == magic) return false;
  for (unsigned bits = 0; bits < 8 * kMagicBytes; bits += 8) {
    if (found == (magic & ((std::uint64_t{1} << bits) - 1))) return true;
  }
  return false;
}

void begin(WorkFile& file, std::uint64_t magic) {
  file.resize(0);
  file.resize(kGrowBytes);
  std::array<std::byte, kMagicBytes> bytes{};
  io::store_little(magic, bytes.data());
  file.write(0, bytes);
  file.sync();
}

}  // namespace

RecordLog::RecordLog(std::unique_ptr<WorkFile> file, const LogKind& kind)
    : file_(std::move(file)), end_(kMagicBytes) {
  const auto magic = [&] { return number_at<std::uint64_t>(*file_, 0); };
  if (file_->size() < kMagicBytes || is_unfinished(magic(), kind.magic)) begin(*file_, kind.magic);
  if (magic() != kind.magic) throw DamagedWork(kind.name, kind.expected);
}

bool RecordLog::next(const TakeRecord& take) {
  if (file_->size() - end_ < kHeadBytes) return false;
  const auto length = number_at<std::uint32_t>(*file_, end_);
  const auto sum = number_at<std::uint32_t>(*file_, end_ + 4);
  if (length == 0 || length > file_->size() - end_ - kHeadBytes) return false;
  bool counts = false;
  file_->read(end_ + kHeadBytes, length, [&](std::span<const std::byte> record) {
    counts = io::checksum(record) == sum && take(end_, record);
  });
  if (counts) end_ += kHeadBytes + length;
  return counts;
}

void RecordLog::cut() {
  // Bytes that are added later are zeros, so that none of these is taken for a record.
  file_->resize(end_);
  // A killed run may not have synced its last records, and what they give up is free from now on.
  if (end_ > kMagicBytes) file_->sync();
}

void RecordLog::replay(const UseRecord& use) {
  const auto take = [&](std::uint64_t at, std::span<const std::byte> record) {
    use(at, record);
    return true;
  };
  while (next(take)) continue;
  cut();
}

std::uint64_t RecordLog::append(std::span<const std::byte> record) {
  const std::uint64_t at = end_, size = kHeadBytes + record.size();
  if (at + size > file_->size()) {
    file_->resize((at + size + kGrowBytes - 1) / kGrowBytes * kGrowBytes);
  }
  std::vector<std::byte> bytes(kHeadBytes);
  io::store_little(static_cast<std::uint32_t>(record.size()), bytes.data());
  io::store_little(io::checksum(record), bytes.data() + 4);
  bytes.insert(bytes.end(), record.begin(), record.end());
  file_->write(at, bytes);
  end_ += size;
  return at;
}

void RecordLog::read(std::uint64_t at, const UseBytes& use) const {
  const auto length = number_at<std::uint32_t>(*file_, at);
  file_->read(at + kHeadBytes, length, use);
}

}  // namespace mw::engine
