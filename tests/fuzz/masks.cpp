// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Masks that overlap, and scores of labels: files out of which labels have to be made.
#include <algorithm>
#include <map>

#include "io/volume/masks/open_masks.h"
#include "io/volume/nifti/open_nifti.h"
#include "io/volume/nrrd/open_nrrd.h"
#include "io/volume/number_volume.h"
#include "io/volume/open_volume.h"
#include "tests/fuzz/all_targets.h"
#include "tests/fuzz/byte_file.h"
#include "tests/fuzz/choices.h"
#include "tests/fuzz/file_tree.h"
#include "tests/fuzz/look_at_volume.h"

namespace mw::fuzz {
namespace {

using Labels = std::vector<RawLabel>;

/// A few voxels at the first corner.
Box3 corner_of(const io::LabelVolume& volume) {
  const Index3 n = volume.info().shape;
  return {{0, 0, 0},
          {std::min<std::int64_t>(n.x, 9), std::min<std::int64_t>(n.y, 8),
           std::min<std::int64_t>(n.z, 7)}};
}

Labels labels_of(const io::LabelVolume& volume) {
  const Box3 box = corner_of(volume);
  Labels out(static_cast<std::size_t>(box.voxels()));
  volume.read(box, out);
  return out;
}

/// A voxel of one mask has its label by any rule; one of several has the labels of the first and
/// the last of them, or one that tells of all of them.
void check_sets(const Labels& first, const Labels& last, const Labels& all) {
  std::map<RawLabel, std::pair<RawLabel, RawLabel>> ends;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::pair own(first[i], last[i]);
    require(ends.emplace(all[i], own).first->second == own, "a label stands for one set of masks");
    if (own.first == own.second) {
      require(all[i] == own.first, "a voxel of one mask has its label");
    } else {
      require(0 < own.first && own.first < own.second, "masks have their order");
      require(all[i] > own.second, "labels of sets are behind those of masks");
    }
  }
}

/// Opens the masks by each rule, and holds the labels against each other.  open(options): a volume.
template <class Open>
void check_rules(Open open) {
  const auto by_rule = [&](io::Overlap rule, Labels& labels) {
    return ends_well([&] {
      const auto volume = open(io::OpenOptions{.overlap = rule});
      look_at(*volume);
      labels = labels_of(*volume);
    });
  };
  Labels apart, first, last, all;
  const bool are_apart = by_rule(io::Overlap::kRefused, apart);
  if (!by_rule(io::Overlap::kFirst, first)) return;
  require(by_rule(io::Overlap::kLast, last), "by any rule masks are read or not");
  require(by_rule(io::Overlap::kAll, all), "sets of masks are read like masks");
  check_sets(first, last, all);
  require(!are_apart || (apart == first && first == last), "without overlaps no rule matters");
}

/// The label of each voxel is the first one with the highest score.
void check_scores(const io::LabelVolume& volume) {
  const io::LabelScores* const scores = volume.scores();
  require(scores != nullptr, "labels out of scores show these");
  const Box3 box = corner_of(volume);
  const Labels labels = labels_of(volume);
  std::vector<double> best(labels.size()), next(labels.size());
  Labels found(labels.size());
  scores->read_scores(0, box, best);
  for (RawLabel label = 1; label < scores->labels(); ++label) {
    scores->read_scores(label, box, next);
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (next[i] > best[i]) found[i] = label;
      best[i] = std::max(best[i], next[i]);
    }
  }
  require(labels == found, "a voxel has the label of its highest score");
}

/// The paths of what is in the folder, as a list of masks has them.
std::string listed(const std::filesystem::path& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    paths.push_back(entry.path().string());
  }
  std::ranges::sort(paths);
  std::string out;
  for (const std::string& path : paths) out += (out.empty() ? "" : ",") + path;
  return out;
}

}  // namespace

/// A folder of files, each of which is a mask.
void fuzz_masks(Bytes bytes) {
  const FileTree files(bytes);
  if (!io::is_mask_folder(files.path())) return;
  check_rules(
      [&](const io::OpenOptions& options) { return io::open_mask_folder(files.path(), options); });
}

/// A NIfTI or NRRD file whose layers are masks.
void fuzz_layers(Bytes bytes) {
  const auto open = io::has_nrrd_magic(bytes) ? io::open_nrrd : io::open_nifti;
  check_rules([&](const io::OpenOptions& options) {
    return open(std::make_unique<ByteFile>(bytes), options);
  });
}

/// The first byte says what the numbers are, the others are the files that have them.
void fuzz_scores(Bytes bytes) {
  Choices choices(bytes);
  const auto values =
      choices.below(2) == 0 ? io::VoxelValues::kProbabilities : io::VoxelValues::kDistances;
  const FileTree files(choices.rest());
  const std::string list = listed(files.path());
  if (list.empty()) return;
  ends_well([&] {
    const auto volume = io::open_volume(list, {.values = values, .cache_bytes = 1 << 20});
    look_at(*volume);
    check_scores(*volume);
  });
}

}  // namespace mw::fuzz
