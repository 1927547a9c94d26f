// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Formats that are read from their end, inside of .gz files that unpack to more than they should.
#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/volume/hdf5/open_hdf5.h"
#include "io/volume/tiff/open_tiff.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

using Open = std::unique_ptr<LabelVolume> (*)(std::unique_ptr<ByteSource>, const OpenOptions&);

struct Bomb {
  const char* name;
  std::string head;
  Open open;
};

/// Each begins as its format does, and goes on with 200 MB of nothing.
TEST(GzipBombs, AreGivenUpWhenTheyHaveFilledTheirRoom) {
  const TempDir dir;
  constexpr std::uint64_t kMax = 8 << 20;
  const std::vector<Bomb> bombs{{"a.tif.gz", std::string("II*\0\x08\0\0\0", 8), open_tiff},
                                {"a.h5.gz", "\x89HDF\r\n\x1a\n", open_hdf5}};
  for (const Bomb& bomb : bombs) {
    const auto path = dir.file(bomb.name, gzip(bomb.head + std::string(200'000'000, '\0')));
    ASSERT_LE(std::filesystem::file_size(path), 1U << 20);
    expect_error(ErrorKind::kResource, {bomb.name, "more than 8388608 bytes", "TMPDIR"}, [&] {
      static_cast<void>(bomb.open(
          std::make_unique<InflatedSource>(std::make_unique<FileSource>(path), 0, kMax), {}));
    });
  }
}

}  // namespace
}  // namespace mw::io
