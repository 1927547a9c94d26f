// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Files of a cache, which have the bytes, the version, and a tail that tells how many these are.
#include "io/remote/disk_cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <tuple>
#include <vector>

#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "io/file/file_descriptor.h"
#include "io/file/folder.h"
#include "io/file/source/file_source.h"

namespace mw::io {
namespace {

namespace fs = std::filesystem;
using Seconds = std::chrono::seconds;

constexpr std::uint64_t kCacheMagic = 0x324548434143574DU;  // "MWCACHE2"
constexpr std::size_t kPieceBytes = 1U << 20U;
/// A digest has 32 digits; the first ones name a folder, the others a file in it.
constexpr std::size_t kFolderDigits = 2;
constexpr std::size_t kFileDigits = 30;
constexpr std::string_view kUnfinished = ".unfinished";
/// Shares of the bytes that the files may have: the largest answer that is kept has at most one in
/// kLargestShare of them, and at most kLeftShare is left when some answers are removed.
constexpr std::uint64_t kLargestShare = 8;
constexpr double kLeftShare = 0.9;
/// A use within kFreshUse of the last one is not noted.  An unfinished file that is older than
/// kAbandoned was left by a process that was killed.
constexpr Seconds kFreshUse{60};
constexpr Seconds kAbandoned{3600};

struct Tail {
  std::uint64_t magic = kCacheMagic;
  std::uint64_t bytes = 0;
  std::uint64_t version_bytes = 0;
  std::uint64_t file_bytes = 0;
  ContentDigest digest;  ///< of the key, all that is before the tail, and the three counts

  using Bytes = std::array<std::byte, 48>;

  [[nodiscard]] Bytes stored() const {
    Bytes out;
    const std::array<std::uint64_t, 6> words{magic,      bytes,        version_bytes,
                                             file_bytes, digest.first, digest.second};
    for (std::size_t i = 0; i < words.size(); ++i) store_little(words[i], out.data() + 8 * i);
    return out;
  }
  [[nodiscard]] static Tail loaded(const Bytes& from) {
    std::array<std::uint64_t, 6> words;
    for (std::size_t i = 0; i < words.size(); ++i) {
      words[i] = load<std::uint64_t>(from.data() + 8 * i, ByteOrder::kLittle);
    }
    return {words[0], words[1], words[2], words[3], {words[4], words[5]}};
  }
};

/// Calls use(offset, bytes) on all bytes, piece by piece.
template <typename Use>
void each_piece(const ByteSource& source, std::uint64_t size, Use use) {
  std::vector<std::byte> piece;
  for (std::uint64_t at = 0; at < size; at += piece.size()) {
    piece.resize(std::min<std::uint64_t>(kPieceBytes, size - at));
    source.read_at(at, piece);
    use(at, std::span<const std::byte>(piece));
  }
}

ContentDigest digest_of(const ContentDigest& key, const ByteSource& before_tail, const Tail& tail) {
  DigestMaker maker;
  maker.add(key);
  each_piece(before_tail, tail.bytes + tail.version_bytes,
             [&](std::uint64_t, std::span<const std::byte> piece) { maker.add(piece); });
  for (const std::uint64_t word : {tail.bytes, tail.version_bytes, tail.file_bytes}) {
    maker.add(word);
  }
  return maker.finish();
}

/// Returns the answer in a file; nothing when the file is not whole, or of another key.
std::optional<CachedAnswer> read_answer(const fs::path& path, const ContentDigest& key,
                                        const std::string& name) {
  auto file = std::make_shared<const FileSource>(path);
  Tail::Bytes stored;
  if (file->size() < stored.size()) return std::nullopt;
  const std::uint64_t before = file->size() - stored.size();
  file->read_at(before, stored);
  const Tail tail = Tail::loaded(stored);
  if (tail.magic != kCacheMagic || saturating_sum(tail.bytes, tail.version_bytes) != before) {
    return std::nullopt;
  }
  if (digest_of(key, *file, tail) != tail.digest) return std::nullopt;
  CachedAnswer out{.file_bytes = tail.file_bytes, .version = {}};
  out.version.resize(tail.version_bytes);
  file->read_at(tail.bytes, std::as_writable_bytes(std::span(out.version)));
  out.bytes = std::make_shared<const BytesPart>(file, 0, tail.bytes, name);
  return out;
}

/// Writes an answer to a file; false when the disk does not take it.
bool write_answer(int file, const ContentDigest& key, const CachedAnswer& answer) {
  Tail tail{.bytes = answer.bytes->size(),
            .version_bytes = answer.version.size(),
            .file_bytes = answer.file_bytes,
            .digest = {}};
  DigestMaker maker;
  maker.add(key);
  std::uint64_t end = 0;
  bool good = true;
  const auto append = [&](std::span<const std::byte> bytes) {
    good = good && write_all(file, end, bytes).error == 0;
    end += bytes.size();
  };
  each_piece(*answer.bytes, tail.bytes, [&](std::uint64_t, std::span<const std::byte> piece) {
    maker.add(piece);
    append(piece);
  });
  const auto version = std::as_bytes(std::span(answer.version));
  maker.add(version);
  append(version);
  for (const std::uint64_t word : {tail.bytes, tail.version_bytes, tail.file_bytes}) {
    maker.add(word);
  }
  tail.digest = maker.finish();
  append(tail.stored());
  return good;
}

struct KeptFile {
  fs::path path;
  fs::file_time_type used;
  std::uint64_t bytes = 0;
};

bool is_hexadecimal(const std::string& text, std::size_t digits) {
  return text.size() == digits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// Adds the files of one of the folders in a cache's folder.  Only files with names that a cache
/// gives count, since the folder may hold other files, which must not be removed.
void add_files_in(const fs::path& folder, std::vector<KeptFile>& out) {
  std::error_code error;
  const auto now = fs::file_time_type::clock::now();
  for (const std::string& name : entries_in(folder, error)) {
    std::error_code gone;  // others may remove files meanwhile
    const fs::path path = folder / name;
    const KeptFile file{path, fs::last_write_time(path, gone),
                        gone ? 0 : fs::file_size(path, gone)};
    if (gone || !fs::is_regular_file(path, gone)) continue;
    if (is_hexadecimal(name, kFileDigits)) out.push_back(file);
    const bool is_unfinished = name.size() > kFileDigits && name.ends_with(kUnfinished) &&
                               is_hexadecimal(name.substr(0, kFileDigits), kFileDigits);
    if (is_unfinished && now - file.used > kAbandoned) fs::remove(file.path, gone);
  }
}

std::vector<KeptFile> files_in(const fs::path& folder) {
  std::vector<KeptFile> out;
  std::error_code error;
  for (const std::string& name : entries_in(folder, error)) {
    if (is_hexadecimal(name, kFolderDigits)) add_files_in(folder / name, out);
  }
  return out;
}

std::string hexadecimal(std::uint64_t word) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out(16, '0');
  for (std::size_t i = out.size(); i-- > 0; word >>= 4U) out[i] = kDigits[word & 15U];
  return out;
}

void note_use(const fs::path& path) {
  std::error_code error;
  const auto now = fs::file_time_type::clock::now();
  if (now - fs::last_write_time(path, error) > kFreshUse) fs::last_write_time(path, now, error);
}

}  // namespace

DiskCache::DiskCache(const CacheFolder& folder) : folder_(folder) {
  const auto fail = [&](const std::string& reason) {
    fail_usage("--cache: ", folder_.path.string(), ": ", reason,
               "; give a folder that can be written to");
  };
  std::error_code error;
  if (fs::create_directories(folder_.path, error)) {
    fs::permissions(folder_.path, fs::perms::owner_all, error);
  }
  if (error) fail("cannot make the folder: " + error.message());
  if (::access(folder_.path.c_str(), R_OK | W_OK | X_OK) != 0) {
    fail(std::generic_category().message(errno));
  }
  for (const KeptFile& file : files_in(folder_.path)) bytes_ += file.bytes;
  if (bytes_ > folder_.bytes) make_room();
}

fs::path DiskCache::path_of(const ContentDigest& key) const {
  const std::string name = hexadecimal(key.first) + hexadecimal(key.second);
  return folder_.path / name.substr(0, kFolderDigits) / name.substr(kFolderDigits);
}

std::optional<CachedAnswer> DiskCache::find(const ContentDigest& key, const std::string& name) {
  const fs::path path = path_of(key);
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  try {
    std::optional<CachedAnswer> out = read_answer(path, key, name);
    if (out) {
      note_use(path);
    } else {
      fs::remove(path, error);
    }
    return out;
  } catch (const Error&) {  // another process removed it, or the disk cannot read it
    return std::nullopt;
  }
}

void DiskCache::keep(const ContentDigest& key, const CachedAnswer& answer) {
  const std::uint64_t bytes = answer.bytes->size();
  if (bytes > folder_.bytes / kLargestShare) return;
  fs::path unfinished = path_of(key);
  {
    const std::lock_guard lock(mutex_);
    if (!can_write_) return;
    unfinished += text(".", static_cast<std::int64_t>(::getpid()), "-", ++written_, kUnfinished);
  }
  std::error_code error;
  bool is_kept = write(unfinished, key, answer);
  if (is_kept) fs::rename(unfinished, path_of(key), error);
  is_kept = is_kept && !error;
  if (!is_kept) fs::remove(unfinished, error);
  const std::lock_guard lock(mutex_);
  can_write_ = can_write_ && is_kept;
  if (is_kept) count(bytes + sizeof(Tail::Bytes) + answer.version.size());
}

bool DiskCache::write(const fs::path& path, const ContentDigest& key, const CachedAnswer& answer) {
  std::error_code error;
  fs::create_directory(path.parent_path(), error);
  const FileDescriptor file(
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR));
  return file.valid() && write_answer(file.get(), key, answer);
}

/// REQUIRES: the caller has the lock.
void DiskCache::count(std::uint64_t bytes) {
  bytes_ += bytes;
  if (bytes_ > folder_.bytes) make_room();
}

/// When other processes do the same at the same time, more is removed than has to be.
void DiskCache::make_room() {
  std::vector<KeptFile> files = files_in(folder_.path);
  std::sort(files.begin(), files.end(), [](const KeptFile& a, const KeptFile& b) {
    return std::tie(a.used, a.path) < std::tie(b.used, b.path);
  });
  bytes_ = 0;
  for (const KeptFile& file : files) bytes_ += file.bytes;
  const auto left = static_cast<std::uint64_t>(kLeftShare * static_cast<double>(folder_.bytes));
  for (const KeptFile& file : files) {
    if (bytes_ <= left) break;
    std::error_code error;
    fs::remove(file.path, error);
    bytes_ -= file.bytes;
  }
}

}  // namespace mw::io
