// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds the step at which frames follow each other.
#include "io/volume/dicom/open_dicom.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/file/errors.h"

namespace mw::io {
namespace {

constexpr std::int64_t kMostSlices = 1 << 20;

/// How far from the grid a frame may lie, in steps, as coordinates are texts of 16 characters.
constexpr double kSlack = 0.05;

/// How far a stated spacing may be from the step of the frames, as a share, since it may be
/// rounded.
constexpr double kRoundedSpacing = 0.01;

/// Slices that are at most this far from each other, in mm, lie at one place.
constexpr double kSameSlice = 1e-3;

Vector3 moved(const Vector3& first, double length, const Vector3& way) {
  return {first[0] + length * way[0], first[1] + length * way[1], first[2] + length * way[2]};
}

/// The places first + n * step along the normal, for all whole n.
struct Lattice {
  double first = 0;
  double step = 0;

  [[nodiscard]] double number(double place) const { return std::round((place - first) / step); }
  [[nodiscard]] double offset(double place) const { return place - (first + number(place) * step); }
  [[nodiscard]] bool has(double place) const { return std::abs(offset(place)) <= kSlack * step; }
};

using Places = std::vector<double>;

bool has_all(const Lattice& lattice, const Places& places) {
  return std::all_of(places.begin(), places.end(), [&](double p) { return lattice.has(p); });
}

/// Returns the lattice of this step that has as many places below it as above it.  The least place
/// stays on it where that makes no difference, so that the coordinates of exact files stay exact.
Lattice centred(const Places& sorted, double step) {
  Lattice out{sorted.front(), step};
  Places offsets;
  for (const double p : sorted) offsets.push_back(out.offset(p));
  const auto middle = offsets.begin() + static_cast<std::ptrdiff_t>(offsets.size() / 2);
  std::nth_element(offsets.begin(), middle, offsets.end());
  if (std::abs(*middle) > kSameSlice) out.first += *middle;
  return out;
}

/// Returns the step near `guess` with the least squares of all offsets, rounded to what coordinates
/// of 16 characters tell; 0: all places are one.
double fitted_step(const Places& sorted, double guess) {
  const auto count = static_cast<double>(sorted.size());
  double number = 0, numbers = 0, places = 0;
  std::vector<double> all;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i > 0) number += std::round((sorted[i] - sorted[i - 1]) / guess);
    all.push_back(number);
    numbers += number;
    places += sorted[i];
  }
  double products = 0, squares = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double n = all[i] - numbers / count;
    products += n * (sorted[i] - places / count);
    squares += n * n;
  }
  constexpr double kParts = 1e9;  // of a mm
  return squares > 0 ? std::round(kParts * products / squares) / kParts : 0;
}

/// Returns the lattice of a step that the file states, or of one that it may have been rounded
/// from.
std::optional<Lattice> stated_lattice(const Places& sorted, double said) {
  if (!(said > 0)) return std::nullopt;
  const Lattice exact = centred(sorted, said);
  if (has_all(exact, sorted)) return exact;
  const double fitted = fitted_step(sorted, said);
  if (!(std::abs(fitted - said) <= kRoundedSpacing * said)) return std::nullopt;
  const Lattice near = centred(sorted, fitted);
  return has_all(near, sorted) ? std::optional(near) : std::nullopt;
}

/// Returns the distances of slices that follow each other, the least first.
Places gaps_of(const Places& sorted, const DicomGrid& grid) {
  double least = std::min(grid.row_spacing, grid.column_spacing);
  for (const double said : {grid.slice_spacing, grid.slice_thickness}) {
    if (said > 0) least = std::min(least, said);
  }
  const double same = std::max(kSameSlice, kSlack * least);
  Places gaps;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double gap = sorted[i] - sorted[i - 1];
    if (gap > same) gaps.push_back(gap);
  }
  std::sort(gaps.begin(), gaps.end());
  return gaps;
}

std::size_t places_off(const Lattice& lattice, const Places& places) {
  return static_cast<std::size_t>(
      std::count_if(places.begin(), places.end(), [&](double p) { return !lattice.has(p); }));
}

/// Returns the lattice of the places, or the one that most of them are on if there is none.
Lattice lattice_of(const Places& sorted, const DicomGrid& grid) {
  const Places gaps = gaps_of(sorted, grid);
  const double said = grid.slice_spacing, thickness = grid.slice_thickness;
  if (const auto found = stated_lattice(sorted, said)) return *found;
  if (gaps.empty()) return centred(sorted, thickness > 0 ? thickness : grid.column_spacing);
  if (std::abs(gaps.front() - thickness) <= 2 * kSlack * thickness) {
    if (const auto found = stated_lattice(sorted, thickness)) return *found;
  }
  const Lattice usual = centred(sorted, fitted_step(sorted, gaps[(gaps.size() - 1) / 2]));
  if (!(said > 0) || has_all(usual, sorted)) return usual;
  const Lattice stated = centred(sorted, said);
  return places_off(stated, sorted) <= places_off(usual, sorted) ? stated : usual;
}

[[noreturn]] void fail_slices(const std::string& file, const std::string& what) {
  fail_input(file, "Image Position (Patient)", text("the slices ", what),
             "export them on one grid of equal steps, for instance with 3D Slicer");
}

/// Returns a length in mm as errors show it.
double shown(double length) {
  constexpr double kParts = 10000;
  return std::round(kParts * length) / kParts;
}

void check_steps(const Places& places, const Lattice& lattice, const std::string& file) {
  constexpr std::size_t kMostNamed = 5;
  std::string frames;
  std::size_t off = 0;
  double most = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (lattice.has(places[i])) continue;
    if (off++ < kMostNamed) frames += text(off == 1 ? "" : ", ", i + 1);
    most = std::max(most, std::abs(lattice.offset(places[i])));
  }
  if (off == 0) return;
  if (off > kMostNamed) frames += text(" and ", off - kMostNamed, " more");
  fail_slices(file,
              text("are not multiples of a step apart: for steps of ", shown(lattice.step), " mm, ",
                   off == 1 ? "frame " : "frames ", frames, off == 1 ? " is" : " are", " off by ",
                   off == 1 ? "" : "up to ", shown(most), " mm"));
}

}  // namespace

SliceGrid::SliceGrid(const DicomSegments& dicom, const std::string& file)
    : normal_(cross(dicom.grid.along_row, dicom.grid.along_column)) {
  Places places;
  for (const DicomFrame& f : dicom.frames) places.push_back(dot(normal_, f.first));
  Places sorted = places;
  std::sort(sorted.begin(), sorted.end());
  const Lattice lattice = lattice_of(sorted, dicom.grid);
  step_ = lattice.step;
  if (!(step_ > 0) || !((sorted.back() - sorted.front()) / step_ < kMostSlices)) {
    fail_slices(file, "are too far from each other");
  }
  check_steps(places, lattice, file);
  const double lowest = lattice.number(sorted.front());
  for (const double p : places) slices_.push_back(std::llround(lattice.number(p) - lowest));
  count_ = 1 + *std::max_element(slices_.begin(), slices_.end());
  first_ = moved(dicom.frames[0].first, lattice.first + lowest * step_ - places[0], normal_);
  check_beside(dicom, file);
}

void SliceGrid::check_beside(const DicomSegments& dicom, const std::string& file) const {
  const double least = std::min(dicom.grid.row_spacing, dicom.grid.column_spacing);
  for (std::size_t i = 0; i < slices_.size(); ++i) {
    const Vector3 way = minus(dicom.frames[i].first, first_);
    const Vector3 beside = moved(way, -dot(normal_, way), normal_);
    if (dot(beside, beside) <= kSlack * kSlack * least * least) continue;
    fail_slices(file, text("do not lie behind each other: frame ", i + 1, " is ",
                           shown(std::sqrt(dot(beside, beside))), " mm beside frame 1"));
  }
}

std::int64_t SliceGrid::empty() const {
  std::vector<std::int64_t> sorted = slices_;
  std::sort(sorted.begin(), sorted.end());
  const auto different = std::unique(sorted.begin(), sorted.end()) - sorted.begin();
  return count_ - static_cast<std::int64_t>(different);
}

}  // namespace mw::io
