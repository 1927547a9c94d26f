// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Work files in memory whose power can be cut and whose disk can fail.
#pragma once

#include "engine/store/journal/work_file.h"
#include "kernels/core/error.h"
#include "tests/testing.h"

namespace mw::engine::test {

/// Files that forget what was not synced.  After cut_power() they hold what was synced, and of each
/// sector written since either the old or the new bytes, at random.
class VolatileFiles : public WorkFiles {
 public:
  static constexpr std::size_t kSectorBytes = 512;
  using Bytes = std::vector<std::byte>;

  /// The operation with this number (counted over all files, from 0) fails, and all after it.
  std::uint64_t fail_at = ~std::uint64_t{0};
  std::uint64_t operations = 0;

  std::unique_ptr<WorkFile> open(const std::string& name) override {
    return std::make_unique<File>(*this, contents_[name]);
  }

  void cut_power(std::mt19937& random) {
    for (auto& [name, content] : contents_) {
      Bytes after = content.durable;
      after.resize(random() % 2 == 0 ? content.now.size() : content.durable.size());
      for (std::size_t at = 0; at < after.size() && at < content.now.size(); at += kSectorBytes) {
        if (random() % 2 == 0) continue;
        const std::size_t end = std::min({at + kSectorBytes, after.size(), content.now.size()});
        std::copy(content.now.begin() + static_cast<long>(at),
                  content.now.begin() + static_cast<long>(end),
                  after.begin() + static_cast<long>(at));
      }
      content.now = content.durable = std::move(after);
      content.written.clear();
    }
    fail_at = ~std::uint64_t{0};
  }

  [[nodiscard]] Bytes& content(const std::string& name) { return contents_[name].now; }

 private:
  struct Content {
    Bytes now;
    Bytes durable;
    std::vector<std::pair<std::size_t, std::size_t>> written;  ///< offset, size; since the sync
  };

  class File : public WorkFile {
   public:
    File(VolatileFiles& files, Content& content) : files_(files), content_(content) {}

    [[nodiscard]] std::uint64_t size() const override { return content_.now.size(); }
    void resize(std::uint64_t size) override {
      files_.step();
      // Shortened and grown again, bytes are 0 once more.
      content_.written.emplace_back(size,
                                    content_.now.size() - std::min(size, content_.now.size()));
      content_.now.resize(size);
    }
    void write(std::uint64_t offset, std::span<const std::byte> bytes) override {
      // The write that fails is a short one: half of it arrives.
      const bool fails = files_.operations == files_.fail_at;
      const auto part = bytes.first(fails ? bytes.size() / 2 : bytes.size());
      if (offset + bytes.size() > content_.now.size()) std::abort();
      std::copy(part.begin(), part.end(), content_.now.begin() + static_cast<long>(offset));
      content_.written.emplace_back(offset, part.size());
      files_.step();
    }
    void read(std::uint64_t offset, std::uint64_t size, const UseBytes& use) const override {
      if (offset + size > content_.now.size()) std::abort();
      use(std::span<const std::byte>(content_.now).subspan(offset, size));
    }
    void prefetch(std::uint64_t, std::uint64_t) const override {}
    void sync() override {
      files_.step();
      content_.durable.resize(content_.now.size());
      for (const auto& [offset, size] : std::exchange(content_.written, {})) {
        const std::size_t end = std::min(offset + size, content_.now.size());
        if (offset >= end) continue;  // cut off since
        std::copy(content_.now.begin() + static_cast<long>(offset),
                  content_.now.begin() + static_cast<long>(end),
                  content_.durable.begin() + static_cast<long>(offset));
      }
    }

   private:
    VolatileFiles& files_;
    Content& content_;
  };

  void step() {
    if (operations++ >= fail_at) throw Error(ErrorKind::kResource, "the disk failed");
  }

  std::map<std::string, Content> contents_;
};

}  // namespace mw::engine::test
