// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Masks that overlap, in files of their own, in layers and one behind the other, against sets of
// masks that are found voxel by voxel.
#include "io/volume/masks/open_masks.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "io/volume/open_volume.h"
#include "tests/io/volume/sample_files.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

constexpr Index3 kShape{5, 4, 3};
constexpr std::size_t kVoxels = 60;

using Masks = std::vector<std::vector<bool>>;

Masks random_masks(std::mt19937& random, std::size_t count) {
  Masks out(count, std::vector<bool>(kVoxels));
  for (std::vector<bool>& mask : out) {
    const std::uint32_t density = 1 + static_cast<std::uint32_t>(random() % 6);
    for (std::size_t v = 0; v < kVoxels; ++v) mask[v] = random() % 8 < density;
  }
  return out;
}

std::string bytes_of(const std::vector<bool>& mask, char value) {
  std::string out;
  for (const bool is_in : mask) out += is_in ? value : '\0';
  return out;
}

std::string nifti(const std::string& voxels, std::int64_t volumes = 1) {
  NiftiSample sample;
  sample.dim = {volumes > 1 ? 4 : 3, kShape.x, kShape.y, kShape.z, volumes, 1, 1, 1};
  return sample.header() + voxels;
}

std::string name_of(std::size_t mask) {
  return "m" + std::to_string(mask + 1);
}

/// Labels and names by the sets of masks that each voxel is in.
struct Expected {
  std::vector<RawLabel> labels;
  std::map<RawLabel, std::string> names;
};

Expected expected(const Masks& masks, Overlap overlap) {
  Expected out;
  std::set<std::vector<std::size_t>> several;
  std::vector<std::vector<std::size_t>> sets(kVoxels);
  for (std::size_t v = 0; v < kVoxels; ++v) {
    for (std::size_t m = 0; m < masks.size(); ++m) {
      if (masks[m][v]) sets[v].push_back(m);
    }
    if (sets[v].size() > 1) several.insert(sets[v]);
  }
  for (std::size_t m = 0; m < masks.size(); ++m) out.names[m + 1] = name_of(m);
  std::map<std::vector<std::size_t>, RawLabel> numbers;
  for (const auto& set : several) {
    numbers[set] = masks.size() + 1 + numbers.size();
    if (overlap != Overlap::kAll) continue;
    std::string& name = out.names[numbers[set]];
    for (const std::size_t m : set) name += (name.empty() ? "" : " + ") + name_of(m);
  }
  for (const auto& set : sets) {
    if (set.empty()) {
      out.labels.push_back(0);
    } else if (overlap == Overlap::kAll && set.size() > 1) {
      out.labels.push_back(numbers[set]);
    } else {
      out.labels.push_back((overlap == Overlap::kLast ? set.back() : set.front()) + 1);
    }
  }
  return out;
}

void expect_labels(const LabelVolume& volume, const Expected& wanted, bool has_names) {
  EXPECT_EQ(volume.info().shape, kShape);
  EXPECT_EQ(read_all(volume), wanted.labels);
  if (!has_names) return;
  for (const auto& [label, name] : wanted.names) EXPECT_EQ(volume.info().names.name(label), name);
  EXPECT_EQ(volume.info().names.rows().size(), wanted.names.size());
}

std::string segmentation(const Masks& masks, bool layers_first) {
  const std::string count = std::to_string(masks.size()), none = "none",
                    vectors = "(1,0,0) (0,1,0) (0,0,1)";
  std::string out = "NRRD0004\ntype: uchar\nencoding: raw\ndimension: 4\n";
  out += "sizes: " + (layers_first ? count + " 5 4 3" : "5 4 3 " + count) + "\n";
  out += "space directions: " + (layers_first ? none + " " + vectors : vectors + " " + none) + "\n";
  for (std::size_t m = 0; m < masks.size(); ++m) {
    const std::string key = "Segment" + std::to_string(m) + "_";
    out += key + "Layer:=" + std::to_string(m) + "\n" + key + "LabelValue:=7\n" + key +
           "Name:=" + name_of(m) + "\n";
  }
  out += "\n";
  if (layers_first) {
    for (std::size_t v = 0; v < kVoxels; ++v) {
      for (const auto& mask : masks) out += mask[v] ? '\7' : '\0';
    }
  } else {
    for (const auto& mask : masks) out += bytes_of(mask, '\7');
  }
  return out;
}

TEST(Masks, BecomeLabelsWhereverTheyAre) {
  std::mt19937 random(81);
  for (int trial = 0; trial < 40; ++trial) {
    const Masks masks = random_masks(random, 2 + random() % 12);
    const TempDir dir;
    std::string list, voxels;
    std::filesystem::create_directory(dir.path() / "all");
    for (std::size_t m = 0; m < masks.size(); ++m) {
      const std::string bytes = bytes_of(masks[m], static_cast<char>(1 + m));
      const auto path = dir.file("all/" + name_of(m) + ".nii", nifti(bytes));
      list += (list.empty() ? "" : ",") + path.string();
      voxels += bytes;
    }
    dir.file("all/statistics.json", "{}");
    const auto one = dir.file("one.nii", nifti(voxels, static_cast<std::int64_t>(masks.size())));
    const auto first = dir.file("first.seg.nrrd", segmentation(masks, true)),
               last = dir.file("last.seg.nrrd", segmentation(masks, false));
    for (const Overlap overlap : {Overlap::kFirst, Overlap::kLast, Overlap::kAll}) {
      const Expected wanted = expected(masks, overlap);
      const OpenOptions options{.overlap = overlap};
      expect_labels(*open_volume(dir.path() / "all", options), wanted, true);
      expect_labels(*open_volume(list, options), wanted, true);
      expect_labels(*open_volume(one, options), wanted, false);
      expect_labels(*open_volume(first, options), wanted, true);
      expect_labels(*open_volume(last, options), wanted, true);
    }
  }
}

TEST(Masks, EndingsCountInAnyCase) {
  std::mt19937 random(83);
  const Masks masks = random_masks(random, 2);
  const TempDir dir;
  dir.file("A.NII.GZ", gzip(nifti(bytes_of(masks[0], '\1'))));
  dir.file("b.Nii", nifti(bytes_of(masks[1], '\1')));
  const auto volume = open_volume(dir.path(), {.overlap = Overlap::kFirst});
  EXPECT_EQ(read_all(*volume), expected(masks, Overlap::kFirst).labels);
  EXPECT_EQ(volume->info().names.name(1), "A");
  EXPECT_EQ(volume->info().names.name(2), "b");
}

/// A mask that is read only where it says that it has voxels.
class MaskOfSlices : public LabelVolume {
 public:
  explicit MaskOfSlices(std::vector<SliceRange> slices) : slices_(std::move(slices)) {
    info_.shape = kShape;
  }
  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override {
    const auto has = [&](const SliceRange& s) { return s.begin <= box.lo.z && box.hi.z <= s.end; };
    EXPECT_TRUE(std::any_of(slices_.begin(), slices_.end(), has)) << box.lo.z << ' ' << box.hi.z;
    std::fill(out.begin(), out.end(), 1);
  }

 private:
  std::vector<SliceRange> slices_;
  VolumeInfo info_;
};

TEST(Masks, AreReadOnlyInTheSlicesThatTheyHave) {
  const std::vector<std::vector<SliceRange>> slices{{{0, 1}, {2, 3}}, {}, {{1, 2}}};
  MaskMerger merger(MaskOfSlices({}).info(), Overlap::kRefused, "masks");
  for (const std::vector<SliceRange>& some : slices) {
    const MaskOfSlices mask(some);
    merger.add({.volume = &mask, .value = 1, .slices = some, .file = "", .name = "", .colour = {}});
  }
  const std::vector<RawLabel> labels = read_all(*merger.finish());
  for (std::size_t v = 0; v < kVoxels; ++v) EXPECT_EQ(labels[v], v / 20 == 1 ? 3U : 1U);
}

TEST(Masks, AreReadInBoxes) {
  std::mt19937 random(82);
  const Masks masks = random_masks(random, 4);
  const TempDir dir;
  const auto path = dir.file("a.seg.nrrd", segmentation(masks, true));
  const Box3 crop{{1, 0, 1}, {4, 3, 3}};
  const auto volume = open_volume(path, {.overlap = Overlap::kAll, .crop = crop});
  const Expected wanted = expected(masks, Overlap::kAll);
  std::vector<RawLabel> labels;
  for_each_index(crop, [&](Index3 v) {
    labels.push_back(wanted.labels[static_cast<std::size_t>(Box3{{0, 0, 0}, kShape}.offset(v))]);
  });
  EXPECT_EQ(read_all(*volume), labels);
}

TEST(Masks, ThatDoNotOverlapNeedNoRule) {
  const TempDir dir;
  Masks masks(2, std::vector<bool>(kVoxels));
  masks[0][3] = masks[1][4] = true;
  const auto volume = open_volume(dir.file("a.seg.nrrd", segmentation(masks, true)));
  expect_labels(*volume, expected(masks, Overlap::kFirst), true);
  EXPECT_TRUE(volume->info().note.empty());
}

TEST(Masks, InRasAndLpsMayLieInOnePlace) {
  Masks masks(2, std::vector<bool>(kVoxels));
  masks[0][3] = masks[1][4] = true;
  NiftiSample ras;
  ras.dim = {3, kShape.x, kShape.y, kShape.z, 1, 1, 1, 1};
  ras.sform_code = 1;
  ras.matrix = {{{2, 0, 0}, {0, 3, 0}, {0, 0, 4}}};
  const TempDir dir;
  const auto nrrd = [&](const std::string& frame, const std::string& origin) {
    return "NRRD0004\ntype: uchar\nencoding: raw\ndimension: 3\nsizes: 5 4 3\nspace: " + frame +
           "\nspace directions: (-2,0,0) (0,-3,0) (0,0,4)\nspace origin: " + origin + "\n\n" +
           bytes_of(masks[1], '\1');
  };
  const auto a = dir.file("a.nii", ras.header() + bytes_of(masks[0], '\1'));
  const auto b = dir.file("b.nrrd", nrrd("LPS", "(-10,-20,30)"));
  const auto ab = open_volume(a.string() + "," + b.string());
  EXPECT_EQ(read_all(*ab), expected(masks, Overlap::kFirst).labels);
  EXPECT_EQ(ab->info().space.frame, WorldFrame::kRas);
  std::swap(masks[0], masks[1]);
  const auto ba = open_volume(b.string() + "," + a.string());
  EXPECT_EQ(read_all(*ba), expected(masks, Overlap::kFirst).labels);
  EXPECT_EQ(ba->info().space.frame, WorldFrame::kLps);
  for (const auto& moved : {dir.file("c.nrrd", nrrd("LPS", "(10,20,30)")),
                            dir.file("d.nrrd", nrrd("RAS", "(-10,-20,30)"))}) {
    expect_error(ErrorKind::kInput, {moved.string(), "lies elsewhere"},
                 [&] { static_cast<void>(open_volume(a.string() + "," + moved.string())); });
  }
}

TEST(Masks, AreRefusedWithAWayOut) {
  const TempDir dir;
  Masks masks(2, std::vector<bool>(kVoxels));
  masks[0][27] = masks[1][27] = masks[1][28] = true;
  expect_not_opened(dir.file("a.seg.nrrd", segmentation(masks, true)),
                    {"'m2'", "1 of its voxels", "2,1,1", "'m1'", "--overlap"});
  std::filesystem::create_directory(dir.path() / "b");
  const std::string voxels = bytes_of(masks[0], '\1');
  dir.file("b/a.nii", nifti(voxels));
  const auto mixed = dir.file("b/c.nii", nifti('\2' + voxels.substr(1)));
  expect_not_opened(dir.path() / "b", {mixed.string(), "labels 2 and 1"});
  NiftiSample elsewhere;
  elsewhere.pixdim[1] = 0.6;
  const auto moved = dir.file("b/c.nii", elsewhere.header() + voxels);
  expect_not_opened(dir.path() / "b", {moved.string(), "lies elsewhere"});
  NiftiSample smaller;
  smaller.dim = {3, 5, 4, 2, 1, 1, 1, 1};
  dir.file("b/c.nii", smaller.header() + voxels);
  expect_not_opened(dir.path() / "b", {moved.string(), "5 x 4 x 2", "5 x 4 x 3"});
}

TEST(Masks, OnlyTheyHaveARule) {
  const TempDir dir;
  const auto path = dir.file("a.mha", "ObjectType = Image\n");
  expect_not_opened(path, {"--overlap", "NIfTI"}, {.overlap = Overlap::kFirst}, ErrorKind::kUsage);
  const std::string voxels(kVoxels, '\1');
  const std::string header = "NRRD0004\ntype: uchar\nencoding: raw\ndimension: 3\nsizes: 5 4 3\n";
  const OpenOptions options{.overlap = Overlap::kFirst};
  for (const auto& labels :
       {dir.file("a.nii", nifti(voxels)), dir.file("a.nrrd", header + "\n" + voxels)}) {
    expect_not_opened(labels, {labels.string(), "--overlap", "one label a voxel"}, options,
                      ErrorKind::kUsage);
  }
  const auto segments = dir.file("a.seg.nrrd", header + "Segment0_LabelValue:=1\n\n" + voxels);
  EXPECT_EQ(read_all(*open_volume(segments, options)), std::vector<RawLabel>(kVoxels, 1));
}

TEST(Masks, ListsAreOfFilesThatExist) {
  const TempDir dir;
  const auto a = dir.file("a.nii", ""), b = dir.file("b.nii", ""), both = dir.file("a,b.nii", "");
  EXPECT_EQ(listed_masks(a.string() + "," + b.string()).size(), 2U);
  EXPECT_TRUE(listed_masks(both).empty());
  const std::string missing = (dir.path() / "c.nii").string();
  EXPECT_TRUE(listed_masks(missing + "," + missing).empty());
  EXPECT_TRUE(listed_masks("https://host/a,b").empty());
  const auto refuse = [](const std::string& list, const std::string& reason) {
    expect_error(ErrorKind::kInput, {list, reason}, [&] { static_cast<void>(listed_masks(list)); });
  };
  refuse(a.string() + "," + missing + "," + b.string(), "names " + missing);
  refuse(a.string() + ",", "an empty name");
  EXPECT_TRUE(listed_masks(a).empty());
}

}  // namespace
}  // namespace mw::io
