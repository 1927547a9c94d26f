// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads images tile by tile, and adds up what each tet gets from a tile.
#include "engine/sample/image_sampler.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/file/errors.h"
#include "io/volume/volume_space.h"
#include "kernels/sample/tet_overlap.h"

namespace mw::engine {
namespace {

/// A smaller share of a tet, or of a voxel if that is smaller, counts as nothing, since corners are
/// rounded.
constexpr double kLeastShare = 1e-6;
/// Tiles begin at multiples of this, so that sums do not depend on what is read at once.
constexpr std::int64_t kTile = 64;
/// How many tets are looked at together; for Statistic::kMode, whose tets hold lists of values,
/// fewer.
constexpr std::size_t kMostTets = 4096, kMostTetsOfMode = 128;
/// The most different values of one tet for Statistic::kMode.
constexpr std::size_t kMostValues = 4096;

/// Values and their volumes, ascending by value.
using Shares = std::vector<std::pair<double, double>>;

/// What is known of a tet so far.
struct Tally {
  double volume = 0;  ///< volume of the voxels that count
  double first = 0;   ///< a value; others are summed as differences, so that equal ones stay exact
  double sum = 0;
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  Shares shares;
};

void add_share(Shares& shares, double value, double volume) {
  const auto at = std::lower_bound(
      shares.begin(), shares.end(), value,
      [](const std::pair<double, double>& share, double x) { return share.first < x; });
  if (at != shares.end() && at->first == value) {
    at->second += volume;
  } else {
    shares.insert(at, {value, volume});
  }
}

double largest_share(const Shares& shares) {
  const auto most =
      std::max_element(shares.begin(), shares.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most->first;
}

double value_of(const Tally& tally, Statistic statistic) {
  switch (statistic) {
    case Statistic::kMin:
      return tally.least;
    case Statistic::kMax:
      return tally.most;
    case Statistic::kMode:
      return largest_share(tally.shares);
    case Statistic::kMean:
      break;
  }
  return tally.first + tally.sum / tally.volume;
}

/// Throws if an image that has the voxels of the labels' file lacks some of those that are meshed.
void require_all_voxels(const SampleImage& sample, const io::VolumeInfo& labels) {
  const Index3 has = sample.image->info().shape, needs = labels.first + labels.shape;
  if (has.x >= needs.x && has.y >= needs.y && has.z >= needs.z) return;
  io::fail_input(sample.file, {},
                 io::text("has ", has.x, " x ", has.y, " x ", has.z,
                          " voxels, and the labels reach to ", needs.x, " x ", needs.y, " x ",
                          needs.z, ": it does not say where it lies, so it must have theirs"),
                 "give an image on the grid of the labels, or one in a format that has a place");
}

/// Returns where the image is in the world of the labels.  An image without a place has the voxels
/// of the labels' file.
io::VolumeSpace space_in(const SampleImage& sample, const io::VolumeInfo& labels) {
  const io::VolumeInfo& image = sample.image->info();
  if (!image.is_placed) {
    require_all_voxels(sample, labels);
    return moved_to(labels.space, Index3{} - labels.first);
  }
  const std::string &own = image.space.unit, &wanted = labels.space.unit;
  if (!own.empty() && !wanted.empty() && own != wanted) {
    io::fail_usage("--sample ", sample.name, ": ", sample.file, " is in ", own,
                   ", the labels are in ", wanted, ": convert one of them");
  }
  return in_frame(image.space, labels.space.frame);
}

/// Reads the numbers of a box.
void read_numbers(const io::LabelVolume& image, const Box3& box, std::vector<double>& out) {
  out.resize(static_cast<std::size_t>(box.voxels()));
  if (const auto* const numbers = dynamic_cast<const io::NumberVolume*>(&image)) {
    numbers->read_numbers(box, out);
    return;
  }
  std::vector<RawLabel> labels(out.size());
  image.read(box, labels);
  const bool is_signed = has_signed_labels(image.info());
  std::transform(labels.begin(), labels.end(), out.begin(), [&](RawLabel label) {
    return is_signed ? static_cast<double>(static_cast<std::int64_t>(label))
                     : static_cast<double>(label);
  });
}

}  // namespace

/// Some tets in one image.
class ImageSampler::Sampling {
 public:
  Sampling(const SampleImage& sample, const io::VolumeSpace& space,
           std::span<const io::Position> positions, std::span<const io::TetRows> tets)
      : sample_(sample), tets_(tets), tallies_(tets.size()), boxes_(tets.size()) {
    points_.reserve(positions.size());
    for (const io::Position& p : positions) points_.push_back(to_corner(space, p));
    for (std::size_t t = 0; t < tets.size(); ++t) {
      boxes_[t] = overlap(t).box(sample.image->info().shape);
      all_ = hull(all_, boxes_[t]);
    }
  }

  void run(Crew& crew) {
    if (is_empty(all_)) return;
    const Index3 edge{kTile, kTile, kTile};
    std::vector<double> numbers;
    for_each_index(cells_of(all_, edge), [&](Index3 cell) {
      const Index3 lo{cell.x * kTile, cell.y * kTile, cell.z * kTile};
      const Box3 tile = intersection(all_, {lo, lo + edge});
      read_numbers(*sample_.image, tile, numbers);
      crew.run([&] {
        tbb::parallel_for(std::size_t{0}, tets_.size(),
                          [&](std::size_t t) { look_at(t, tile, numbers); });
      });
    });
  }

  /// Writes the values into a column of the rows, and counts.
  void put(std::span<double> rows, std::size_t column, SampleFacts& facts) const {
    const std::size_t columns = rows.size() / std::max<std::size_t>(1, tets_.size());
    for (std::size_t t = 0; t < tets_.size(); ++t) {
      const Tally& tally = tallies_[t];
      const double volume = overlap(t).volume();
      double& out = rows[t * columns + column];
      out = std::numeric_limits<double>::quiet_NaN();
      if (tally.volume > 0 && tally.volume >= kLeastShare * volume) {
        out = value_of(tally, sample_.statistic);
      }
      ++facts.tets;
      if (!std::isfinite(out)) {
        out = std::numeric_limits<double>::quiet_NaN();
        ++facts.outside;
        continue;
      }
      if (tally.volume < (1 - kLeastShare) * volume) ++facts.partly_outside;
      const bool is_first = facts.tets == facts.outside + 1;
      facts.least = is_first ? out : std::min(facts.least, out);
      facts.most = is_first ? out : std::max(facts.most, out);
    }
  }

 private:
  [[nodiscard]] TetOverlap overlap(std::size_t t) const {
    const auto [a, b, c, d] = tets_[t];
    return TetOverlap({points_[a], points_[b], points_[c], points_[d]});
  }

  void look_at(std::size_t t, const Box3& tile, const std::vector<double>& numbers) {
    const Box3 part = intersection(boxes_[t], tile);
    if (is_empty(part)) return;
    const TetOverlap tet = overlap(t);
    tet.cut(part, [&](const CoveredRow& row) {
      const double* const values = numbers.data() + tile.offset(row.first);
      for (std::size_t i = 0; i < row.volumes.size(); ++i) {
        if (row.volumes[i] > 0 && std::isfinite(values[i])) {
          add(tallies_[t], values[i], row.volumes[i], kLeastShare * std::min(1.0, tet.volume()));
        }
      }
    });
  }

  void add(Tally& tally, double value, double volume, double least) const {
    if (tally.volume == 0) tally.first = value;
    tally.volume += volume;
    tally.sum += volume * (value - tally.first);
    if (volume >= least) {
      tally.least = std::min(tally.least, value);
      tally.most = std::max(tally.most, value);
    }
    if (sample_.statistic != Statistic::kMode) return;
    add_share(tally.shares, value, volume);
    if (tally.shares.size() <= kMostValues) return;
    io::fail_input(sample_.file, {},
                   io::text("more than ", kMostValues, " different values in one tet"),
                   "mode is for labels; take the mean");
  }

  const SampleImage& sample_;
  std::span<const io::TetRows> tets_;
  std::vector<ImagePoint> points_;
  std::vector<Tally> tallies_;
  std::vector<Box3> boxes_;
  Box3 all_{};
};

ImageSampler::ImageSampler(std::vector<SampleImage> images, const io::VolumeInfo& labels,
                           int threads)
    : images_(std::move(images)), threads_(threads) {
  for (const SampleImage& image : images_) {
    names_.push_back(image.name);
    spaces_.push_back(space_in(image, labels));
    facts_.push_back({.name = image.name, .file = image.file, .statistic = image.statistic});
  }
}

std::uint64_t ImageSampler::cell_of(const std::array<io::Position, 4>& corners) const {
  io::Position middle{};
  for (const io::Position& corner : corners) {
    for (std::size_t k = 0; k < 3; ++k) middle[k] += corner[k] / 4;
  }
  const io::Vector3 at = to_corner(spaces_.front(), middle);
  constexpr double kMost = 1 << 20;
  std::uint64_t out = 0;
  for (std::size_t k = 3; k-- > 0;) {
    const double tile = std::clamp(std::floor(at[k] / kTile), -kMost, kMost - 1);
    out = out << 21U | static_cast<std::uint64_t>(tile + kMost);
  }
  return out;
}

std::size_t ImageSampler::most_tets() const {
  const bool any_mode = std::any_of(images_.begin(), images_.end(), [](const SampleImage& image) {
    return image.statistic == Statistic::kMode;
  });
  return any_mode ? kMostTetsOfMode : kMostTets;
}

std::vector<double> ImageSampler::of(std::span<const io::Position> positions,
                                     std::span<const io::TetRows> tets) {
  if (!crew_) crew_.emplace(threads_);
  std::vector<double> out(tets.size() * images_.size());
  for (std::size_t i = 0; i < images_.size(); ++i) {
    Sampling sampling(images_[i], spaces_[i], positions, tets);
    sampling.run(*crew_);
    sampling.put(out, i, facts_[i]);
  }
  return out;
}

std::uint64_t ImageSampler::buffer_bytes() const {
  constexpr std::uint64_t kTileBytes = kTile * kTile * kTile * (sizeof(double) + sizeof(RawLabel));
  constexpr std::uint64_t kPerThread = std::uint64_t{64} << 10U;
  constexpr std::uint64_t kPerColumn = std::uint64_t{1} << 19U;
  constexpr std::uint64_t kPerTet = sizeof(Tally) + sizeof(Box3) + 4 * sizeof(ImagePoint);
  // A list grows to twice what is in it.
  constexpr std::uint64_t kLists = 2 * kMostTetsOfMode * kMostValues * sizeof(Shares::value_type);
  const std::uint64_t lists = most_tets() == kMostTetsOfMode ? kLists : 0;
  std::uint64_t largest = 0;
  for (const SampleImage& image : images_) {
    largest += image.image->buffer_bytes(1);  // chunks are kept from tile to tile
  }
  return largest + kTileBytes + lists + kMostTets * kPerTet + kPerColumn * (1 + images_.size()) +
         static_cast<std::uint64_t>(threads_) * kPerThread;
}

}  // namespace mw::engine
