// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the fuzzers begin with, of formats in pieces: read by many threads, and damaged everywhere.
#include <thread>

#include "tests/fuzz/file_tree.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

struct Format {
  const char* name;    ///< of its folder below seeds/
  const char* ending;  ///< empty: stores of several files
};

/// A file or a folder of a seed's bytes.
class Seed {
 public:
  Seed(const Format& format, const std::string& content)
      : tree_(std::as_bytes(std::span(*format.ending == '\0' ? content : ""))),
        path_(tree_.path()) {
    if (*format.ending == '\0') return;
    path_ /= std::string("seed") + format.ending;
    write_file(path_, content);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::vector<std::filesystem::path> files() const {
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(tree_.path())) {
      if (entry.is_regular_file()) out.push_back(entry.path());
    }
    return out;
  }

 private:
  fuzz::FileTree tree_;
  std::filesystem::path path_;
};

class Seeds : public testing::TestWithParam<Format> {
 protected:
  /// Calls visit with each seed that is sound; there are at least two.
  static void each_sound(const std::function<void(const Seed&)>& visit) {
    const auto folder =
        std::filesystem::path(MW_SOURCE_DIR) / "tests" / "fuzz" / "seeds" / GetParam().name;
    int sound = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const Seed seed(GetParam(), content_of(entry.path()));
      if (is_refused(seed.path())) continue;
      SCOPED_TRACE(entry.path());
      ++sound;
      visit(seed);
    }
    EXPECT_GE(sound, 2);
  }
};

TEST_P(Seeds, DamagedAreReadOrRefused) {
  each_sound([](const Seed& seed) {
    int refused = 0;
    for (const std::filesystem::path& file : seed.files()) {
      const std::size_t step = 1 + std::filesystem::file_size(file) / 100;
      refused += refused_when_damaged(seed.path(), file, step);
    }
    EXPECT_GT(refused, 60);
  });
}

TEST_P(Seeds, ManyThreadsReadOne) {
  each_sound([](const Seed& seed) {
    for (const std::uint64_t cache : {0U, 1U << 20U}) {
      const auto volume = open_volume(seed.path(), {.cache_bytes = cache});
      const std::vector<RawLabel> labels = read_all(*open_volume(seed.path()));
      std::vector<std::thread> threads;
      for (unsigned i = 0; i < 4; ++i) {
        threads.emplace_back([&, i] { expect_boxes(*volume, labels, i, 20); });
      }
      for (std::thread& thread : threads) thread.join();
    }
  });
}

INSTANTIATE_TEST_SUITE_P(All, Seeds,
                         testing::Values(Format{"tiff", ".tif"}, Format{"png", ".png"},
                                         Format{"zarr", ""}, Format{"n5", ""},
                                         Format{"precomputed", ""}, Format{"mgh", ".mgh"},
                                         Format{"vti", ".vti"}, Format{"zarr_zip", ".zip"}),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace mw::io
