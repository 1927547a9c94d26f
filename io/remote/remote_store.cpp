// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Files of a web server as a store.
#include "io/remote/remote_store.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>

#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/source/file_source.h"
#include "io/json/json.h"
#include "io/remote/address.h"
#include "io/store/held_bytes.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kHeldBytes = 4ULL << 20U;
/// The bytes that are read first of a file in parts; indices of shards are there.
constexpr std::size_t kFrontBytes = 16U << 10U;
/// The bytes of the largest document that is remembered, and the most answers that are.
constexpr std::uint64_t kMaxRemembered = 256U << 10U;
constexpr std::size_t kMaxAnswers = 256;
constexpr std::size_t kMaxVersions = 4096;

/// A body, in memory if it is small and else in a file.
class Body : public BodySink {
 public:
  void restart() override {
    held_.clear();
    file_.reset();
  }
  void take(std::span<const std::byte> bytes) override {
    if (!file_ && held_.size() + bytes.size() <= kHeldBytes) {
      held_.insert(held_.end(), bytes.begin(), bytes.end());
      return;
    }
    if (!file_) {
      file_.emplace(scratch_folder());
      file_->append(held_);
      held_ = {};
    }
    file_->append(bytes);
  }
  [[nodiscard]] std::unique_ptr<ByteSource> source(const std::string& name) {
    if (!file_) return std::make_unique<HeldBytes>(std::move(held_), name);
    const std::uint64_t size = file_->size();
    return std::make_unique<FileSource>(file_->release(), size, name);
  }

 private:
  std::vector<std::byte> held_;
  std::optional<ScratchFile> file_;
};

/// Reads parts of files, all of which must be of the same version of their file.
class PartReader {
 public:
  PartReader(const HttpLimits& limits, const CacheFolder* folder) : client_(limits) {
    if (folder != nullptr) cache_ = std::make_unique<DiskCache>(*folder);
  }

  [[nodiscard]] const HttpClient& client() const { return client_; }
  /// Returns the cache; null when there is none.
  [[nodiscard]] DiskCache* cache() const { return cache_.get(); }
  /// Reads bytes from offset on.  ENSURES: empty when there is no such file.
  [[nodiscard]] std::optional<RemotePart> read(const std::string& address, std::uint64_t offset,
                                               std::span<std::byte> out) const {
    auto part = cached(address, offset, out);
    if (part && !is_known_version(address, part->version)) {
      fail_input(address, {},
                 text("the file has changed on the server while it was read",
                      cache_ ? ", or since a part of it was cached" : ""),
                 text("begin the run anew when the volume is no longer written to",
                      cache_ ? ", with another folder for --cache" : ""));
    }
    return part;
  }

  /// Notes a document that tells how a store is to be read.  These are fetched in every run and are
  /// part of the keys of all that lies below them, so that answers that were kept when they were
  /// different are not found.
  void add_document(const std::string& address, std::span<const std::byte> bytes) const {
    const auto slash = address.rfind('/');
    const std::lock_guard lock(mutex_);
    documents_[address.substr(0, slash + 1)][address] = content_digest(bytes);
  }
  [[nodiscard]] ContentDigest key_of(const std::string& address, std::uint64_t offset,
                                     std::uint64_t size) const {
    DigestMaker maker;
    const std::lock_guard lock(mutex_);
    for (const auto& [folder, documents] : documents_) {
      if (!address.starts_with(folder)) continue;
      for (const auto& [name, digest] : documents) {
        maker.add(name);
        maker.add(digest);
      }
    }
    maker.add(address);
    maker.add(offset);
    maker.add(size);
    return maker.finish();
  }

 private:
  /// Reads from the cache, else from the server.
  std::optional<RemotePart> cached(const std::string& address, std::uint64_t offset,
                                   std::span<std::byte> out) const {
    if (!cache_) return client_.get_part(address, offset, out);
    const ContentDigest key = key_of(address, offset, out.size());
    if (const auto known = cache_->find(key, address)) {
      const std::uint64_t bytes = std::min<std::uint64_t>(known->bytes->size(), out.size());
      known->bytes->read_at(0, out.first(bytes));
      return RemotePart{bytes, known->file_bytes, known->version};
    }
    auto part = client_.get_part(address, offset, out);
    if (part) {
      const auto bytes = out.first(part->bytes);
      cache_->keep(key,
                   {std::make_shared<HeldBytes>(std::vector(bytes.begin(), bytes.end()), address),
                    part->file_bytes, part->version});
    }
    return part;
  }

  bool is_known_version(const std::string& address, const std::string& version) const {
    if (version.empty()) return true;
    const std::lock_guard lock(mutex_);
    if (versions_.size() >= kMaxVersions) versions_.clear();
    return versions_.emplace(address, version).first->second == version;
  }

  HttpClient client_;
  std::unique_ptr<DiskCache> cache_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::string> versions_;  ///< by address
  /// The digests of documents by their address, by the folder that they are in.
  mutable std::map<std::string, std::map<std::string, ContentDigest>> documents_;
};

/// Some bytes of a file on the server.
class RemoteBytes : public ByteSource {
 public:
  /// front has bytes from offset on that were read already.
  // More than five parameters: where bytes are, how many, what they are called, and those at hand.
  RemoteBytes(std::shared_ptr<const PartReader> reader, std::string address, std::uint64_t offset,
              std::uint64_t size, std::string label, std::vector<std::byte> front = {})
      : reader_(std::move(reader)),
        address_(std::move(address)),
        offset_(offset),
        size_(size),
        label_(std::move(label)),
        front_(std::move(front)) {}

  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] const std::string& name() const override { return label_; }
  void read_at(std::uint64_t offset, std::span<std::byte> out) const override {
    if (offset > size_ || out.size() > size_ - offset) fail_short(offset, out.size());
    if (offset + out.size() <= front_.size()) {
      std::copy_n(front_.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
      return;
    }
    const auto part = reader_->read(address_, offset_ + offset, out);
    if (!part) {
      fail_input(label_, {}, "the file is no longer on the server",
                 "get a whole copy of the store");
    }
    if (part->bytes < out.size()) fail_short(offset, out.size());
  }

 private:
  [[noreturn]] void fail_short(std::uint64_t offset, std::size_t length) const {
    fail_input(label_, {},
               text("expected ", length, " bytes at offset ", offset, ", and there are fewer"),
               "get a whole copy of the store");
  }

  std::shared_ptr<const PartReader> reader_;
  std::string address_;
  std::uint64_t offset_;
  std::uint64_t size_;
  std::string label_;
  std::vector<std::byte> front_;
};

class RemoteStore : public Store {
 public:
  RemoteStore(const HttpLimits& limits, const CacheFolder* cache)
      : reader_(std::make_shared<const PartReader>(limits, cache)) {}

  [[nodiscard]] std::unique_ptr<ByteSource> open(const std::string& name,
                                                 std::uint64_t max) const override {
    if (const auto known = remembered(name)) {
      return *known ? std::make_unique<HeldBytes>(**known, name) : nullptr;
    }
    if (reader_->cache() == nullptr) return fetch(name, max);
    constexpr std::uint64_t kWhole = ~std::uint64_t{0};
    const ContentDigest key = reader_->key_of(name, 0, kWhole);
    const auto as_source = [&](std::shared_ptr<const ByteSource> bytes) {
      const std::uint64_t size = bytes->size();
      return std::make_unique<BytesPart>(std::move(bytes), 0, size, name);
    };
    const auto known = reader_->cache()->find(key, name);
    if (known && known->bytes->size() <= max) return as_source(known->bytes);
    std::shared_ptr<const ByteSource> bytes = fetch(name, max);
    if (!bytes) return nullptr;
    reader_->cache()->keep(key, {bytes, bytes->size(), {}});
    return as_source(std::move(bytes));
  }
  [[nodiscard]] std::unique_ptr<ByteSource> open_parts(const std::string& name) const override {
    std::vector<std::byte> front(kFrontBytes);
    const auto part = reader_->read(name, 0, front);
    if (!part) return nullptr;
    front.resize(part->bytes);
    return std::make_unique<RemoteBytes>(reader_, name, 0, part->file_bytes, name,
                                         std::move(front));
  }
  [[nodiscard]] std::shared_ptr<const ByteSource> open_part(const std::string& name,
                                                            std::uint64_t offset,
                                                            std::uint64_t size,
                                                            std::string label) const override {
    return std::make_shared<RemoteBytes>(reader_, name, offset, size, std::move(label));
  }
  [[nodiscard]] std::uint64_t held_bytes(std::uint64_t max) const override {
    return std::min(max, kHeldBytes) + kFrontBytes;
  }
  [[nodiscard]] bool has_file(const std::string& name) const override {
    if (const auto known = remembered(name)) return known->has_value();
    Body body;
    return is_there(name, reader_->client().get(name, kMaxJsonBytes, body), body);
  }
  [[nodiscard]] bool has_document(const std::string& name) const override {
    if (const auto known = remembered(name)) return known->has_value();
    Body body;
    const Presence presence = reader_->client().probe(name, kMaxJsonBytes, body);
    if (presence == Presence::kRefused) {
      const std::lock_guard lock(mutex_);
      if (refused_.empty()) refused_ = name;
    }
    return is_there(name, presence, body);
  }
  [[nodiscard]] std::string refusal() const override {
    const std::lock_guard lock(mutex_);
    if (refused_.empty()) return {};
    return text("the server answers ", refused_,
                " with status 403 (forbidden): ", HttpClient::way_past_refusal(refused_));
  }
  [[nodiscard]] std::optional<bool> has_folder(const std::string& /*name*/) const override {
    return std::nullopt;
  }
  [[nodiscard]] std::optional<std::vector<std::string>> folders_in(
      const std::string& /*name*/) const override {
    return std::nullopt;
  }
  [[nodiscard]] bool is_near() const override { return false; }
  [[nodiscard]] std::string below(const std::string& name, std::string_view more) const override {
    return address_below(name, more);
  }
  [[nodiscard]] std::optional<std::pair<std::string, std::string>> above(
      const std::string& name) const override {
    return split_address(name);
  }

 private:
  /// Remembers the metadata that were fetched, since callers open them right afterwards.
  [[nodiscard]] bool is_there(const std::string& name, Presence presence, Body& body) const {
    if (presence == Presence::kTooLarge) return true;
    if (presence != Presence::kThere) {
      remember(name, std::nullopt);
      return false;
    }
    const auto source = body.source(name);
    std::vector<std::byte> document = read_prefix(*source, kMaxJsonBytes);
    reader_->add_document(name, document);
    if (document.size() <= kMaxRemembered) remember(name, std::move(document));
    return true;
  }
  /// Fetches a whole file; null when there is no such file.
  [[nodiscard]] std::unique_ptr<ByteSource> fetch(const std::string& name,
                                                  std::uint64_t max) const {
    Body body;
    switch (reader_->client().get(name, max, body)) {
      case Presence::kAbsent:
      case Presence::kRefused:  // get() throws in its place
        return nullptr;
      case Presence::kTooLarge:
        fail_input(name, {}, text("the server sends more than the ", max, " bytes it can have"),
                   "it is damaged or belongs to another store");
      case Presence::kThere:
        break;
    }
    return body.source(name);
  }
  /// The bytes of a document, or nothing when there is no such file.
  using Answer = std::optional<std::vector<std::byte>>;

  [[nodiscard]] std::optional<Answer> remembered(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    const auto found = answers_.find(name);
    if (found == answers_.end()) return std::nullopt;
    return std::make_optional<Answer>(found->second);
  }
  void remember(const std::string& name, Answer answer) const {
    const std::lock_guard lock(mutex_);
    if (answers_.size() < kMaxAnswers) answers_.emplace(name, std::move(answer));
  }

  std::shared_ptr<const PartReader> reader_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, Answer> answers_;
  mutable std::string refused_;  ///< the first document that the server refused
};

}  // namespace

Place remote_place(std::string_view address, const CacheFolder* cache, const HttpLimits& limits) {
  std::string name = web_address(address);
  return {std::make_shared<const RemoteStore>(limits, cache), std::move(name)};
}

}  // namespace mw::io
