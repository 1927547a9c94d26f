// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Zip archives of .npy arrays, hand-made by PKWARE's APPNOTE.
#include "tests/io/volume/damaged_files.h"
#include "tests/io/volume/sample_files.h"

namespace mw::io {
namespace {

constexpr Index3 kShape{5, 4, 3};

struct Member {
  std::string name;
  std::string content;
  bool pack = false;
  bool zip64 = false;               ///< sizes and place in the 64-bit field
  std::uint64_t claimed_bytes = 0;  ///< instead of the right number, when not 0
  int flags = 0;
  int method = -1;
};

/// Little-endian number.
std::string le(std::uint64_t value, int size) {
  return number_bytes(value, size, false);
}

class ZipMaker {
 public:
  void add(const Member& m) {
    const std::string packed = m.pack ? deflated(m.content, -15) : m.content;
    const auto crc = crc32(0, reinterpret_cast<const Bytef*>(m.content.data()),
                           static_cast<uInt>(m.content.size()));
    const std::uint64_t bytes = m.claimed_bytes != 0 ? m.claimed_bytes : m.content.size();
    const auto method = static_cast<std::uint64_t>(m.method >= 0 ? m.method : m.pack ? 8 : 0);
    const std::string fields = le(45, 2) + le(static_cast<std::uint64_t>(m.flags), 2) +
                               le(method, 2) + le(0, 4) + le(crc, 4);
    const std::uint64_t index = file_.size();
    const auto narrow = [&](std::uint64_t value) { return le(m.zip64 ? 0xffffffff : value, 4); };
    const std::string local64 =
        m.zip64 ? le(1, 2) + le(16, 2) + le(bytes, 8) + le(packed.size(), 8) : "";
    const std::string extra64 = m.zip64 ? le(7, 2) + le(1, 2) + "x" + le(1, 2) + le(24, 2) +
                                              le(bytes, 8) + le(packed.size(), 8) + le(index, 8)
                                        : "";
    file_ += "PK\3\4" + fields + narrow(packed.size()) + narrow(bytes) + le(m.name.size(), 2) +
             le(local64.size(), 2) + m.name + local64 + packed;
    directory_ += "PK\1\2" + le(45, 2) + fields + narrow(packed.size()) + narrow(bytes) +
                  le(m.name.size(), 2) + le(extra64.size(), 2) + le(0, 2) + le(0, 2) + le(0, 2) +
                  le(0, 4) + narrow(index) + m.name + extra64;
    ++members_;
  }

  [[nodiscard]] std::string finished(bool zip64 = false, const std::string& comment = "") const {
    const std::uint64_t start = file_.size();
    const std::uint64_t end64 = start + directory_.size();
    std::string file = file_ + directory_;
    if (zip64) {
      file += "PK\6\6" + le(44, 8) + le(45, 2) + le(45, 2) + le(0, 4) + le(0, 4) + le(members_, 8) +
              le(members_, 8) + le(directory_.size(), 8) + le(start, 8);
      file += "PK\6\7" + le(0, 4) + le(end64, 8) + le(1, 4);
    }
    return file + "PK\5\6" + le(0, 4) + le(zip64 ? 0xffff : members_, 2) +
           le(zip64 ? 0xffff : members_, 2) + le(zip64 ? 0xffffffff : directory_.size(), 4) +
           le(zip64 ? 0xffffffff : start, 4) + le(comment.size(), 2) + comment;
  }

 private:
  std::string file_;
  std::string directory_;
  std::uint64_t members_ = 0;
};

std::string array_of(const std::vector<RawLabel>& labels) {
  return npy_file("<u2", false, "(3, 4, 5)", voxel_bytes(labels, VoxelType::kU16, false));
}

std::string archive(const std::vector<Member>& members, bool zip64 = false) {
  ZipMaker zip;
  for (const Member& member : members) zip.add(member);
  return zip.finished(zip64);
}

TEST(Npz, StoredAndDeflatedWithAndWithout64Bits) {
  const TempDir dir;
  const auto labels = sample_labels(kShape, VoxelType::kU16);
  for (const bool pack : {false, true}) {
    for (const bool zip64 : {false, true}) {
      const Member member{
          .name = "labels.npy", .content = array_of(labels), .pack = pack, .zip64 = zip64};
      const auto path = dir.file("a.npz", archive({{"readme.txt", "hello"}, member}, zip64));
      const auto volume = open_volume(path);
      EXPECT_EQ(volume->info().shape, kShape);
      expect_boxes(*volume, labels);
    }
  }
}

TEST(Npz, ACommentAndOtherNamesByContent) {
  const TempDir dir;
  const auto labels = sample_labels(kShape, VoxelType::kU16);
  ZipMaker zip;
  zip.add({.name = "a.npy", .content = array_of(labels)});
  const auto path = dir.file("a.dat", zip.finished(false, "a comment"));
  EXPECT_EQ(read_all(*open_volume(path)), labels);
}

TEST(Npz, TheDatasetIsChosenByName) {
  const TempDir dir;
  const auto labels = sample_labels(kShape, VoxelType::kU16);
  const auto others = std::vector<RawLabel>(labels.rbegin(), labels.rend());
  const auto path = dir.file("a.npz", archive({{.name = "one.npy", .content = array_of(labels)},
                                               {.name = "two.npy", .content = array_of(others)}}));
  for (const char* name : {"two", "two.npy"}) {
    EXPECT_EQ(read_all(*open_volume(path, {.dataset = name})), others);
  }
  expect_error(ErrorKind::kInput, {"a.npz", "one, two", "--dataset"},
               [&] { static_cast<void>(open_volume(path)); });
  expect_error(ErrorKind::kInput, {"a.npz", "three", "one, two"},
               [&] { static_cast<void>(open_volume(path, {.dataset = "three"})); });
}

TEST(Npz, WhatIsWrongIsNamed) {
  const TempDir dir;
  const std::string array = array_of(sample_labels(kShape, VoxelType::kU16));
  const auto refuse = [&](const std::string& content, std::vector<std::string> pieces) {
    const auto path = dir.file("a.npz", content);
    pieces.push_back(path.string());
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(open_volume(path)); });
  };
  const auto refuse_member = [&](const Member& member, const std::vector<std::string>& pieces) {
    refuse(archive({member}), pieces);
  };
  refuse("PK", {"zip directory"});
  refuse(archive({{"a.txt", "text"}}), {"npz arrays", "none"});
  refuse(archive({{"a.npy", array}}).substr(0, 200), {"zip directory", "end record"});
  refuse_member({.name = "a.npy", .content = array, .flags = 1}, {"a.npy", "encrypted"});
  refuse_member({.name = "a.npy", .content = array, .method = 12}, {"a.npy", "method 12"});
  refuse_member({.name = "a.npy", .content = "no array at all"}, {"a.npy", "npy magic"});
  for (const bool pack : {false, true}) {
    std::string bad = archive({{.name = "a.npy", .content = array, .pack = pack}});
    bad[bad.find("NUMPY") == std::string::npos ? 80 : bad.find("NUMPY") + 130] ^= 1;
    refuse(bad, {"a.npy"});
  }
  std::string bad = archive({{.name = "a.npy", .content = array}});
  bad[bad.find("NUMPY") + 130] ^= 1;
  refuse(bad, {"a.npy", "checksum"});
}

/// A small archive that claims much, in its own numbers and in those of the array within.
TEST(Npz, BombsAreRefusedBeforeTheyAreUnpacked) {
  const TempDir dir;
  const auto refuse = [&](const Member& member, std::vector<std::string> pieces) {
    const auto path = dir.file("a.npz", archive({member}, member.zip64));
    pieces.push_back(path.string());
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(open_volume(path)); });
  };
  const std::string zeros(1 << 22, '\0');
  const std::string small = npy_file("|u1", false, "(2, 2, 2)", zeros);
  refuse({.name = "a.npy", .content = small, .pack = true}, {"8", "the member has"});
  const std::string huge = npy_file("|u1", false, "(1000000, 1000000, 1000)", zeros);
  refuse({.name = "a.npy", .content = huge, .pack = true}, {"1000000000000"});
  refuse({.name = "a.npy",
          .content = huge,
          .pack = true,
          .zip64 = true,
          .claimed_bytes = 1'000'000'000'000'000 + huge.size() - zeros.size()},
         {"cannot hold enough"});
}

TEST(Npz, DamagedFilesAreReadOrRefused) {
  const TempDir dir;
  const std::string array = array_of(sample_labels(kShape, VoxelType::kU16));
  for (const bool pack : {false, true}) {
    for (const bool zip64 : {false, true}) {
      const Member member{.name = "a.npy", .content = array, .pack = pack, .zip64 = zip64};
      damage_everywhere(dir, "a.npz", archive({member}, zip64));
    }
  }
}

}  // namespace
}  // namespace mw::io
