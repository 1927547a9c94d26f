// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a cache finds is what it was given, while others are at work in its folder.
#include "io/remote/disk_cache.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <thread>
#include <vector>

#include "tests/temp_folder.h"

namespace mw::io {
namespace {

using mw::test::TempFolder;

class Bytes : public ByteSource {
 public:
  explicit Bytes(std::string bytes) : bytes_(std::move(bytes)) {}
  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
  [[nodiscard]] const std::string& name() const override { return bytes_; }
  void read_at(std::uint64_t offset, std::span<std::byte> out) const override {
    const auto from = std::as_bytes(std::span(bytes_)).subspan(offset, out.size());
    std::copy(from.begin(), from.end(), out.begin());
  }

 private:
  std::string bytes_;
};

ContentDigest key_of(std::uint64_t number) {
  DigestMaker maker;
  maker.add(number);
  return maker.finish();
}

/// Up to 2,000 bytes that follow from the number.
std::string bytes_of(std::uint64_t number) {
  std::mt19937_64 random(number);
  std::string out(random() % 2000, ' ');
  for (char& c : out) c = static_cast<char>(random());
  return out;
}

CachedAnswer answer_of(std::uint64_t number) {
  return {std::make_shared<Bytes>(bytes_of(number)), 3 * number,
          number % 2 == 0 ? "" : "version " + std::to_string(number)};
}

/// False when the cache has no answer; one that is another fails the test.
bool finds(DiskCache& cache, std::uint64_t number) {
  const auto found = cache.find(key_of(number), "name");
  if (!found) return false;
  EXPECT_EQ(read_whole(*found->bytes, 1 << 20), bytes_of(number));
  EXPECT_EQ(found->bytes->name(), "name");
  EXPECT_EQ(found->file_bytes, answer_of(number).file_bytes);
  EXPECT_EQ(found->version, answer_of(number).version);
  return true;
}

TEST(DiskCache, FindsWhatItKeptAndNothingElse) {
  const TempFolder folder;
  for (int run = 0; run < 2; ++run) {
    DiskCache cache({folder.path() / "a" / "b"});
    for (std::uint64_t number = 0; number < 40; ++number) {
      EXPECT_EQ(finds(cache, number), run == 1 && number % 3 != 0);
      if (number % 3 != 0) cache.keep(key_of(number), answer_of(number));
    }
  }
}

TEST(DiskCache, ExchangedFilesAreNotFound) {
  const TempFolder folder;
  DiskCache cache({folder.path()});
  std::vector<std::filesystem::path> files;
  for (std::uint64_t number = 0; number < 3; ++number)
    cache.keep(key_of(number), answer_of(number));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  ASSERT_EQ(files.size(), 3U);
  const auto aside = folder.path() / "aside";
  std::filesystem::rename(files[0], aside);
  std::filesystem::rename(files[1], files[0]);
  std::filesystem::rename(aside, files[1]);
  int found = 0;
  for (std::uint64_t number = 0; number < 3; ++number) found += finds(cache, number) ? 1 : 0;
  EXPECT_EQ(found, 1);
  for (std::uint64_t number = 0; number < 3; ++number)
    cache.keep(key_of(number), answer_of(number));
  for (std::uint64_t number = 0; number < 3; ++number) EXPECT_TRUE(finds(cache, number));
}

TEST(DiskCache, ThreadsAndProcessesShareAFolderThatIsTooSmall) {
  const TempFolder folder;
  constexpr std::uint64_t kLimit = 40'000;
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < 6; ++t) {
    threads.emplace_back([&, t] {
      DiskCache cache({folder.path(), kLimit});
      std::mt19937 random(t);
      for (int i = 0; i < 300; ++i) {
        const std::uint64_t number = random() % 60;
        if (!finds(cache, number)) cache.keep(key_of(number), answer_of(number));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  DiskCache cache({folder.path(), kLimit});
  std::uint64_t bytes = 0, found = 0;
  for (std::uint64_t number = 0; number < 60; ++number) {
    if (!finds(cache, number)) continue;
    ++found;
    bytes += bytes_of(number).size();
  }
  EXPECT_LE(bytes, kLimit);
  EXPECT_GT(found, 10U);
}

TEST(DiskCache, AnswersThatAreALargePartOfItAreNotKept) {
  const TempFolder folder;
  DiskCache cache({folder.path(), 4000});
  cache.keep(key_of(1), {std::make_shared<Bytes>(std::string(501, 'a')), 501, ""});
  EXPECT_FALSE(cache.find(key_of(1), "name"));
}

}  // namespace
}  // namespace mw::io
