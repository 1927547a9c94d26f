// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A folder in which the answers of servers are kept for later runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "io/codec/hasher.h"
#include "io/file/source/byte_source.h"

namespace mw::io {

struct CacheFolder {
  std::filesystem::path path;
  std::uint64_t bytes = 10ULL << 30U;  ///< the most that its files may have
};

/// An answer: some or all bytes of a file on a server.
struct CachedAnswer {
  std::shared_ptr<const ByteSource> bytes;
  std::uint64_t file_bytes = 0;  ///< of the whole file
  std::string version;           ///< of the file, as in RemotePart
};

/// Keeps each answer in a file of its own, named by the digest of its key.  A file gets its name
/// when it is complete and has a digest of its key and its content, so that what a kill, a full
/// disk or a broken one leaves, and what has another's name, is removed and never taken for an
/// answer.  When the files have more bytes than they may, those that were not used for the longest
/// time are removed.  An answer that is large against the folder, or that cannot be written, is
/// not kept.
/// Thread safety: any; several processes may share a folder.
class DiskCache {
 public:
  /// Makes the folder, for this user alone, unless it is there.
  /// ERRORS: mw::Error(kUsage) when that fails or nothing can be written there.
  explicit DiskCache(const CacheFolder& folder);

  /// Returns the answer kept for a key; errors call its bytes `name`.
  [[nodiscard]] std::optional<CachedAnswer> find(const ContentDigest& key, const std::string& name);
  void keep(const ContentDigest& key, const CachedAnswer& answer);

 private:
  [[nodiscard]] std::filesystem::path path_of(const ContentDigest& key) const;
  [[nodiscard]] bool write(const std::filesystem::path& path, const ContentDigest& key,
                           const CachedAnswer& answer);
  void count(std::uint64_t bytes);
  void make_room();

  CacheFolder folder_;
  std::mutex mutex_;
  std::uint64_t bytes_ = 0;    ///< of all files, as far as is known
  std::uint64_t written_ = 0;  ///< files that this cache wrote
  bool can_write_ = true;
};

}  // namespace mw::io
