// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads boxes of numbers and keeps those that are sizes.
#include "engine/labels/size_image.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "io/file/errors.h"
#include "kernels/core/index.h"

namespace mw::engine {

namespace {

/// The most voxels that are read at a time where all of an image is: a plane of a large one would
/// take more memory than a run may have.
constexpr std::int64_t kPieceVoxels = 1 << 16;

/// Returns whether both files say where they lie in the world, and not in the same place.
bool is_elsewhere(const io::VolumeSpace& image, const io::VolumeSpace& labels) {
  const bool both_tell =
      image.frame != io::WorldFrame::kOwn && labels.frame != io::WorldFrame::kOwn;
  return both_tell && !is_same_place(in_frame(image, labels.frame), labels);
}

}  // namespace

SizeImage::SizeImage(const io::LabelVolume& image, const io::VolumeInfo& labels, std::string file)
    : numbers_(dynamic_cast<const io::NumberVolume*>(&image)), shape_(image.info().shape) {
  if (numbers_ == nullptr) {
    io::fail_input(file, {}, "numbers of a " + image.info().format + " file are not read here",
                   "give sizes as .npy, NIfTI, NRRD or MetaImage, and the whole grid");
  }
  const Index3 &a = shape_, &b = labels.shape;
  if (a != b) {
    io::fail_input(file, {},
                   io::text("has ", a.x, " x ", a.y, " x ", a.z, " voxels, the labels have ", b.x,
                            " x ", b.y, " x ", b.z),
                   "give a size for each voxel of the labels");
  }
  if (!is_elsewhere(image.info().space, labels.space)) return;
  io::fail_input(file, {}, "lies elsewhere in the world than the labels, by what the files say",
                 "resample it onto the grid of the labels, or save it as .npy if it is on it");
}

SizeImage SizeImage::scaled(double factor) const {
  SizeImage out = *this;
  out.factor_ *= factor;
  return out;
}

SizeImage SizeImage::part(const Box3& voxels) const {
  SizeImage out = *this;
  out.first_ = first_ + voxels.lo;
  out.shape_ = voxels.shape();
  return out;
}

std::vector<double> SizeImage::read(const Box3& box, Index3 lattice) const {
  const Index3 layers{lattice.x / shape_.x, lattice.y / shape_.y, lattice.z / shape_.z};
  const Box3 below{{box.lo.x / layers.x, box.lo.y / layers.y, box.lo.z / layers.z},
                   {(box.hi.x - 1) / layers.x + 1, (box.hi.y - 1) / layers.y + 1,
                    (box.hi.z - 1) / layers.z + 1}};
  std::vector<double> coarse(static_cast<std::size_t>(below.voxels()));
  numbers_->read_numbers({first_ + below.lo, first_ + below.hi}, coarse);
  std::vector<double> out;
  out.reserve(static_cast<std::size_t>(box.voxels()));
  for_each_index(box, [&](Index3 v) {
    const Index3 voxel{v.x / layers.x, v.y / layers.y, v.z / layers.z};
    const double size = factor_ * coarse[static_cast<std::size_t>(below.offset(voxel))];
    out.push_back(size > 0.0 ? size : std::numeric_limits<double>::infinity());
  });
  return out;
}

std::uint64_t SizeImage::fingerprint() const {
  constexpr std::uint64_t kPrime = 1099511628211U;  // FNV-1a
  std::uint64_t sum = 14695981039346656037U;
  each_size([&](double size) { sum = (sum ^ std::bit_cast<std::uint64_t>(size)) * kPrime; });
  return sum;
}

double SizeImage::least() const {
  double least = std::numeric_limits<double>::infinity();
  each_size([&](double size) { least = std::min(least, size); });
  return least;
}

std::uint64_t SizeImage::voxels_below(double size) const {
  std::uint64_t count = 0;
  each_size([&](double asked) { count += asked < size ? 1U : 0U; });
  return count;
}

/// Reads whole rows, as many as fit into a piece, or pieces of one row where it does not fit.
template <typename Visit>
void SizeImage::each_size(Visit visit) const {
  const std::int64_t row = std::min(shape_.x, kPieceVoxels);
  const std::int64_t rows = std::min(shape_.y, kPieceVoxels / row);
  for_each_index(
      Index3{(shape_.x + row - 1) / row, (shape_.y + rows - 1) / rows, shape_.z},
      [&](Index3 piece) {
        const Index3 lo{piece.x * row, piece.y * rows, piece.z};
        const Index3 hi{std::min(lo.x + row, shape_.x), std::min(lo.y + rows, shape_.y), lo.z + 1};
        for (const double size : read({lo, hi}, shape_)) visit(size);
      });
}

}  // namespace mw::engine
