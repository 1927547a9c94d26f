// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/keep/record_log.h"

#include <array>
#include <utility>

#include "io/codec/checksums.h"
#include "io/file/byte_order.h"

namespace mw::engine {
namespace {

constexpr std::uint64_t kLogMagic = 0x0200474F4C574D2EU;  // ".MWLOG", version 0 2
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

}  // namespace

RecordLog::RecordLog(std::unique_ptr<WorkFile> file) : file_(std::move(file)), end_(kMagicBytes) {
  if (file_->size() < kMagicBytes || number_at<std::uint64_t>(*file_, 0) == 0) {
    file_->resize(kGrowBytes);
    std::array<std::byte, kMagicBytes> magic{};
    io::store_little(kLogMagic, magic.data());
    file_->write(0, magic);
    file_->sync();
  }
  if (number_at<std::uint64_t>(*file_, 0) != kLogMagic) {
    throw DamagedWork("records of windows", "they do not begin as a log of version 2");
  }
}

void RecordLog::replay(const UseRecord& use) {
  while (file_->size() - end_ > kHeadBytes) {
    const auto length = number_at<std::uint32_t>(*file_, end_);
    if (length == 0 || length > file_->size() - end_ - kHeadBytes) break;
    const auto sum = number_at<std::uint32_t>(*file_, end_ + 4);
    bool whole = false;
    file_->read(end_ + kHeadBytes, length, [&](std::span<const std::byte> record) {
      whole = io::checksum(record) == sum;
      if (whole) use(end_, record);
    });
    if (!whole) break;
    end_ += kHeadBytes + length;
  }
  // Bytes that are added later are zeros, so that none of these is taken for a record.
  file_->resize(end_);
  // A killed run may not have synced its last records, and what they give up is free from now on.
  if (end_ > kMagicBytes) file_->sync();
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
