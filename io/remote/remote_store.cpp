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

namespace mw::io {
namespace {

constexpr std::uint64_t kHeldBytes = 4ULL << 20U;
/// The front of a file that is read in parts; indices of shards are there.
constexpr std::size_t kFrontBytes = 16U << 10U;
/// The largest document that is remembered, and how many answers are.
constexpr std::uint64_t kMaxRemembered = 256U << 10U;
constexpr std::size_t kMaxAnswers = 256;
constexpr std::size_t kMaxVersions = 4096;

class HeldBytes : public ByteSource {
 public:
  HeldBytes(std::vector<std::byte> bytes, std::string name)
      : bytes_(std::move(bytes)), name_(std::move(name)) {}

  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
  [[nodiscard]] const std::string& name() const override { return name_; }
  void read_at(std::uint64_t offset, std::span<std::byte> out) const override {
    if (offset > bytes_.size() || out.size() > bytes_.size() - offset) {
      fail_input(name_, {},
                 text("expected ", out.size(), " bytes at offset ", offset, ", and the file has ",
                      bytes_.size()),
                 "get a whole copy of the store");
    }
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
  }

 private:
  std::vector<std::byte> bytes_;
  std::string name_;
};

/// A body in memory, as far as it is small.
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

/// Files by their parts, each of which has to be of the same version of its file.
class PartReader {
 public:
  explicit PartReader(const HttpLimits& limits) : client_(limits) {}

  [[nodiscard]] const HttpClient& client() const { return client_; }
  /// ENSURES: empty when there is no such file.
  [[nodiscard]] std::optional<RemotePart> read(const std::string& address, std::uint64_t offset,
                                               std::span<std::byte> out) const {
    auto part = client_.get_part(address, offset, out);
    if (part && !is_known_version(address, part->version)) {
      fail_input(address, {}, "the file has changed on the server while it was read",
                 "begin the run anew when the volume is no longer written to");
    }
    return part;
  }

 private:
  bool is_known_version(const std::string& address, const std::string& version) const {
    if (version.empty()) return true;
    const std::lock_guard lock(mutex_);
    if (versions_.size() >= kMaxVersions) versions_.clear();
    return versions_.emplace(address, version).first->second == version;
  }

  HttpClient client_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::string> versions_;  ///< by address
};

/// Some bytes of a file on the server.
class RemoteBytes : public ByteSource {
 public:
  /// front: bytes from offset on that are there already.
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
  explicit RemoteStore(const HttpLimits& limits)
      : reader_(std::make_shared<const PartReader>(limits)) {}

  [[nodiscard]] std::unique_ptr<ByteSource> open(const std::string& name,
                                                 std::uint64_t max) const override {
    if (const auto known = remembered(name)) {
      return *known ? std::make_unique<HeldBytes>(**known, name) : nullptr;
    }
    Body body;
    switch (reader_->client().get(name, max, body)) {
      case Presence::kAbsent:
        return nullptr;
      case Presence::kTooLarge:
        fail_input(name, {}, text("the server sends more than the ", max, " bytes it can have"),
                   "it is damaged or belongs to another store");
      case Presence::kThere:
        break;
    }
    return body.source(name);
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
  /// What metadata say is asked for right afterwards, so it is remembered.
  [[nodiscard]] bool has_file(const std::string& name) const override {
    if (const auto known = remembered(name)) return known->has_value();
    Body body;
    const Presence presence = reader_->client().get(name, kMaxJsonBytes, body);
    if (presence == Presence::kTooLarge) return true;
    if (presence == Presence::kAbsent) {
      remember(name, std::nullopt);
      return false;
    }
    const auto source = body.source(name);
    if (source->size() <= kMaxRemembered) remember(name, read_prefix(*source, kMaxRemembered));
    return true;
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
  /// Bytes of a document, or that there is none.
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
};

}  // namespace

Place remote_place(std::string_view address, const HttpLimits& limits) {
  return {std::make_shared<const RemoteStore>(limits), web_address(address)};
}

}  // namespace mw::io
